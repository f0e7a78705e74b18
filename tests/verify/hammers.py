"""What the tests of hammer tests share: cases as text, run and read as a user would."""
import csv
import pathlib
import subprocess
import sys

from figures import PROGRAM, conclude, failures, show  # noqa: F401

STEEL = """
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = {poissons_ratio}
density = 7800
"""


def run(folder, name, text):
    """Runs a case of that text; returns its results file."""
    case, results = pathlib.Path(folder) / f"{name}.toml", pathlib.Path(folder) / f"{name}.h5"
    case.write_text(text)
    done = subprocess.run(
        [PROGRAM, "run", str(case), "--set", f"output.file={results}"], check=False, capture_output=True, text=True
    )
    if done.returncode != 0:
        sys.exit(f"{done.stdout}\n{done.stderr}\n{case} did not run")
    return str(results)


def responses(results, *options):
    """{name of a response: [(frequency, accelerance)]} and what the command printed."""
    table = str(pathlib.Path(results[0]).with_suffix(".csv"))
    done = subprocess.run(
        [PROGRAM, "frf", *results, "--csv", table, *options], check=False, capture_output=True, text=True
    )
    if done.returncode != 0:
        sys.exit(done.stderr)
    found = {}
    with open(table, newline="") as file:
        for row in csv.DictReader(file):
            found.setdefault(row["response"], []).append(
                (float(row["frequency"]), complex(float(row["real"]), float(row["imaginary"])))
            )
    return found, done.stdout


def peaks(printed):
    """Frequencies and dampings (of critical) of the peaks that the command reported."""
    lines = [line.split() for line in printed.splitlines()]
    return [
        (float(words[1]), float(words[4]) / 100 if words[4] != "-" else None)
        for words in lines
        if words[:1] == ["peak"]
    ]
