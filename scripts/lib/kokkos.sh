# shellcheck shell=bash
# Kokkos with OpenMP, in .deps/kokkos: an installed one is used where there is one, otherwise it is built from
# the source tree named by RAILWAVE_KOKKOS_SOURCE or from Debian's source package trilinos, which holds one.

kokkos_minimum=3.4
kokkos_link="$deps_dir/kokkos" # what CMake looks at
kokkos_system_mark="$deps_dir/kokkos-installed"

kokkos_ready() {
    if [ -n "${Kokkos_ROOT:-}" ]; then
        return 0 # the user's own, which CMake looks at
    elif [ -n "${RAILWAVE_KOKKOS_SOURCE:-}" ]; then
        [ -f "$kokkos_link/lib/cmake/Kokkos/KokkosConfig.cmake" ] &&
            [ "$(cat "$kokkos_link/built-from" 2>/dev/null)" = "$RAILWAVE_KOKKOS_SOURCE" ]
    elif [ -f "$kokkos_link/lib/cmake/Kokkos/KokkosConfig.cmake" ]; then
        return 0
    else
        # Noted by an earlier call that found an installed one; still there?
        [ -f "$kokkos_system_mark" ] && [ -f "$(cat "$kokkos_system_mark")/KokkosConfig.cmake" ]
    fi
}

# Asks CMake for an installed Kokkos with OpenMP, and notes where it is.
find_installed_kokkos() {
    local probe
    probe=$(mktemp -d)
    cat >"$probe/CMakeLists.txt" <<EOF
cmake_minimum_required(VERSION 3.16)
project(probe CXX)
find_package(Kokkos $kokkos_minimum CONFIG REQUIRED)
if(NOT Kokkos_ENABLE_OPENMP)
  message(FATAL_ERROR "without OpenMP")
endif()
file(WRITE "\${CMAKE_BINARY_DIR}/where" "\${Kokkos_DIR}")
EOF
    if cmake -S "$probe" -B "$probe/build" >/dev/null 2>&1; then
        mkdir -p "$deps_dir"
        cp "$probe/build/where" "$kokkos_system_mark"
        rm -rf "$probe"
        return 0
    fi
    rm -rf "$probe"
    return 1
}

# Unpacks packages/kokkos of Debian's trilinos to the folder $1.
fetch_kokkos_source() {
    local target=$1 work="$deps_dir/trilinos" tarball
    rm -rf "$work" "$target"
    mkdir -p "$work"
    private_apt_open source deb-src ||
        fail "could not reach Debian's source packages. Name a Kokkos source tree with RAILWAVE_KOKKOS_SOURCE=FOLDER"
    say "downloading Debian's source package trilinos, 170 MB (Kokkos is a part of it)"
    (cd "$work" && apt-get "${private_apt_options[@]}" source --download-only trilinos >/dev/null) ||
        fail "the source package trilinos did not arrive. Name a Kokkos source tree with RAILWAVE_KOKKOS_SOURCE=FOLDER"
    tarball=$(find "$work" -name 'trilinos_*.orig.tar.*' ! -name '*.asc' | head -n 1)
    [ -n "$tarball" ] || fail "the source package trilinos came without its tarball"
    mkdir -p "$target.partial"
    tar -xf "$tarball" -C "$target.partial" --strip-components=3 --wildcards '*/packages/kokkos/*'
    mv "$target.partial" "$target"
    rm -rf "$work"
}

kokkos_source_version() {
    awk 'tolower($0) ~ /^[ \t]*set *\( *kokkos_version_(major|minor|patch) / {
            gsub(/[^0-9]/, "", $2)
            v = v (v == "" ? "" : ".") $2
        }
        END {print v}' "$1/CMakeLists.txt"
}

# Prints the CMake arguments that this version of Kokkos needs.
kokkos_version_options() {
    # 4.6.99 came with a new View that crashes when default-constructed with g++ 12; the old one is still there.
    if version_at_least "$1" 4.6.99 && ! version_at_least "$1" 4.7.1; then
        echo -DKokkos_ENABLE_IMPL_VIEW_LEGACY=ON
    fi
}

# build_kokkos SOURCE BUILD PREFIX [CMake arguments...]
build_kokkos() {
    local source=$1 build=$2 prefix=$3
    shift 3
    if ! {
        cmake -S "$source" -B "$build" -G Ninja \
            -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_STANDARD=17 -DCMAKE_POSITION_INDEPENDENT_CODE=ON \
            -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib \
            -DKokkos_ENABLE_OPENMP=ON -DKokkos_ENABLE_SERIAL=ON "$@" &&
            cmake --build "$build" --target install -j "$(build_jobs)"
    } >"$build.log" 2>&1; then
        tail -n 40 "$build.log" >&2
        fail "Kokkos did not build; the whole log is $build.log"
    fi
}

setup_kokkos() {
    local source version prefix options=()
    if [ -n "${RAILWAVE_KOKKOS_SOURCE:-}" ]; then
        source=$RAILWAVE_KOKKOS_SOURCE
        [ -f "$source/CMakeLists.txt" ] || fail "RAILWAVE_KOKKOS_SOURCE=$source is no Kokkos source tree"
    else
        if find_installed_kokkos; then
            say "using the Kokkos in $(cat "$kokkos_system_mark")"
            return 0
        fi
        source="$deps_dir/kokkos-source"
        [ -f "$source/CMakeLists.txt" ] || fetch_kokkos_source "$source"
    fi
    version=$(kokkos_source_version "$source")
    version_at_least "$version" "$kokkos_minimum" ||
        fail "Kokkos $version in $source is too old, $kokkos_minimum is needed"
    mapfile -t options < <(kokkos_version_options "$version")

    prefix="$deps_dir/kokkos-$version"
    say "building Kokkos $version with OpenMP into ${prefix#"$project_root"/}"
    mkdir -p "$deps_dir"
    rm -rf "$prefix" "$deps_dir/kokkos-build"
    build_kokkos "$source" "$deps_dir/kokkos-build" "$prefix" "${options[@]}"
    echo "${RAILWAVE_KOKKOS_SOURCE:-Debian trilinos}" >"$prefix/built-from"
    ln -sfn "kokkos-$version" "$kokkos_link"
    rm -rf "$deps_dir/kokkos-build" "$deps_dir/kokkos-build.log"
}
