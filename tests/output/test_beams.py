"""Beams in the files: lines with section forces in the results, lines in what `railwave mesh` writes, both read by
ParaView's reader, and drawn by scripts/picture."""

import os
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

ROOT = os.environ["RAILWAVE_SOURCE_DIR"]
PROGRAM = os.path.join(os.environ["RAILWAVE_BIN_DIR"], "railwave")

CASE = """
title = "a bolt through a block"
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.block]
type = "box"
size = [0.08, 0.08, 0.08]
divisions = [2, 2, 2]
[parts.block]
mesh = "block"
material = "steel"
hourglass = "stiffness"
[points.head]
mass = 0
position = [0.04, 0.04, 0.1]
[points.nut]
mass = 0
position = [0.04, 0.04, -0.02]
[beams.shank]
from = "nut"
to = "head"
material = "steel"
radius = 0.012
divisions = 4
pretension = 12500
[beams.washer]
from = "head"
to = "block.z_max"
material = "steel"
radius = 0.01
[beams.washer_below]
from = "nut"
to = "block.z_min"
material = "steel"
radius = 0.01
[time]
end = 2e-5
[output]
file = "run.h5"
history_interval = 1e-5
field_interval = 1e-5
field_sets = ["block"]
fields = ["displacement", "stress"]
"""


def run(*arguments, folder):
    return subprocess.run(arguments, cwd=folder, capture_output=True, text=True, check=False)


def blocks(path, time=None):
    """Grids by name, as ParaView's reader finds them, and its complaints; None without that reader."""
    try:
        import vtk_reader
    except ImportError:
        return None, ""
    reader, complaints = vtk_reader.opened(path)
    return vtk_reader.grids(reader, time), complaints.GetOutput() or ""


class Beams(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = cls.scratch.name
        with open(os.path.join(cls.folder, "case.toml"), "w", encoding="utf-8") as file:
            file.write(CASE)
        cls.ran = run(PROGRAM, "run", "case.toml", folder=cls.folder)
        cls.meshed = run(PROGRAM, "mesh", "case.toml", "--out", "model.h5", folder=cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_results(self):
        self.assertEqual(self.ran.returncode, 0, self.ran.stderr)
        with h5py.File(self.path("run.h5")) as file:
            self.assertEqual(set(file["beams"]), {"shank", "washer", "washer_below"})
            self.assertEqual(set(file["fields"]), {"block"})
            shank = file["beams/shank"]
            self.assertEqual(shank.attrs["kind"], "beam")
            self.assertEqual(
                set(shank),
                {"nodes", "coordinates", "elements", "connectivity", "time", "step", "displacement", "force", "moment"},
            )
            ends = shank["coordinates"][:][shank["connectivity"][:]]
            np.testing.assert_allclose(ends[:, 0, 2], -0.02 + 0.03 * np.arange(4), atol=1e-15)
            np.testing.assert_allclose(ends[:, 1, 2], 0.01 + 0.03 * np.arange(4), atol=1e-15)
            self.assertEqual(len(shank["time"]), 3)
            np.testing.assert_array_equal(file["beams/washer/elements"][:], np.arange(4, 13))
            np.testing.assert_allclose(
                file["beams/washer/coordinates"][:][file["beams/washer/connectivity"][:]][:, 0], [[0.04, 0.04, 0.1]] * 9
            )
            np.testing.assert_allclose(shank["force"][0], [[12500, 0, 0]] * 4, rtol=1e-12, atol=1e-6)
            for name in file["beams"]:
                for what in ("force", "moment"):
                    np.testing.assert_array_equal(
                        file[f"beams/{name}/{what}"][:], file[f"history/beam/{name}/{what}"][:]
                    )
            # The bolt presses the block together: its ends near each other.
            moved = shank["displacement"][-1][shank["connectivity"][:]]
            self.assertLess(moved[-1, 1, 2], 0)
            self.assertGreater(moved[0, 0, 2], 0)

    def test_results_in_paraview(self):
        found, complaints = blocks(self.path("run.xdmf"), 2e-5)
        if found is None:
            self.skipTest("no VTK with the XDMF reader")
        self.assertEqual(complaints, "")
        self.assertEqual(set(found), {"block", "beam shank", "beam washer", "beam washer_below"})
        shank = found["beam shank"]
        self.assertEqual((shank.GetNumberOfCells(), shank.GetNumberOfPoints()), (4, 5))
        self.assertEqual(shank.GetCell(0).GetNumberOfPoints(), 2)
        self.assertEqual(shank.GetCell(0).GetCellDimension(), 1)
        with h5py.File(self.path("run.h5")) as file:
            force = file["beams/shank/force"][-1]
        for cell in range(4):
            self.assertAlmostEqual(
                shank.GetCellData().GetArray("force").GetTuple(cell)[0], force[cell, 0], delta=1e-9 * force[cell, 0]
            )
        self.assertIsNotNone(shank.GetPointData().GetArray("displacement"))

    def test_model(self):
        self.assertEqual(self.meshed.returncode, 0, self.meshed.stderr)
        with h5py.File(self.path("model.h5")) as file:
            self.assertEqual(list(file.attrs["beam_names"]), ["shank", "washer", "washer_below"])
            np.testing.assert_array_equal(file["beams/beam"][:], [0] * 4 + [1] * 9 + [2] * 9)
            np.testing.assert_array_equal(file["beams/pretension"][:], [12500] * 4 + [0] * 18)
            lines = file["beams/coordinates"][:][file["beams/connectivity"][:]]
            np.testing.assert_allclose(lines[:4, 0, 2], -0.02 + 0.03 * np.arange(4), atol=1e-15)
            np.testing.assert_allclose(lines[4:13, 1, 2], 0.08)
        found, complaints = blocks(self.path("model.xdmf"))
        if found is not None:
            self.assertEqual(complaints, "")
            self.assertEqual(found["beams"].GetNumberOfCells(), 22)
            self.assertEqual(found["beams"].GetCell(0).GetCellDimension(), 1)

    def test_picture(self):
        done = run(sys.executable, os.path.join(ROOT, "scripts", "picture"), "--mesh", "model.h5", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("model-mesh.png"), "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")


if __name__ == "__main__":
    unittest.main()
