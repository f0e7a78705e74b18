"""`railwave modes --out`: what is in its files, that ParaView's reader takes them, and that scripts/mode_shapes draws
them."""

import os
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

ROOT = os.environ["RAILWAVE_SOURCE_DIR"]
sys.path.insert(0, os.path.join(ROOT, "tests", "output"))
PROGRAM = os.path.join(os.environ["RAILWAVE_BIN_DIR"], "railwave")

CASE = """
title = "a ring and a block"
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.ring]
type = "roller"
ring = true
radius = 0.2
bore_radius = 0.15
side_start = -0.02
side_end = 0.02
zone_size = 0.02
coarse_size = 0.02
[meshes.block]
type = "box"
size = [0.2, 0.02, 0.02]
divisions = [16, 2, 2]
[parts.ring]
mesh = "ring"
material = "steel"
hourglass = "stiffness"
[parts.block]
mesh = "block"
material = "steel"
hourglass = "stiffness"
position = [0, 0.3, 0]
[constraints.end]
target = "block.x_min"
fixed = ["x", "y", "z"]
[time]
end = 1e-3
"""


class ModeFile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="railwave-modes-")
        cls.path = os.path.join(cls.scratch.name, "modes.h5")
        case = os.path.join(cls.scratch.name, "case.toml")
        with open(case, "w", encoding="utf-8") as file:
            file.write(CASE)
        cls.table = os.path.join(cls.scratch.name, "modes.csv")
        cls.done = subprocess.run(
            [PROGRAM, "modes", case, "--up-to", "3000", "--out", cls.path, "--csv", cls.table], capture_output=True,
            text=True, check=False
        )
        assert cls.done.returncode == 0, cls.done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_shapes_and_table_agree(self):
        table = np.genfromtxt(self.table, delimiter=",", names=True, dtype=None, encoding="utf-8")
        with h5py.File(self.path) as file:
            modes = {name: dataset[:] for name, dataset in file["modes"].items()}
            ring, block = file["fields/ring"], file["fields/block"]
            np.testing.assert_allclose(modes["frequency"], table["frequency"], rtol=1e-9)
            self.assertEqual(int(modes["rigid"].sum()), 6)
            self.assertEqual([str(name) for name in file.attrs["part_names"]], ["ring", "block"])
            self.assertEqual([ring.attrs[f"axis_{c}"] for c in "xyz"], [0, 1, 0])
            self.assertNotIn("axis_x", block.attrs)
            largest = np.maximum(
                *(np.linalg.norm(part["displacement"][:], axis=2).max(axis=1) for part in (ring, block))
            )
            np.testing.assert_allclose(largest, 1, rtol=1e-12)
            held = block["coordinates"][:, 0] == 0
            self.assertEqual(held.sum(), 9)
            self.assertEqual(np.abs(block["displacement"][:][:, held]).max(), 0)
            # The ring's in-plane mode of two diameters: radial displacement goes with cos(2 angle).
            first = [k for k in range(len(modes["kind"])) if modes["kind"][k] == 1][0]
            self.assertEqual((modes["nodal_diameters"][first], modes["nodal_circles"][first]), (2, 0))
            x, u = ring["coordinates"][:], ring["displacement"][first]
            angle = np.arctan2(x[:, 2], x[:, 0])
            radial = u[:, 0] * np.cos(angle) + u[:, 2] * np.sin(angle)
            waves = np.stack([np.cos(2 * angle), np.sin(2 * angle)], axis=1)
            rest = radial - waves @ np.linalg.lstsq(waves, radial, rcond=None)[0]
            self.assertLess(np.linalg.norm(rest), 0.05 * np.linalg.norm(radial))

    def test_paraview_reads_them(self):
        try:
            import vtk_reader
        except ImportError:
            self.skipTest("no VTK with the XDMF reader")
        reader, complaints = vtk_reader.opened(self.path.replace(".h5", ".xdmf"))
        with h5py.File(self.path) as file:
            frequencies, shape = file["modes/frequency"][:], file["fields/block/displacement"][:]
        number = len(frequencies) - 1
        found = vtk_reader.grids(reader, number + 1.0)
        self.assertEqual(complaints.GetOutput() or "", "")
        self.assertEqual(set(found), {"ring", "block"})
        read = found["block"].GetPointData().GetArray("displacement")
        np.testing.assert_allclose([read.GetTuple3(n) for n in range(shape.shape[1])], shape[number])

    def test_they_are_drawn(self):
        picture = os.path.join(self.scratch.name, "drawn.png")
        script = os.path.join(ROOT, "scripts", "mode_shapes")
        done = subprocess.run(
            [sys.executable, "-B", script, self.path, "--out", picture], capture_output=True, text=True, check=False
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(picture, "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        done = subprocess.run(
            [sys.executable, "-B", script, self.path, "--only", "99"], capture_output=True, text=True, check=False
        )
        self.assertEqual(done.returncode, 2)
        self.assertIn("there is no mode 99", done.stderr)


if __name__ == "__main__":
    unittest.main()
