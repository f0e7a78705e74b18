#!/usr/bin/env python3
"""The default hourglass control takes under 2 % in the scenes of scripts/hourglass_table, and what the watch advises about a large share of hourglass
energy makes that share smaller: each advice is followed."""

import os
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy  # noqa: F401
except ImportError:
    sys.exit(77)

SOURCE, PROGRAM = os.environ["RAILWAVE_SOURCE_DIR"], os.path.join(os.environ["RAILWAVE_BIN_DIR"], "railwave")
sys.path.insert(0, os.path.join(SOURCE, "scripts"))
import hourglass.scenes as scenes  # noqa: E402

CASES = os.path.join(SOURCE, "benchmarks", "cases", "hourglass")
SAID = r"hourglass energy of a part, .*?; likely cause: (.*?)(?: \(worst .*)?\n"
NAMED = {"refine": "meshes.beam.divisions=[40,4,4]"}


def control(parts, **values):
    return [f"parts.{part}.{key}={value}" for part in parts for key, value in values.items()]


def run(case, overrides):
    """What the program said, and the results' energies by name."""
    with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
        command = [PROGRAM, "run", os.path.join(CASES, case)]
        for override in [*overrides, f"output.file={folder}/results.h5"]:
            command += ["--set", override]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        assert done.returncode == 0, done.stdout
        with h5py.File(f"{folder}/results.h5", "r") as file:
            return done.stdout, {name: values[:] for name, values in file["history/energy"].items()}


def share(said):
    """The worst that the watch saw of any part."""
    return float(re.search(r"hourglass_share (\S+) \(", said).group(1))


def lost(energy):
    """In hourglass control, of the energy given."""
    given = energy["kinetic"][0] + energy["external_work"].max()
    return (energy["hourglass"] - energy["hourglass_stored"])[-1] / given


class Default(unittest.TestCase):
    def test_it_takes_under_two_per_cent(self):
        for name in ("drop, 10 mm", "drop, 5 mm", "bars", "beam swings, 2 thick", "beam bent, 2 thick"):
            scene = scenes.SCENES[name]
            with self.subTest(name):
                _, energy = run(os.path.basename(scene.case), [override for override in scene.overrides if not override.startswith("output")])
                self.assertLess(lost(energy), 0.02)
                self.assertGreaterEqual(lost(energy), -1e-9)

    def test_a_dropped_box_keeps_what_viscous_control_took(self):
        _, viscous = run("drop.toml", control(("upper", "lower"), hourglass="viscous"))
        _, default = run("drop.toml", [])
        self.assertGreater(lost(viscous), 0.1)
        self.assertLess(default["hourglass"][-1] / default["kinetic"][0], 0.02)
        self.assertGreater(default["kinetic"][-1], viscous["kinetic"][-1])


class Advice(unittest.TestCase):
    def advised(self, case, overrides):
        """The share, and what is advised."""
        said, _ = run(case, overrides)
        found = re.search(SAID, said)
        self.assertIsNotNone(found, said)
        return share(said), found.group(1)

    def test_of_viscous_control_is_the_default_and_no_higher_coefficient(self):
        before, advice = self.advised("drop.toml", control(("upper", "lower"), hourglass="viscous"))
        self.assertNotIn("raise", advice)
        part, kind = re.search(r'set parts\.(\w+)\.hourglass = "(\w+)"', advice).groups()
        self.assertIn(part, ("upper", "lower"))
        after, _ = run("drop.toml", control(("upper", "lower"), hourglass=kind))
        self.assertLess(share(after), 0.5 * before)

    def test_of_a_coefficient_of_ones_own_goes_with_it(self):
        _, advice = self.advised("drop.toml", control(("upper", "lower"), hourglass="viscous", hourglass_coefficient=0.3))
        self.assertIn("without the hourglass_coefficient", advice)

    def test_of_stiff_control_is_a_lower_coefficient_or_a_finer_mesh(self):
        stiff = control(("beam",), hourglass="stiffness", hourglass_coefficient=0.25)
        before, advice = self.advised("beam.toml", stiff)
        self.assertIn("refine it there", advice)
        lower = float(re.search(r"lower parts\.beam\.hourglass_coefficient \(0\.25\) to (\S+)", advice).group(1))
        lowered, _ = run("beam.toml", control(("beam",), hourglass="stiffness", hourglass_coefficient=lower))
        self.assertLess(share(lowered), 0.5 * before)
        refined, _ = run("beam.toml", [*stiff, NAMED["refine"]])
        self.assertLess(share(refined), 0.5 * before)

    def test_of_much_viscosity_is_less(self):
        parts = ("upper", "lower")
        before, advice = self.advised("drop.toml", control(parts, hourglass="combined", hourglass_viscosity=0.3))
        less = float(re.search(r"lower parts\.\w+\.hourglass_viscosity \(0\.3\) to (\S+),", advice).group(1))
        after, _ = run("drop.toml", control(parts, hourglass="combined", hourglass_viscosity=less))
        self.assertLess(share(after), before)


if __name__ == "__main__":
    unittest.main()
