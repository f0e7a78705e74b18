"""cases/surface_pulse.toml: the surface wave runs at Rayleigh's speed, its particles backwards at the top, normal
motion a quarter period off the tangential one, and higher than that by Rayleigh's ratio."""

import os
import re
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from made_up_results import PROGRAM, SOURCE_DIR, signal

E, NU, RHO = 210e9, 0.3, 7800.0
BAND = ("--low", "100e3", "--high", "250e3")


def rayleigh():
    """Speed of Rayleigh's wave on a half-space, m/s, and its normal over its tangential motion at the surface, from the
    secular equation."""
    shear, pressure = np.sqrt(E / (2 * (1 + NU)) / RHO), np.sqrt(E * (1 - NU) / ((1 + NU) * (1 - 2 * NU)) / RHO)

    def secular(c):
        return (2 - (c / shear) ** 2) ** 2 - 4 * np.sqrt((1 - (c / pressure) ** 2) * (1 - (c / shear) ** 2))

    low, high = 0.5 * shear, 0.9999 * shear
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if secular(middle) < 0 else (low, middle)
    # u = e^(-pkz) - 2ps/(1+s^2) e^(-skz), w = p (e^(-pkz) - 2/(1+s^2) e^(-skz)) at the depth z = 0.
    p, s = np.sqrt(1 - (low / pressure) ** 2), np.sqrt(1 - (low / shear) ** 2)
    return low, abs(p * (1 - 2 / (1 + s**2)) / (1 - 2 * p * s / (1 + s**2)))


class SurfacePulse(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        case = os.path.join(SOURCE_DIR, "cases", "surface_pulse.toml")
        run = subprocess.run([PROGRAM, "run", case], cwd=cls.folder.name, capture_output=True, text=True)
        assert run.returncode == 0, run.stderr
        cls.results = os.path.join(cls.folder.name, "results", "surface_pulse", "surface_pulse.h5")
        cls.speed, cls.ratio = rayleigh()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_theory(self):
        self.assertAlmostEqual(self.speed, 2984, delta=1)
        self.assertAlmostEqual(self.ratio, 1.52, delta=0.01)

    def test_speed(self):
        for component in "xz":
            text = signal("speed", self.results, "--channel", f"block.row_*.velocity.{component}", *BAND)
            speeds = [float(found) for found in re.findall(r"([\d.]+) m/s,", text)]
            self.assertEqual(len(speeds), 2, text)
            for speed in speeds:
                self.assertLess(abs(speed / self.speed - 1), 0.01, text)

    def test_ellipse(self):
        out = os.path.join(self.folder.name, "ellipse.h5")
        signal(
            "ellipse", self.results, "--channel", "block.row_*.displacement.x", "--channel",
            "block.row_*.displacement.z", *BAND, "--hdf5",
            out
        )
        with h5py.File(out, "r") as file:
            self.assertTrue(file["ellipse/retrograde"][:].all())
            self.assertEqual(len(file["ellipse/retrograde"]), 31)
            # Body waves of the same blow have not all gone ahead at the nearest probes.
            np.testing.assert_allclose(file["ellipse/amplitude_ratio"][:].mean(), self.ratio, rtol=0.03)
            self.assertGreater(file["ellipse/polarisation"][:].min(), 0.95)

    def test_phase(self):
        out = os.path.join(self.folder.name, "cross.h5")
        signal(
            "cross", self.results, "--channel", "block.row_*.velocity.x", "--channel", "block.row_*.velocity.z", *BAND,
            "--hdf5",
            out
        )
        with h5py.File(out, "r") as file:
            self.assertAlmostEqual(abs(file.attrs["band_phase"]), 90, delta=3)
            self.assertGreater(file.attrs["band_coherence"], 0.95)
            frequency, phase = file["cross/frequency"][:], file["cross/phase"][:]
            inside = (frequency >= 100e3) & (frequency <= 250e3)
            self.assertLess(abs(abs(phase[inside]) - 90).max(), 3)


if __name__ == "__main__":
    unittest.main()
