#!/usr/bin/python3
"""The exact solutions that scripts/verify_contact compares with, against figures found elsewhere, their own integrals,
and each other; and its areas, of a patch that is known."""

import os
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"]) / "scripts"))
from verification.exact import Carter, Hertz, HertzLine, Mindlin  # noqa: E402
from verification.measured import enclosed, outlines  # noqa: E402


def integral(values, places):
    """By the trapezoidal rule; NumPy has renamed its own."""
    return np.sum((values[1:] + values[:-1]) * np.diff(places)) / 2


class Exact(unittest.TestCase):
    def test_hertz_by_another_program(self):
        for across, a, b, peak, approach in ((0.46, 7.23535339e-3, 7.23535339e-3, 1155.393569e6, 113.8050840e-6),
                                             (0.30, 7.74908993e-3, 5.82903787e-3, 1339.065630e6, 121.8994651e-6)):
            hertz = Hertz(126680, 0.46, across)
            for found, known in ((hertz.a, a), (hertz.b, b), (hertz.peak, peak), (hertz.approach, approach)):
                self.assertAlmostEqual(found / known, 1, 8)

    def test_displacement_is_half_the_approach_at_the_surface_and_a_point_force_far_away(self):
        hertz = Hertz(126680, 0.46, 0.30)
        self.assertAlmostEqual(2 * hertz.displacement(1e-9) / hertz.approach, 1, 3)
        point = 1.3 / (2 * np.pi * 210e9) * 126680 * (1 + 2 * 0.7) / 0.5
        self.assertAlmostEqual(hertz.displacement(0.5) / point, 1, 3)

    def test_mindlin_and_carter_carry_the_force_they_are_for(self):
        hertz = Hertz(1e5, 0.46, 0.46)
        r = np.linspace(0, hertz.a, 200001)
        shear = Mindlin(hertz, 0.6 * 0.45 * 1e5, 0.45).shear(r)
        self.assertAlmostEqual(integral(2 * np.pi * r * shear, r) / (0.6 * 0.45 * 1e5), 1, 6)
        line = HertzLine(7e6, 0.46)
        x = np.linspace(-line.half_width, line.half_width, 200001)
        for share in (0.2, 0.6, 0.95):
            carter = Carter(line, 0.45, Carter.creepage(line, 0.45, share))
            self.assertAlmostEqual(carter.share, share, 12)
            self.assertAlmostEqual(integral(carter.shear(x), x) / carter.force, 1, 5)

    def test_area_of_a_known_patch(self):
        hertz = Hertz(1e5, 0.46, 0.30)
        for shift in (0.0, 0.3, 0.5):
            x, y = np.meshgrid((np.arange(-12, 13) + shift) * 1e-3, (np.arange(-12, 13) - shift / 2) * 1e-3)
            area = enclosed(outlines(x, y, hertz.pressure(x, y)))
            self.assertLess(abs(area / hertz.area - 1), 0.01)
        x, y = np.meshgrid(np.arange(13) * 1e-3, np.arange(13) * 1e-3)
        self.assertLess(abs(enclosed(outlines(x, y, hertz.pressure(x, y)), "xy") / hertz.area - 1), 0.01)


if __name__ == "__main__":
    unittest.main()
