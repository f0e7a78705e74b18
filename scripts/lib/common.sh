# shellcheck shell=bash
# What every script here needs: where the project is, how to speak, how to fail, how to become root.

project_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
deps_dir="$project_root/.deps"

say() { printf 'railwave: %s\n' "$*" >&2; }

fail() {
    printf 'railwave: error: %s\n' "$*" >&2
    exit 1
}

# Runs a command as root: directly when we are, otherwise with sudo.
as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        fail "this needs root, and there is no sudo here. As root, run: $*"
    fi
}

# True when version $1 is at least $2, both in dotted numbers.
version_at_least() {
    [ "$(printf '%s\n%s\n' "$2" "$1" | sort -V | head -n 1)" = "$2" ]
}

# Number of compile jobs: one a core, but no more than memory allows at about 1.5 GB a job.
build_jobs() {
    local cores kilobytes by_memory
    if [ -n "${RAILWAVE_JOBS:-}" ]; then
        echo "$RAILWAVE_JOBS"
        return
    fi
    cores=$(nproc)
    kilobytes=$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo)
    by_memory=$((${kilobytes:-1500000} / 1500000))
    [ "$by_memory" -ge 1 ] || by_memory=1
    echo "$((cores < by_memory ? cores : by_memory))"
}

# build_preset PRESET TARGET: configures if that was never done, or without the tests that `all` needs, and builds.
# Quiet unless it takes work or fails.
build_preset() {
    local preset=$1 target=$2 folder="$project_root/build/$1" log="$project_root/build/$1.log"
    cd "$project_root" || return
    mkdir -p build
    if [ ! -f "$folder/build.ninja" ] || { [ "$target" = all ] && [ ! -d "$folder/tests" ]; }; then
        say "configuring build/$preset"
        if ! cmake --preset "$preset" >"$log" 2>&1; then
            tail -n 40 "$log" >&2
            fail "CMake did not get through; the whole log is build/$preset.log"
        fi
    fi
    say "building build/$preset ($target)"
    cmake --build --preset "$preset" -j "$(build_jobs)" --target "$target" >&2 || fail "the build failed"
}

# run_tests PRESET [arguments of ctest...]: the tests that the preset has built, side by side.
run_tests() {
    local preset=$1 jobs
    jobs=$(nproc)
    shift
    cd "$project_root" || return
    # Tests take one or two threads. Threads that wait awake would keep each other from a busy machine's processors.
    OMP_WAIT_POLICY=${OMP_WAIT_POLICY:-passive} ctest --preset "$preset" -j "$jobs" "$@"
}
