"""A wheel rolls over the joint of cases/joint.toml, in the coarse variant that the case itself names."""

import os
import re
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

ROOT = os.environ["RAILWAVE_SOURCE_DIR"]
PROGRAM = os.path.join(os.environ["RAILWAVE_BIN_DIR"], "railwave")
CASE = os.path.join(ROOT, "cases", "joint.toml")


def coarse_variant():
    """The overrides that the case's comment gives."""
    with open(CASE, encoding="utf-8") as file:
        comment = "".join(line[1:] for line in file if line.startswith("#"))
    return re.findall(r"--set (\S+)", comment)


class LooseTolerance(unittest.TestCase):
    """Pressures are not renewed from states far from rest, however much may be left unbalanced."""

    def test_it_settles_in_as_few_steps_as_with_a_tight_one(self):
        steps = {}
        with tempfile.TemporaryDirectory(prefix="railwave-joint-") as scratch:
            for tolerance in ("1e-3", "2e-2"):
                command = [PROGRAM, "run", CASE]
                for override in [
                    *coarse_variant(), f"output.file={scratch}/joint.h5", "settle.cache=false", "time.end=1e-6",
                    f"settle.tolerance={tolerance}",
                ]:
                    command += ["--set", override]
                done = subprocess.run([*command, "--overwrite"], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                found = re.search(r"settled after \d+ evaluations .* in (\d+) steps of Newton's method", done.stdout)
                self.assertIsNotNone(found, done.stdout)
                steps[tolerance] = int(found[1])
        self.assertLess(steps["2e-2"], 2 * steps["1e-3"])  # it took 81 steps in place of 9


class OverTheGap(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="railwave-joint-")
        results = os.path.join(cls.scratch.name, "joint.h5")
        command = [PROGRAM, "run", CASE]
        for override in [*coarse_variant(), f"output.file={results}"]:
            command += ["--set", override]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)
        with h5py.File(results) as file:
            history = file["history"]
            cls.time = history["time"][:]
            cls.before, cls.behind = (history[f"contact/{name}/normal_force"][:, 2] for name in ("tread", "tread_2"))
            cls.wheel = history["set/wheel.bore/displacement"][:]
            cls.bolts = {
                name: history[f"beam/{name}/force"][:, 0, 0]
                for name in history["beam"]
                if re.fullmatch(r"track_bolt_\d", name)
            }
            cls.energy = {name: history[f"energy/{name}"][:] for name in history["energy"]}

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_the_wheel_goes_over_from_one_rail_to_the_other(self):
        self.assertGreater(self.wheel[-1, 0], 0.075)  # it began 40 mm before the gap
        self.assertEqual(self.behind[0], 0)
        self.assertEqual(self.before[-1], 0)
        both = (self.before > 0) & (self.behind > 0)
        self.assertTrue(np.any(both))

    def test_it_never_loses_contact(self):
        load = self.before + self.behind
        static = load[0]
        self.assertGreater(load.min(), 0.3 * static)
        self.assertLess(load.max(), 3 * static)
        self.assertLess(abs(np.mean(load) - static), 0.1 * static)

    def test_its_fall_into_the_gap_is_small(self):
        self.assertLess(np.ptp(self.wheel[:, 2]), 0.5e-3)

    def test_bolts_are_tight_when_it_has_settled_and_stay_so(self):
        self.assertEqual(len(self.bolts), 4)
        for force in self.bolts.values():
            self.assertLess(abs(force[0] / 12.5e3 - 1), 0.01)
            self.assertLess(np.max(np.abs(force / 12.5e3 - 1)), 0.1)

    def test_energy_is_kept(self):
        largest = max(np.max(np.abs(self.energy[name])) for name in ("internal", "external_work"))
        self.assertLess(np.max(np.abs(self.energy["balance_error"])), 0.02 * largest)


if __name__ == "__main__":
    unittest.main()
