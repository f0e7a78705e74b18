#!/usr/bin/env python3
"""Runs that are killed at random moments, a handful of scripts/kill_test's."""

import os
import pathlib
import subprocess
import sys
import unittest

try:
    import h5py  # noqa: F401  (the script needs it)
except ImportError:
    sys.exit(77)

SCRIPT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"]) / "scripts" / "kill_test"
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"


class Kills(unittest.TestCase):
    def test_killed_runs_are_taken_up_again(self):
        done = subprocess.run(
            [sys.executable, "-B", SCRIPT, "--kills", "6", "--seed", "7", "--program", PROGRAM],
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("6 kills: 6 of 6 taken up again", done.stdout)


if __name__ == "__main__":
    unittest.main()
