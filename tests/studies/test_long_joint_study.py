#!/usr/bin/env python3
"""The study of the insulated joint, coarse, by its one command: a table with a row for each finding, pictures, and
nothing computed twice."""

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
    def test_coarse(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            words = [
                sys.executable, ROOT / "studies" / "joint" / "run", "--coarse", "--out", folder, "--program", PROGRAM
            ]
            first = subprocess.run(words, capture_output=True, text=True)
            self.assertEqual(first.returncode, 0, first.stdout[-4000:] + first.stderr[-4000:])
            with open(pathlib.Path(folder) / "table.csv", newline="", encoding="utf-8") as file:
                found = {row["what"]: row["found"] for row in csv.DictReader(file)}
            pictures = ["accelerance.png", "forces.png", "footprint.png", "footprints.png", "patches.png"]
            for number in (1, 2, 3):
                pictures += [f"{kind}_{number}.png" for kind in ("landing", "surface")]
                pictures += [f"adhesion_{number}_1.png", f"wavelet_{number}_vertical.png", f"approach_{number}.gif"]
            for picture in pictures:
                self.assertTrue((pathlib.Path(folder) / picture).exists(), picture)
            second = subprocess.run(words, capture_output=True, text=True)
            self.assertEqual(second.returncode, 0, second.stderr[-4000:])
            self.assertEqual(second.stdout.count("there already"), first.stdout.count("== "))
        f2 = float(found["rail on fastening, f2: peak at the rail end, vertical"].split()[0])
        self.assertTrue(250 < f2 < 450, f2)
        for number in (1, 2, 3):
            name = f"simulation {number}"
            force = float(found[f"{name}: force of the first impact"].split()[0])
            self.assertTrue(100 < force < 600, force)
            balance = float(found[f"{name}: energy balance over the largest elastic energy"].split()[0])
            self.assertLess(balance, 0.5)
            self.assertNotEqual(found[f"{name}: first touch of the second rail"], "none")
        self.assertIn("order of the forces of the first impact", found)


if __name__ == "__main__":
    unittest.main()
