"""scripts/picture --signal: a picture of each kind of analysis, and what it says of other files."""

import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from made_up_results import SOURCE_DIR, signal, write_results

UP, ALONG, ONE = "rail.p_*.velocity.z", "rail.p_*.velocity.x", "rail.p_3.velocity.z"
BAND = ("--low", "20e3", "--high", "60e3")
KINDS = {
    "psd": ("--channel", ONE),
    "wavelet": ("--channel", ONE, "--low", "1e4"),
    "bandpass": ("--channel", ONE, *BAND),
    "cross": ("--channel", ALONG, "--channel", UP, *BAND),
    "ellipse": ("--channel", ALONG, "--channel", UP, *BAND),
    "speed": ("--channel", UP, *BAND),
}


def picture(*arguments):
    return subprocess.run(
        [sys.executable, os.path.join(SOURCE_DIR, "scripts", "picture"), *arguments], capture_output=True, text=True
    )


class Pictures(unittest.TestCase):
    def test_each_kind_is_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            results = os.path.join(folder, "run.h5")
            write_results(results, {})
            for kind, options in KINDS.items():
                found = os.path.join(folder, "found.h5")
                if os.path.exists(found):
                    os.remove(found)
                signal(kind, results, *options, "--hdf5", found)
                drawn = picture("--signal", found, "--resolution", "60")
                self.assertEqual(drawn.returncode, 0, drawn.stderr)
                path = os.path.join(folder, f"found-{kind}.png")
                self.assertIn(path, drawn.stdout)
                self.assertGreater(os.path.getsize(path), 3000, kind)
            refused = picture("--signal", results)
            self.assertEqual(refused.returncode, 2)
            self.assertIn("is no file that 'railwave signal --hdf5' wrote", refused.stderr)


if __name__ == "__main__":
    unittest.main()
