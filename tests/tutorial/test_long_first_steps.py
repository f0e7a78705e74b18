"""docs/first-steps.md, typed: running, speed, friction and lateral place, a study of four frictions."""

import csv
import os
import sys
import unittest

import h5py
import numpy as np
from PIL import Image

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from typed import DeskTest  # noqa: E402


class Rolling(DeskTest):
    made = {"frictions.py"}

    def patches(self, run):
        """Rows of the largest patch, in their order."""
        with open(self.desk.path("results", run, "patch.csv"), newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["patch"] == "1"]
        self.assertGreater(len(rows), 1, run)
        return [{name: float(value or "nan") for name, value in row.items() if name != "contact"} for row in rows]

    def test_run(self):
        said = self.desk.type("Install and run")
        self.assertIn("completed", said)
        self.assertNotIn("warning", said)
        for words in ("settled after", "energy balance error", "contact tread, mean over"):
            self.assertIn(words, said)
        last = self.patches("first_steps")[-1]
        weight = 106929 + 9.81 * 382  # preload and wheel
        self.assertAlmostEqual(last["normal_force"], weight, delta=0.05 * weight)
        for name in ("forces", "energies", "tread-patch", "tread-row", "tread-evolution"):
            with Image.open(self.desk.path("results", "first_steps", f"first_steps-{name}.png")) as image:
                self.assertAlmostEqual(image.info["dpi"][0], 300, delta=0.1)

    def test_speed_friction_and_place(self):
        self.desk.type("Change speed, friction and lateral place")
        speed = {}
        for run in ("slow", "slippery", "aside"):
            with h5py.File(self.desk.path("results", run, f"{run}.h5"), "r") as results:
                self.assertEqual(results.attrs["completed"], 1)
                speed[run] = results["history/set/wheel.bore/velocity"][:, 0].mean()
                bound = results["contact/tread"].attrs["friction"]
                normal = np.linalg.norm(results["history/contact/tread/normal_force"][:], axis=1)
                tangential = np.linalg.norm(results["history/contact/tread/tangential_force"][:], axis=1)
                self.assertTrue((tangential <= bound * normal * (1 + 1e-9)).all())
                self.assertAlmostEqual(bound, 0.05 if run == "slippery" else 0.45)
        self.assertAlmostEqual(speed["slow"], 20, delta=0.05)
        self.assertAlmostEqual(speed["aside"], 27.78, delta=0.05)
        # The slow wheel rolls: creepage of per mille, not of per cent.
        slow = self.patches("slow")[-1]
        self.assertAlmostEqual(slow["rolling_velocity"], 20, delta=0.3)
        self.assertLess(abs(slow["longitudinal_creepage"]), 5e-3)
        moved = self.patches("aside")[0]["centre_y"] - self.patches("slow")[0]["centre_y"]
        self.assertAlmostEqual(moved, -9.1e-3, delta=1e-3)

    def test_study_of_four_frictions(self):
        said = self.desk.type("A study of four frictions")
        rows = [line.split() for line in said[said.index("friction  normal"):].splitlines()[1:5]]
        self.assertEqual([float(row[0]) for row in rows], [0.05, 0.1, 0.2, 0.4])
        friction, normal, _, ratio = np.array([row[:4] for row in rows], dtype=float).T
        np.testing.assert_allclose(normal, 110, rtol=0.05)
        self.assertTrue((ratio <= friction * (1 + 1e-3)).all(), ratio)
        self.assertAlmostEqual(ratio[0], 0.05, delta=0.002)  # slips wholly
        shares = [int(row[4].split("/")[0]) for row in rows]
        self.assertEqual(shares, sorted(shares, reverse=True))
        self.assertGreater(shares[0], shares[3])


if __name__ == "__main__":
    unittest.main()
