#!/usr/bin/python3
"""The steady rolling of half-spaces that scripts/verify_contact compares with (verification.half_space) against what
others found: Kalker's CONTACT, his linear creep coefficients, and Coulomb's law itself."""

import os
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"]) / "scripts"))
from verification.exact import Hertz, Steel  # noqa: E402
from verification.half_space import (  # noqa: E402
    FallingFriction, SteadyRolling, converged, creepage_for_force, influence,
)
from verification.rolling import DATA, interpolate, reference_field, table_5_2  # noqa: E402
from verification.stick_measure import sampled  # noqa: E402


class QuarterPoisson(Steel):
    poissons_ratio = 0.25


class HalfSpaceRolling(unittest.TestCase):
    def set_of_table_5_2(self, letter):
        row = table_5_2()[letter]
        creepages = (row["longitudinal_creepage"], row["lateral_creepage"], 0)
        return row, Hertz(row["normal_N"], 0.46, 0.30), creepages

    def test_forces_and_stick_of_contact(self):
        for letter in "abcdef":
            row, hertz, creepages = self.set_of_table_5_2(letter)
            force, stick = converged(hertz, 0.45, creepages, 40)
            wished = np.array([row["longitudinal_N"], row["lateral_N"]])
            self.assertLess(np.linalg.norm(force - wished), 0.005 * np.linalg.norm(wished), letter)
            self.assertLess(abs(stick - row["adhesion_share"]), 0.03, letter)

    def test_shear_of_contact(self):
        for letter in "ace":
            _, hertz, creepages = self.set_of_table_5_2(letter)
            solution = SteadyRolling(hertz, 0.45, creepages, 40)
            reference = interpolate(reference_field(letter), solution.x, solution.y)
            known = ~np.isnan(reference[:, 0])
            off = np.sqrt(np.sum((solution.shear[known] - reference[known]) ** 2) / np.sum(reference[known] ** 2))
            self.assertGreater(known.mean(), 0.9)
            self.assertLess(off, 0.05, letter)  # of two grids, each of first order
            weight = np.linalg.norm(reference[known], axis=1)
            angle = np.abs(np.angle((solution.shear[known] @ [1, 1j]) / (reference[known] @ [1, 1j]), deg=True))
            self.assertLess(np.sum(weight * angle) / np.sum(weight), 0.4, letter)
            field = np.loadtxt(DATA / f"field_{letter}.csv", delimiter=",", skiprows=1)
            sticks = solution.nearest(~solution.slips, 1e-3 * field[:, 0], 1e-3 * field[:, 1])
            self.assertGreater(np.mean(sticks == (field[:, 5] == 1)), 0.97, letter)

    def test_kalkers_linear_coefficients(self):
        """Circle, nu 0.25: C11 4.12, C22 3.67, C23 1.47 (Kalker 1990, table E.3); the moment of lateral creepage is
        C23's too. So much friction that nothing slips but at the edge."""
        hertz = Hertz(1e5, 0.46, 0.46, QuarterPoisson)
        c, modulus = hertz.a, QuarterPoisson.shear_modulus()

        def extrapolated(creepages):
            coarse, fine = (SteadyRolling(hertz, 1000, creepages, cells) for cells in (24, 48))
            return 2 * np.array([*fine.force, fine.moment]) - [*coarse.force, coarse.moment]

        small = [0.01, 0.01, 0.01 / c]
        longitudinal, lateral, spin = (extrapolated(small[k] * np.eye(3)[k]) / small[k] for k in range(3))
        self.assertLess(abs(longitudinal[0] / (modulus * c**2 * 4.12) - 1), 0.015)
        self.assertLess(abs(lateral[1] / (modulus * c**2 * 3.67) - 1), 0.015)
        self.assertLess(abs(spin[1] / (-modulus * c**3 * 1.47) - 1), 0.03)
        self.assertLess(abs(lateral[2] / (-modulus * c**3 * 1.47) - 1), 0.03)

    def test_creepages_in_a_ring(self):
        """Without traction those prescribed; with it what differences of the displacement, an integral over rectangles,
        give."""
        hertz = Hertz(1e5, 0.46, 0.30)
        for found, prescribed in zip(
            SteadyRolling(hertz, 1e-9, (0.003, 0.002, 0.1), 10).creepages_round(1.5, 3), (0.003, 0.002, 0.1)
        ):
            self.assertAlmostEqual(found, prescribed, places=9)
        solution = SteadyRolling(hertz, 0.45, (0.003, 0.004, 0), 20)
        nu, modulus, angle = (
            Steel.poissons_ratio,
            Steel.shear_modulus(),
            1e-3 + np.linspace(0, 2 * np.pi, 720, endpoint=False),
        )
        radius = 3 * max(hertz.a, hertz.b)
        x, y = radius * np.cos(angle), radius * np.sin(angle)

        def displacement(px, py):
            xx, yy, xy = influence(px[:, None] - solution.x, py[:, None] - solution.y, solution.h, solution.k)
            along, across = solution.shear.T
            return np.array(
                [(xx + (1 - nu) * yy) @ along + nu * xy @ across, nu * xy @ along + (yy + (1 - nu) * xx) @ across]
            ) / (np.pi * modulus)

        step = 1e-5
        velocity = -(displacement(x + step, y) - displacement(x - step, y)) / (2 * step)
        spin = np.mean(x * velocity[1] - y * velocity[0]) / radius**2
        self.assertGreater(spin, 1e-3)
        found = solution.creepages_round(2.99, 3, 1500)
        self.assertLess(abs(found[2] / spin - 1), 0.01)
        self.assertLess(
            np.linalg.norm(np.array(found[:2]) - [0.003 - velocity[0].mean(), 0.004 - velocity[1].mean()]), 1e-7
        )

    def test_coulombs_law(self):
        hertz = Hertz(1e5, 0.46, 0.30)
        for creepages in ((0.004, 0, 0), (0, 0.004, 0), (0, 0, 1.0), (0.002, -0.001, 0.4)):
            solution = SteadyRolling(hertz, 0.45, creepages, 20)
            bound = 0.45 * solution.pressure
            size, slip = np.linalg.norm(solution.shear, axis=1), np.linalg.norm(solution.slip, axis=1)
            self.assertGreater(solution.slips.sum(), 20)
            self.assertGreater((~solution.slips).sum(), 20)
            self.assertLess((size / bound).max(), 1 + 1e-6)
            self.assertLess(slip[~solution.slips].max(), 1e-6 * slip.max())
            slips = solution.slips & (slip > 1e-3 * slip.max())
            against = np.sum(solution.shear * solution.slip, axis=1)[slips] / (size * slip)[slips]
            self.assertLess(against.max(), -1 + 1e-5)

    def test_falling_friction(self):
        """Against CONTACT's creep force of 0.370 of the normal force and peak shear of 602 MPa; the bound that makes
        them is that of each cell's own slip."""
        hertz = Hertz(110e3, 0.46, 0.30)
        law, creepages = FallingFriction(0.5, 0.32, 6, 27.78), (0.005, 0, 0)
        force, _ = converged(hertz, law, creepages, 60)
        self.assertLess(abs(force[0] / hertz.force / 0.370 - 1), 0.01)
        solution = SteadyRolling(hertz, law, creepages, 60)
        size = np.linalg.norm(solution.shear, axis=1)
        self.assertLess(abs(size.max() / 602e6 - 1), 0.03)
        slip = 27.78 * np.linalg.norm(solution.slip, axis=1)
        wished = 0.32 + 0.18 * np.exp(-6 * np.where(solution.slips, slip, 0))
        self.assertLess(np.abs(solution.coefficient - wished).max(), 1e-4)
        self.assertLess(np.abs(size / (wished * solution.pressure) - 1)[solution.slips].max(), 1e-3)
        # Constant where it does not fall.
        constant = SteadyRolling(hertz, FallingFriction(0.4, 0.4, 6, 27.78, 4e-5), creepages, 20)
        np.testing.assert_allclose(constant.shear, SteadyRolling(hertz, 0.4, creepages, 20).shear, atol=1e3)

    def test_memory_of_friction(self):
        """What a particle remembers is the mean of its past's slip; friction comes down later, and more force is
        left."""
        law = FallingFriction(0.5, 0.32, 6, 30, 1e-4)
        slip, h = np.full((2000, 1, 2), [0.003, 0.004]), 1e-5
        seen = 30 * 0.005 * (1 - np.exp(-np.arange(1, 2001) * h / (30 * 1e-4)))
        np.testing.assert_allclose(law.along(slip, h)[:, 0], 0.32 + 0.18 * np.exp(-6 * seen), rtol=1e-9)
        hertz = Hertz(110e3, 0.46, 0.30)
        forces = [SteadyRolling(hertz, FallingFriction(0.5, 0.32, 6, 27.78, memory), (0.005, 0, 0), 30).force[0]
                  for memory in (0, 2e-5, 4e-5)]
        self.assertTrue(1.005 * forces[0] < forces[1] < 0.995 * forces[2] < 1.03 * forces[0], forces)

    def test_stick_area_is_measured_right_at_a_runs_nodes(self):
        """Ten elements over the minor axis, half and a sixth of the patch sticking."""
        for letter, limit in (("b", 0.04), ("e", 0.06)):
            _, hertz, creepages = self.set_of_table_5_2(letter)
            found = sampled(SteadyRolling(hertz, 0.45, creepages, 40), 2 * hertz.b / 10, 40)
            self.assertLess(np.abs(found.mean(axis=0) - 1).max(), limit, letter)

    def test_creepage_for_a_force(self):
        hertz = Hertz(1e5, 0.46, 0.30)
        for which, creepage in enumerate((0.004, 0.004, 0.6)):
            creepages = creepage * np.eye(3)[which]
            force = converged(hertz, 0.45, creepages, 16)[0][0 if which == 0 else 1]
            found = creepage_for_force(hertz, 0.45, creepages * 1.05, which, force, 16)
            self.assertLess(abs(found / creepage - 1), 2e-3)


if __name__ == "__main__":
    unittest.main()
