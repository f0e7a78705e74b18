# shellcheck shell=bash
# The Debian packages Railwave needs, and their installation.

packages_to_build=(
    cmake dpkg-dev g++ libcli11-dev libeigen3-dev libfmt-dev libhdf5-dev libspdlog-dev libtomlplusplus-dev
    make ninja-build pkg-config
)
packages_to_draw=(python3 python3-h5py python3-matplotlib)
packages_to_test=(python3 python3-h5py python3-matplotlib python3-vtk9)

# Prints those of the given packages that are not installed. A package is also there if another provides it.
missing_packages() {
    local installed package
    installed=" $(dpkg-query -W -f '${db:Status-Abbrev}|${Package} ${Provides}\n' |
        awk -F'|' '$1 ~ /^ii/ {gsub(/\([^)]*\)/, "", $2); gsub(/,/, " ", $2); print $2}' | tr -s ' \n' '  ') "
    for package in "$@"; do
        case "$installed" in
        *" $package "*) ;;
        *) echo "$package" ;;
        esac
    done
}

# Installs the given packages without what they merely recommend; fetches apt's lists only if they lack one.
install_packages() {
    say "installing Debian packages: $*"
    if ! apt-get install --simulate --no-install-recommends "$@" >/dev/null 2>&1; then
        as_root apt-get -q update >&2
    fi
    if ! as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y install --no-install-recommends "$@" >&2; then
        # The lists may be older than the archive, which then no longer has the files they name.
        as_root apt-get -q update >&2
        as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y install --no-install-recommends "$@" >&2 ||
            fail "apt-get could not install: $*"
    fi
}
