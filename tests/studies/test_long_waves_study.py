#!/usr/bin/env python3
"""The study of waves, coarse, by its one command: a table with a row for each finding, pictures, nothing computed
twice, and the same table from what was packed."""

import csv
import os
import pathlib
import subprocess
import sys
import tarfile
import tempfile
import unittest

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
PICTURES = ("creepage_waves.png", "creepage_surface.png", "creepage_nodes.png", "perturbation_places.png",
            "perturbation_times.png", "perturbation_spread.png", "crack_force.png", "crack_waves.png",
            "crack_ways.png", "crack_nearing.gif", "crack_over.gif")


class Whole(unittest.TestCase):
    def run_study(self, *options):
        words = [sys.executable, ROOT / "studies" / "waves" / "run", "--coarse", "--program", PROGRAM, *options]
        done = subprocess.run(words, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout[-4000:] + done.stderr[-4000:])
        return done.stdout

    def table(self, folder):
        with open(pathlib.Path(folder) / "table.csv", newline="", encoding="utf-8") as file:
            return {row["what"]: row["found"] for row in csv.DictReader(file)}

    def test_coarse(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as name:
            folder, packed, again = (pathlib.Path(name) / part for part in ("study", "packed", "again"))
            first = self.run_study("--out", folder, "--pack", packed)
            found = self.table(folder)
            for picture in PICTURES:
                self.assertTrue((folder / picture).exists(), picture)
            second = self.run_study("--out", folder)
            self.assertEqual(second.count("there already"), first.count("== "))
            with tarfile.open(packed / "findings.tar") as tar:
                self.assertLessEqual({"table.md", "table.csv", *PICTURES}, set(tar.getnames()))
            self.run_study("--out", again, "--data", packed)
            self.assertEqual(self.table(again), found)

        def numbers(start):
            (text,) = (text for what, text in found.items() if what.startswith(start))
            return [float(word) for word in text.replace("%", " ").replace(";", " ").replace(",", " ").split()
                    if word.strip("+-.0123456789") == ""]

        off, mean = numbers("crack: normal force over that of the sound rail")
        self.assertLess(abs(off), 5)
        self.assertLess(abs(mean), 5)
        self.assertGreater(numbers("crack: nodes in contact")[1], 0.7)
        largest, _, _ = numbers("crack: error of the energy balance")
        self.assertLess(abs(largest), 0.5)  # J, of 60 that are held
        # Torques one against the other.
        along = [float(next(text for what, text in found.items() if what.startswith(f"{run}: share of friction"))
                       .split("; ")[1].split()[0]) for run in ("traction", "braking")]
        self.assertGreater(along[0], 20)
        self.assertLess(along[1], -20)
        # In the mesh itself waves are Rayleigh's, and slower the shorter they are.
        speeds = [float(text.split()[0]) for what, text in found.items() if what.startswith("Rayleigh waves in a mesh")]
        self.assertEqual(speeds, sorted(speeds, reverse=True))
        self.assertLess(abs(speeds[0] / 2.984 - 1), 0.02)


if __name__ == "__main__":
    unittest.main()
