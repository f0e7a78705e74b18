#!/usr/bin/env python3
"""`railwave export --vtkhdf`: every rule of the format (VTK 2026, "VTKHDF format specification") on files of one time
and of several, whose sets come and go; the values against the results; and VTK's own reader."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from test_beams import CASE  # noqa: E402

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
CORNERS = {12: 8, 9: 4, 3: 2}  # of VTK's hexahedron, quadrilateral, line
KINDS = {8: 12, 4: 9, 2: 3}

SCENE = CASE.replace(
    'fields = ["displacement", "stress"]', 'fields = ["displacement", "stress", "mises"]'
).replace('field_sets = ["block"]', 'field_sets = ["block", "block.z_max"]') + """
[output_windows.top]
start = 5e-6
end = 1.5e-5
interval = 2e-6
field_sets = ["block.z_max"]
"""


def run(folder, *words, code=0):
    done = subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout + done.stderr


def steps_of(file):
    """By step: time, number of its only part, and where points, cells, corners and each array begin."""
    root = file["VTKHDF"]
    if "Steps" not in root:
        return [(root["FieldData/TimeValue"][0], 0, 0, 0, 0, {}, {})]
    steps = root["Steps"]
    count = steps.attrs["NSteps"]
    arrays = [
        {name: offsets[()] for name, offsets in steps[group].items()}
        for group in ("PointDataOffsets", "CellDataOffsets")
    ]
    return [
        (
            steps["Values"][k],
            steps["PartOffsets"][k],
            steps["PointOffsets"][k],
            steps["CellOffsets"][k, 0],
            steps["ConnectivityIdOffsets"][k, 0],
            *({name: offsets[k] for name, offsets in one.items()} for one in arrays),
        )
        for k in range(count)
    ]


def read(file):
    """What a reader makes of the file: by step time, points, types, cells (lists of points), arrays of points, of
    cells."""
    root, grids = file["VTKHDF"], []
    for time, part, point, cell, corner, of_points, of_cells in steps_of(file):
        points, cells = root["NumberOfPoints"][part], root["NumberOfCells"][part]
        ids = root["Connectivity"][corner : corner + root["NumberOfConnectivityIds"][part]]
        offsets = root["Offsets"][cell + part : cell + part + cells + 1]
        data = [
            {
                name: array[first.get(name, start) : first.get(name, start) + count]
                for name, array in root[group].items()
            }
            for group, first, start, count in (
                ("PointData", of_points, point, points),
                ("CellData", of_cells, cell, cells),
            )
        ]
        corners = [ids[offsets[i] : offsets[i + 1]] for i in range(cells)]
        grids.append((time, root["Points"][point : point + points], root["Types"][cell : cell + cells], corners, *data))
    return grids


class Exported(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="railwave-")
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        (cls.folder / "case.toml").write_text(SCENE)
        run(cls.folder, "run", "case.toml")
        cls.said = run(cls.folder, "export", "run.h5", "--vtkhdf")
        run(cls.folder, "export", "run.h5", "--vtkhdf", "--show", "block,block.z_max,shank", "--out", "shown.vtkhdf")
        run(cls.folder, "export", "run.h5", "--vtkhdf", "--from", "2e-5", "--out", "last.vtkhdf")

        with h5py.File(cls.folder / "run.h5") as results:
            sets = [f"fields/{name}" for name in ("block", "block.z_max")]
            cls.times = len(np.unique(np.concatenate([results[name]["time"][()] for name in sets])))
        assert cls.times > 3, "no output of the window's set alone"

    def file(self, name):
        file = h5py.File(self.folder / name)
        self.addCleanup(file.close)
        return file

    def expect_rules(self, name, version, steps):
        root = self.file(name)["VTKHDF"]
        np.testing.assert_array_equal(root.attrs["Version"], version)
        self.assertEqual(root.attrs["Version"].shape, (2,))
        kind = root.attrs.get_id("Type").get_type()
        self.assertEqual((kind.get_class(), kind.is_variable_str()), (h5py.h5t.STRING, False))
        self.assertEqual(kind.get_cset(), h5py.h5t.CSET_ASCII)
        self.assertEqual(bytes(root.attrs["Type"]), b"UnstructuredGrid")
        counts = [root[f"NumberOf{what}"] for what in ("Points", "Cells", "ConnectivityIds")]
        for array in (*counts, root["Connectivity"], root["Offsets"]):
            self.assertEqual(array.dtype, np.int64)
            self.assertEqual(array.ndim, 1)
        points, cells, ids = (array[()] for array in counts)
        self.assertEqual(len(points), len(cells))
        self.assertEqual(len(points), len(ids))
        self.assertEqual(root["Points"].shape, (points.sum(), 3))
        self.assertEqual(root["Points"].dtype, np.float64)
        self.assertEqual(root["Connectivity"].shape, (ids.sum(),))
        self.assertEqual(root["Offsets"].shape, ((cells + 1).sum(),))
        self.assertEqual((root["Types"].dtype, root["Types"].shape), (np.uint8, (cells.sum(),)))
        for group in ("PointData", "CellData"):
            for array in root[group]:
                self.assertNotIn(".", array)
        if steps == 1:
            self.assertNotIn("Steps", root)
        else:
            self.expect_steps(root, steps, points, cells, ids)
        return root

    def expect_steps(self, root, count, points, cells, ids):
        steps = root["Steps"]
        self.assertEqual(steps.attrs["NSteps"], count)
        self.assertTrue((np.diff(steps["Values"][()]) > 0).all())
        np.testing.assert_array_equal(steps["NumberOfParts"][()], np.ones(count))
        part = steps["PartOffsets"][()]
        self.assertTrue(((part >= 0) & (part < len(points))).all())
        before = [np.concatenate([[0], np.cumsum(sizes)[:-1]])[part] for sizes in (points, cells, ids)]
        np.testing.assert_array_equal(steps["PointOffsets"][()], before[0])
        np.testing.assert_array_equal(steps["CellOffsets"][()], before[1][:, None])
        np.testing.assert_array_equal(steps["ConnectivityIdOffsets"][()], before[2][:, None])
        for group, sizes in (("PointData", points), ("CellData", cells)):
            self.assertEqual(set(steps[f"{group}Offsets"]), set(root[group]))
            for name, offsets in steps[f"{group}Offsets"].items():
                self.assertEqual((offsets.dtype, offsets.shape), (np.int64, (count,)))
                self.assertTrue((offsets[()] >= 0).all())
                self.assertTrue((offsets[()] + sizes[part] <= len(root[group][name])).all(), name)

    def test_rules_of_the_format(self):
        self.assertIn("block.z_max is within block", self.said)
        self.assertEqual(len(self.expect_rules("run.vtkhdf", [2, 0], 3)["NumberOfCells"]), 1)
        self.assertEqual(len(self.expect_rules("shown.vtkhdf", [2, 0], self.times)["NumberOfCells"]), 2)
        self.expect_rules("last.vtkhdf", [1, 0], 1)

    def expect_values(self, name, sets, outputs):
        """The grids of a file hold just what the results do."""
        file, results = self.file(name), self.file("run.h5")
        grids = read(file)
        self.assertEqual(list(file.attrs["set_names"]), sets)
        self.assertEqual(len(grids), outputs)
        for time, points, types, cells, of_points, of_cells in grids:
            point = cell = 0
            for number, one in enumerate(sets):
                source = results[f"beams/{one}" if f"beams/{one}" in results else f"fields/{one}"]
                at = np.flatnonzero(source["time"][()] == time)
                if len(at) == 0:
                    self.assertNotIn(number, of_cells["set"])
                    continue
                corners = source["connectivity"][()]
                nodes = slice(point, point + len(source["nodes"]))
                own = slice(cell, cell + len(corners))
                np.testing.assert_array_equal(points[nodes], source["coordinates"][()])
                np.testing.assert_array_equal(of_points["node"][nodes], source["nodes"][()])
                np.testing.assert_array_equal(of_cells["element"][own], source["elements"][()])
                np.testing.assert_array_equal(of_cells["set"][own], number)
                np.testing.assert_array_equal(types[own], KINDS[corners.shape[1]])
                np.testing.assert_array_equal(np.array(cells[own]), corners + point)
                np.testing.assert_array_equal(of_points["displacement"][nodes], source["displacement"][at[0]])
                for field in ("stress", "mises", "beam_force", "beam_moment"):
                    there = field.replace("beam_", "") if source.attrs["kind"] == "beam" else field
                    if there in source and (there != field) == (source.attrs["kind"] == "beam"):
                        np.testing.assert_array_equal(of_cells[field][own], source[there][at[0]])
                    elif field in of_cells:
                        self.assertTrue(np.isnan(of_cells[field][own]).all(), (field, one))
                point, cell = nodes.stop, own.stop
            self.assertEqual((len(points), len(types)), (point, cell))

    def test_values(self):
        beams = ["shank", "washer", "washer_below"]
        self.expect_values("run.vtkhdf", ["block", *beams], 3)
        self.expect_values("last.vtkhdf", ["block", *beams], 1)
        self.expect_values("shown.vtkhdf", ["block", "block.z_max", "shank"], self.times)

    def test_single_precision_stays(self):
        run(self.folder, "run", "case.toml", "--set", "output.file=single.h5", "--set", "output.precision=single")
        run(self.folder, "export", "single.h5", "--vtkhdf")
        root, results = self.file("single.vtkhdf")["VTKHDF"], self.file("single.h5")
        self.assertEqual(root["CellData/stress"].dtype, np.float32)
        self.assertEqual(root["CellData/beam_force"].dtype, np.float64)
        np.testing.assert_array_equal(
            root["CellData/stress"][()].reshape(3, -1, 6)[:, : len(results["fields/block/elements"])],
            results["fields/block/stress"][()],
        )

    def test_requests_that_cannot_be(self):
        for words, text in (
            (["run.h5"], "--vtkhdf"),
            (["run.h5", "--vtkhdf", "--show", "blok"], "did you mean"),
            (["run.h5", "--vtkhdf", "--from", "1"], "no output"),
            (["run.h5", "--vtkhdf", "--from", "1", "--to", "0"], "--from 1 is after --to 0"),
            (["run.h5", "--vtkhdf", "--out", "run.h5"], "run.h5"),
            (["case.toml", "--vtkhdf"], "case.toml"),
        ):
            self.assertIn(text, run(self.folder, "export", *words, code=2))
        self.assertFalse(list(self.folder.glob("*.new")))

    def test_a_damaged_file_leaves_nothing(self):
        with h5py.File(self.folder / "run.h5") as source, h5py.File(self.folder / "bad.h5", "w") as file:
            for name in source:
                source.copy(name, file)
            file.attrs.update(source.attrs)
            file["fields/block/connectivity"][0, 0] = 1000
        self.assertIn("no node", run(self.folder, "export", "bad.h5", "--vtkhdf", code=2))
        self.assertFalse((self.folder / "bad.vtkhdf").exists())

    def test_vtk_reads_it(self):
        try:
            from vtkmodules.util.numpy_support import vtk_to_numpy
            from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
            from vtkmodules.vtkIOHDF import vtkHDFReader
        except ImportError:
            self.skipTest("no VTK for Python: scripts/setup --tests installs it")
        complaints = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(complaints)
        reader = vtkHDFReader()
        knows_steps = hasattr(reader, "SetStep")
        for name in ("last.vtkhdf", *(("run.vtkhdf", "shown.vtkhdf") if knows_steps else ())):
            grids = read(self.file(name))
            reader.SetFileName(str(self.folder / name))
            for k, (_, points, types, cells, of_points, of_cells) in enumerate(grids):
                if knows_steps:
                    reader.SetStep(k)
                reader.Update()
                grid = reader.GetOutput()
                self.assertEqual(complaints.GetOutput() or "", "")
                np.testing.assert_array_equal(vtk_to_numpy(grid.GetPoints().GetData()), points)
                np.testing.assert_array_equal([grid.GetCellType(i) for i in range(len(types))], types)
                for i, corners in enumerate(cells):
                    ids = grid.GetCell(i).GetPointIds()
                    self.assertEqual([ids.GetId(j) for j in range(CORNERS[types[i]])], list(corners))
                for data, arrays in ((grid.GetPointData(), of_points), (grid.GetCellData(), of_cells)):
                    self.assertEqual({data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}, set(arrays))
                    for array, values in arrays.items():
                        np.testing.assert_array_equal(vtk_to_numpy(data.GetArray(array)), values)


if __name__ == "__main__":
    unittest.main()
