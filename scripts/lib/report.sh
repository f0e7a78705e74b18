# shellcheck shell=bash
# The page that `railwave report` fills: the sources in report/ and libraries from npm, bundled into one HTML file in
# build/report. The program finds it there.

report_folder="$project_root/build/report"
report_page="$report_folder/report.html"

# True when the page is there and no source of it is newer.
report_ready() {
    [ -f "$report_page" ] && [ -z "$(find "$project_root/report" -type f -newer "$report_page" -print -quit)" ]
}

# Prints the Debian packages with node and npm that are missing. Whoever has them from elsewhere keeps those.
packages_to_report() {
    if ! { command -v node && command -v npm; } >/dev/null; then printf '%s\n' nodejs npm; fi
}

# Fetches the libraries, in the versions of report/package-lock.json and with its checksums, and bundles. Returns 1,
# and says why, where that does not work: without it everything else does.
setup_report() {
    local log="$project_root/build/report.log" modules="$report_folder/node_modules"
    mkdir -p "$report_folder"
    if ! cmp -s "$project_root/report/package-lock.json" "$modules/.package-lock-of-report.json"; then
        say "fetching the libraries of reports from npm"
        cp "$project_root/report/package.json" "$project_root/report/package-lock.json" "$report_folder/"
        if ! (cd "$report_folder" && npm ci --ignore-scripts --no-audit --no-fund) >"$log" 2>&1; then
            tail -n 5 "$log" >&2
            say "npm could not fetch the libraries of reports; the whole log is build/report.log"
            return 1
        fi
        cp "$project_root/report/package-lock.json" "$modules/.package-lock-of-report.json"
    fi
    say "bundling the page of reports: build/report/report.html"
    if ! node "$project_root/report/build.mjs" "$modules" "$report_page" >"$log" 2>&1; then
        tail -n 20 "$log" >&2
        say "the page of reports could not be bundled; the whole log is build/report.log"
        return 1
    fi
}
