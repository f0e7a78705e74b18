"""The step and the time that --restart names are those of one and the same instant."""

import os
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.path.join(os.environ.get("RAILWAVE_BIN_DIR", "build/release/bin"), "railwave")
CASE = """
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
[initial_motion.fall]
parts = ["block"]
velocity = [0, 0, -1]
[time]
end = 1e-3
[output]
file = "block.h5"
history_interval = 1e-4
"""


def run(folder, *words):
    return subprocess.run(
        [PROGRAM, "run", "case.toml", *words], cwd=folder, capture_output=True, text=True, timeout=120
    )


class RestartStep(unittest.TestCase):
    def test_step_and_time_belong_together(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "case.toml"), "w", encoding="utf-8") as file:
                file.write(CASE)
            first = run(folder, "--keep-state")
            self.assertEqual(first.returncode, 0, first.stdout + first.stderr)
            again = run(folder, "--restart", "--set", "time.end=2e-3")
            self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
            goes_on = re.search(r"goes on from .*: step (\d+), t = (\S+) s", again.stdout)
            # The checkpoint is that of the first run's end; the time of the step before it was reported once.
            self.assertEqual(goes_on[1], re.search(r"in (\d+) steps", first.stdout)[1])
            self.assertAlmostEqual(float(goes_on[2]), 1e-3, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
