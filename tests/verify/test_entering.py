#!/usr/bin/env python3
"""Bodies that come into another from beside its contact surface, through an edge or through a corner make no energy."""

import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
except ImportError:
    sys.exit(77)

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"

CASE = """
[materials.s]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.cube]
type = "box"
size = [0.01, 0.01, 0.01]
divisions = [4, 4, 4]
[parts.low]
mesh = "cube"
material = "s"
[parts.up]
mesh = "cube"
material = "s"
position = {position}
[constraints.floor]
target = "low.z_min"
fixed = ["x", "y", "z"]
[contacts.pair]
slave = "{slave}"
master = {master}
algorithm = "{algorithm}"
[initial_motion.go]
parts = ["up"]
velocity = {velocity}
[time]
end = {end}
[output]
history_interval = {interval}
"""
TOP, ALL = '"low.z_max"', '["low.z_max", "low.y_max", "low.x_max", "low.x_min", "low.y_min"]'
# Where the upper body begins, where it goes: from beside under the top's edge; through the edge; through the corner;
# from beside, but 0.1 um under the top.
WAYS = {
    "beside": ([0.0003, 0.0101, 0.0095], [0, -1, 0]),
    "edge": ([0.0003, 0.01 + 2e-5, 0.01 + 2e-5], [0, -1, -1]),
    "corner": ([0.01 + 2e-5, 0.01 + 2e-5, 0.01 + 2e-5], [-1, -1, -1]),
    "along the top": ([0.0003, 0.0101, 0.01 - 1e-7], [0, -1, 0]),
}


class Entering(unittest.TestCase):
    def energy_made(self, way, speed, master, algorithm, slave="up.z_min"):
        """The most that was made, over the kinetic energy; and what was said."""
        position, direction = WAYS[way]
        velocity = [speed * c / math.hypot(*direction) for c in direction]
        end = min(2e-3, 6e-4 / speed)
        with tempfile.TemporaryDirectory(prefix="railwave-") as name:
            folder = pathlib.Path(name)
            (folder / "case.toml").write_text(
                CASE.format(
                    position=position, velocity=velocity, slave=slave, master=master, algorithm=algorithm, end=end,
                    interval=end / 50,
                )
            )
            done = subprocess.run(
                [PROGRAM, "run", "case.toml"], cwd=folder, capture_output=True, text=True, check=False
            )
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with h5py.File(folder / "results" / "case" / "case.h5") as file:
                energy = file["history/energy"]
                kinetic = energy["kinetic"][:]
                whole = kinetic + energy["internal"][:] + energy["contact"][:] + energy["hourglass"][:]
        return (whole.max() - kinetic[0]) / kinetic[0], done.stdout + done.stderr

    def test_no_energy_is_made(self):
        for way in WAYS:
            for speed in (0.1, 1, 10, 100):
                for master in (TOP, ALL):
                    with self.subTest(way=way, speed=speed, master=master):
                        self.assertLess(self.energy_made(way, speed, master, "penalty")[0], 0.01)

    def test_no_energy_is_made_by_multipliers(self):
        for way in WAYS:
            for master in (TOP, ALL):
                with self.subTest(way=way, master=master):
                    self.assertLess(self.energy_made(way, 10, master, "multiplier")[0], 0.01)

    def test_it_is_reported(self):
        self.assertIn("came in beside its surface low.z_max", self.energy_made("beside", 1, TOP, "penalty")[1])


if __name__ == "__main__":
    unittest.main()
