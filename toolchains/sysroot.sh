#!/bin/sh
# Makes the sysroot of a Linux target: C and C++ libraries, GoogleTest and what the SIL links.
# Usage: sysroot.sh arm64|armhf [DIR]    (DIR: default build/sysroot/ARCH, where toolchains/*.cmake look for it)
# A second run with the same packages returns at once.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
case ${1:-} in
arm64 | armhf) ;;
*)
    echo "usage: sysroot.sh arm64|armhf [DIR]" >&2
    exit 2
    ;;
esac
dir=${2:-$here/../build/sysroot/$1}
mkdir -p "$(dirname "$dir")"
# OpenCV's -dev packages alone: what they depend on is three times the rest.
exec "$here/unpack.sh" "$1" "$dir" libc6-dev libstdc++-12-dev libeigen3-dev libgtest-dev libpng-dev libcli11-dev \
    nlohmann-json3-dev libopencv-features2d406 =libopencv-core-dev =libopencv-features2d-dev =libopencv-imgproc-dev \
    =libopencv-flann-dev
