#!/usr/bin/env python3
"""The study of decks (studies/decks), coarse: all figures within 5 % of theory; nothing is computed twice; a demand
that is not met ends it with an error."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"


class Coarse(unittest.TestCase):
    def run_study(self, folder, *options):
        words = [sys.executable, ROOT / "studies" / "decks" / "run", "--coarse", "--program", PROGRAM, "--out", folder]
        words += ["--only", "rod_on_wall,plastic_bar,two_bars,balls"]  # without Taylor's bar: seconds
        return subprocess.run([*words, *options], capture_output=True, text=True, check=False)

    def test_within_five_percent(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as name:
            folder = pathlib.Path(name)
            first = self.run_study(folder)
            self.assertEqual(first.returncode, 0, first.stdout[-4000:] + first.stderr[-4000:])
            self.assertEqual(first.stdout.count("kinetic energy at the begin"), 4)
            with h5py.File(folder / "rod_on_wall_coarse.h5", "r") as results:
                self.assertEqual(np.abs(results["fields/rigid_wall_1/velocity"][-1]).max(), 0)
            again = self.run_study(folder, "--within", "1")
            self.assertEqual(again.stdout.count("there already"), first.stdout.count("== "))
            self.assertNotEqual(again.returncode, 0)
            self.assertIn("demanded are 1 %", again.stderr)
            self.assertEqual((folder / "table.md").read_text(), first.stdout[first.stdout.index("| what"):])

    def test_wrong_options(self):
        for options in (["--only", "rod"], ["--within", "0"]):
            self.assertEqual(self.run_study("unused", *options).returncode, 2)


if __name__ == "__main__":
    unittest.main()
