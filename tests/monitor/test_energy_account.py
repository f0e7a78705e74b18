#!/usr/bin/env python3
"""What `completed` says of the energy account, beside a heavy mass that travels: kept, broken (exit code 3), or not
judged."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
except ImportError:
    sys.exit(77)

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
from two_blocks import two_blocks  # noqa: E402

DONE, STOPPED = 0, 3

# A blow on bodies one element thick: penalty springs err by some per cent of it (docs/monitor.md). The traveller has
# 4.2 MJ.
CASE = two_blocks(([0.01, 0.01, 0.01], [1, 1, 1]), ([0.01, 0.01, 0.01], [1, 1, 1]), [0, 0, 0.010004]) + """\
[points.traveller]
mass = 10900
position = [0, 5, 0]
[initial_motion.travel]
parts = ["traveller"]
velocity = [27.78, 0, 0]
[initial_motion.fall]
parts = ["upper"]
velocity = [0, 0, -10]
[time]
end = 4e-5
[output]
file = "results.h5"
"""


class EnergyAccount(unittest.TestCase):
    def run_case(self, *overrides):
        folder = self.enterContext(tempfile.TemporaryDirectory(prefix="railwave-"))
        pathlib.Path(folder, "case.toml").write_text(CASE)
        command = [PROGRAM, "run", "case.toml"]
        for override in overrides:
            command += ["--set", override]
        run = subprocess.run(
            command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300, check=False
        )
        with h5py.File(pathlib.Path(folder, "results.h5"), "r") as results:
            error = float(abs(results["history/energy/balance_error"][()]).max())
            return (
                run.returncode,
                run.stdout,
                int(results.attrs["completed"]),
                error,
                float(results["history/energy/kinetic"][0]),
            )

    def test_an_account_within_its_limit_is_kept(self):
        code, said, completed, error, kinetic = self.run_case(
            "contacts.between.algorithm=multiplier", "contacts.between.friction=0"
        )
        self.assertEqual((code, completed), (DONE, 1), said)
        self.assertIn("\ncompleted\n", said)
        self.assertIn("\n  energy account kept: error at most ", said)
        self.assertNotIn("energy balance:", said)
        self.assertLess(error, 1e-3)
        self.assertGreater(kinetic, 4e6)

    def test_some_per_cent_of_what_deforms_are_seen_beside_what_travels(self):
        """And the cause is named."""
        code, said, _, error, kinetic = self.run_case("monitor.energy_error=0.001")
        self.assertEqual(code, DONE, said)
        self.assertRegex(said, r"warning: energy balance: .*bodies strike the undamped springs of contact between")
        self.assertLess(error, 1e-7 * kinetic)

    def test_an_account_beyond_its_limit_ends_the_run_as_a_fault(self):
        code, said, completed, _, _ = self.run_case("monitor.energy_error=0.0005", "monitor.fatal_energy_error=0.001")
        self.assertEqual((code, completed), (STOPPED, 0), said)
        self.assertIn("energy account broken", said)
        self.assertRegex(
            said,
            r"FAULT: energy balance: its error over what deformation has held and dissipated: .*, limit 0\.001;"
            r" .*part (upper|lower)",
        )

    def test_nobody_judges_where_the_monitor_is_off(self):
        code, said, _, _, _ = self.run_case("monitor.active=false", "monitor.fatal_energy_error=0.001")
        self.assertEqual(code, DONE, said)
        self.assertIn("\ncompleted\n", said)
        self.assertIn("\n  energy account not judged: monitor.active = false\n", said)


if __name__ == "__main__":
    unittest.main()
