"""scripts/picture: what it draws of the made-up run, and what it says when it cannot."""

import os
import struct
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from sample import SOURCE_DIR, SampleTest

SCRIPTS = os.path.join(SOURCE_DIR, "scripts")
sys.path.insert(0, SCRIPTS)
from pictures.contact_solution import ContactSolution, solve

PROGRAM = os.path.join(os.environ.get("RAILWAVE_BIN_DIR", ""), "railwave")


def picture(*arguments, options=(), program=PROGRAM):
    return subprocess.run(
        [sys.executable, *options, os.path.join(SCRIPTS, "picture"), *arguments, "--program", program],
        capture_output=True,
        text=True,
    )


def png_size(path):
    with open(path, "rb") as file:
        head = file.read(24)
    assert head[:8] == b"\x89PNG\r\n\x1a\n", path
    return struct.unpack(">II", head[16:24])


class Pictures(SampleTest):
    def test_all_pictures_are_drawn(self):
        out = os.path.join(self.sample.folder, "drawn", "here")
        result = picture(self.sample.path, "--out", out, "--time", "2.1e-4")
        self.assertEqual(result.returncode, 0, result.stderr)
        expected = [f"run-{name}.png" for name in ("energies", "forces", "tread-evolution", "tread-patch", "tread-row")]
        self.assertEqual(sorted(os.listdir(out)), expected)
        for name in expected:
            width, height = png_size(os.path.join(out, name))
            self.assertGreater(min(width, height), 300, name)
            self.assertIn(name, result.stdout)

    def test_only_what_is_asked_for(self):
        out = os.path.join(self.sample.folder, "some")
        result = picture(
            self.sample.path, "--out", out, "--only", "row,forces", "--times", "1e-4,4e-4", "--resolution", "60"
        )
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(os.listdir(out)), ["run-forces.png", "run-tread-row.png"])
        result = picture(self.sample.path, "--only", "patches")
        self.assertEqual(result.returncode, 2)
        self.assertIn("--only patches: there are forces, energies, patch", result.stderr)

    def test_the_animation_has_a_frame_for_each_output(self):
        from PIL import Image

        out = os.path.join(self.sample.folder, "moving")
        result = picture(self.sample.path, "--out", out, "--animate")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(os.listdir(out), ["run-tread.gif"])
        with Image.open(os.path.join(out, "run-tread.gif")) as image:
            self.assertEqual(image.n_frames, 5)

    def test_the_patch_that_is_drawn(self):
        with tempfile.TemporaryDirectory() as scratch:
            path = solve(self.sample.path, PROGRAM, scratch)
            (contact,) = ContactSolution(path).contacts()
            self.assertEqual(contact.nearest(None), 4)
            self.assertEqual(contact.nearest(2.1e-4), 2)
            (patch,) = contact.patches(4)
        self.assertEqual(contact.surface, "wheel.tread")
        self.assertAlmostEqual(patch.pressure.max(), 1000, places=6)
        self.assertAlmostEqual(patch.normal_force, 1e-3 * (2 / 3) * np.pi * 6.5 * 5 * 1e3, delta=0.02 * 68)
        self.assertAlmostEqual(patch.traction_coefficient, 0.4 * (1 - 0.6**3), delta=0.005)
        self.assertAlmostEqual(patch.centre[0], 2, places=1)
        self.assertTrue((np.hypot(patch.shear_x, patch.shear_y) <= patch.bound + 1e-9).all())
        np.testing.assert_allclose(patch.bound, 0.4 * patch.pressure, atol=1e-9)
        square = patch.square_of_pressure()
        self.assertTrue((square[patch.touching] > 0).all())
        self.assertTrue((square[~patch.touching] <= 0).all())
        self.assertTrue((patch.slips == patch.slips_by_velocity).all())
        np.testing.assert_allclose(patch.slip_x[patch.slips], -0.2, rtol=1e-9)
        cut = patch.cut()
        self.assertAlmostEqual(cut["pressure"].max(), 1000, delta=15)
        self.assertEqual(len(contact.history("normal_force")), 5)
        corners = np.column_stack([patch.x, patch.y])[patch.facets]
        np.testing.assert_allclose(np.ptp(corners, axis=1), 1, atol=1e-9)  # cells of 1 mm

    def test_without_the_program_it_says_what_is_missing(self):
        result = picture(self.sample.path, program="/nowhere/railwave")
        self.assertEqual(result.returncode, 2)
        self.assertIn("there is no program /nowhere/railwave", result.stderr)
        self.assertIn("--program", result.stderr)

    def test_files_that_cannot_be_drawn(self):
        text = os.path.join(self.sample.folder, "text.h5")
        with open(text, "w") as file:
            file.write("no HDF5")
        for path, message in [(text, "cannot be read as an HDF5 file"), (text + ".none", "there is no results file")]:
            result = picture(path)
            self.assertEqual(result.returncode, 2)
            self.assertIn(message, result.stderr)
            self.assertNotIn("Traceback", result.stderr)

    def test_missing_modules_are_named(self):
        result = picture(self.sample.path, options=("-I", "-S"))  # sees no installed modules
        self.assertEqual(result.returncode, 1)
        self.assertIn("has no module h5py", result.stderr)
        self.assertIn("python3-matplotlib", result.stderr)


if __name__ == "__main__":
    unittest.main()
