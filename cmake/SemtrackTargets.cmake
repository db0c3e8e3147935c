# Compile options of the project's own targets. Determinism lives here, on the targets, not in toolchain files:
# it has to hold under a plain `cmake -DCMAKE_CXX_FLAGS=...` with any compiler and any -O.
include_guard(GLOBAL)

# Every target: language level and warnings.
add_library(semtrack_warnings INTERFACE)
target_compile_features(semtrack_warnings INTERFACE cxx_std_17)
target_compile_options(semtrack_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
                       -Wdouble-promotion -Wnon-virtual-dtor -Wold-style-cast -Wno-psabi)
if(SEMTRACK_WERROR)
  target_compile_options(semtrack_warnings INTERFACE -Werror)
endif()

# Every target that computes with floating point: the same bits with every compiler and on every target.
add_library(semtrack_determinism INTERFACE)
target_compile_options(semtrack_determinism INTERFACE -ffp-contract=off -fno-fast-math -fno-unsafe-math-optimizations)
# g++ 12 makes vfmaddsub of neighbouring sums and differences in spite of -ffp-contract=off (-O2 -march=x86-64-v3).
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|i[3-6]86)$")
  target_compile_options(semtrack_determinism INTERFACE -mno-fma)
endif()
target_link_libraries(semtrack_determinism INTERFACE semtrack_warnings)

# The core: no exceptions, no RTTI, no thread-safe statics (there are none).
add_library(semtrack_core_options INTERFACE)
target_compile_options(semtrack_core_options INTERFACE -fno-exceptions -fno-rtti -fno-threadsafe-statics)
target_link_libraries(semtrack_core_options INTERFACE semtrack_determinism)

# Whoever includes the public headers sees the same capacities as the core.
add_library(semtrack_capacity INTERFACE)
if(SEMTRACK_CAPACITY STREQUAL small)
  target_compile_definitions(semtrack_capacity INTERFACE SEMTRACK_CAPACITY_SMALL)
endif()

# semtrack_layer(NAME DIR [DEPENDS layer...]): one directory of the core as a static library semtrack_NAME.
# DEPENDS lists the layers below it; the gate tests/gates/layers checks the includes against the same direction.
function(semtrack_layer name dir)
  cmake_parse_arguments(arg "" "" "DEPENDS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${dir}/*.cpp ${CMAKE_CURRENT_SOURCE_DIR}/${dir}/*.hpp)
  set(has_code ${sources})
  list(FILTER has_code INCLUDE REGEX "\\.cpp$")
  if(has_code)
    add_library(semtrack_${name} STATIC ${sources})
    target_link_libraries(semtrack_${name} PRIVATE semtrack_core_options)
    set_target_properties(semtrack_${name} PROPERTIES UNITY_BUILD ${SEMTRACK_UNITY})
    set(scope PUBLIC)
    set_property(GLOBAL APPEND PROPERTY SEMTRACK_CORE_OBJECTS $<TARGET_OBJECTS:semtrack_${name}>)
  else()
    add_library(semtrack_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(semtrack_${name} ${scope} ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(semtrack_${name} ${scope} Eigen3::Eigen semtrack_capacity)
  foreach(layer IN LISTS arg_DEPENDS)
    target_link_libraries(semtrack_${name} ${scope} semtrack_${layer})
  endforeach()
endfunction()
