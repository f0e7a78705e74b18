#!/usr/bin/env python3
"""Mistakes as users make them, in case files: each is refused, or the run warns of it or stops, and the true cause is
named first. `--table` prints what docs/monitor.md shows."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy
except ImportError:
    sys.exit(77)

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
from two_blocks import two_blocks  # noqa: E402

CASE = two_blocks(([0.06, 0.05, 0.03], [6, 5, 3]), ([0.04, 0.04, 0.03], [5, 5, 4]), [0.01, 0.005, 0.03]) + """\
[curves.rise]
type = "cosine_ramp"
duration = 2e-4
[curves.measured]
type = "table"
points = [[0, 0], [1e-4, 1], [1, 1]]
[loads.press]
type = "pressure"
target = "upper.z_max"
pressure = 1e6
curve = "rise"
[time]
end = 2e-3
[output]
file = "results.h5"
history_interval = 2e-5
field_interval = 5e-4
field_sets = ["upper", "lower"]
fields = ["displacement", "stress"]
"""

INVERTED = """*NODE
1, 0, 0, 0
2, 0.01, 0, 0
3, 0.01, 0.01, 0
4, 0, 0.01, 0
5, 0, 0, 0.01
6, 0.01, 0, 0.01
7, 0.01, 0.01, 0.01
8, 0, 0.01, 0.01
*ELEMENT, TYPE=C3D8R, ELSET=ALL
1, 5, 6, 7, 8, 1, 2, 3, 4
"""

HELD_CORNER = """[loads.pull]
type = "nodal_force"
target = "upper.corner"
force = [0, 0, 4000]
[node_sets.corner]
part = "upper"
position = [0.05, 0.045, 0.06]
[constraints.side]
target = "upper.x_min"
fixed = ["x", "y", "z"]
"""

REFUSED, ENDED, STOPPED = 2, 0, 3

# What is wrong; what stands in place of what; exit code; what the first message must say (of a warning or fault: as its
# likely cause).
SEEDS = [
    (
        "a mesh in mm",
        {"size = [0.04, 0.04, 0.03]": "size = [40, 40, 30]"},
        None,
        r"elements of part upper are .* m across: see the lengths of meshes\.upper",
    ),
    (
        "Young's modulus in GPa",
        {"youngs_modulus = 210e9": "youngs_modulus = 210"},
        None,
        r"material steel .* waves of .*youngs_modulus \(Pa\)",
    ),
    ("density in g/cm3", {"density = 7800": "density = 7.8"}, None, r"material steel .* waves of .*density \(kg/m3\)"),
    (
        "yield stress in MPa",
        {"density = 7800": "density = 7800\nyield_stress = 500\ntangent_modulus = 21e9"},
        None,
        r"yields at 500 Pa: see materials\.steel",
    ),
    ("bodies that overlap", {"0.005, 0.03]": "0.005, 0.026]"}, None, r"begins with contact between pressed in"),
    (
        "pressure in other units, 1e6 times",
        {"pressure = 1e6": "pressure = 1e12"},
        STOPPED,
        r"load press strains the elements under it",
    ),
    (
        "a curve that jumps to 1e6",
        {'curve = "rise"': 'curve = "measured"', "[1e-4, 1], [1, 1]": "[1e-4, 1], [2e-4, 1e6], [1, 1]"},
        STOPPED,
        r"load press strains the elements under it",
    ),
    (
        "speed in mm/s",
        {"[time]": '[initial_motion.fall]\nparts = ["upper"]\nvelocity = [0, 0, -2000]\n[time]'},
        None,
        r"bodies begin with 2000 m/s: see initial_motion\.fall",
    ),
    (
        "contact springs too soft",
        {"friction = 0.3": "friction = 0.3\npenalty_scale = 1e-4", "pressure = 1e6": "pressure = 1e8"},
        None,
        r"springs of contact between .* too soft",
    ),
    (
        "no hourglass control",
        {
            'material = "steel"\nposition': 'material = "steel"\nhourglass_coefficient = 0\nposition',
            "[time]": HELD_CORNER + "[time]",
        },
        None,
        r"part upper has no hourglass control",
    ),
    (
        "nothing holds the lower block",
        {
            "[constraints.floor]": "[constraints.other]",
            '"lower.z_min"': '"upper.x_min"',
            'target = "upper.z_max"': 'target = "lower.z_max"',
            "pressure = 1e6": "pressure = 1e8",
            "end = 2e-3": "end = 4e-3",
        },
        None,
        r"nothing holds part lower",
    ),
    ("friction in per cent", {"friction = 0.3": "friction = 30"}, REFUSED, r"friction.* 30.* between 0 and 2"),
    ("step_scale above 1", {"[time]": "[time]\nstep_scale = 1.5"}, REFUSED, r"step_scale.* 1\.5.* at most 1"),
    (
        "a step three times the stable one",
        {"[time]": "[time]\nstep = 2e-6"},
        REFUSED,
        r"step = 2e-06 s is longer than the stable step",
    ),
    (
        "an element turned inside out",
        {'type = "box"\nsize = [0.04, 0.04, 0.03]\ndivisions = [5, 5, 4]': 'type = "file"\npath = "inverted.inp"'},
        REFUSED,
        r"inverted\.inp:11: element 1 is mirrored",
    ),
    ("a curve's value that is no number", {"[1e-4, 1]": "[1e-4, nan]"}, REFUSED, r"points.*nan"),
    (
        "Poisson's ratio of one half",
        {"poissons_ratio = 0.3": "poissons_ratio = 0.5"},
        REFUSED,
        r"poissons_ratio.* 0\.5",
    ),
]


def spoilt(changes):
    text = CASE
    for old, new in changes.items():
        assert old in text, old
        text = text.replace(old, new, 1)
    return text


def first_message(said):
    """Of a run: the likely cause that its first warning or fault names."""
    found = re.search(r"^(?:warning|FAULT): .*?likely cause: ([^\n]*)", said, re.MULTILINE)
    if found:
        return found.group(1).split("; or else: ")[0]
    return next((line for line in said.splitlines() if line.startswith("railwave: ")), "")


class SeededCases(unittest.TestCase):
    def run_seed(self, changes):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="railwave-")))
        (folder / "case.toml").write_text(spoilt(changes))
        (folder / "inverted.inp").write_text(INVERTED)
        run = subprocess.run(
            [PROGRAM, "run", "case.toml"],
            cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300, check=False,
        )
        return folder, run.returncode, run.stdout

    def check_fault_file(self, folder, said):
        """The last state is in the results, and the culprit's surroundings beside them."""
        with h5py.File(folder / "results.h5", "r") as results, h5py.File(folder / "results.fault.h5", "r") as fault:
            self.assertEqual(results.attrs["completed"], 0)
            self.assertIn(fault.attrs["fault"], said)
            self.assertEqual(results.attrs["reason"], fault.attrs["fault"])
            self.assertEqual(results["history/time"][-1], fault.attrs["time"])
            self.assertEqual(results["fields/upper/time"][-1], fault.attrs["time"])
            culprits = sum(int(numpy.sum(part["culprit"][()])) for part in fault["parts"].values())
            self.assertEqual(culprits, 1)
        self.assertIn("results.fault.h5:/parts/", (folder / "results.fault.xdmf").read_text())

    def test_all_are_named_with_the_true_cause_first(self):
        wrong = []
        for what, changes, code, pattern in SEEDS:
            with self.subTest(what):
                folder, ended, said = self.run_seed(changes)
                message = first_message(said)
                right = re.search(pattern, message) is not None
                if "--table" in sys.argv:
                    print(f"| {what} | {ended} | {message} |", flush=True)
                if not right:
                    wrong.append(f"{what}: {message}\n{said[:2000]}")
                self.assertNotEqual(message, "", said)
                self.assertIn(ended, (REFUSED, ENDED, STOPPED) if code is None else (code,), said)
                if ended == REFUSED:
                    self.assertFalse((folder / "results.h5").exists())
                elif ended == STOPPED:
                    self.check_fault_file(folder, said)
                else:
                    with h5py.File(folder / "results.h5", "r") as results:
                        self.assertEqual(results.attrs["completed"], 1)
                        self.assertTrue(any(message in str(line) for line in results.attrs["warnings"]))
        self.assertEqual("\n".join(wrong), "")

    def test_no_place_for_the_surroundings_of_a_fault(self):
        """That is reported before the run."""
        folder, ended, _ = self.run_seed({"pressure = 1e6": "pressure = 1e12"})
        self.assertEqual(ended, STOPPED)
        (folder / "results.fault.h5").unlink()
        (folder / "results.fault.h5").mkdir()
        (folder / "results.fault.h5" / "in the way").touch()
        run = subprocess.run(
            [PROGRAM, "run", "case.toml"], cwd=folder, capture_output=True, text=True, timeout=300, check=False
        )
        self.assertEqual(run.returncode, REFUSED)
        self.assertIn("results.fault.h5 is a folder", run.stderr)
        self.assertTrue((folder / "results.fault.h5" / "in the way").exists())
        with h5py.File(folder / "results.h5", "r") as results:
            self.assertIn("likely cause", results.attrs["reason"])

    def test_the_sound_case_brings_no_warning(self):
        _, ended, said = self.run_seed({})
        self.assertEqual(ended, 0, said)
        self.assertNotIn("warning", said)


if __name__ == "__main__":
    unittest.main(argv=[argument for argument in sys.argv if argument != "--table"])
