# shellcheck shell=bash
# Catch2 3 for the tests. Debian 12 itself has Catch2 2; version 3 lies in its suite bookworm-backports, whose
# package is unpacked into .deps/catch2. An installed version 3 is used as it is.

catch2_ready() {
    local config
    [ -z "${Catch2_ROOT:-}" ] || return 0 # the user's own, which CMake looks at
    for config in "$deps_dir"/catch2/usr/lib/*/cmake/Catch2/Catch2Config.cmake \
        "$deps_dir"/catch2/usr/lib/cmake/Catch2/Catch2Config.cmake; do
        [ ! -f "$config" ] || return 0
    done
    for config in /usr/lib/*/cmake/Catch2 /usr/lib/cmake/Catch2 /usr/local/lib/cmake/Catch2; do
        [ ! -f "$config/Catch2ConfigVersion.cmake" ] ||
            ! grep -q 'PACKAGE_VERSION "3' "$config/Catch2ConfigVersion.cmake" || return 0
    done
    return 1
}

setup_catch2() {
    local candidate work="$deps_dir/catch2-download" packages
    # Debian 13 and later have version 3 in their main archive.
    candidate=$(apt-cache policy catch2 2>/dev/null | awk '/Candidate:/ {print $2}')
    if [ -n "$candidate" ] && [ "$candidate" != "(none)" ] && version_at_least "$candidate" 3; then
        install_packages catch2
        return
    fi
    rm -rf "$work" "$deps_dir/catch2"
    mkdir -p "$work"
    private_apt_open backports deb -backports ||
        fail "could not read Debian's backports, where Catch2 3 is. Name an installed one with Catch2_ROOT=FOLDER"
    say "downloading Catch2 3 from Debian's backports"
    (cd "$work" && apt-get "${private_apt_options[@]}" download libcatch2-dev >/dev/null) ||
        fail "Catch2 3 did not arrive. Name an installed one with Catch2_ROOT=FOLDER"
    packages=("$work"/libcatch2-dev_*.deb)
    dpkg-deb -x "${packages[0]}" "$work/root"
    mv "$work/root" "$deps_dir/catch2"
    rm -rf "$work"
    catch2_ready || fail "the package ${packages[0]##*/} holds no CMake files of Catch2"
}
