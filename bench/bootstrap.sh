# shellcheck shell=bash
# Sourced by tests/run and bench/run: finds what building needs, configures, builds. Expects `set -euo pipefail`.
# Once all packages are installed nothing here needs the network or root.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
build=$root/build

required_packages=(g++ cmake ninja-build pkg-config libtbb-dev libglm-dev libhwy-dev libopenimageio-dev libcli11-dev
    libfmt-dev nlohmann-json3-dev doctest-dev libbenchmark-dev)
optional_packages=(libembree-dev gnuplot-nox)  # a peer to measure against; charts in reports
sanitizer_packages=(clang libclang-rt-14-dev)

# Says what is going on, and how long it has been.
tell() {
    printf '[%d:%02d] %s\n' $((SECONDS / 60)) $((SECONDS % 60)) "$*" >&2
}

# Prints which of the given Debian packages are not installed.
missing_packages() {
    local package
    for package in "$@"; do
        [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || echo "$package"
    done
}

apt_install() {
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null
}

# Installs what is missing where that is possible, else says what to install and ends the script.
ensure_packages() {
    if ! command -v dpkg-query >/dev/null; then
        tell "not Debian or the like: packages are not checked; README names those of other systems"
        return
    fi
    local missing optional
    # Names have no blanks. Not < <(...): a fresh chroot has no /dev/fd.
    # shellcheck disable=SC2207
    missing=($(missing_packages "${required_packages[@]}")) optional=($(missing_packages "${optional_packages[@]}"))
    if ((${#missing[@]} > 0 && EUID != 0)); then
        echo "missing packages; as root: apt-get install ${missing[*]}" >&2
        exit 1
    fi
    if ((${#missing[@]} + ${#optional[@]} == 0)); then return; fi
    if ((EUID != 0)); then
        tell "going on without ${optional[*]}; to have it, as root: apt-get install ${optional[*]}"
        return
    fi
    tell "installing ${missing[*]} ${optional[*]}"
    apt-get update -qq >/dev/null || echo "apt-get update failed, trying with what is known" >&2
    if ((${#missing[@]} > 0)) && ! apt_install "${missing[@]}"; then
        echo "could not install: ${missing[*]}" >&2
        exit 1
    fi
    if ((${#optional[@]} > 0)) && ! apt_install "${optional[@]}"; then
        tell "going on without ${optional[*]}"
    fi
}

# Runs a command quietly: its output is shown only when it fails.
quietly() {
    local log status=0
    log=$(mktemp)
    "$@" >"$log" 2>&1 || status=$?
    if ((status != 0)); then cat "$log" >&2; fi
    rm -f "$log"
    return "$status"
}

# Configures build/ and builds the given targets.
build_targets() {
    ensure_packages
    tell "configuring $build"
    quietly cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo
    tell "building $*"
    NINJA_STATUS='[%f/%t %es] ' cmake --build "$build" --target "$@"
}
