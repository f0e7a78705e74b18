#!/usr/bin/env python3
"""Runs the tests of faults and prints docs/faults.md: RAILWAVE_BIN_DIR=build/release/bin tests/output/faults_table.py >
docs/faults.md"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
HEAD = """# What goes wrong outside, and what Railwave says

Each row is a fault that a test brings about (`tests/output/test_faults_disk.py`, `test_faults_run.py`, \
`test_signals.py`, `test_standard_output.py`), with what the program then said and how it
ended; made by `tests/output/faults_table.py`. After each, what was there before is there still, and no half-written \
file is left; results that a
fault ended are as they were flushed last, and `railwave run CASE --restart` goes on from the last checkpoint. How \
that is done and what
kills leave: [restart.md](restart.md). Messages to a run that goes on are warnings, reported at once on stderr.

| fault | exit code | message |
|---|---|---|"""


def main():
    with tempfile.TemporaryDirectory() as folder:
        rows = pathlib.Path(folder) / "rows"
        codes = [
            subprocess.run(
                [sys.executable, "-B", HERE / name], env=dict(os.environ, RAILWAVE_FAULTS=str(rows)), stdout=sys.stderr
            ).returncode
            for name in ("test_faults_disk.py", "test_faults_run.py", "test_signals.py", "test_standard_output.py")
        ]
        table = dict((row[0], row[1:]) for row in map(json.loads, rows.read_text().splitlines()))
    print(HEAD)
    for what, (code, text) in sorted(table.items()):
        print(f"| {what} | {code} | {text.replace('|', chr(92) + '|')} |")
    return max(codes)


if __name__ == "__main__":
    sys.exit(main())
