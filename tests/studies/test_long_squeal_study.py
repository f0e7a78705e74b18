#!/usr/bin/env python3
"""The study of squeal, coarse, by its one command: a table with a row for each finding, pictures, and nothing computed
twice."""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
PICTURES = ("forces", "carried", "swing", "solutions_1", "solutions_2", "solutions_3", "solutions_4", "falling",
            "theory", "vibration", "wavelet_1_lateral", "wavelet_4_longitudinal")


class Whole(unittest.TestCase):
    def test_coarse(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            words = [
                sys.executable, ROOT / "studies" / "squeal" / "run", "--coarse", "--out", folder, "--program", PROGRAM
            ]
            first = subprocess.run(words, capture_output=True, text=True)
            self.assertEqual(first.returncode, 0, first.stdout[-4000:] + first.stderr[-4000:])
            with open(pathlib.Path(folder) / "table.csv", newline="", encoding="utf-8") as file:
                found = {row["what"]: row["found"] for row in csv.DictReader(file)}
            for picture in PICTURES:
                self.assertTrue((pathlib.Path(folder) / f"{picture}.png").exists(), picture)
            second = subprocess.run(words, capture_output=True, text=True)
            self.assertEqual(second.returncode, 0, second.stderr[-4000:])
            self.assertEqual(second.stdout.count("there already"), first.stdout.count("== "))

        def forces(start):
            (where,) = {what.rsplit(",", 1)[0] for what in found if what.startswith(f"{start}: case")}
            return [float(found[f"{where}, {name} force"].split()[0]) for name in ("normal", "lateral", "longitudinal")]

        # The lateral force of the motion that is larger is larger, and friction is used up in the end.
        lateral = [forces(name)[1] for name in ("a", "b", "c")]
        self.assertEqual(lateral, sorted(lateral))
        normal, across, along = forces("f")
        self.assertGreater(across, along)
        self.assertLess(abs((across**2 + along**2) ** 0.5 / (0.45 * normal) - 1), 0.05)


if __name__ == "__main__":
    unittest.main()
