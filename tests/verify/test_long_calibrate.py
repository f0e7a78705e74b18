#!/usr/bin/env python3
"""scripts/calibrate on three sleepers: the target is the model's own accelerance with other values, which it finds
again."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import numpy  # noqa: F401
except ImportError:
    sys.exit(77)

SOURCE = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
PROGRAM = os.path.join(os.environ["RAILWAVE_BIN_DIR"], "railwave")
CASE = str(SOURCE / "cases" / "calibrate_track.toml")
SMALL = ["tracks.track.start=-0.9", "tracks.track.end=0.9", "tracks.track.first_sleeper=-0.6", "time.end=0.01"]
EXACT = {"vertical_stiffness": 150e6, "vertical_damping": 90e3}

with tempfile.TemporaryDirectory(prefix="railwave-") as place:
    folder = pathlib.Path(place)
    small = [word for text in SMALL for word in ("--set", text)]
    subprocess.run(
        [
            PROGRAM, "run", CASE, *small, "--set",
            "sleepers.concrete.fastening_stiffness=[100e6, 100e6, 150e6]",
            "--set",
            "sleepers.concrete.fastening_damping=[40e3, 40e3, 90e3]",
            "--set", f"output.file={folder / 'target.h5'}",
        ],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    subprocess.run(
        [
            PROGRAM, "frf", str(folder / "target.h5"), "--response", "blow", "--window", "exponential", "--from", "50",
            "--to", "3000", "--csv", str(folder / "target.csv"),
        ],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    done = subprocess.run(
        [
            sys.executable, "-B", str(SOURCE / "scripts" / "calibrate"), str(folder / "target.csv"), "--case", CASE,
            "--program", PROGRAM, "--fit", ",".join(EXACT), "--from", "100", *small,
        ],
        check=False, capture_output=True, text=True,
    )
print(done.stdout, done.stderr)
failed = done.returncode != 0
for name, exact in EXACT.items():
    line = re.search(rf"^{name} +(\S+) +(\S+)", done.stdout, re.M)
    off = abs(float(line.group(2)) / exact - 1) if line else float("inf")
    print(f"{name}: {100 * off:.2f} % off")
    failed = failed or not off < 0.02
sys.exit(1 if failed else 0)
