#!/usr/bin/env python3
"""The study of squeal (studies/squeal) in its parts: its case is sound in all five cases, fine and coarse; what it
measures in results it finds in results made up to have it. Its whole is in test_long_squeal_study.py."""

import os
import pathlib
import subprocess
import sys
import tempfile
import types
import unittest

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
STUDY = ROOT / "studies" / "squeal"
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
sys.path[:0] = [str(folder) for folder in (STUDY, STUDY.parent / "common", ROOT / "scripts")]
import cases  # noqa: E402
import draw  # noqa: E402
import fit  # noqa: E402
import vibration  # noqa: E402
import wheel_modes  # noqa: E402

MODES = [{"kind": "axial", "nodal_circles": "0", "nodal_diameters": str(n), "frequency": str(f)}
         for n, f in ((0, 185.3), (2, 405.3), (3, 1076.7), (4, 1924.5))]


class Fake:
    """Stands for the steps: a run's lateral forces follow displacement and duration by laws of their own."""

    def __init__(self, folder):
        self.folder, self.count = pathlib.Path(folder), 0

    def path(self, name):
        return self.folder / name

    def run(self, name, case, overrides):
        self.count += 1
        values = dict(override.split("=", 1) for override in overrides)
        size = -1e3 * float(values["prescribed_motion.inner.displacement"].strip("[]").split(",")[1])
        duration = 1e3 * float(values["curves.sideways.duration"])
        time = np.arange(0, 18.6e-3, 1e-5)
        known = 12.0 * size**0.8 * (2 / duration) ** 1.4, 25.0 * size**0.5 * (2 / duration) ** 0.4  # kN
        lateral = np.interp(time, (cases.SIDEWAYS, 17.58e-3, 18.54e-3), (0, *known))
        force = np.column_stack([0 * time + 35, lateral, 0 * time]) * 1e3
        path = self.folder / f"{name}.h5"
        with h5py.File(path, "w") as file:
            file["history/time"] = time
            file["history/contact/tread/normal_force"] = np.tile([0, 0, 110e3], (len(time), 1))
            file["history/contact/tread/tangential_force"] = force
            file["history/energy/balance_error"] = file["history/energy/internal"] = np.ones(len(time))
            file["history/set/wheelset.middle/displacement"] = np.zeros((len(time), 3))
            file.create_group("contact/tread").attrs["friction"] = 0.45
        return path


class Cases(unittest.TestCase):
    def check(self, case, overrides):
        words = [PROGRAM, "check", case]
        for override in overrides:
            words += ["--set", override]
        done = subprocess.run(words, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_coarse_cases(self):
        for number in (1, 5):
            self.check(cases.CASE, [*cases.EXTENTS["coarse"], *cases.settings(number)])

    def test_the_fine_band_is_fine(self):
        said = self.check(cases.CASE, cases.settings(4))
        self.assertRegex(said, r"in all: 4\d{5} elements")

    def test_table_of_forces(self):
        directions = [round(solution.direction) for solution in cases.SOLUTIONS.values()]
        self.assertEqual(directions, [3, 13, 28, 29, 47, 83])
        used = [round(solution.used(0.45), 2) for solution in cases.SOLUTIONS.values()]
        self.assertEqual(used, [0.69, 0.71, 0.77, 0.83, 0.96, 0.99])


class Fit(unittest.TestCase):
    def test_finds_the_forces_of_the_table(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            fake = Fake(folder)
            rows = fit.fit(fake, "full", [2, 3])
            motions = cases.read_motions(fake.path("fit.json"))
            self.assertEqual(fake.count, len(rows) - 1)
            self.assertLessEqual(fake.count, 2 * fit.ROUNDS)
            for number in (2, 3):
                off, _ = fit.misfit(cases.Rolling(number, fake.run("again", None, cases.settings(
                    number, motions[number]))), number)
                self.assertLess(np.abs(off).max(), fit.NEAR)
            self.assertEqual(motions[5], motions[3])


class Shear(unittest.TestCase):
    def test_what_is_carried(self):
        """Peaks that the material carries through the patch at 27.78 m/s, while the whole grows."""
        times, place = 16.5e-3 + 3e-5 * np.arange(74), np.linspace(-6, 6, 61)
        random = np.random.default_rng(3)
        born = random.normal(size=200)
        material = (place[None, :] + 27.78e3 * times[:, None]) / 1.5  # of the material at a place, in widths of peaks
        shear = np.interp(material, material.min() + np.arange(200) * 1.0, born)
        shear += 200 * (1 - (place / 7) ** 2) + 2e4 * (times[:, None] - times[0])
        late, alike, carried = draw.delay(times, place, shear + 0.2 * random.normal(size=shear.shape))
        self.assertLess(abs(late / carried - 1), 0.1)
        self.assertLess(abs(carried - 0.003 / 27.78), 1e-6)
        self.assertGreater(alike, 0.7)
        self.assertTrue(np.isnan(draw.delay(times[:4], place, shear[:4])[0]))


    def test_rows_and_picture_of_a_made_up_contact(self):
        times = 16.5e-3 + 3e-5 * np.arange(74)
        place = np.linspace(-6, 6, 13)

        def patches(k):
            pressure = np.sqrt(1 - (place / 6.5) ** 2)
            shear = 100 * pressure + 10 * np.sin(1e3 * (place / 1e3 + 27.78 * times[k]))
            return [types.SimpleNamespace(cut=lambda: {
                "distance": place, "pressure": pressure, "shear_along": shear, "shear_across": 0 * place})]

        clock = np.linspace(0, 20e-3, 2001)
        run = types.SimpleNamespace(time=clock, earlier=0.0, friction=0.45, normal=110 + np.sin(2e4 * clock),
                                    creep=30 + np.cos(2e4 * clock))
        contact = types.SimpleNamespace(times=times, patches=patches)
        rows = draw.findings({1: run}, {1: contact})
        self.assertEqual(len(rows), 2)
        self.assertRegex(rows[1][2], r"^\d+ us")
        self.assertIsNotNone(draw.draw_carried(*draw.along_centre(contact, times[0], times[-1])))


class Vibration(unittest.TestCase):
    def test_modes_found_and_named(self):
        time = np.arange(0, 24e-3, 1e-5)
        velocity = sum(size * np.sin(2 * np.pi * f * time + f) * np.exp(-20 * time)
                       for size, f in ((1.0, 181.0), (0.003, 1068.0), (0.001, 1900.0)))
        velocity += 0.3 * time / time[-1] + 1e-5 * np.random.default_rng(1).normal(size=len(time))
        density = vibration.spectrum(time, velocity)
        self.assertLess(abs(vibration.peaks(*density)[0] / 181 - 1), 0.01)
        for diameters, there in ((0, 181), (3, 1068), (4, 1900)):
            self.assertLess(abs(vibration.near(*density, wheel_modes.axial(MODES, diameters)) / there - 1), 0.01)
        self.assertIsNone(vibration.near(*density, 700.0))
        self.assertIsNone(wheel_modes.axial(MODES, 7))

    def test_a_rigid_wheel_does_not_vibrate(self):
        """One that rolls, rises and is tilted a little: its rim has no radial velocity, no circumferential one."""
        time = np.arange(0, 40e-3, 1e-5)
        angle, middle = 60.4 * time, np.column_stack([27.78 * time, 0 * time, 1e-3 * np.sin(900 * time)])
        out = np.column_stack([np.sin(angle), 0 * angle, np.cos(angle)])
        places = {"wheelset.rim_above": middle + 0.42 * out, "wheelset.bore": middle}
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            path = pathlib.Path(folder) / "rigid.h5"
            with h5py.File(path, "w") as file:
                file["history/time"] = time
                for name, place in places.items():
                    group = file.create_group(f"history/set/{name}")
                    group["position"], group["displacement"] = place[0], place - place[0]
                    group["velocity"] = np.gradient(place, time, axis=0, edge_order=2)
            rim = vibration.Rim(types.SimpleNamespace(number=1, results=path, earlier=0.0))
        self.assertLess(np.abs(rim.radial[2:-2]).max(), 1e-3)
        self.assertLess(np.abs(rim.circumferential[2:-2]).max(), 1e-3)


if __name__ == "__main__":
    unittest.main()
