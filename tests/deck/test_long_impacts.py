"""Decks of impacts, imported and run: bars against the theory of waves, balls against Hertz's theory of impact."""

import os
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from deck_writer import Deck, card, quarter_ball  # noqa: E402

PROGRAM = os.path.join(os.environ["RAILWAVE_BIN_DIR"], "railwave")


def imported(folder, name, deck, *options):
    """Writes the deck, imports, checks and runs it; the open results file."""
    with open(os.path.join(folder, name + ".k"), "w", encoding="ascii") as file:
        file.write(deck.text())
    for command in (["import", name + ".k", *options], ["check", name + ".toml"], ["run", name + ".toml"]):
        done = subprocess.run([PROGRAM, *command], cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise AssertionError(f"{command}: {done.returncode}\n{done.stdout}\n{done.stderr}")
    return h5py.File(os.path.join(folder, "results", name, name + ".h5"), "r")


def contact_times(time, force, least):
    """First and last time at which the force is above that share of its largest."""
    touching = time[force > least * force.max()]
    return touching[0], touching[-1]


class Bars(unittest.TestCase):
    """Two equal bars of E 210 GPa, 7850 kg/m3, side 10 mm, length 500 mm; one strikes the other at 10 m/s. In kg, mm,
    ms."""

    def test_wave_theory(self):
        length, side, speed = 500.0, 10.0, 10.0  # mm, mm, mm/ms
        youngs, density = 210.0, 7.85e-6  # kN/mm2, kg/mm3
        deck = Deck("two bars")
        deck.block(1, (0, 0, 0), (side, side, length), (2, 2, 100))
        deck.block(2, (0, 0, length + 0.01), (side, side, 2 * length + 0.01), (2, 2, 100))
        deck.part(1, "lower bar", 1)
        deck.part(2, "upper bar", 1)
        deck.add("*MAT_ELASTIC", card(1, density, youngs, 0.0))
        deck.add("*INITIAL_VELOCITY_GENERATION", card(2, 2, 0.0, 0.0, 0.0, -speed), "")
        deck.add("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", card(1, 2, 3, 3), card(0.0), "")
        deck.add("*CONTROL_TERMINATION", card(0.3), "*DATABASE_GLSTAT", card(1e-4), "*DATABASE_RCFORC", card(1e-4))
        with tempfile.TemporaryDirectory() as folder, imported(
            folder, "bars", deck, "--units", "mm,kg,ms"
        ) as results:
            time = results["history/time"][:]
            force = np.abs(results["history/contact/contact_1/normal_force"][:, 2])
            kinetic = results["history/energy/kinetic"][:]
            balance = np.abs(results["history/energy/balance_error"][:]).max()
            lower = results["fields/lower_bar/velocity"][-1][:, 2].mean()
            upper = results["fields/upper_bar/velocity"][-1][:, 2].mean()
        wave = np.sqrt(210e9 / 7850)
        expected_force = 7850 * wave * 1e-4 * 5.0  # rho c A v / 2
        plateau = force[(time > 0.25 * 2 * 0.5 / wave) & (time < 0.75 * 2 * 0.5 / wave)].mean()
        begin, end = contact_times(time, force, 0.01)
        given = 0.5 * 7850 * 0.5e-4 * 10.0**2
        print(f"bars: force {plateau:.0f} N, theory {expected_force:.0f}; contact {1e6 * (end - begin):.1f} us, theory"
              f" {1e6 * 2 * 0.5 / wave:.1f}; velocities {lower:.3f} and {upper:.3f} m/s, theory -10 and 0;"
              f" kinetic energy left {kinetic[-1] / kinetic[0]:.4f}; balance {balance / given:.2e}")
        self.assertAlmostEqual(kinetic[0] / given, 1, delta=1e-6)
        self.assertAlmostEqual(plateau / expected_force, 1, delta=0.02)
        self.assertAlmostEqual((end - begin) / (2 * 0.5 / wave), 1, delta=0.05)
        self.assertAlmostEqual(lower / -10, 1, delta=0.05)
        self.assertAlmostEqual(upper / 10, 0, delta=0.05)
        self.assertLess(balance / given, 1e-3)


class Wall(unittest.TestCase):
    """One such bar strikes a rigid wall: the force is twice that between two bars, and it comes back."""

    def test_wave_theory(self):
        deck = Deck("a bar on a wall")
        deck.block(1, (0, 0, 0.01), (10, 10, 500.01), (2, 2, 100))
        deck.part(1, "bar", 1)
        deck.add("*MAT_ELASTIC", card(1, 7.85e-6, 210.0, 0.0), "*RIGIDWALL_PLANAR", card(0, 0, 0))
        deck.add(card(0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0), "*INITIAL_VELOCITY", "", card(0.0, 0.0, -10.0))
        deck.add("*CONTROL_TERMINATION", card(0.3), "*DATABASE_RCFORC", card(1e-4))
        with tempfile.TemporaryDirectory() as folder, imported(
            folder, "wall", deck, "--units", "mm,kg,ms"
        ) as results:
            time = results["history/time"][:]
            force = np.abs(results["history/contact/rigid_wall_1_contact/normal_force"][:, 2])
            speed = results["fields/bar/velocity"][-1][:, 2].mean()
            wall = np.abs(results["fields/rigid_wall_1/velocity"][-1]).max()
        wave = np.sqrt(210e9 / 7850)
        expected = 7850 * wave * 1e-4 * 10.0
        plateau = force[(time > 0.25 / wave) & (time < 0.75 / wave)].mean()
        begin, end = contact_times(time, force, 0.01)
        print(f"wall: force {plateau:.0f} N, theory {expected:.0f}; contact {1e6 * (end - begin):.1f} us, theory"
              f" {1e6 / wave:.1f}; velocity after it {speed:.3f} m/s")
        self.assertAlmostEqual(plateau / expected, 1, delta=0.02)
        self.assertAlmostEqual((end - begin) * wave, 1, delta=0.05)
        self.assertAlmostEqual(speed / 10, 1, delta=0.05)
        self.assertEqual(wall, 0)


class Balls(unittest.TestCase):
    """Two equal steel balls of 10 mm radius meet at 5 m/s, quarters of them behind planes of symmetry. In mm, t, s.
    Theory: Johnson, Contact Mechanics, section 11.4."""

    def test_hertz_impact(self):
        radius, youngs, poisson, density, speed = 10.0, 210e3, 0.3, 7.85e-9, 5e3  # mm, MPa, t/mm3, mm/s
        deck = Deck("two balls")

        def held(i, j, _):
            return 4 if i == 0 and j == 0 else 1 if i == 0 else 2 if j == 0 else 0

        for part, up in ((1, False), (2, True)):
            places = quarter_ball(radius, 0.018, (12, 16), up)
            if up:
                places[..., 2] += 1e-3
            deck.grid(part, places, held)
            deck.part(part, f"ball {part}", 1, 1)
            velocity = -speed / 2 if up else speed / 2
            deck.add("*INITIAL_VELOCITY_GENERATION", card(part, 2, 0.0, 0.0, 0.0, velocity), "")
        deck.add("*MAT_ELASTIC", f"{1:10d}{density:10.3e}{youngs:10.3e}{poisson:10.3f}")
        deck.add("*HOURGLASS", card(1, 5, 0.05))
        deck.add("*SET_PART_LIST", card(9), card(1, 2))
        deck.add("*CONTACT_AUTOMATIC_SINGLE_SURFACE", card(9, 0, 2, 0), card(0.0), "")
        deck.add("*CONTROL_TERMINATION", card(6e-5), "*DATABASE_RCFORC", card(5e-8))
        with tempfile.TemporaryDirectory() as folder, imported(folder, "balls", deck, "--units", "mm,t,s") as results:
            time = results["history/time"][:]
            force = 4 * np.abs(results["history/contact/contact_1/normal_force"][:, 2])
            kinetic = results["history/energy/kinetic"][:]
        modulus = 210e9 / (2 * (1 - 0.3**2))
        reduced_radius, mass = 0.005, 7850 * 4 / 3 * np.pi * 0.01**3 / 2
        stiffness = 4 / 3 * modulus * np.sqrt(reduced_radius)
        depth = (5 * mass * 5.0**2 / (4 * stiffness)) ** 0.4
        peak = stiffness * depth**1.5
        lasts = 2.9433 * depth / 5.0
        begin, end = contact_times(time, force, 1e-4)  # of F ~ sin^1.5: within 0.2 %
        print(f"balls: peak {force.max() / 1e3:.2f} kN, theory {peak / 1e3:.2f}; contact {1e6 * (end - begin):.2f} us,"
              f" theory {1e6 * lasts:.2f}; kinetic energy left {kinetic[-1] / kinetic[0]:.4f}")
        self.assertAlmostEqual(force.max() / peak, 1, delta=0.05)
        self.assertAlmostEqual((end - begin) / lasts, 1, delta=0.05)
        self.assertGreater(kinetic[-1] / kinetic[0], 0.95)


if __name__ == "__main__":
    unittest.main()
