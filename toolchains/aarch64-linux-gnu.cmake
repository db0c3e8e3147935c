# 64-bit ARM Linux: Cortex-A53, A72 and everything later.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(semtrack_triple aarch64-linux-gnu)
set(semtrack_debian_arch arm64)
set(semtrack_qemu qemu-aarch64)
set(semtrack_cpu_flags "-march=armv8-a -mtune=cortex-a72")
include(${CMAKE_CURRENT_LIST_DIR}/debian-linux.cmake)
