"""cases/wheel_modes.toml: the modes that the thesis names (table 5.3), each within 5 %."""

import csv
import os
import subprocess
import tempfile
import unittest

ROOT = os.environ["RAILWAVE_SOURCE_DIR"]
PROGRAM = os.path.join(os.environ["RAILWAVE_BIN_DIR"], "railwave")
# Hz, by kind, nodal circles, nodal diameters
THESIS = {("axial", 0, 0): 183, ("axial", 0, 3): 1075, ("axial", 0, 4): 1934}


class WheelModes(unittest.TestCase):
    def test_the_wheel_has_the_modes_of_the_thesis(self):
        with tempfile.TemporaryDirectory(prefix="railwave-modes-") as scratch:
            table = os.path.join(scratch, "wheel.csv")
            case = os.path.join(ROOT, "cases", "wheel_modes.toml")
            done = subprocess.run(
                [PROGRAM, "modes", case, "--up-to", "2000", "--csv", table], capture_output=True, text=True, check=False
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(table, newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
        found = {}
        for row in rows:
            name = row["kind"], int(row["nodal_circles"]), int(row["nodal_diameters"])
            found.setdefault(name, []).append(float(row["frequency"]))
        for name, expected in THESIS.items():
            self.assertEqual(len(found[name]), 1 if name[2] == 0 else 2, name)
            for frequency in found[name]:
                print(f"{name}: {frequency:.1f} Hz, {100 * (frequency / expected - 1):+.2f} % off {expected} Hz")
                self.assertLess(abs(frequency / expected - 1), 0.05, name)


if __name__ == "__main__":
    unittest.main()
