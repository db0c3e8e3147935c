# The ARM targets: set-up, sysroots, tests under emulation. Sourced by ./test after common.sh.
target_packages="g++-aarch64-linux-gnu g++-arm-linux-gnueabihf gcc-arm-none-eabi libnewlib-arm-none-eabi
libstdc++-arm-none-eabi-newlib qemu-user qemu-system-arm user-mode-linux can-utils cpio kmod iproute2"

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
    build "$2" -DSEMTRACK_UNITY=ON semtrack_core_tests semtrack-sil test_sil_world
    run_tests "$2" -L core
    step "tests: $2, WorldBytes"
    ctest --test-dir "build/$2" --output-on-failure --no-tests=error -R '^WorldBytes\.' >"build/$2-world.log" 2>&1 || {
        tail -n 20 "build/$2-world.log"
        finish 1 "FAILED: WorldBytes of $2"
    }
}

# count_instructions PRESET...: of a frame and its stages under qemu-user, against docs/budgets.md, as a customer builds
# with the preset: the tests' build compiles layers together, which changes the counts.
count_instructions() {
    local preset dir version scene=build/instructions.scene plugin=build/count_stages.so
    build host-release semtrack-budget-scene
    build/host-release/bin/semtrack-budget-scene street "$scene" 10 || finish 1 "FAILED: scene of the counts"
    gcc -O2 -Wall -Wextra -Werror -shared -fPIC tests/budget/count_stages.c -o "$plugin" || finish 1 "FAILED: plugin"
    for preset in "$@"; do
        dir=build/count-$preset
        step "gate: instructions, $preset"
        { cmake --preset "$preset" -B "$dir" && cmake --build "$dir" --target semtrack-count-run; } >"$dir.log" 2>&1 ||
            finish 1 "FAILED: build $dir (whole log: $dir.log)"
        version=$(sed -n 's/^set(CMAKE_CXX_COMPILER_VERSION "\(.*\)")/\1/p' "$dir"/CMakeFiles/*/CMakeCXXCompiler.cmake)
        set -- . "$preset" "g++ $version" "$dir/bin/semtrack-count-run" "$scene" \
            "$plugin" "${SEMTRACK_SYSROOT:-build/sysroot}"
        python3 tests/gates/check_instructions.py "$@" || finish 1 "FAILED: instructions of $preset"
        python3 tests/gates/check_instructions.py "$@" --plant || finish 1 "FAILED: planted instructions of $preset"
    done
}

# on_board IMAGE: what a bare Cortex-M7 prints.
on_board() {
    timeout 300 qemu-system-arm -M mps2-an500 -display none -monitor none -serial none \
        -semihosting-config enable=on,target=native -kernel "$1" 2>&1
}

# board_image: the core on a bare Cortex-M7 prints the hash that the host prints.
board_image() {
    local scene=$PWD/build/board/scene.bin host board
    build host-release semtrack-board-scene semtrack-board-run
    mkdir -p build/board
    build/host-release/bin/semtrack-board-scene "$scene" || finish 1 "FAILED: scene of the board"
    step "configure and build: cortex-m7"
    if ! { cmake --preset cortex-m7 -DSEMTRACK_UNITY=ON -DSEMTRACK_BOARD_SCENE="$scene" &&
        cmake --build --preset cortex-m7; } >build/cortex-m7.log 2>&1; then
        grep -E 'error|FAILED' build/cortex-m7.log | head -n 20
        finish 1 "FAILED: build cortex-m7 (whole log: build/cortex-m7.log)"
    fi
    step "board: Cortex-M7"
    host=$(build/host-release/bin/semtrack-board-run "$scene")
    board=$(on_board build/cortex-m7/bin/semtrack-board.elf)
    printf '  host       %s\n  Cortex-M7  %s\n' "$host" "$board"
    case $board in
    "$host
stack "*) ;;
    *) finish 1 "FAILED: the board's CAN frames are not the host's" ;;
    esac
}

# sil_build NAME COMPILER FLAGS...: semtrack-sil alone, in build/NAME.
sil_build() {
    local dir=build/$1 compiler=$2
    shift 2
    step "configure and build: $dir ($compiler $*)"
    if ! { cmake -S . -B "$dir" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_CXX_FLAGS_RELEASE="$* -DNDEBUG" -DSEMTRACK_TESTS=OFF && cmake --build "$dir" --target semtrack-sil; } \
        >"$dir.log" 2>&1; then
        tail -n 20 "$dir.log"
        finish 1 "FAILED: build $dir (whole log: $dir.log)"
    fi
}

# back_to_back FRAMES BUILD...: each build's replay gives the bytes that host-release's gives. Images come from files.
back_to_back() {
    local frames=$1 drive=build/back_to_back/drive build name failed=0
    shift
    step "back to back: $frames frames; host-release against $*"
    rm -rf build/back_to_back
    mkdir -p build/back_to_back
    build/host-release/bin/semtrack-sil render --scenario street --layout odometry --frames $((frames + 4)) \
        --out "$drive" >/dev/null || finish 1 "FAILED: rendering"
    for build in host-release "$@"; do
        replay_for_comparison "$build" world --layout odometry --root "$drive" --sequence 00 \
            --detections "$drive/detections/00.txt" --first 4 --last $((frames + 3))
        if [ -d "${SEMTRACK_KITTI:-}/raw" ]; then
            replay_for_comparison "$build" 0039 --layout raw --root "$SEMTRACK_KITTI/raw" \
                --sequence 2011_09_26_drive_0039 --detections labels --first 100 --last $((frames + 99))
        fi
    done
    [ -d "${SEMTRACK_KITTI:-}/raw" ] || step "SKIPPED: drive 0039 (set SEMTRACK_KITTI)"
    for name in build/back_to_back/host-release-*/; do
        name=${name%/}
        python3 tests/targets/compare_runs.py --self-test "$name" || failed=1
        for build in "$@"; do
            python3 tests/targets/compare_runs.py "$name" "build/back_to_back/$build-${name##*host-release-}" || failed=1
        done
    done
    [ "$failed" -eq 0 ] || finish 1 "FAILED: back to back"
}

# replay_for_comparison BUILD NAME option...
replay_for_comparison() {
    local build=$1 name=$2 emulator=
    shift 2
    case $build in
    aarch64) emulator="qemu-aarch64 -L build/sysroot/arm64" ;;
    armv7) emulator="qemu-arm -L build/sysroot/armhf" ;;
    esac
    $emulator "build/$build/bin/semtrack-sil" replay "$@" --stages --no-progress \
        --out "build/back_to_back/$build-$name" >"build/back_to_back/$build-$name.log" 2>&1 || {
        tail -n 5 "build/back_to_back/$build-$name.log"
        finish 1 "FAILED: replay of $name by $build"
    }
}

# guests: what semtrack-sil publishes on SocketCAN, recorded in other kernels. A guest that does not get there fails.
guests() {
    local drive=$PWD/build/back_to_back/drive share=$PWD/build/guest/share uml=$PWD/build/guest/uml
    step "guest: arm64 kernel, vcan and two controllers"
    if ! tests/guest/make_image.sh build/guest/arm64 >build/guest-image.log 2>&1; then
        tail -n 20 build/guest-image.log
        finish 1 "FAILED: guest image (whole log: build/guest-image.log)"
    fi
    rm -rf "$share" "$uml"
    mkdir -p "$share" "$uml"
    cp -r "$drive" "$share/drive"
    cp tests/guest/publish.sh build/aarch64/bin/semtrack-sil "$share/"
    cp tests/guest/guest_vcan.sh "$share/guest.sh"
    guest_log arm64 tests/guest/run_guest.sh build/guest/arm64 "$share" "$PWD/build/sysroot/arm64" \
        -object can-bus,id=bus -device kvaser_pci,canbus=bus -device kvaser_pci,canbus=bus
    recorded "$share/vcan/can.log" "$share/vcan.dump"
    recorded "$share/controller/can.log" "$share/controller.dump"

    step "guest: User Mode Linux, vcan, a slow receiver, a full queue"
    build host-release semtrack-sil slcan_adapter
    guest_log uml tests/guest/run_uml.sh "$uml" tests/guest/uml_vcan.sh "$uml" build/host-release/bin/semtrack-sil "$drive"
    recorded "$uml/vcan/can.log" "$uml/vcan.dump"
    recorded "$uml/slow/can.log" "$uml/slow.dump"
    recorded "$uml/full/can.log" "$uml/full.dump"
    # Images from files: the guest would take a second to render each, and lists have to come ten times a second.
    build/host-release/bin/semtrack-sil render --scenario street --layout odometry --frames 100 --out "$uml/drive" \
        >/dev/null || finish 1 "FAILED: rendering"
    step "guest: User Mode Linux, a serial adapter: error-passive, bus-off, full queue, interface down"
    guest_log uml-faults tests/guest/run_uml.sh "$uml" tests/guest/uml_faults.sh "$uml" \
        build/host-release/bin/semtrack-sil build/host-release/bin/slcan_adapter "$uml/drive"
    # Stall, bus-off and interface down may cut one list each; 1.5 s without a reader leave out eight lists or more.
    recorded --disturbed 3 8 "$uml/faults/can.log" "$uml/adapter.log"
}

# guest_log NAME COMMAND...
guest_log() {
    local log=build/guest/$1.log status=0
    shift
    "$@" >"$log" 2>&1 || status=$?
    [ "$status" -eq 0 ] && return 0
    tail -n 20 "$log"
    case $status in
    124) finish 1 "FAILED: the guest took too long (whole log: $log)" ;;
    125) finish 1 "FAILED: the guest never got to the test (whole log: $log)" ;;
    *) finish 1 "FAILED: in the guest, status $status (whole log: $log)" ;;
    esac
}

recorded() { python3 tests/guest/check_recorded.py "$@" || finish 1 "FAILED: recorded frames"; }
