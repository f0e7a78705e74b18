#!/usr/bin/env python3
"""The study of decks whole: figures within 5 % of theory and of OpenRadioss; forces, energy balances and impacts on
walls closer."""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"


class Whole(unittest.TestCase):
    def test_forces_times_energies(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            words = [sys.executable, ROOT / "studies" / "decks" / "run", "--program", PROGRAM, "--out", folder]
            done = subprocess.run(words, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout[-4000:] + done.stderr[-4000:])
            with open(pathlib.Path(folder) / "table.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            with open(pathlib.Path(folder) / "openradioss.csv", newline="", encoding="utf-8") as file:
                beside = list(csv.DictReader(file))
        forces = [row for row in rows if "force" in row["what"]]
        balances = [row for row in rows if row["what"].startswith("error of the energy balance")]
        self.assertEqual((len(forces), len(balances)), (4, 5))
        for row in forces:
            self.assertLess(abs(float(row["off by"].split()[0])), 2, row)
        compared = [row for row in beside if row["found"]]
        self.assertEqual((len(beside) - len(compared), len(compared)), (5, 17))
        for row in compared[:9]:  # impacts on walls, without penalty springs
            self.assertLess(abs(float(row["off by"].split()[0])), 2, row)
        for row in balances:
            self.assertLess(float(row["found"].split()[0]), 0.3, row)  # Taylor's bar, coarse: 0.14 %


if __name__ == "__main__":
    unittest.main()
