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
    cores=$(nproc)
    kilobytes=$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo)
    by_memory=$((${kilobytes:-1500000} / 1500000))
    [ "$by_memory" -ge 1 ] || by_memory=1
    echo "$((cores < by_memory ? cores : by_memory))"
}
