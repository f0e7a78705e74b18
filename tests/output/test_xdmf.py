"""The XDMF companion opened by VTK's own reader, without a display; values against tests/output/made_up_run.hpp."""

import os
import sys
import unittest

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from sample import Sample, SampleTest

SKIPPED = 77  # ctest shows this exit status as "skipped"

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, VTK_QUAD, vtkDataObject
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtk_reader import grids as blocks
    from vtk_reader import opened
except ImportError as error:
    print("\n" + "=" * 80)
    print(f"NOT TESTED: the XDMF companion. {sys.executable} has no VTK with the XDMF reader ({error}).")
    print(
        "Debian's python3-vtk9 is built without it; the package python3-paraview has it: scripts/setup --tests installs"
        " that."
    )
    print("=" * 80)
    sys.exit(SKIPPED)


def read(path):
    """The reader, the output times, and what the reader complained of while it was asked."""
    reader, complaints = opened(path)
    info = reader.GetOutputInformation(0)
    key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    return reader, [info.Get(key, i) for i in range(info.Length(key))], complaints


def array(data, name):
    return vtk_to_numpy(data.GetArray(name))


class Xdmf(SampleTest):
    name = "run & more.h5"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.reader, cls.times, cls.complaints = read(os.path.join(cls.sample.folder, "run & more.xdmf"))

    def test_times(self):
        np.testing.assert_allclose(self.times, [0, 1e-4, 2e-4, 3e-4, 4e-4], rtol=1e-12)

    def test_grids(self):
        grids = blocks(self.reader, self.times[0])
        self.assertEqual(
            set(grids), {"block", "block.lower", "block.top", "contact tread slave", "contact tread master"}
        )
        for name, cell, cells, points in [
            ("block", VTK_HEXAHEDRON, 24, 60),
            ("block.lower", VTK_HEXAHEDRON, 12, 40),
            ("block.top", VTK_QUAD, 12, 20),
            ("contact tread slave", VTK_QUAD, 320, 357),
        ]:
            grid = grids[name]
            self.assertEqual(grid.GetCellType(0), cell, name)
            self.assertEqual(grid.GetNumberOfCells(), cells, name)
            self.assertEqual(grid.GetNumberOfPoints(), points, name)
        self.assertEqual(grids["block"].GetBounds(), (0, 0.02, 0, 0.015, 0, 0.01))

    def test_values_at_every_time(self):
        for time in self.times:
            grids = blocks(self.reader, time)
            nodes = np.arange(60)[:, None] + 0.25 * np.arange(3) + 1000 * time
            points, cells = grids["block"].GetPointData(), grids["block"].GetCellData()
            np.testing.assert_allclose(array(points, "displacement"), 1e-6 * nodes, rtol=1e-12)
            np.testing.assert_allclose(array(points, "velocity"), nodes, rtol=1e-12)
            np.testing.assert_allclose(array(points, "acceleration"), 1e3 * nodes, rtol=1e-12)
            elements = np.arange(24)[:, None] + 0.1 * np.arange(6) + 1000 * time
            np.testing.assert_allclose(array(cells, "stress"), 1e6 * elements, rtol=1e-12)
            np.testing.assert_allclose(array(cells, "plastic_strain"), 1e-3 * np.arange(24) + time, rtol=1e-12)
            np.testing.assert_allclose(
                array(grids["block.top"].GetCellData(), "stress"), 1e6 * elements[12:], rtol=1e-12
            )

    def test_contact(self):
        # The made-up contact nodes stand still from the first output on.
        slave = blocks(self.reader, self.times[0])["contact tread slave"]
        place = vtk_to_numpy(slave.GetPoints().GetData()) + array(slave.GetPointData(), "displacement")
        slave = blocks(self.reader, self.times[4])["contact tread slave"]
        pressure = array(slave.GetPointData(), "pressure")
        dome = 1 - ((place[:, 0] - 2e-3) / 6.5e-3) ** 2 - (place[:, 1] / 5e-3) ** 2
        # VTK's points are single precision
        np.testing.assert_allclose(pressure, 1e9 * np.sqrt(np.maximum(dome, 0)), rtol=1e-3, atol=1e6)
        shear = np.linalg.norm(array(slave.GetPointData(), "shear"), axis=1)
        self.assertTrue((shear <= 0.4 * pressure * (1 + 1e-12)).all())
        self.assertGreater(shear.max(), 1e8)
        np.testing.assert_array_equal(array(slave.GetPointData(), "slipping") > 0, pressure > 0)

    def test_reader_does_not_complain(self):
        for time in self.times:
            blocks(self.reader, time)
        self.assertEqual(self.complaints.GetOutput(), "")


class KilledRun(unittest.TestCase):
    def test_its_xdmf_opens(self):
        with Sample(kill_after=250) as sample:
            reader, times, complaints = read(os.path.join(sample.folder, "run.xdmf"))
            np.testing.assert_allclose(times, [0, 1e-4, 2e-4], rtol=1e-12)
            velocity = array(blocks(reader, times[2])["block"].GetPointData(), "velocity")
            self.assertAlmostEqual(velocity[0, 0], 0.2, places=12)
            self.assertEqual(complaints.GetOutput(), "")


if __name__ == "__main__":
    unittest.main()
