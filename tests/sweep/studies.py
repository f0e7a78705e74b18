"""A small study for tests: a block slides on a held one, with a friction and a speed of its own in each member."""

import csv
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
from two_blocks import STEEL, two_blocks  # noqa: E402, F401

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"

CASE = two_blocks(("[0.08, 0.08, 0.02]", "[6, 6, 2]"), ("[0.04, 0.04, 0.01]", "[4, 4, 2]"), "[0.02, 0.02, 0.02]") + """
[gravity]
acceleration = [0, 0, -1e5]
[initial_motion.slide]
parts = ["upper"]
velocity = [1, 0, 0]
[settle]
tolerance = 1e-3
[time]
end = 5e-5
[output]
history_interval = 1e-6
field_interval = 1e-5
history_sets = ["upper.z_max"]
"""

FIGURES = """
[figures]
area = "patch.between.area"
peak_shear = {of = "patch.between.peak_shear", take = "maximum"}
force = {of = "contact.between.normal_force.size", take = "mean", from = 1e-5}
heat = "energy.friction"
speed = "upper.z_max.velocity.x"
rattle = {of = "contact.between.normal_force.size", take = "frequency"}
"""

GRID = """
[grid]
contacts.between.friction = [0.2, 0.4]
"initial_motion.slide.velocity[0]" = [3, 4, 6]
"""


def write(folder, text=GRID + FIGURES, case=CASE):
    """Writes case.toml and study.toml; the sweep's own folder is OUT below."""
    (folder / "case.toml").write_text(case)
    study = folder / "study.toml"
    study.write_text(f'title = "blocks"\ncase = "case.toml"\nfolder = "{folder}/out"\n{text}')
    return study


def sweep(study, *options, **more):
    return subprocess.run(
        [PROGRAM, "sweep", study, "--no-pictures", *options], capture_output=True, text=True, cwd=study.parent, **more
    )


def rows(study):
    with open(study.parent / "out" / "sweep.csv", newline="") as file:
        return list(csv.DictReader(file))


def members(study):
    return sorted(path for path in (study.parent / "out" / "members").iterdir())


def leftovers(study):
    """Names of files that only a process at work should have."""
    return [
        path.name
        for path in (study.parent / "out").rglob("*")
        if path.name.endswith((".lock", ".previous")) or ".new" in path.name
    ]
