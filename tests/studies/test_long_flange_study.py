#!/usr/bin/env python3
"""The study of one and two contact points, coarse, with one angle, by its one command: a table, pictures, and nothing
computed twice."""

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
            words = [sys.executable, ROOT / "studies" / "flange" / "run", "--coarse", "--angles", "25",
                     "--out", folder, "--program", PROGRAM]
            first = subprocess.run(words, capture_output=True, text=True)
            self.assertEqual(first.returncode, 0, first.stdout[-4000:] + first.stderr[-4000:])
            with open(pathlib.Path(folder) / "table.csv", newline="", encoding="utf-8") as file:
                found = {row["what"].removeprefix("25 mrad: "): row["found"] for row in csv.DictReader(file)}
            for picture in ("forces", "shear", "footprints", "frames_25_patch_1", "frames_25_patch_2"):
                self.assertTrue((pathlib.Path(folder) / f"{picture}.png").exists(), picture)
            second = subprocess.run(words, capture_output=True, text=True)
            self.assertEqual(second.returncode, 0, second.stderr[-4000:])
            self.assertEqual(second.stdout.count("there already"), first.stdout.count("== "))
        # In elements of 4 mm the flange's patch is two or three long, and on the short way the axle bends less before:
        # 0.329 m.
        self.assertLess(abs(float(found["the flange touches at"].split()[0]) / 0.29 - 1), 0.2)
        # The gauge corner of 13 mm turns by 18 degrees from one facet of 4 mm to the next.
        for angle in found["contact angle of patch 2"].removesuffix(" deg").split(" to "):
            self.assertLess(abs(float(angle) - 70), 18)
        self.assertLess(float(found["energy balance; static start; wall time"].split()[0]), 0.5)


if __name__ == "__main__":
    unittest.main()
