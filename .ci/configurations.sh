# Other ways to build and use the library: threads, other flags, the core alone, customers' projects. Sourced by ./test.

# threads: what runs on several threads, under the thread sanitizer.
threads() {
    build threads test_hal_linux test_pipeline semtrack-sil
    step "tests: threads"
    g++ -std=c++17 -O1 -fsanitize=thread tests/gates/planted_race.cpp -o build/planted_race
    ! build/planted_race >/dev/null 2>&1 || finish 1 "FAILED: the thread sanitizer does not see a planted race"
    { build/threads/bin/test_hal_linux --gtest_filter='ThreadExecutor.*' &&
        build/threads/bin/test_pipeline --gtest_filter='ParallelObjects.*' &&
        build/threads/bin/semtrack-sil replay --layout world --sequence street --detections labels --last 12 \
            --no-progress --workers 4 --out build/threads-run; } >build/threads-tests.log 2>&1 || {
        tail -n 40 build/threads-tests.log
        finish 1 "FAILED: thread sanitizer"
    }
}

# core_alone COMPILER LEVEL: the core as a customer builds it, with a compiler and Eigen; nothing else may be looked for.
core_alone() {
    local dir=build/core-alone-$1$2 package hidden=()
    step "core alone: $1 $2"
    for package in GTest PNG CLI11 nlohmann_json Threads benchmark Ceres Python3; do
        hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
    done
    if ! { cmake -S . -B "$dir" -G Ninja -DCMAKE_CXX_COMPILER="$1" -DCMAKE_CXX_FLAGS="$2" -DSEMTRACK_SIL=OFF \
        -DSEMTRACK_TESTS=OFF "${hidden[@]}" && cmake --build "$dir"; } >"$dir.log" 2>&1; then
        tail -n 30 "$dir.log"
        finish 1 "FAILED: core alone (whole log: $dir.log)"
    fi
}

# consumers: a customer's project takes the sources in, core alone, from a path with blanks.
consumers() {
    local compiler
    for compiler in g++ clang++; do
        step "consumer: sources by add_subdirectory, $compiler"
        tests/consumer/check.sh build/host-release "$compiler" subdirectory || finish 1 "FAILED: consumer"
    done
}

# without_emulator: a target's tests where no qemu is found are listed as skipped, and none is run.
without_emulator() {
    step "target's tests without an emulator"
    { cmake --preset aarch64 -B build/no-emulator -DSEMTRACK_EMULATOR= &&
        cmake --build build/no-emulator --target test_math test_model receiver_example &&
        ctest --test-dir build/no-emulator -R '^test_(math|model)$'; } >build/no-emulator.log 2>&1 &&
        [ "$(grep -c 'Skipped' build/no-emulator.log)" -ge 2 ] && ! grep -qi 'exec format' build/no-emulator.log || {
        tail -n 20 build/no-emulator.log
        finish 1 "FAILED: without an emulator (whole log: build/no-emulator.log)"
    }
}

# small_capacities: 8 objects and 256 features, in a street with 14 objects: whole, and the same on a bare board.
small_capacities() {
    local scene=$PWD/build/board/scene.bin host board
    step "small capacities: host and Cortex-M7"
    { cmake --preset sanitize -B build/small -DSEMTRACK_CAPACITY=small &&
        cmake --build build/small --target semtrack-board-run &&
        cmake --preset cortex-m7 -B build/cortex-m7-small -DSEMTRACK_CAPACITY=small -DSEMTRACK_BOARD_SCENE="$scene" &&
        cmake --build build/cortex-m7-small; } >build/small.log 2>&1 || {
        grep -E 'error|FAILED' build/small.log | head -n 20
        finish 1 "FAILED: small capacities (whole log: build/small.log)"
    }
    host=$(build/small/bin/semtrack-board-run "$scene") || finish 1 "FAILED: run with small capacities: $host"
    board=$(on_board build/cortex-m7-small/bin/semtrack-board.elf)
    printf '  host       %s\n  Cortex-M7  %s\n' "$host" "$board"
    case $board in
    "$host
stack "*) ;;
    *) finish 1 "FAILED: the board's CAN frames with small capacities are not the host's" ;;
    esac
    case $host in
    *" objects 8 "*) ;;
    *) finish 1 "FAILED: small capacities were not filled" ;;
    esac
}
