"""scripts/free_vibration: the wheel rings in the explicit run at the frequencies of its modes, within 0.5 %."""

import os
import subprocess
import sys
import unittest

ROOT = os.environ["RAILWAVE_SOURCE_DIR"]
PROGRAM = os.path.join(os.environ["RAILWAVE_BIN_DIR"], "railwave")


class FreeVibration(unittest.TestCase):
    def test_the_run_rings_at_the_frequencies_of_its_modes(self):
        script = os.path.join(ROOT, "scripts", "free_vibration")
        done = subprocess.run(
            [sys.executable, "-B", script, "--program", PROGRAM], capture_output=True, text=True, check=False
        )
        print(done.stdout)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
