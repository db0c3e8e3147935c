# Shared by the Linux targets: Debian's cross compiler, a sysroot of toolchains/sysroot.sh, and qemu-user for tests.
# Set before: semtrack_triple, semtrack_debian_arch, semtrack_qemu, CMAKE_SYSTEM_PROCESSOR, semtrack_cpu_flags.
# SEMTRACK_SYSROOT in the environment names a folder of sysroots (default: build/sysroot of this tree).
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_C_COMPILER ${semtrack_triple}-gcc)
set(CMAKE_CXX_COMPILER ${semtrack_triple}-g++)
set(CMAKE_CXX_FLAGS_INIT "${semtrack_cpu_flags}")
set(CMAKE_LIBRARY_ARCHITECTURE ${semtrack_triple})

if(DEFINED ENV{SEMTRACK_SYSROOT})
  set(semtrack_sysroots $ENV{SEMTRACK_SYSROOT})
else()
  cmake_path(SET semtrack_sysroots NORMALIZE "${CMAKE_CURRENT_LIST_DIR}/../build/sysroot")
endif()
set(CMAKE_SYSROOT ${semtrack_sysroots}/${semtrack_debian_arch})
if(NOT IS_DIRECTORY ${CMAKE_SYSROOT})
  message(FATAL_ERROR "${CMAKE_SYSROOT} is missing: run toolchains/sysroot.sh ${semtrack_debian_arch}")
endif()
# The host's programs, the target's everything else.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
find_program(SEMTRACK_EMULATOR NAMES ${semtrack_qemu} ${semtrack_qemu}-static NO_CMAKE_FIND_ROOT_PATH)
if(SEMTRACK_EMULATOR)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${SEMTRACK_EMULATOR};-L;${CMAKE_SYSROOT})
endif()
