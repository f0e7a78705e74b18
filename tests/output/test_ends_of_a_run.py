#!/usr/bin/env python3
"""How `railwave run` ends when it is interrupted and when the disk is full: what the results hold, what is said, exit
codes."""

import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import h5py
except ImportError:
    sys.exit(77)

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
CASE = """
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.block]
type = "box"
size = [0.1, 0.1, 0.1]
divisions = [9, 8, 7]
[parts.block]
mesh = "block"
material = "steel"
[gravity]
acceleration = [1, 2, -9.81]
[time]
end = {end}
[output]
file = "results.h5"
history_interval = 2e-5
field_interval = 1e-4
field_sets = ["block", "block.z_max"]
fields = ["displacement", "velocity", "stress"]
"""


def full_disk(size):
    """No file of the program grows beyond that many bytes."""
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
    return limit


class EndsOfARun(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name)
        self.results = self.folder / "results.h5"

    def start(self, end, **options):
        (self.folder / "case.toml").write_text(CASE.format(end=end))
        return subprocess.Popen(
            [PROGRAM, "run", "case.toml"],
            cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
            **options
        )

    def test_interrupted(self):
        run = self.start(end=1e3)
        give_up = time.monotonic() + 60
        while not self.results.exists():
            self.assertLess(time.monotonic(), give_up, "no results")
            self.assertIsNone(run.poll(), "the run has ended by itself")
            time.sleep(0.01)
        run.send_signal(signal.SIGINT)
        _, said = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 130)
        self.assertEqual(said, "")
        with h5py.File(self.results, "r") as file:
            self.assertEqual(file.attrs["completed"], 0)
            self.assertTrue(file.attrs["reason"].startswith("interrupted at step"))
            steps = file.attrs["steps"]
            self.assertGreater(steps, 0)
            for name in ("history", "fields/block", "fields/block.z_max"):
                self.assertEqual(file[name]["step"][-1], steps, name)
                self.assertEqual(file[name]["time"][-1], file.attrs["time_reached"], name)
                self.assertEqual(len(file[name]["time"]), len(file[name]["step"]), name)
            self.assertEqual(len(file["fields/block/stress"]), len(file["fields/block/time"]))

    def test_full_disk(self):
        run = self.start(end=1e3, preexec_fn=full_disk(400000))
        try:
            _, said = run.communicate(timeout=60)  # the run ends itself, long before its last step
        finally:
            run.kill()
        self.assertEqual(run.returncode, 1, said)
        self.assertTrue(said.startswith("railwave: "), said)
        self.assertIn("File too large", said)
        self.assertNotIn("HDF5-DIAG", said)
        self.assertEqual(said.count("railwave:"), 1)


if __name__ == "__main__":
    unittest.main()
