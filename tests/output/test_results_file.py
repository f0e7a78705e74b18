"""The results file read back with h5py, against the formulas of tests/output/made_up_run.hpp."""

import os
import signal
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from sample import Sample, SampleTest

OUTPUT_STEPS = [0, 100, 200, 300, 400]
KIND = {"displacement": 1e-6, "velocity": 1.0, "acceleration": 1e3}


def node_field(name, nodes, time):
    return KIND[name] * (nodes[:, None] + 0.25 * np.arange(3) + 1000 * time)


def stress(elements, time):
    return 1e6 * (elements[:, None] + 0.1 * np.arange(6) + 1000 * time)


class ResultsFile(SampleTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.file = h5py.File(cls.sample.path, "r")
        cls.addClassCleanup(cls.file.close)

    def test_attributes(self):
        attributes = self.file.attrs
        self.assertEqual(attributes["format"], "Railwave results")
        self.assertEqual(attributes["program"], "railwave 0.0.0")
        self.assertEqual(attributes["title"], 'A made-up run <with> "marks" & ö')
        self.assertEqual(attributes["case_text"], 'title = "made up"\n# a remark\n')
        self.assertEqual(attributes["completed"], 1)
        self.assertEqual(attributes["reason"], "completed")
        self.assertEqual(attributes["step_size"], 1e-6)
        self.assertEqual(attributes["steps"], 400)
        self.assertEqual(list(attributes["left_out"]), ["gravity", "loads"])
        self.assertRegex(attributes["start_time"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")

    def test_history(self):
        history = self.file["history"]
        step = np.arange(401)
        np.testing.assert_array_equal(history["step"][:], step)
        np.testing.assert_array_equal(history["time"][:], 1e-6 * step)
        np.testing.assert_array_equal(history["energy/kinetic"][:], 1000.0 + step)
        np.testing.assert_array_equal(history["energy/plastic"][:], 0.125 * step)
        np.testing.assert_array_equal(history["energy/external_work"][:], 1.5 * step)
        self.assertEqual(
            set(history["energy"]),
            {
                "kinetic",
                "internal",
                "hourglass",
                "contact",
                "friction",
                "connector",
                "damping",
                "plastic",
                "external_work",
                "balance_error",
            },
        )
        contact = history["contact/tread"]
        np.testing.assert_array_equal(
            contact["master_force"][:], -contact["normal_force"][:] - contact["tangential_force"][:]
        )
        np.testing.assert_array_equal(contact["nodes_slipping"][:], step)
        corner = history["set/block.corner"]
        np.testing.assert_array_equal(corner["displacement"][:], step[:, None] + np.arange(3.0))
        np.testing.assert_array_equal(corner["velocity"][:, 0], -step)
        np.testing.assert_array_equal(history["set/sprung_mass/displacement"][:, 2], step)
        self.assertEqual(corner.attrs["asked_by"], "probe corner")
        self.assertNotIn("asked_by", history["set/sprung_mass"].attrs)

    def test_loads(self):
        loads = self.file["history/load"]
        step = np.arange(401)
        np.testing.assert_array_equal(loads["blow/force"][:], np.outer(step, [0, 0, -1]))
        np.testing.assert_array_equal(loads["blow/direction"][:], [0, 0, -1])
        self.assertEqual((loads["blow"].attrs["target"], loads["blow"].attrs["hammer"]), ("block.corner", 1))
        np.testing.assert_array_equal(loads["drive/moment"][:], 2 * step)
        self.assertNotIn("force", loads["drive"])
        self.assertEqual(loads["drive"].attrs["hammer"], 0)

    def test_fields(self):
        self.assertEqual(set(self.file["fields"]), {"block", "block.lower", "block.top"})
        for name, corners, elements, nodes in [
            ("block", 8, 24, 60),
            ("block.lower", 8, 12, 40),
            ("block.top", 4, 12, 20),
        ]:
            group = self.file["fields"][name]
            self.assertEqual(group["connectivity"].shape, (elements, corners))
            self.assertEqual(group["coordinates"].shape, (nodes, 3))
            self.assertLess(group["connectivity"][:].max(), nodes)
            np.testing.assert_array_equal(group["step"][:], OUTPUT_STEPS)
            for i, time in enumerate(group["time"][:]):
                for field in KIND:
                    np.testing.assert_allclose(group[field][i], node_field(field, group["nodes"][:], time), rtol=1e-14)
                np.testing.assert_allclose(group["stress"][i], stress(group["elements"][:], time), rtol=1e-14)
                np.testing.assert_allclose(group["plastic_strain"][i], 1e-3 * group["elements"][:] + time, rtol=1e-14)

    def test_volumes_of_cells_are_positive(self):
        group = self.file["fields/block"]
        corners = group["coordinates"][:][group["connectivity"][:]]
        edges = [corners[:, i] - corners[:, 0] for i in (1, 3, 4)]
        volumes = np.einsum("ij,ij->i", np.cross(edges[0], edges[1]), edges[2])
        np.testing.assert_allclose(volumes, 5e-3**3, rtol=1e-12)

    def test_contact(self):
        group = self.file["contact/tread"]
        self.assertEqual(group.attrs["friction"], 0.4)
        self.assertEqual(
            (group["slave"].attrs["surface"], group["master"].attrs["surface"]), ("wheel.tread", "rail.head")
        )
        np.testing.assert_array_equal(group["step"][:], OUTPUT_STEPS)
        slave, master = group["slave"], group["master"]
        nodes = len(slave["nodes"])
        for side in (slave, master):
            self.assertEqual(side["facets"].shape, (20 * 16, 4))
            for name in ("position", "velocity", "normal", "normal_force", "tangential_force", "shear"):
                self.assertEqual(side[name].shape, (5, nodes, 3), name)
            for name in ("area", "pressure"):
                self.assertEqual(side[name].shape, (5, nodes), name)
        np.testing.assert_array_equal(slave["normal_force"][:], -master["normal_force"][:])
        np.testing.assert_allclose(slave["pressure"][:] * slave["area"][:], slave["normal_force"][:, :, 2], rtol=1e-12)
        x, y = slave["position"][4, :, 0], slave["position"][4, :, 1]
        dome = 1 - ((x - 2e-3) / 6.5e-3) ** 2 - (y / 5e-3) ** 2
        np.testing.assert_allclose(slave["pressure"][4], 1e9 * np.sqrt(np.maximum(dome, 0)), rtol=1e-9, atol=1)
        np.testing.assert_array_equal(slave["slipping"][4] > 0, slave["pressure"][4] > 0)
        self.assertTrue(np.isnan(slave["gap"][4]).any())

    def test_facets_are_turned_outwards(self):
        for side, up in (("slave", -1), ("master", 1)):
            group = self.file["contact/tread"][side]
            corners = group["position"][0][group["facets"][:]]
            normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0])
            self.assertTrue((normals[:, 2] * up > 0).all(), side)


class KilledRun(unittest.TestCase):
    def test_what_was_written_is_readable(self):
        with Sample(kill_after=350) as sample:
            self.assertEqual(sample.status, -signal.SIGKILL)
            with h5py.File(sample.path, "r") as file:
                self.assertEqual(file.attrs["completed"], 0)
                self.assertIn("killed", file.attrs["reason"])
                self.assertEqual(len(file["history/time"]), 301)
                for data in file["history/energy"].values():
                    self.assertEqual(len(data), 301)
                    self.assertFalse(np.isnan(data[:]).any())
                group = file["fields/block"]
                for i, time in enumerate(group["time"][:]):
                    np.testing.assert_allclose(
                        group["velocity"][i], node_field("velocity", group["nodes"][:], time), rtol=1e-14
                    )
                self.assertEqual(len(group["time"]), 4)


if __name__ == "__main__":
    unittest.main()
