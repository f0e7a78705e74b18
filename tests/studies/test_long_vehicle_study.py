#!/usr/bin/env python3
"""The study of a bogie on a wheelset by its one command, as far as the weld: a table, pictures, nothing
computed twice. Skipped where Simbody was not found at the build."""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from test_vehicle_study import PROGRAM, simbody_was_found

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])


class Whole(unittest.TestCase):
    def test_into_the_weld(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            words = [sys.executable, ROOT / "studies" / "vehicle" / "run", "--until", "3e-3", "--out", folder,
                     "--program", PROGRAM.parent / "railwave"]
            first = subprocess.run(words, capture_output=True, text=True)
            self.assertEqual(first.returncode, 0, first.stdout[-4000:] + first.stderr[-4000:])
            with open(pathlib.Path(folder) / "table.csv", newline="", encoding="utf-8") as file:
                found = {row["what"]: row["found"] for row in csv.DictReader(file)}
            for picture in ("two_masses", "weld", "one_way"):
                self.assertTrue((pathlib.Path(folder) / f"{picture}.png").exists(), picture)
            second = subprocess.run(words, capture_output=True, text=True)
            self.assertEqual(second.returncode, 0, second.stderr[-4000:])
            self.assertEqual(second.stdout.count("there already"), first.stdout.count("== "))
        closing = [(what, float(value)) for what, value in found.items() if "closes" in what]
        self.assertEqual(len(closing), 2)
        for what, closes in closing:
            self.assertLess(closes, 1e-6, what)
        off = {way: [float(value.split()[0]) for what, value in found.items() if f"one-way, {way}" in what][0]
               for way in ("forces of the coupled run", "the static force")}  # N, of the contact force
        self.assertEqual(off["forces of the coupled run"], 0)  # the same forces at the same steps
        self.assertGreater(off["the static force"], 3)


if __name__ == "__main__":
    if not PROGRAM.exists() and not simbody_was_found():
        print("skipped: Simbody was not found at the build; scripts/setup --simbody installs it")
        sys.exit(77)
    unittest.main()
