#!/usr/bin/env bash
# Holds `railwave check` against the example decks of CalculiX that have 8-node hexahedra. They are free software under
# the GPL and so no part of this project: Debian's package calculix-ccx-test is fetched into a temporary folder, which
# is deleted afterwards. Needs no root.
#
#   tests/mesh_files/calculix_examples.sh [RAILWAVE]    RAILWAVE: the program, build/release/bin/railwave by default
#
# Exit code 0: each deck was read or refused with file and line, and those that must be read were; 1: not so;
# 77: the package can't be had here, nothing was tried.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR
. "$(dirname "${BASH_SOURCE[0]}")/../../scripts/lib/common.sh"
# shellcheck source-path=SCRIPTDIR
. "$project_root/scripts/lib/private_apt.sh"

package=calculix-ccx-test
railwave=${1:-$project_root/build/release/bin/railwave}

# Decks of hexahedra only, which must be read.
must_be_read=" beam8b beam8f beam8p beam8t changefric changesurfbeh contact1 contact3 contact6 contact7 contact8 \
contact9 contactenergy cubespring equrem1 equrem2 equrem3 fricloop friction1 friction2 hueeber1 hueeber2 hueeber3 \
hueeber4 oneel8ra scheibe2f2f scheibe2n2f sens_orien1 sensitivity_I sensitivity_V sensitivity_VI "

skip() {
    say "skipped: $*"
    exit 77
}

# Leaves the package's file in the current folder.
fetch_package() {
    apt-get -q -o "APT::Sandbox::User=$(id -un)" download "$package" >&2 && return
    say "the system's package lists don't have $package; reading Debian's into a private folder"
    private_apt_open "$package" deb && apt-get "${private_apt_options[@]}" download "$package" >&2 || return
    private_apt_close
}

[ -x "$railwave" ] || fail "there is no program $railwave; build it (scripts/run does) or give its path"
railwave=$(realpath "$railwave")
{ command -v apt-get && command -v dpkg-deb; } >/dev/null || skip "this needs Debian's apt-get and dpkg-deb"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fetch_package || skip "$package can't be had from Debian now"
dpkg-deb -x "$package"_*.deb package
examples=package/usr/share/doc/$package/examples/test
[ -d "$examples" ] || skip "$package has no examples where they used to be"
find "$examples" -name '*.inp.gz' -exec gunzip {} +

failures=0 read=0 refused=0
mapfile -t decks < <(grep -liE '^\*element *,.*type *= *c3d8[ri]?([ ,]|\s*$)' "$examples"/*.inp)
for deck in "${decks[@]}"; do
    name=$(basename "$deck" .inp)
    cat >case.toml <<EOF
title = "CalculiX example $name"
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.example]
type = "file"
path = "$deck"
[parts.example]
mesh = "example"
material = "steel"
[time]
end = 1e-9
EOF
    code=0
    "$railwave" check case.toml >output.txt 2>&1 || code=$?
    if [ "$code" -eq 0 ]; then
        echo "read     $name"
        read=$((read + 1))
    elif [ "$code" -eq 2 ] && grep -qE "$name\.inp:[0-9]+: " output.txt; then
        echo "refused  $(grep -E -m 1 "$name\.inp:[0-9]+: " output.txt | sed "s|.*/$name|$name|")"
        refused=$((refused + 1))
        case "$must_be_read" in
        *" $name "*)
            echo "         ... but it must be read"
            failures=$((failures + 1))
            ;;
        esac
    else
        echo "FAILED   $name, exit code $code:"
        sed 's/^/         /' output.txt
        failures=$((failures + 1))
    fi
done

# One of them, a bar of 4 x 4 x 16 elements, carries waves at the right speeds.
waves=$(dirname "$railwave")/test_verify
if [ -x "$waves" ]; then
    for name in beam8b; do
        if RAILWAVE_WAVE_MESH="$examples/$name.inp" OMP_PROC_BIND=false "$waves" '[others]' -s >output.txt 2>&1; then
            echo "waves    $name: $(grep -o 'speed / theory [0-9.]*' output.txt | paste -sd' ')"
        else
            echo "FAILED   waves in $name:"
            sed 's/^/         /' output.txt
            failures=$((failures + 1))
        fi
    done
fi
echo "$read read, $refused refused, $failures failures"
[ "$read" -gt 0 ] && [ "$failures" -eq 0 ]
