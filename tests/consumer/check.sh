#!/usr/bin/env bash
# A customer's project links the library and gets the bytes that this tree's own build gives.
# usage: check.sh BUILD COMPILER package|subdirectory
#   BUILD     a configured and built tree of the host, with semtrack-board-scene and semtrack-board-run
#   package   installs BUILD and finds it; subdirectory: takes the sources in, core alone
# Paths have blanks; the consumer's flags are -mavx2 -mfma -ffast-math where the machine can run them.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd)
compiler=$2
way=$3
work="$build/consumer of $compiler/by $way"
rm -rf "$work"
mkdir -p "$work"
exec 3>&1 >"$work/log" 2>&1
trap 'status=$?; [ "$status" -eq 0 ] || tail -n 20 "$work/log" >&3' EXIT

flags="-O3 -ffast-math"
if grep -qw avx2 /proc/cpuinfo && grep -qw fma /proc/cpuinfo; then
    flags="$flags -mavx2 -mfma"
fi
cp -r "$root/tests/consumer" "$work/my project"
cp -r "$root/tests/board" "$work/my project/board"
set -- -S "$work/my project" -B "$work/my build" -G Ninja "-DCMAKE_CXX_COMPILER=$compiler" "-DCMAKE_CXX_FLAGS=$flags" \
    "-DBOARD_SOURCE=$work/my project/board"
if [ "$way" = package ]; then
    cmake --install "$build" --prefix "$work/my prefix"
    cmake "$@" "-DCMAKE_PREFIX_PATH=$work/my prefix"
else
    mkdir "$work/our source"
    for part in CMakeLists.txt cmake include src; do # what the core alone is made of
        cp -r "$root/$part" "$work/our source/"
    done
    cmake "$@" "-DSEMTRACK_SOURCE=$work/our source"
fi
cmake --build "$work/my build"
# The consumer's objects stand before the archive, as in most link lines.
ninja -C "$work/my build" -t commands consumer | grep -E 'consumer.cpp.o .*libsemtrack\.a'
"$work/my build/receiving"
# The library's own code rounds after each operation, whatever the consumer's flags allow.
if [ "$way" = subdirectory ] && [ "${flags%-mfma}" != "$flags" ]; then
    fused='\sv?fn?m(add|sub)'
    echo 'double f(double a, double b, double c) { return a * b + c; }' >"$work/fused.cpp"
    "$compiler" -O2 -mfma -ffp-contract=fast -c "$work/fused.cpp" -o "$work/fused.o"
    objdump -d "$work/fused.o" | grep -Eq "$fused" || { echo "a planted fused operation is not seen"; exit 1; }
    find "$work/my build" -name 'libsemtrack*.a' | grep .
    if find "$work/my build" -name 'libsemtrack*.a' -exec objdump -d {} + | grep -E "$fused"; then
        exit 1
    fi
fi

scene="$work/scene.bin"
"$build/bin/semtrack-board-scene" "$scene"
own=$("$build/bin/semtrack-board-run" "$scene")
theirs=$("$work/my build/consumer" "$scene")
printf '  own build %s\n  consumer  %s (%s)\n' "$own" "$theirs" "$compiler $flags, $way" >&3
[ "$own" = "$theirs" ]
