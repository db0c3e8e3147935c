# The ARM targets: set-up, sysroots, tests under emulation. Sourced by ./test after common.sh.
target_packages="g++-aarch64-linux-gnu g++-arm-linux-gnueabihf gcc-arm-none-eabi libnewlib-arm-none-eabi
libstdc++-arm-none-eabi-newlib qemu-user qemu-system-arm"

# Installs what the targets need as root. Fails, and says why, where that cannot be done: the parts are then skipped.
set_up_targets() {
    local missing
    missing=$(missing_packages "$target_packages")
    [ -n "$missing" ] || return 0
    if [ "$(id -u)" -ne 0 ]; then
        step "SKIPPED: ARM targets. Packages are missing: sudo apt-get install --no-install-recommends $missing"
        return 1
    fi
    if ! install_packages "$missing"; then
        step "SKIPPED: ARM targets. apt-get could not install $missing"
        return 1
    fi
}

# sysroot ARCH: the target's libraries, kept in build/sysroot.
sysroot() {
    step "sysroot: $1"
    mkdir -p build
    if ! toolchains/sysroot.sh "$1" >"build/sysroot-$1.log" 2>&1; then
        tail -n 20 "build/sysroot-$1.log"
        finish 1 "FAILED: sysroot of $1 (whole log: build/sysroot-$1.log)"
    fi
}

# target_tests ARCH PRESET: the core's tests under qemu-user, and the rendered worlds' hashes.
target_tests() {
    sysroot "$1"
    build "$2" semtrack_core_tests semtrack-sil test_sil_world
    run_tests "$2" -L core
    step "tests: $2, WorldBytes"
    ctest --test-dir "build/$2" --output-on-failure --no-tests=error -R '^WorldBytes\.' >"build/$2-world.log" 2>&1 || {
        tail -n 20 "build/$2-world.log"
        finish 1 "FAILED: WorldBytes of $2"
    }
}
