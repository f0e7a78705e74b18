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
        for options in (["--only", "rod"], ["--within", "0"], ["--openradioss", "unused"]):
            self.assertEqual(self.run_study("unused", *options).returncode, 2)


class BesideOpenRadioss(unittest.TestCase):
    def run_study(self, folder, *options):
        words = [sys.executable, ROOT / "studies" / "decks" / "run", "--program", PROGRAM, "--out", folder / "out"]
        return subprocess.run([*words, "--only", "rod_on_wall", *options], capture_output=True, text=True, check=False)

    def history(self, folder, times, momentum, kinetic, internal):
        """A time history as th_to_csv writes it, in inches, slinches and seconds."""
        titles = ["time", "INTERNAL ENERGY", "KINETIC ENERGY", "CONTACT ENERGY", "PLASTIC WORK", "rod    ZMOM "]
        rows = [titles, *([t, internal, kinetic, 0.0, 0.0, p] for t, p in zip(times, momentum))]
        text = "\n".join(",".join(str(field) for field in row) for row in rows) + "\n"
        (folder / "rod_on_wallT01.csv").write_text(text, encoding="utf-8")

    def test_own_history(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as name:
            folder = pathlib.Path(name)
            first = self.run_study(folder)
            self.assertEqual(first.returncode, 0, first.stdout[-4000:] + first.stderr[-4000:])
            self.assertIn("| contact force | 133.2 kN | 133.2 kN |", first.stdout)
            missing = self.run_study(folder, "--openradioss", folder / "theirs")
            self.assertEqual(missing.returncode, 1)
            self.assertIn("rod_on_wallT01.csv: is not there", missing.stderr)
            self.assertTrue((folder / "theirs" / "rod_on_wall.k").exists())
            # 1000 slinch in/s2 for 0.1 ms of 0.2 ms, or 4.45 kN: far from the rod's 133 kN.
            times = np.linspace(0, 2e-4, 2001)
            momentum = 1000 * np.clip(times - 5e-5, 0, 1e-4)
            self.history(folder / "theirs", times, momentum, 0.0, 150.0)
            other = self.run_study(folder, "--openradioss", folder / "theirs")
            self.assertEqual(other.returncode, 1)
            self.assertIn("| contact force | 133.2 kN | 4.448 kN |", other.stdout)
            self.assertIn("| energy stored and dissipated at most | 16.86 J | 16.95 J |", other.stdout)


if __name__ == "__main__":
    unittest.main()
