"""What each keyword does to a body, against what it should: one deck of free cubes, a cube a keyword. In mm, t, s."""

import csv
import os
import subprocess
import sys
import tempfile
import tomllib
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.environ["RAILWAVE_SOURCE_DIR"], "studies", "decks"))
from deck_writer import Deck, card  # noqa: E402

PROGRAM = os.path.join(os.environ["RAILWAVE_BIN_DIR"], "railwave")
SIDE, DENSITY, END = 10.0, 7.8e-9, 1e-3  # mm, t/mm3, s
MASS = DENSITY * SIDE**3  # t
DIVISIONS = (2, 2, 2)


class Bodies(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        deck = Deck("free cubes")
        cls.cubes = {}
        names = ("forced", "pressed", "pulled", "falling", "turning", "damped", "driven", "pushed", "led", "struck")
        for i, name in enumerate(names):
            low = np.array([0, 30.0 * i, 0])
            cls.cubes[name] = deck.block(i + 1, low, low + SIDE, DIVISIONS)
            deck.part(i + 1, name, 1, 1)
        number = {name: i + 1 for i, name in enumerate(names)}
        # A second cube is tied to the one that moves along z.
        low = np.array([SIDE, 30.0 * (number["struck"] - 1), 0])
        deck.block(20, low, low + SIDE, (3, 3, 3))
        deck.part(20, "carried", 1, 1)
        deck.add("*CONTACT_TIED_SURFACE_TO_SURFACE", card(20, number["struck"], 3, 3), card(0.0), "")
        deck.add("*INITIAL_VELOCITY_GENERATION", card(number["struck"], 2, 0.0, 0.0, 0.0, 1000.0), "")
        deck.add("*MAT_ELASTIC", f"{1:10d}{DENSITY:10.3e}{2.1e5:10.3e}{0.3:10.3f}", "*HOURGLASS", card(1, 4, 0.05))
        deck.add("*DEFINE_CURVE", "1", "0,1", "1,1", "*DEFINE_CURVE", "2", "0,0", f"{END},1", "1,1")
        cls.add_loads(deck, number)
        cls.add_spring(deck)
        deck.add("*CONTROL_TERMINATION", card(END), "*DATABASE_NODOUT", card(1e-6))
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "cubes.k"), "w", encoding="ascii") as file:
                file.write(deck.text())
            for command in (["import", "cubes.k", "--units", "mm,t,s"], ["run", "cubes.toml"]):
                done = subprocess.run([PROGRAM, *command], cwd=folder, capture_output=True, text=True, check=False)
                if done.returncode != 0:
                    raise AssertionError(f"{command}: {done.stdout}\n{done.stderr}")
            with h5py.File(os.path.join(folder, "results/cubes/cubes.h5"), "r") as results:
                cls.velocity = {name: cls.mean(results, name, "velocity") for name in (*names, "carried")}
                cls.displacement = {name: cls.mean(results, name, "displacement") for name in (*names, "carried")}
                turning = results["fields/turning"]
                cls.turning = turning["coordinates"][:], turning["velocity"][0]
                cls.time = results["history/time"][:]
                cls.swing = results["history/set/node_9001/displacement"][:, 2]

    @staticmethod
    def mean(results, name, field):
        """Of a body by mass: nodes weigh as the elements around them."""
        body = results["fields/" + name]
        weight = np.bincount(body["connectivity"][:].ravel(), minlength=len(body["coordinates"]))
        return weight @ body[field][-1] / weight.sum()

    @classmethod
    def add_loads(cls, deck, number):
        def nodes_of(name):
            return cls.cubes[name].ravel()

        top = cls.cubes["forced"][:, :, -1].ravel()
        deck.add("*SET_NODE_LIST", card(1), *(card(*top[i : i + 8]) for i in range(0, len(top), 8)))
        deck.add("*LOAD_NODE_SET", card(1, 1, 1, 2.0))  # 2 N on each along x
        for name, turned in (("pressed", False), ("pulled", True)):
            grid = cls.cubes[name][:, :, -1]
            deck.add("*LOAD_SEGMENT")
            for i in range(2):
                for j in range(2):
                    corners = [grid[i, j], grid[i + 1, j], grid[i + 1, j + 1], grid[i, j + 1]]
                    deck.add(card(1, 0.5, 0.0, *(corners[::-1] if turned else corners)))  # 0.5 MPa
        deck.add("*INITIAL_VELOCITY_GENERATION", card(number["turning"], 2, 100.0, 10.0, 20.0, 30.0))
        deck.add(card(1.0, 2.0, 3.0, 0.0, 0.0, 2.0))
        deck.add("*INITIAL_VELOCITY_GENERATION", card(number["damped"], 2, 0.0, 500.0, 0.0, 0.0), "")
        deck.add("*DAMPING_PART_MASS", card(number["damped"], 1, 700.0))  # 1/s
        kinds = {"driven": 0, "pushed": 1, "led": 2}
        for i, (name, kind) in enumerate(kinds.items()):
            members = nodes_of(name)
            deck.add("*SET_NODE_LIST", card(10 + i), *(card(*members[k : k + 8]) for k in range(0, len(members), 8)))
            # mm/s, mm/s2, mm; each grows from 0
            deck.add("*BOUNDARY_PRESCRIBED_MOTION_SET", card(10 + i, 1, kind, 2, (400.0, 4e5, 0.3)[kind]))
        deck.add("*LOAD_BODY_Z", card(1, 9810.0))

    @staticmethod
    def add_spring(deck):
        """A mass of 1 g on a spring of 1 N/mm that hangs from the ground; gravity pulls it down."""
        deck.nodes.append((9001, -50.0, 0.0, 0.0, 0))
        deck.nodes.append((9002, -50.0, 0.0, 20.0, 7))
        deck.add("*ELEMENT_DISCRETE", f"{9001:8d}{90:8d}{9001:8d}{9002:8d}")
        deck.add("*ELEMENT_MASS", f"{9002:8d}{9001:8d}{1e-6:16.3e}")
        deck.add("*PART", "spring", card(90, 90, 90), "*SECTION_DISCRETE", card(90, 0), "")
        deck.add("*MAT_SPRING_ELASTIC", card(90, 1.0), "*DATABASE_HISTORY_NODE", card(9001))

    def test_gravity_pulls_against_the_base(self):
        self.assertAlmostEqual(self.velocity["falling"][2] / (-9.81 * END), 1, delta=1e-9)

    def test_a_force_on_each_node_of_a_set(self):
        expected = 9 * 2.0 / (1e3 * MASS) * END  # N, kg
        self.assertAlmostEqual(self.velocity["forced"][0] / expected, 1, delta=1e-3)

    def test_pressure_pushes_and_pulls(self):
        speed = 0.5 * SIDE**2 / (1e3 * MASS) * END
        self.assertAlmostEqual((self.velocity["pressed"][2] + 9.81 * END) / -speed, 1, delta=1e-3)
        self.assertAlmostEqual((self.velocity["pulled"][2] + 9.81 * END) / speed, 1, delta=1e-3)

    def test_translation_and_rotation_at_the_start(self):
        places, velocities = self.turning
        expected = np.array([0.01, 0.02, 0.03]) + np.cross([0, 0, 100.0], places - 1e-3 * np.array([1.0, 2.0, 3.0]))
        np.testing.assert_allclose(velocities, expected, atol=2e-4)  # half a step later

    def test_damping_by_mass(self):
        self.assertAlmostEqual(self.velocity["damped"][0] / (0.5 * np.exp(-0.7)), 1, delta=1e-3)

    def test_prescribed_velocity_acceleration_displacement(self):
        self.assertAlmostEqual(self.displacement["driven"][0] / (0.4 * END / 2), 1, delta=1e-3)
        self.assertAlmostEqual(self.velocity["pushed"][0] / (400 * END / 2), 1, delta=2e-3)
        self.assertAlmostEqual(self.displacement["pushed"][0] / (400 * END**2 / 6), 1, delta=2e-3)
        self.assertAlmostEqual(self.displacement["led"][0] / 0.3e-3, 1, delta=1e-3)

    def test_tied_bodies_go_on_together(self):
        """Momentum of both is what they began with: the tied nodes of the second, half a layer of three, begin with the
        velocity of the first."""
        both = self.velocity["struck"][2] + self.velocity["carried"][2] + 2 * 9.81 * END
        self.assertAlmostEqual(both, 1 + 1 / 6, delta=1e-6)

    def test_a_mass_on_a_spring(self):
        rate = np.sqrt(1e3 / 1e-3)
        expected = -9.81 / rate**2 * (1 - np.cos(rate * self.time))
        np.testing.assert_allclose(self.swing, expected, atol=2e-3 * np.abs(expected).max())


class Cantilever(unittest.TestCase):
    """A beam of 500 mm, 20 mm high along s, 10 mm wide along t, clamped at one end: its frequencies are Euler's and
    Bernoulli's, but for some per mille of shear."""

    def test_frequencies_in_both_planes(self):
        deck, count, length = Deck("a cantilever"), 20, 500.0
        deck.block(1, (0, 100, 0), (10, 110, 10), (1, 1, 1))  # a case needs a body
        deck.part(1, "cube", 1)
        for i in range(count + 1):
            deck.nodes.append((1000 + i, length * i / count, 0.0, 0.0, 0))
        deck.nodes.append((2000, 0.0, 100.0, 0.0, 0))  # s is y
        deck.add("*ELEMENT_BEAM")
        deck.add(*("".join(f"{n:8d}" for n in (100 + i, 2, 1000 + i, 1001 + i, 2000)) for i in range(count)))
        deck.add("*BOUNDARY_SPC_NODE", card(1000, 0, 1, 1, 1, 1, 1, 1), "*PART", "beam", card(2, 2, 1))
        deck.add("*SECTION_BEAM", card(2, 1, 0.0, 0.0, 0.0), card(20.0, 20.0, 10.0, 10.0))
        deck.add("*MAT_ELASTIC", f"{1:10d}{7.85e-9:10.3e}{2.1e5:10.3e}{0.3:10.3f}", "*CONTROL_TERMINATION", card(1e-5))
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "beam.k"), "w", encoding="ascii") as file:
                file.write(deck.text())
            modes = ["modes", "beam.toml", "--up-to", "100", "--csv", "modes.csv"]
            for command in (["import", "beam.k", "--units", "mm,t,s"], modes):
                done = subprocess.run([PROGRAM, *command], cwd=folder, capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with open(os.path.join(folder, "beam.toml"), "rb") as file:
                beam = tomllib.load(file)["beams"]["beam_100"]
            with open(os.path.join(folder, "modes.csv"), encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
        column = next(name for name in rows[0] if "frequency" in name.lower() or "Hz" in name)
        found = [float(row[column]) for row in rows if float(row[column]) > 1]
        self.assertEqual((beam["height"], beam["width"], beam["orientation"]), (0.02, 0.01, [0, 1, 0]))
        expected = [
            1.87510407**2 / (2 * np.pi * 0.5**2) * np.sqrt(2.1e11 * height**2 / (12 * 7850)) for height in (0.01, 0.02)
        ]
        np.testing.assert_allclose(found, expected, rtol=5e-3)


if __name__ == "__main__":
    unittest.main()
