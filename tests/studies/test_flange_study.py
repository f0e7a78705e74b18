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


class Made:
    """A results file's contact, made up of touching nodes."""

    def __init__(self):
        self.time, self.rows = [], []
        self.columns = {name: [] for name in ("normal_force", "tangential_force", "area")}

    def output(self, time, *patches):
        """patches: (normal force in kN, along, across, lean in degrees, nodes, of these slipping)."""
        for normal, along, across, lean, nodes, slipping in patches:
            angle = np.radians(lean)
            up = np.array([0, -np.sin(angle), np.cos(angle)])
            left = np.cross(up, [1, 0, 0])
            size = np.hypot(along, across)
            direction = np.array([along, 0, 0]) / size + across / size * left if size else np.zeros(3)
            # Those that slip carry all that friction holds, the others the rest of the tangential force evenly.
            held = 0.6 * normal / nodes
            rest = (size - slipping * held) / max(1, nodes - slipping)
            for k in range(nodes):
                self.columns["normal_force"].append(1e3 * normal / nodes * up)
                self.columns["tangential_force"].append(1e3 * (held if k < slipping else rest) * direction)
                self.columns["area"].append(2e-6)
        self.time.append(time)
        self.rows.append(len(self.columns["area"]))

    def write(self, file):
        pair = file.create_group("contact/tread")
        pair.attrs["friction"] = 0.6
        pair["time"], pair["slave/rows"] = self.time, self.rows
        count = len(self.columns["area"])
        pair["slave/coordinates"] = np.arange(3 * count).reshape(count, 3) * 1e-3
        pair["slave/near/node"], pair["slave/near/displacement"] = np.arange(count), np.full((count, 3), 0.5)
        for name, values in self.columns.items():
            pair[f"slave/near/{name}"] = values


class Patches(unittest.TestCase):
    STEP = 6.7e-4 / angles.SPEED  # s: ten outputs a frame

    def passing(self, folder, flange=True):
        """The flange touches at output 60 and grows; the tread loses its load at output 80."""
        made = Made()
        for k in range(100):
            # The tread's middle and its shoulder; nodes of the shoulder do not slip.
            patches = [(80, 16, -2 if k < 60 else -30, 4, 40, 5), (20, 4, 0, 14, 10, 0)] if k < 80 else []
            if k >= 60 and flange:
                normal = 0.1 + 5 * (k - 59)
                patches.append((normal, 0.36 * normal, 0.48 * normal, 70, 20, 20))
            elif k == 30:
                patches.append((0.2, 0, 0, 70, 1, 0))  # grazes
            made.output(k * self.STEP, *patches)
        results = pathlib.Path(folder) / "results.h5"
        time = np.linspace(0, 100 * self.STEP, 501)
        with h5py.File(results, "w") as file:
            made.write(file)
            file["history/time"] = time
            file["history/set/wheelset.bore/position"] = [0.01, 0.7, 0.6]
            file["history/set/wheelset.bore/displacement"] = np.column_stack([angles.SPEED * time, 0 * time, 0 * time])
            file["history/energy/balance_error"] = file["history/energy/internal"] = np.ones(len(time))
        return angles.Passing(25, results, None, left_out=0.1)

    def test_patches_are_told_apart_by_how_they_lean(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            one = self.passing(folder)
        self.assertEqual(one.first, 60)
        self.assertAlmostEqual(one.place[60], 0.11 + 60 * 6.7e-4, delta=1e-6)
        self.assertEqual(one.frames(), [10, 20, 30, 40, 50, 60, 70, 80, 90])
        together = np.array([0, 80 * np.sin(np.radians(4)) + 20 * np.sin(np.radians(14)),
                             80 * np.cos(np.radians(4)) + 20 * np.cos(np.radians(14))])
        self.assertAlmostEqual(one.tread.normal[10], np.linalg.norm(together))
        self.assertAlmostEqual(one.tread.contact_angle[10], np.degrees(np.arctan2(together[1], together[2])))
        self.assertAlmostEqual(one.tread.longitudinal[10], 20)
        self.assertAlmostEqual(one.tread.lateral[10], -2, delta=0.02)  # its tangent plane is not quite the middle's
        self.assertAlmostEqual(one.tread.theta[10], np.degrees(np.arctan2(2, 20)), delta=0.1)
        self.assertAlmostEqual(one.tread.slipping[10], 0.1)
        self.assertAlmostEqual(one.tread.area[10], 100)
        self.assertAlmostEqual(one.tread.pressure[10], 80e3 / 40 / 2e-6 / 1e6)
        self.assertAlmostEqual(one.flange.contact_angle[70], 70)
        self.assertAlmostEqual(one.flange.slipping[70], 1)
        self.assertAlmostEqual(one.flange.theta[70], np.degrees(np.arctan2(4, 3)))
        self.assertAlmostEqual(one.flange.shear[70], 0.6 * one.flange.pressure[70])
        self.assertAlmostEqual(one.flange.mean_shear()[1][70], 1e3 * 0.48 * 55.1 / 40)
        self.assertTrue(np.isnan(one.flange.normal[20]))
        self.assertAlmostEqual(one.unloaded(), one.place[80])
        found = {what: value for what, _, value, *_ in angles.findings({25: one})}
        self.assertEqual(found["25 mrad: longitudinal force of patch 2"], "1.8, 19.8, 37.8, 55.8 kN")
        self.assertIn("0.150 m", found["25 mrad: the flange touches at"])

    def test_places_of_what_touches(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            places = self.passing(folder).touching(1)
        self.assertEqual(places.shape, (50, 3))
        np.testing.assert_allclose(places[0], 0.5 + 1e-3 * (3 * 50 + np.arange(3)))

    def test_no_second_patch_is_said(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            one = self.passing(folder, flange=False)
        self.assertIsNone(one.first)
        self.assertEqual(one.frames(), [])
        self.assertIn("never", [value for _, _, value, *_ in angles.findings({25: one})])


if __name__ == "__main__":
    unittest.main()
