"""`railwave mesh`: what is in its files, that ParaView's reader takes them, and that scripts/picture draws them."""

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
title = "a block on a bed"
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[materials.soft]
youngs_modulus = 21e9
poissons_ratio = 0.3
density = 7800
[meshes.long]
type = "box"
size = [0.4, 0.2, 0.1]
divisions = [4, 2, 1]
[meshes.flat]
type = "box"
origin = [0, 0, 0.2]
size = [0.2, 0.2, 0.05]
divisions = [2, 2, 1]
[parts.below]
mesh = "long"
material = "soft"
[parts.above]
mesh = "flat"
material = "steel"
[node_sets.edge]
part = "above"
box = [[0, 0, 0], [0, 1, 1]]
[connectors.pad]
from = "below.z_max"
to = "above.z_min"
stiffness = [0, 0, 6e6]
damping = [0, 0, 6e3]
spread = [3, 2]
[connectors.bed]
from = "ground"
to = "below.z_min"
stiffness = [0, 0, 1e6]
[time]
end = 1e-4
"""


def run(*arguments, folder):
    return subprocess.run(arguments, cwd=folder, capture_output=True, text=True, check=False)


class MeshCommand(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = cls.scratch.name
        with open(os.path.join(cls.folder, "case.toml"), "w", encoding="utf-8") as file:
            file.write(CASE)
        cls.done = run(PROGRAM, "mesh", "case.toml", "--out", "model.h5", folder=cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_parts_and_the_step_of_each_element(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertIn("12 elements of 2 parts, 7 springs and dashpots", self.done.stdout)
        with h5py.File(self.path("model.h5")) as file:
            self.assertEqual(list(file.attrs["part_names"]), ["below", "above"])
            self.assertEqual(list(file.attrs["material_names"]), ["steel", "soft"])
            above, below = file["parts/above"], file["parts/below"]
            self.assertEqual(above["connectivity"].shape, (4, 8))
            self.assertTrue(np.all(above["part"][:] == 1) and np.all(above["material"][:] == 0))
            self.assertTrue(np.all(below["part"][:] == 0) and np.all(below["material"][:] == 1))
            # V / A_max over the speed of pressure waves.
            for part, height, modulus in ((above, 0.05, 210e9), (below, 0.1, 21e9)):
                speed = np.sqrt(modulus * 0.7 / (1.3 * 0.4) / 7800)
                np.testing.assert_allclose(part["stable_step"][:], height / speed, rtol=1e-9)
            np.testing.assert_allclose(above["step_ratio"][:], 1, rtol=1e-9)
            np.testing.assert_allclose(below["step_ratio"][:], 2 * np.sqrt(10), rtol=1e-9)
            corners = above["coordinates"][:][above["connectivity"][:]]
            np.testing.assert_allclose(corners.mean(axis=1)[:, 2], 0.225)

    def test_sets_and_connectors(self):
        with h5py.File(self.path("model.h5")) as file:
            self.assertEqual(file["surfaces/above.z_max/connectivity"].shape, (4, 4))
            np.testing.assert_allclose(file["surfaces/above.z_max/coordinates"][:, 2], 0.25)
            edge = file["node_sets/above.edge/coordinates"][:]
            self.assertEqual(edge.shape, (6, 3))
            np.testing.assert_allclose(edge[:, 0], 0)
            lines = file["connectors/coordinates"][:].reshape(-1, 2, 3)
            self.assertEqual(list(file.attrs["connector_names"]), ["pad", "bed"])
            np.testing.assert_array_equal(file["connectors/connector"][:], [0] * 6 + [1])
            np.testing.assert_allclose(file["connectors/stiffness"][:], [1e6] * 7)
            np.testing.assert_allclose(file["connectors/damping"][:], [1e3] * 6 + [0])
            # Six cells over 0.2 m x 0.2 m, each between its middle below and above.
            np.testing.assert_allclose(lines[:6, 0, 2], 0.1)
            np.testing.assert_allclose(lines[:6, 1, 2], 0.2)
            np.testing.assert_allclose(lines[:6, 0, :2], lines[:6, 1, :2], atol=1e-15)
            np.testing.assert_allclose(lines[:6, 0, 0], np.repeat([1 / 30, 0.1, 1 / 6], 2))
            np.testing.assert_allclose(lines[6], [[0.2, 0.1, -0.1], [0.2, 0.1, 0]], atol=1e-15)

    def test_paraview_reads_it(self):
        try:
            import vtk_reader
        except ImportError:
            self.skipTest("no VTK with the XDMF reader")
        reader, complaints = vtk_reader.opened(self.path("model.xdmf"))
        found = vtk_reader.grids(reader)
        self.assertEqual(complaints.GetOutput() or "", "")
        self.assertEqual(found["below"].GetNumberOfCells(), 8)
        self.assertIsNotNone(found["below"].GetCellData().GetArray("step_ratio"))
        self.assertEqual(found["surfaces above.z_max"].GetNumberOfCells(), 4)
        self.assertEqual(found["node_sets above.edge"].GetNumberOfPoints(), 6)
        self.assertEqual(found["connectors"].GetNumberOfCells(), 7)

    def test_picture(self):
        done = run(sys.executable, os.path.join(ROOT, "scripts", "picture"), "--mesh", "model.h5", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("model-mesh.png", done.stdout)
        with open(self.path("model-mesh.png"), "rb") as file:
            self.assertEqual(file.read(4), b"\x89PNG")
        place = [sys.executable, os.path.join(ROOT, "scripts", "picture"), "--mesh", "model.h5", "--reach", "0.2"]
        done = run(*place, "--around", "0.2,0.1,0.2", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("model-place.png", done.stdout)
        done = run(*place, "--around", "9,9,9", folder=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("has no element within 0.2 m of (9, 9, 9)", done.stderr)
        done = run(*place, "--around", "here", folder=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("3 numbers with commas between are wanted", done.stderr)
        with h5py.File(self.path("other.h5"), "w"):
            pass
        done = run(sys.executable, os.path.join(ROOT, "scripts", "picture"), "--mesh", "other.h5", folder=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("other.h5 is no file that 'railwave mesh' wrote", done.stderr)
        done = run(sys.executable, os.path.join(ROOT, "scripts", "picture"), folder=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("name either a results file or", done.stderr)

    def test_mistakes(self):
        done = run(PROGRAM, "mesh", "case.toml", "--out", "nowhere/model.h5", folder=self.folder)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("nowhere", done.stderr)


if __name__ == "__main__":
    unittest.main()
