# shellcheck shell=bash
# Lets apt-get see more than the system's own settings show (source packages, the backports suite) without
# touching those settings: lists, cache and source entries of its own lie under .deps/apt. Needs no root.

# Prints "URI suite" of each of the system's entries that carries Debian's main archive for this release.
# apt itself is asked, so both formats of source entries are read; third parties' entries are left out by origin.
debian_archives() {
    local lists=$1 codename
    # shellcheck source=/dev/null
    codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
    # shellcheck disable=SC2016 # apt fills these in, not the shell
    apt-get ${lists:+-o "Dir::State::Lists=$lists"} indextargets \
        --format '$(ORIGIN)|$(CODENAME)|$(COMPONENT)|$(TRUSTED)|$(REPO_URI) $(RELEASE)' 'Created-By: Packages' |
        awk -F'|' -v codename="$codename" '$1 == "Debian" && $2 == codename && $3 == "main" && $4 == "yes" {print $5}' |
        sort -u
}

# private_apt_open NAME TYPE [SUITE_SUFFIX]: prepares private lists of the given type (deb or deb-src), for this
# release's main suite or, with a suffix (-backports), the suite of that name beside it. Sets private_apt_options.
private_apt_open() {
    local type=$2 suffix=${3:-} base="$deps_dir/apt/$1" keyring=/usr/share/keyrings/debian-archive-keyring.gpg
    local archives uri suite signed=""
    mkdir -p "$base/lists/partial" "$base/cache/archives/partial" "$base/sources.d" "$deps_dir/apt/system/partial"

    archives=$(debian_archives "")
    if [ -z "$archives" ]; then
        # The system's lists were never fetched or have been emptied, as container images do.
        apt-get -qq -o "Dir::State::Lists=$deps_dir/apt/system" -o "APT::Sandbox::User=$(id -un)" update >&2 || return 1
        archives=$(debian_archives "$deps_dir/apt/system")
    fi
    if [ -z "$archives" ]; then
        say "apt knows of no entry for Debian's main archive of this release"
        return 1
    fi

    [ ! -f "$keyring" ] || signed="[signed-by=$keyring] "
    while read -r uri suite; do
        # The main suite may be written as a name (bookworm) or a role (stable); both have suites beside them.
        echo "$type $signed$uri ${suite}${suffix} main"
    done <<<"$archives" >"$base/sources.d/debian.list"

    private_apt_options=(
        -qq
        -o "Dir::Etc::sourcelist=/dev/null"
        -o "Dir::Etc::sourceparts=$base/sources.d"
        -o "Dir::State::Lists=$base/lists"
        -o "Dir::Cache=$base/cache"
        -o "APT::Sandbox::User=$(id -un)"
    )
    say "reading the package lists of Debian ($type," \
        "$(awk '{print $(NF-1)}' "$base/sources.d/debian.list" | sort -u | tr '\n' ' '))"
    if ! apt-get "${private_apt_options[@]}" update >"$base/update.log" 2>&1; then
        # An archived suite or a frozen mirror keeps lists past their date. Their signatures are checked all the same.
        if grep -q 'expired' "$base/update.log" &&
            apt-get "${private_apt_options[@]}" -o Acquire::Check-Valid-Until=false update >&2; then
            say "these lists are past their date (an archived suite or a mirror that stands still);" \
                "taking them as they are"
            return 0
        fi
        cat "$base/update.log" >&2
        return 1
    fi
}

private_apt_close() { rm -rf "$deps_dir/apt"; }
