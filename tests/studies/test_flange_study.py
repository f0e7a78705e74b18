#!/usr/bin/env python3
"""The study of one and two contact points (studies/flange) in its parts: its case is sound at all angles, fine and
coarse, with the thesis's clearance between the rigid profiles; what it reads of a table of patches it finds in one made
up to have it. Its whole is in test_long_flange_study.py."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
STUDY = ROOT / "studies" / "flange"
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
sys.path[:0] = [str(folder) for folder in (STUDY, STUDY.parent / "common", ROOT / "scripts")]
import angles  # noqa: E402


def check(milliradians, coarse):
    words = [PROGRAM, "check", angles.CASE]
    for override in angles.settings(milliradians, coarse):
        words += ["--set", override]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return done.stdout


class Case(unittest.TestCase):
    def test_flange_meets_where_the_clearance_says(self):
        for milliradians in angles.ANGLES:
            for coarse in (False, True) if milliradians == 25 else (True,):
                with self.subTest(milliradians=milliradians, coarse=coarse):
                    said = check(milliradians, coarse)
                    self.assertNotIn("warning:", said)
                    jumps = re.findall(r"wheel ([+-][\d.]+) mm along y: the profiles now meet elsewhere, .* contact"
                                       r" angle ([\d.]+) deg, ([\d.]+) mm ahead", said)
                    self.assertTrue(jumps, said)
                    lateral, steep, ahead = map(float, jumps[-1])
                    self.assertAlmostEqual(steep, 70, delta=1)
                    # Radius times slope of the flange times the angle.
                    self.assertAlmostEqual(ahead, 1e-3 * milliradians * 460 * np.tan(np.radians(70)), delta=2)
                    # Smaller angles need somewhat more, as the flange meets nearer to the axle.
                    left = 1e3 * np.tan(1e-3 * milliradians) * angles.way_before(milliradians, coarse)
                    self.assertAlmostEqual(lateral + left, 1e3 * (angles.CLEARANCE - angles.BENDS), delta=0.4)

    def test_the_wheel_travels_in_its_plane(self):
        for milliradians in angles.ANGLES:
            values = dict(text.split("=", 1) for text in angles.settings(milliradians, False))
            velocity = np.array(eval(values["initial_motion.roll.velocity"]))  # noqa: S307: our own text
            axes = np.array(eval(values["prescribed_motion.inner.axes"]))  # noqa: S307
            np.testing.assert_allclose(axes @ velocity, [angles.SPEED, 0, 0], atol=1e-6)
            np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-9)


def row(time, number, normal, along, across, lean, nodes=50, slipping=10, area=100e-6):
    angle = np.radians(lean)
    return {"time": str(time), "patch": str(number), "normal_force": str(1e3 * normal), "creep_force": str(1e3 * along),
            "lateral_force": str(1e3 * across), "area": str(area), "peak_nodal_pressure": "9e8", "peak_shear": "3e8",
            "slipping_by_force": str(slipping), "nodes_in_contact": str(nodes), "normal_x": "0",
            "normal_y": str(np.sin(angle)), "normal_z": str(np.cos(angle)), "centre_x": "0", "centre_y": "0",
            "centre_z": "0"}


class Patches(unittest.TestCase):
    STEP = 6.7e-4 / angles.SPEED  # s: ten outputs a frame

    def passing(self, folder):
        """The flange touches at output 60 and grows; the tread loses its load at output 80."""
        rows = []
        for k in range(100):
            time = k * self.STEP
            rows.append(row(time, 0, 1, 0, 0, 0))
            if k < 80:
                rows.append(row(time, 1, 80, 16, -2 if k < 60 else -30, 4))
                rows.append(row(time, 2, 20, 4, 0, 14))  # the tread's second patch, on the shoulder
            if k >= 60:
                rows.append(row(time, 3, 0.1 + 5 * (k - 59), 2, 4, 70, slipping=50))
            elif k == 30:
                rows.append(row(time, 4, 0.2, 0, 0, 70, nodes=1, slipping=0))  # grazes
        results = pathlib.Path(folder) / "results.h5"
        time = np.linspace(0, 100 * self.STEP, 501)
        with h5py.File(results, "w") as file:
            file["history/time"] = time
            file["history/set/wheelset.bore/position"] = [0.01, 0.7, 0.6]
            file["history/set/wheelset.bore/displacement"] = np.column_stack([angles.SPEED * time, 0 * time, 0 * time])
            file["history/energy/balance_error"] = file["history/energy/internal"] = np.ones(len(time))
        table = pathlib.Path(folder) / "table.csv"
        table.write_text("\n".join([",".join(rows[0]), *(",".join(one.values()) for one in rows)]))
        return angles.Passing(25, results, table, None, left_out=0.1)

    def test_patches_are_told_apart_by_how_they_lean(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            one = self.passing(folder)
        self.assertEqual(one.first, 60)
        self.assertAlmostEqual(one.place[60], 0.11 + 60 * 6.7e-4, delta=1e-6)
        self.assertEqual(one.frames(), [10, 20, 30, 40, 50, 60, 70, 80, 90])
        self.assertAlmostEqual(one.tread.normal[10], 100)
        self.assertAlmostEqual(one.tread.contact_angle[10], 0.8 * 4 + 0.2 * 14)
        self.assertAlmostEqual(one.tread.theta[10], np.degrees(np.arctan2(2, 20)))
        self.assertAlmostEqual(one.tread.slipping[10], 0.2)
        self.assertAlmostEqual(one.tread.area[10], 200)
        self.assertAlmostEqual(one.flange.contact_angle[70], 70)
        self.assertAlmostEqual(one.flange.slipping[70], 1)
        self.assertAlmostEqual(one.flange.mean_shear()[1][70], 40)
        self.assertTrue(np.isnan(one.flange.normal[20]))
        self.assertAlmostEqual(one.unloaded(), one.place[80])
        found = {what: value for what, _, value, *_ in angles.findings({25: one})}
        self.assertEqual(found["25 mrad: longitudinal force of patch 2"], ", ".join(["2.0"] * 4) + " kN")
        self.assertIn("0.150 m", found["25 mrad: the flange touches at"])

    def test_no_second_patch_is_said(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            one = self.passing(folder)
            rows = [line for line in angles.rows_of(pathlib.Path(folder) / "table.csv") if line["patch"] != "3"]
            _, one.tread, one.flange = angles.sides_of(rows)
        self.assertIsNone(one.first)
        self.assertEqual(one.frames(), [])
        self.assertIn("never", [value for _, _, value, *_ in angles.findings({25: one})])


if __name__ == "__main__":
    unittest.main()
