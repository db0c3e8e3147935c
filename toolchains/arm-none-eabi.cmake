# Bare metal, no operating system: the core alone (SEMTRACK_SIL=OFF SEMTRACK_TESTS=OFF). Cortex-M7 with double precision
# unless SEMTRACK_CPU says otherwise, e.g. "-mcpu=cortex-r52 -marm -mfloat-abi=hard".
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES SEMTRACK_CPU)
if(NOT SEMTRACK_CPU)
  set(SEMTRACK_CPU "-mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard" CACHE STRING "flags of the core")
endif()
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_CXX_FLAGS_INIT "${SEMTRACK_CPU} -ffunction-sections -fdata-sections")
# There is nothing to link a test program with before the board's own start-up code and linker script.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
# Eigen is headers only: the host's.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
