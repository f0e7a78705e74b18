#!/usr/bin/python3
"""The verification cases of the contact at ten elements over the patch, by multipliers, within what is promised of
them. The whole table, with other meshes, algorithms and penalties, is scripts/verify_contact's."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
sys.path.insert(0, str(ROOT / "scripts"))
from verification.cases import CASES  # noqa: E402
from verification.measured import Run  # noqa: E402

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"


class ContactCases(unittest.TestCase):
    def figures(self, name, points=None):
        with tempfile.TemporaryDirectory() as folder:

            def run(label, case, overrides):
                results = pathlib.Path(folder) / f"{label}.h5"
                command = [PROGRAM, "run", ROOT / "cases" / "verify" / f"{case}.toml"]
                for override in [*overrides, f"output.file={results}"]:
                    command += ["--set", override]
                subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
                return Run(results, PROGRAM)

            contact = CASES[name].contact
            outcome = CASES[name](run, name, 10, [f"contacts.{contact}.algorithm=multiplier"], points)
            return {
                what.strip(): (computed / exact - 1 if exact else computed)
                for what, computed, exact, _ in outcome.figures
            }

    def check(self, figures, limits):
        for what, limit in limits.items():
            found = [error for name, error in figures.items() if name.startswith(what)]
            self.assertTrue(found, what)
            for error in found:
                self.assertLess(abs(error), limit, what)

    def test_hertz(self):
        for name in ("hertz_sphere", "hertz_ellipse"):
            self.check(self.figures(name), {"peak pressure": 0.04, "patch area": 0.06, "approach": 0.03})

    def test_cattaneo(self):
        self.check(self.figures("cattaneo"), {"stick radius": 0.05, "peak pressure": 0.04})

    def test_carter(self):
        self.check(self.figures("carter", ["0.6"]), {"creep force, N/m": 0.04, "creepage for this force": 0.04})

    def test_rolling(self):
        self.check(self.figures("rolling", ["a"]), {"(a) creepage for these forces": 0.06, "(a) stick share": 0.10,
                                                    "(a) direction of the creep force": 5,
                                                    "(a) direction of the shear": 5,
                                                    "(a) longitudinal creepage, of the bodies' motion": 0.06})

    def test_rolling_with_one_creepage_alone(self):
        for point in ("longitudinal", "lateral", "spin"):
            self.check(
                self.figures("rolling", [point]),
                {
                    f"({point}) creepage for these forces": 0.06,
                    f"({point}) stick share of the patch, zero line": 0.10,
                    f"({point}) direction of the creep force": 5,
                    f"({point}) direction of the shear": 5,
                },
            )


if __name__ == "__main__":
    unittest.main()
