# 32-bit ARM Linux, hard float with NEON: Cortex-A7, A9 with NEON, A15.
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(semtrack_triple arm-linux-gnueabihf)
set(semtrack_debian_arch armhf)
set(semtrack_qemu qemu-arm)
set(semtrack_cpu_flags "-march=armv7-a+simd -mfloat-abi=hard -mtune=cortex-a15")
include(${CMAKE_CURRENT_LIST_DIR}/debian-linux.cmake)
