"""docs/first-steps.md, typed: an own mesh, a point's history, a movie, resuming, Python, ParaView.
test_long_first_steps.py has the rest."""

import csv
import hashlib
import os
import pathlib
import re
import shutil
import sys
import unittest

import h5py
import numpy as np
from PIL import Image

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "output"))
from typed import SOURCE, DeskTest, sections  # noqa: E402


class FirstSteps(DeskTest):
    made = {"read_drop.py", "look.py"}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.said = cls.desk.type("Your own mesh")  # what it computes the other tasks look at

    def drop(self):
        return h5py.File(self.desk.path("results", "drop", "drop.h5"), "r")

    def test_own_mesh(self):
        self.assertIn("completed", self.said)
        self.assertNotIn("warning", self.said)
        with self.drop() as results:
            self.assertEqual(results.attrs["completed"], 1)
            force = results["history/contact/blow/normal_force"][:, 2]
            time = results["history/time"][:]
            # 0.5 mm at 3 m/s: nothing touches before, and the punch is thrown back up.
            self.assertTrue((force[time < 0.5e-3 / 3 - 1e-5] == 0).all())
            self.assertGreater(force.max(), 1e3)
            self.assertGreater(results["history/set/punch.eye/velocity"][:, 2].max(), 0)
            ends = np.abs(np.abs(results["fields/plate/coordinates"][:, 0]) - 0.1) < 1e-9
            self.assertGreater(ends.sum(), 0)
            self.assertTrue((results["fields/plate/displacement"][-1][ends] == 0).all())
        with h5py.File(self.desk.path("results", "drop", "model.h5"), "r") as model:
            self.assertLessEqual(
                {"plate.top", "plate.ends", "plate.exterior", "punch.nose", "punch.exterior"}, set(model["surfaces"])
            )
            self.assertIn("punch.eye", model["node_sets"])
        with Image.open(self.desk.path("results", "drop", "model-mesh.png")) as image:
            self.assertGreater(min(image.size), 1000)

    def test_the_meshes_are_what_their_scripts_make(self):
        folder = self.desk.path("cases", "own_mesh")
        with open(os.path.join(folder, "punch.inp"), encoding="ascii") as file:
            committed = file.read()
        self.desk.command("python3 cases/own_mesh/make_punch.py")
        with open(os.path.join(folder, "punch.inp"), encoding="ascii") as file:
            self.assertEqual(file.read(), committed)
        if shutil.which("gmsh"):
            self.desk.command(
                "cd cases/own_mesh && gmsh -3 plate.geo -format msh41 -o again.msh && sed s/plate.msh/again.msh/"
                " drop.toml > again.toml"
            )
            again, first = (
                self.desk.command(f"railwave check cases/own_mesh/{name}.toml") for name in ("again", "drop")
            )
            self.assertEqual(again, first)

    def test_history_at_a_point(self):
        self.assertIn("plate.middle.acceleration.z", self.desk.type("History at a point"))
        with self.drop() as results:
            place = results["history/set/plate.middle/position"][:]
            np.testing.assert_allclose(place, [0, 0, 0], atol=1e-9)
            self.assertLess(results["history/set/plate.middle/displacement"][:, 2].min(), -1e-6)
            # bent down: the lower side is pulled
            self.assertGreater(results["history/set/plate.middle/stress"][:, 0].max(), 1e7)
            self.assertEqual(results["history/set/plate.middle/stress"].attrs["unit"], "Pa")
        with open(self.desk.path("results", "drop", "spectrum.csv"), newline="", encoding="utf-8") as file:
            self.assertGreater(len(list(csv.reader(file))), 10)

    def test_movie(self):
        self.desk.type("A movie")
        with Image.open(self.desk.path("results", "drop", "drop-scene-von_mises.gif")) as movie, self.drop() as results:
            self.assertEqual(movie.n_frames, len(results["fields/plate/time"]))
            frames = set()
            for k in range(movie.n_frames):
                movie.seek(k)
                frames.add(hashlib.sha256(np.asarray(movie.convert("RGB"))[60:].tobytes()).digest())  # below the time
            self.assertGreater(len(frames), movie.n_frames // 2)
        with Image.open(self.desk.path("results", "drop", "drop-plate-displacement-z.png")) as image:
            self.assertAlmostEqual(image.info["dpi"][0], 300, delta=0.1)

    def test_resume(self):
        self.desk.type("Resume", ends=(0, 4))
        for name, end in (("long", 8e-3), ("longer", 2e-3)):
            with h5py.File(self.desk.path("results", name, f"{name}.h5"), "r") as results:
                time = results["history/time"][:]
                self.assertEqual(results.attrs["completed"], 1)
                self.assertEqual(results.attrs["restarts"], 1)
                self.assertAlmostEqual(time[-1], end, delta=2e-6)
                self.assertTrue((np.diff(time) > 0).all())
                self.assertLess(np.diff(time).max(), 3e-6)  # no gap where it was taken up

    def test_python(self):
        said = self.desk.type("Read results in Python")
        with self.drop() as results:
            force = np.linalg.norm(results["history/contact/blow/normal_force"][:], axis=1).max()
            stress = results["fields/plate/stress"][:, :, 0].max()
        self.assertIn("a punch falls on a plate: ", said)
        self.assertIn(f"largest contact force {1e-3 * force:.1f} kN", said)
        self.assertIn(f"largest stress along x {1e-6 * stress:.0f} MPa", said)
        self.assertRegex(said, r"goes down by [1-9]\d+ micrometres")

    def test_paraview(self):
        try:
            from vtk_reader import grids, opened
        except ImportError as error:
            self.skipTest(f"no VTK with the XDMF reader: {error}")
        with self.drop() as results:
            times, last = results["fields/plate/time"][:], results["fields/plate/displacement"][-1]
        reader, complaints = opened(self.desk.path("results", "drop", "drop.xdmf"))
        blocks = grids(reader, times[-1])
        self.assertLessEqual({"plate", "punch", "contact blow slave", "contact blow master"}, set(blocks))
        shown = blocks["plate"].GetPointData().GetArray("displacement")
        np.testing.assert_allclose([shown.GetTuple3(i) for i in range(shown.GetNumberOfTuples())], last, rtol=1e-12)
        self.assertIsNotNone(blocks["contact blow slave"].GetPointData().GetArray("pressure"))
        self.assertFalse(complaints.GetOutput())
        if shutil.which("pvpython"):
            self.desk.type("ParaView")
            said = self.desk.command("pvpython look.py")
            self.assertIn(f"{len(times)} times to {1e3 * times[-1]:.2f} ms", said)
            self.assertIn("displacement", said)


class Page(unittest.TestCase):
    def test_every_section_is_typed_by_a_test(self):
        """A new section of the page needs a test: its name stands in one of the files here."""
        here = os.path.dirname(os.path.abspath(__file__))
        tests = "".join(
            pathlib.Path(here, name).read_text(encoding="utf-8")
            for name in os.listdir(here)
            if name.startswith("test_")
        )
        for section, blocks in sections().items():
            if any(language in ("sh", "python") for language, _ in blocks):
                self.assertIn(f'type("{section}"', tests, section)

    def test_links_lead_somewhere(self):
        folder = os.path.join(SOURCE, "docs")
        with open(os.path.join(folder, "first-steps.md"), encoding="utf-8") as file:
            for link in re.findall(r"\]\(([^)#]+)\)", file.read()):
                self.assertTrue(os.path.exists(os.path.join(folder, link)), link)


if __name__ == "__main__":
    unittest.main()
