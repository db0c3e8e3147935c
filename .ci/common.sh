# Shared by ./demo and ./test: set-up of a Debian 12 machine, and progress lines. Sourced, not run.
packages="g++ clang cmake ninja-build libeigen3-dev libopencv-core-dev libopencv-features2d-dev libgtest-dev libpng-dev
libcli11-dev nlohmann-json3-dev python3 python3-canmatrix binutils
libbenchmark-dev valgrind"

started=$(date +%s)

step() { printf '[%4ds] %s\n' "$(($(date +%s) - started))" "$*"; }

# finish STATUS TEXT: the clear last line.
finish() {
    step "$2"
    exit "$1"
}

# missing_packages LIST
missing_packages() {
    local package
    for package in $1; do
        dpkg-query -W -f '${Status}\n' "$package" 2>/dev/null | grep -q 'install ok installed' || printf '%s ' "$package"
    done
}

# install_packages LIST: as root; shows apt's last lines when it fails.
install_packages() {
    step "set-up: installing $1"
    local log
    log=$(mktemp)
    if ! { apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $1; } \
        >"$log" 2>&1; then
        tail -n 20 "$log"
        rm -f "$log"
        return 1
    fi
    rm -f "$log"
}

# Installs what is missing as root; otherwise says exactly what to install and stops.
set_up() {
    local missing
    missing=$(missing_packages "$packages")
    if [ -z "$missing" ]; then
        step "set-up: all packages are there"
        return 0
    fi
    if [ "$(id -u)" -ne 0 ]; then
        echo "These Debian packages are missing. Install them and start again:"
        echo "    sudo apt-get install --no-install-recommends $missing"
        finish 1 "FAILED: packages are missing"
    fi
    install_packages "$missing" || finish 1 "FAILED: apt-get could not install the packages above"
}

# build PRESET [-DOPTION=VALUE...] [TARGET...]
build() {
    local preset=$1 options=()
    shift
    while [[ ${1:-} == -D* ]]; do
        options+=("$1")
        shift
    done
    step "configure and build: $preset"
    mkdir -p build
    local log=build/$preset.log
    if ! cmake --preset "$preset" "${options[@]}" >"$log" 2>&1; then
        tail -n 30 "$log"
        finish 1 "FAILED: configure $preset (whole log: $log)"
    fi
    if ! cmake --build --preset "$preset" ${@:+--target "$@"} >>"$log" 2>&1; then
        grep -E 'error|FAILED' "$log" | head -n 20
        finish 1 "FAILED: build $preset (whole log: $log)"
    fi
}
