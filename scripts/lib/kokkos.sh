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

# Sets kokkos_source to the tree that the user names, or to Debian's, which is fetched once; and kokkos_version.
find_kokkos_source() {
    kokkos_source="$deps_dir/kokkos-source"
    if [ -n "${RAILWAVE_KOKKOS_SOURCE:-}" ]; then
        kokkos_source=$RAILWAVE_KOKKOS_SOURCE
        [ -f "$kokkos_source/CMakeLists.txt" ] || fail "RAILWAVE_KOKKOS_SOURCE=$kokkos_source is no Kokkos source tree"
    elif [ ! -f "$kokkos_source/CMakeLists.txt" ]; then
        fetch_kokkos_source "$kokkos_source"
    fi
    kokkos_version=$(kokkos_source_version "$kokkos_source")
    version_at_least "$kokkos_version" "$kokkos_minimum" ||
        fail "Kokkos $kokkos_version in $kokkos_source is too old, $kokkos_minimum is needed"
}

# With HIP, in .deps/kokkos-hip; its file built-from has source tree and architecture.
kokkos_hip_link="$deps_dir/kokkos-hip"
kokkos_hip_architecture=${RAILWAVE_HIP_ARCH:-VEGA908} # as Kokkos names it

kokkos_hip_ready() {
    [ "$(cat "$kokkos_hip_link/built-from" 2>/dev/null)" = \
        "${RAILWAVE_KOKKOS_SOURCE:-Debian trilinos} $kokkos_hip_architecture" ]
}

setup_kokkos_hip() {
    local build="$deps_dir/kokkos-hip-build" options=()
    find_kokkos_source
    mapfile -t options < <(kokkos_version_options "$kokkos_version")
    say "building Kokkos $kokkos_version with HIP ($kokkos_hip_architecture) and OpenMP into .deps/kokkos-hip"
    rm -rf "$kokkos_hip_link" "$build"
    build_kokkos "$kokkos_source" "$build" "$kokkos_hip_link" -DCMAKE_CXX_COMPILER=hipcc -DKokkos_ENABLE_HIP=ON \
        "-DKokkos_ARCH_$kokkos_hip_architecture=ON" "${options[@]}"
    echo "${RAILWAVE_KOKKOS_SOURCE:-Debian trilinos} $kokkos_hip_architecture" >"$kokkos_hip_link/built-from"
    rm -rf "$build" "$build.log"
}

setup_kokkos() {
    local source version prefix options=()
    if [ -z "${RAILWAVE_KOKKOS_SOURCE:-}" ] && find_installed_kokkos; then
        say "using the Kokkos in $(cat "$kokkos_system_mark")"
        return 0
    fi
    find_kokkos_source
    source=$kokkos_source version=$kokkos_version
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
