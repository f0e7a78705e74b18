#!/usr/bin/env python3
"""The study of a bogie on a wheelset (studies/vehicle): two masses against the exact vibration, the energy over the
interface, windows that are taken back, mistakes. Skipped where Simbody was not found at the build. The weld is in
test_long_vehicle_study.py."""

import os
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

try:
    import numpy as np
except ImportError:
    sys.exit(77)

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
STUDY = ROOT / "studies" / "vehicle"
BIN = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"])
PROGRAM = BIN / "railwave_vehicle"
sys.path[:0] = [str(folder) for folder in (STUDY, STUDY.parent / "common", ROOT / "scripts")]
sys.dont_write_bytecode = True
import two_masses as masses  # noqa: E402


def couple(folder, bogie, *words):
    table = pathlib.Path(folder) / "table.csv"
    done = subprocess.run([PROGRAM, masses.CASE, bogie, "--out", table, "--window", "4e-5", *words],
                          capture_output=True, text=True)
    return done, table


class TwoMasses(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            done, table = couple(folder, masses.BOGIE, "--samples", "5", "--rewind", "40", "--set", "time.end=0.35",
                                 "--curves", folder)
            if done.returncode != 0:
                raise AssertionError(done.stderr)
            cls.said = done.stdout
            cls.table = np.genfromtxt(table, delimiter=",", names=True)
            cls.curve = np.genfromtxt(pathlib.Path(folder) / "suspension_z.csv", delimiter=",", names=True)

    def test_frequency_and_decrement_are_those_of_two_rigid_masses(self):
        for axis, name in enumerate(masses.AXES):
            with self.subTest(name):
                one = masses.Compared(self.table, axis)
                # The block gives way (4e-6 at most, two_masses.py); forces between samples are straight lines, 1e-6.
                self.assertAlmostEqual(one.frequency / one.exact.frequency, 1, delta=1e-5)
                self.assertAlmostEqual(one.decrement, one.exact.decrement, delta=1e-5)
                self.assertLess(one.difference, 2e-4)

    def test_a_softer_block_shows(self):
        """The comparison sees what it must: a block of a hundredth of the modulus vibrates more slowly."""
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            done, table = couple(folder, masses.BOGIE, "--samples", "2", "--set", "time.end=0.2",
                                 "--set", "materials.steel.youngs_modulus=210e7")
            self.assertEqual(done.returncode, 0, done.stderr)
            one = masses.Compared(np.genfromtxt(table, delimiter=",", names=True), 0)
        lower = 1 - one.frequency / one.exact.frequency
        self.assertAlmostEqual(lower / (100 * masses.elastic_share(0)), 1, delta=0.1)

    def test_what_one_side_gives_the_other_gets(self):
        given, got = self.table["wheelset_work_J"], self.table["bogie_work_J"]
        self.assertGreater(np.abs(got).max(), 1)
        self.assertLess(np.abs(given + got).max(), 1e-6 * np.abs(got).max())

    def test_the_centre_of_both_masses_goes_on_evenly(self):
        for name, place, speed in zip(masses.AXES, masses.PLACE, masses.VELOCITY):
            frame, wheelset = self.table[f"frame_{name}_m"], self.table[f"displacement_{name}_m"]
            moment = masses.FRAME * frame + masses.WHEELSET * wheelset
            evenly = masses.FRAME * (place + speed * self.table["time_s"])
            # The middle of the block is ahead of its centre by a force over 2e11 N/m or more: 20 nm.
            self.assertLess(np.abs(moment - evenly).max(), masses.WHEELSET * 4e-8)

    def test_windows_that_are_taken_back_are_the_same(self):
        self.assertIn("the first 40 windows, 200 samples, came out the same bit for bit", self.said)

    def test_curves_are_the_forces(self):
        np.testing.assert_array_equal(self.curve["force_N"], self.table["force_z_N"])


class Weld(unittest.TestCase):
    def test_case_is_sound(self):
        done = subprocess.run([BIN / "railwave", "check", STUDY / "dipped_weld.toml"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("warning:", done.stdout + done.stderr)

    def test_static_force_is_the_weight_over_an_axle_box(self):
        case = tomllib.loads((STUDY / "dipped_weld.toml").read_text())
        bogie = tomllib.loads((STUDY / "bogie.toml").read_text())
        weight = bogie["gravity"]["acceleration"] * (bogie["frame"]["mass"] + bogie["car_body"]["mass"]) / 2
        self.assertAlmostEqual(case["curves"]["suspension_z"]["points"][0][1], -weight, delta=0.1)


class Mistakes(unittest.TestCase):
    def refused(self, text, *said):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            bogie = pathlib.Path(folder) / "bogie.toml"
            bogie.write_text(text)
            done, table = couple(folder, bogie)
            self.assertEqual(done.returncode, 1)
            for words in said:
                self.assertIn(words, done.stderr)
            self.assertEqual([path.name for path in table.parent.iterdir()], ["bogie.toml"])

    def test_of_the_bogie_file(self):
        text = masses.BOGIE.read_text()
        self.refused(text.replace("mass = 3000", "mass = -3"), "bogie.toml: [frame] mass", "above 0")
        self.refused(text.replace("mass = 3000", ""), "[frame] mass: is missing")
        self.refused(text.replace("damping", "dampnig"), "[primary_suspension] damping: is missing")
        self.refused(text + "\n[frames]\nmass = 1\n", "[frames] mass", "is not known")
        self.refused(text.replace("[4e6, 2e6, 1.2e6]", "[4e6, 2e6]"), "stiffness: three numbers")
        self.refused(text + "\n[gravity\n", "bogie.toml:")
        self.refused(text.replace("wheelset.middle", "wheelset.centre"), "wheelset.centre", "known are")
        self.refused(text.replace('"suspension_x"', '"pull"'), "curves.pull")

    def test_a_folder_that_is_not_there(self):
        done, _ = couple("/nowhere", masses.BOGIE, "--set", "time.end=1e-4")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/nowhere/table.csv cannot be written", done.stderr)

    def test_windows_that_are_too_long(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            bogie = pathlib.Path(folder) / "bogie.toml"
            bogie.write_text(masses.BOGIE.read_text().replace("[0, 2301.6, 1188.5]", "[0, 0, 1e9]"))
            done, table = couple(folder, bogie, "--samples", "5")
            self.assertEqual(done.returncode, 1)
            self.assertIn("iterations the forces of both sides still differ", done.stderr)
            self.assertFalse(table.exists())


def simbody_was_found():
    """By the build's cache. Builds that leave the study out never look for it."""
    cache = (BIN.parent / "CMakeCache.txt").read_text(encoding="utf-8")
    return any(line.startswith("Simbody_DIR") and not line.rstrip().endswith("NOTFOUND") for line in cache.splitlines())


if __name__ == "__main__":
    if not PROGRAM.exists() and not simbody_was_found():
        print("skipped: Simbody was not found at the build; scripts/setup --simbody installs it")
        sys.exit(77)
    unittest.main()
