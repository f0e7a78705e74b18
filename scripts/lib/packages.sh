# shellcheck shell=bash
# The Debian packages Railwave needs, and their installation.

packages_to_build=(
    cmake dpkg-dev g++ libcli11-dev libeigen3-dev libfmt-dev libhdf5-dev libspdlog-dev libspectra-dev
    libtomlplusplus-dev ninja-build nlohmann-json3-dev pkg-config zlib1g-dev
)
# Pictures, and by scipy the exact contact solutions of scripts/verification.
packages_to_draw=(python3 python3-h5py python3-matplotlib python3-scipy)
# clang-format for the layout of sources; VTK for Python with its XDMF reader, which Debian's python3-vtk9 is built
# without; Chromium, in which reports are opened.
packages_to_test=(chromium chromium-driver clang-format python3-paraview python3-selenium)
# Runs over several processes: MPI; METIS, which deals elements out to them; ssh, without which mpirun starts nothing,
# not even on one machine.
packages_for_ranks=(libmetis-dev libopenmpi-dev openmpi-bin openssh-client)
# The Python module.
packages_for_python=(pybind11-dev python3-dev python3-numpy)
# scripts/hip: AMD's compiler with its runtime's headers, and clang's OpenMP of the same version.
packages_for_hip=(hipcc libomp-15-dev)
# studies/vehicle: multibody dynamics (6 MB to fetch).
packages_for_simbody=(libsimbody-dev)
# The site of docs/: mkdocs, its theme, formulas, and the drawing of libraries.
packages_for_site=(graphviz libjs-katex mkdocs mkdocs-material)
# What hands sweeps over to many machines, here with controller and node on one, for its tests.
packages_for_schedulers=(munge slurm-wlm snakemake)
# libFuzzer and what reads its coverage.
packages_to_fuzz=(
    clang cmake libclang-rt-dev libcli11-dev libeigen3-dev libfmt-dev libspdlog-dev libspectra-dev libtomlplusplus-dev
    llvm ninja-build nlohmann-json3-dev
)

# Prints those of the given packages that are not installed. A package is also there if another provides it.
missing_packages() {
    local installed package
    installed=" $(dpkg-query -W -f '${db:Status-Abbrev}|${Package} ${Provides}\n' |
        awk -F'|' '$1 ~ /^ii/ {gsub(/\([^)]*\)/, "", $2); gsub(/,/, " ", $2); print $2}' | tr -s ' \n' '  ') "
    # The two shut each other out, and nothing of the user's is removed: with python3-vtk9 the test of the XDMF
    # companion is skipped, and says so.
    installed=${installed/ python3-vtk9 / python3-vtk9 python3-paraview }
    for package in "$@"; do
        case "$installed" in
        *" $package "*) ;;
        *) echo "$package" ;;
        esac
    done
}

# Installs the given packages without what they merely recommend; fetches apt's lists only if they lack one or are
# older than the archive. Never removes a package. apt's own words go to .deps/apt.log, and to the terminal when it
# fails.
install_packages() {
    local log="$deps_dir/apt.log"
    mkdir -p "$deps_dir"
    : >"$log"
    say "installing Debian packages, and those they need: $*"
    if ! apt-get install --simulate --no-install-recommends "$@" >>"$log" 2>&1; then
        as_root apt-get -q update >>"$log" 2>&1 || true # the installation below tells whether it mattered
    fi
    if ! apt_install "$@" >>"$log" 2>&1; then
        as_root apt-get -q update >>"$log" 2>&1 || true
        if ! apt_install "$@" >>"$log" 2>&1; then
            tail -n 30 "$log" >&2
            fail "apt-get could not install: $*"
        fi
    fi
}

apt_install() {
    as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get -q -y -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=120 install --no-install-recommends --no-remove "$@"
}
