#!/usr/bin/env python3
"""The Python module computes what the program does, bit for bit, window by window; and is half of two masses on a
spring, whose other half is computed here, with windows that are taken back until both agree."""

import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

BIN = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"])
sys.path.insert(0, str(BIN.parent / "python"))
sys.path.insert(0, str(pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"]) / "tests" / "output"))
try:
    import h5py
    import numpy as np
    import railwave
    from blocks_case import KINDS, case
except ImportError as missing:
    print(missing)
    sys.exit(77)

WINDOW = 1e-5

BLOCK = """
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.block]
type = "box"
size = [0.1, 0.1, 0.1]
divisions = [2, 2, 2]
[parts.block]
mesh = "block"
material = "steel"
[curves.suspension]
type = "table"
points = [[0, 0]]
[loads.suspension]
type = "nodal_force"
target = "block.z_max"
force = [0, 0, 1]
curve = "suspension"
[time]
end = 1
[monitor]
active = false
[output]
history_sets = ["block.z_max"]
"""


class Module(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        self.addCleanup(temporary.cleanup)
        self.case = pathlib.Path(temporary.name) / "case.toml"

    def compare(self, text):
        self.case.write_text(text)
        subprocess.run([BIN / "railwave", "run", "case.toml", "--set", f"output.history_interval={WINDOW}"],
                       cwd=self.case.parent, check=True, stdout=subprocess.DEVNULL)
        run = railwave.Simulation(str(self.case), WINDOW)
        with h5py.File(self.case.parent / "results.h5") as file:
            times, row = file["history/time"][()], 0
            self.assertGreater(len(times), 10)
            while True:
                self.assertEqual(run.time, times[row])
                for name in run.histories:
                    kind, _, rest = name.partition(".")
                    middle, _, quantity = rest.rpartition(".")
                    place = "/".join(part for part in ("history", kind, middle, quantity) if part)
                    if place not in file:  # of a load, its direction and a force that stays as it is
                        self.assertEqual(kind, "load")
                        continue
                    np.testing.assert_array_equal(np.ravel(file[place][row]), run.values(name), name)
                field = file["fields/upper/displacement"]
                if row == len(times) - 1:
                    np.testing.assert_array_equal(field[-1], run.field("displacement", "upper"))
                    break
                run.advance()
                row += 1
        self.assertFalse(run.advance() if not run.end else False)
        self.assertEqual(run.end, "completed")

    def test_the_program_and_the_module_compute_the_same(self):
        for kind in ("penalty", "multiplier"):
            with self.subTest(kind):
                options = dict(KINDS[kind])
                options["end"] = 0.3 * options.get("end", 1.2e-3)
                self.compare(case(**options))

    def test_two_masses_on_a_spring(self):
        """A block of steel and a mass that this test computes, free but for a spring between them."""
        self.case.write_text(BLOCK)
        run = railwave.Simulation(str(self.case), WINDOW)
        mass, other = 7.8, 20.0
        frequency = 60.0  # Hz, far below the block's own
        stiffness = (2 * math.pi * frequency) ** 2 * mass * other / (mass + other)
        place, speed = 1e-3, 0.0  # m, m/s, of the other one, above where the spring holds nothing
        z = force = 0.0
        work, distances, times, taken_back = 0.0, [], [], 0

        def accelerations(spring):
            return -spring / other

        force_now = stiffness * (place - z)
        run.drive("suspension", force_now)  # from nothing within the first window
        before_z, before_force = z, 0.0
        while run.time < 1.4 / frequency:
            state, begin = run.save(), run.time
            guess = force_now
            for _ in range(8):
                run.drive("suspension", guess)
                run.advance()
                step = run.time - begin
                z = run.values("set.block.z_max.displacement")[2]
                # The other mass by the mean of its accelerations at both ends.
                mean = 0.5 * (accelerations(before_force) + accelerations(guess))
                next_place, next_speed = place + step * speed + 0.5 * step ** 2 * mean, speed + step * mean
                wanted = stiffness * (next_place - z)
                if abs(wanted - guess) <= 1e-10 * stiffness * 1e-3:
                    break
                guess = wanted
                run.restore(state)
                taken_back += 1
            else:
                self.fail("the windows do not agree")
            work += 0.5 * (before_force + guess) * (z - before_z)
            place, speed, before_z, before_force, force_now = next_place, next_speed, z, guess, guess
            distances.append(place - z)
            times.append(run.time)
        self.assertGreater(taken_back, 100)
        # The distance is a cosine; where it first crosses zero downwards is a quarter of the period.
        distances, times = np.array(distances), np.array(times)
        crossings = np.flatnonzero((distances[:-1] > 0) & (distances[1:] <= 0))
        at = [times[k] + (times[k + 1] - times[k]) * distances[k] / (distances[k] - distances[k + 1])
              for k in crossings]
        self.assertGreaterEqual(len(at), 2)
        self.assertAlmostEqual((at[1] - at[0]) * frequency, 1, delta=0.01)
        # What the spring did on the block, by both sides' accounts.
        given = run.values("energy.external_work")[0]  # of windows of one step; of longer ones docs/library.md
        largest = 0.5 * stiffness * 1e-6
        self.assertLess(abs(given - work), 1e-9 * largest)

    def test_mistakes_are_errors_of_python(self):
        self.case.write_text(BLOCK)
        with self.assertRaises(railwave.InputError):
            railwave.Simulation(str(self.case), -1)
        with self.assertRaisesRegex(ValueError, "ende"):
            railwave.Simulation(str(self.case), WINDOW, ["time.ende=1"])
        run = railwave.Simulation(str(self.case), WINDOW, ["time.end=1e-4"])
        with self.assertRaisesRegex(ValueError, "known are"):
            run.values("nothing")


if __name__ == "__main__":
    unittest.main()
