"""Bodies by a field as pictures and movies (scripts/picture --show, --by, --animate), their formats, and which files
are replaced."""

import contextlib
import io
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import h5py
import numpy as np
from PIL import Image

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from sample import SOURCE_DIR, SampleTest

SCRIPTS = os.path.join(SOURCE_DIR, "scripts")
sys.path.insert(0, SCRIPTS)
from pictures import style

style.apply()
from pictures.bodies import Body, rigid_motion
from pictures.body_pictures import Frame, Stage
from pictures.faces import exterior
from pictures.options import parse
from pictures.output import MARK, made_by_us, put
from pictures.quantities import Quantity, von_mises
from pictures.results import BadFile, Results
from pictures.view import View, read_view


def picture(*arguments):
    return subprocess.run(
        [sys.executable, os.path.join(SCRIPTS, "picture"), *arguments], capture_output=True, text=True
    )


def box(divisions, size=1.0):
    """Nodes and hexahedra of a cube."""
    line = np.linspace(0, size, divisions + 1)
    x, y, z = np.meshgrid(line, line, line, indexing="ij")
    number = np.arange(x.size).reshape(x.shape)
    low, high = slice(None, -1), slice(1, None)
    corners = [number[i, j, k] for k in (low, high) for i, j in ((low, low), (high, low), (high, high), (low, high))]
    return np.stack([x, y, z], axis=-1).reshape(-1, 3), np.stack([c.reshape(-1) for c in corners], axis=1)


def made_up(path, nodes, elements, places, stress=None):
    """A results file with one body, `places` (outputs, nodes, 3)."""
    with h5py.File(path, "w") as file:
        file.attrs.update({"format": "Railwave results", "format_version": 1, "title": "made up"})
        file.create_group("contact")
        group = file.create_group("fields/body")
        group.attrs["kind"] = "volume"
        for name, data in (
            ("nodes", np.arange(len(nodes))),
            ("coordinates", nodes),
            ("elements", np.arange(len(elements))),
            ("connectivity", elements),
            ("time", 1e-3 * np.arange(len(places))),
            ("step", np.arange(len(places))),
            ("displacement", places - nodes),
        ):
            group[name] = data
        if stress is not None:
            group["stress"] = stress
    return path


class WhatIsDrawn(unittest.TestCase):
    def test_outer_faces(self):
        for divisions in (1, 2, 5):
            nodes, elements = box(divisions)
            faces, owner = exterior(elements)
            self.assertEqual(len(faces), 6 * divisions**2)
            first, second = (nodes[faces[:, b]] - nodes[faces[:, a]] for a, b in ((0, 2), (1, 3)))
            outwards = nodes[faces].mean(axis=1) - nodes[elements[owner]].mean(axis=1)
            self.assertTrue((np.einsum("ij,ij->i", np.cross(first, second), outwards) > 0).all())

    def test_faces_seen_from_each_side(self):
        nodes, elements = box(2)
        corners = nodes[exterior(elements)[0]]
        for name, axis, sign in (("side", 1, -1), ("front", 0, 1), ("behind", 0, -1), ("top", 2, 1), ("below", 2, -1)):
            seen, polygons, light = View(*read_view(name)).painted(corners)
            self.assertEqual(len(seen), 4, name)
            np.testing.assert_allclose(corners[seen][:, :, axis], 1 if sign > 0 else 0, atol=1e-12, err_msg=name)
            np.testing.assert_allclose(np.ptp(polygons.reshape(-1, 2), axis=0), 1, err_msg=name)
            self.assertEqual(len(View(*read_view(name)).painted(corners, both_sides=True)[0]), 8, name)
        seen, _, _ = View(*read_view("iso")).painted(corners)
        self.assertEqual(len(seen), 12)
        depth = corners[seen].mean(axis=1) @ View(*read_view("iso")).towards
        self.assertTrue((np.diff(depth) >= 0).all())  # the farthest first

    def test_quantities(self):
        stress = np.array([[100.0, 0, 0, 0, 0, 0], [0, 0, 0, 50, 0, 0], [-30, -30, -30, 0, 0, 0]])
        np.testing.assert_allclose(von_mises(stress), [100, 50 * 3**0.5, 0], atol=1e-12)
        with tempfile.TemporaryDirectory() as folder:
            nodes, elements = box(1)
            path = made_up(
                os.path.join(folder, "r.h5"), nodes, elements, np.stack([nodes, nodes + [1e-3, 2e-3, -2e-3]]),
                np.stack([np.zeros((1, 6)), stress[2:]]),
            )
            group = Results(path).fields()["body"]
            for text, value, unit, signed in (
                ("displacement", 3e-3, "m", False),
                ("displacement:z", -2e-3, "m", True),
                ("pressure", 30, "Pa", True),
                ("stress:yy", -30, "Pa", True),
                ("von_mises", 0, "Pa", False),
                ("stress", 0, "Pa", False),
            ):
                quantity = Quantity(text, [group])
                np.testing.assert_allclose(quantity.of(group, 1), value, atol=1e-12, err_msg=text)
                self.assertEqual((quantity.unit, quantity.signed), (unit, signed), text)
            for text, words in (
                ("velocity", "holds no 'velocity'; this file has displacement, stress"),
                ("stress:xq", "there is no 'xq'"),
                ("displacement:xx", "one of displacement:x"),
            ):
                with self.assertRaises(BadFile) as caught:
                    Quantity(text, [group])
                self.assertIn(words, str(caught.exception))

    def test_deformation_is_magnified_and_rigid_motion_is_not(self):
        nodes, elements = box(2)
        angle = 0.5
        turn = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
        middle = nodes.mean(axis=0)
        stretched = middle + (nodes - middle) * [1, 1, 1.001]
        found, shift = rigid_motion(nodes, (nodes - middle) @ turn.T + [3, 0, 0])
        np.testing.assert_allclose(found, turn, atol=1e-12)
        np.testing.assert_allclose(found @ middle + shift, [3, 0, 0], atol=1e-12)
        with tempfile.TemporaryDirectory() as folder:
            rolled = (stretched - middle) @ turn.T + middle + [3, 0, 0]
            for name, place, travels in (("rolls", rolled, True), ("stays", stretched, False)):
                path = made_up(os.path.join(folder, f"{name}.h5"), nodes, elements, np.stack([nodes, place]))
                body = Body("body", Results(path).fields()["body"])
                body.check_whether_it_travels([0, 1])
                self.assertEqual(body.travels, travels, name)
                corners = body.corners(1, 100)
                if travels:
                    corners = (corners - middle - [3, 0, 0]) @ turn + middle
                expected = (middle + (nodes - middle) * [1, 1, 1.1])[body.faces]
                np.testing.assert_allclose(corners, expected, atol=1e-9, err_msg=name)

    def test_one_scale_for_all_instants(self):
        nodes, elements = box(2)
        with tempfile.TemporaryDirectory() as folder:
            stress = np.zeros((3, 8, 6))
            stress[1, :, 0], stress[2, :, 0] = 7e6, -2e6
            path = made_up(os.path.join(folder, "r.h5"), nodes, elements, np.stack([nodes] * 3), stress)
            stage = Stage(Results(path), ["scene"], "stress:xx")
            self.assertEqual((stage.least, stage.most), (-7e6, 7e6))
            stage = Stage(Results(path), ["body"], "von_mises")
            self.assertEqual((stage.least, stage.most), (0, 7e6))
            frame = Frame(stage)
            self.assertEqual(frame.map.get_clim(), (0, 7))  # MPa
            frame.show(1)
            self.assertEqual(len(frame.faces.get_paths()), 12)
            self.assertIn("t = 1.0000 ms", frame.heading.get_text())
            frame.close()

    def test_a_hundred_thousand_faces(self):
        """Usable, not timed to a limit: what a frame takes is printed."""
        nodes, elements = box(50)
        faces = exterior(elements)[0]
        corners = np.concatenate([nodes[faces] + [2 * k, 0, 0] for k in range(7)])
        self.assertGreater(len(corners), 100000)
        start = time.perf_counter()
        seen, polygons, _ = View(*read_view("iso")).painted(corners)
        self.assertEqual(len(polygons), len(corners) // 2)
        print(f"{len(corners)} faces sorted in {time.perf_counter() - start:.2f} s")


class Files(SampleTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="railwave-")
        self.addCleanup(folder.cleanup)
        self.out = folder.name

    def draw(self, *arguments, code=0):
        result = picture(self.sample.path, "--out", self.out, *arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        return result.stderr if code else result.stdout

    def test_pictures_of_all_formats(self):
        for kind, begins in (("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")):
            self.draw("--by", "stress:xx", "--format", kind, "--time", "2.1e-4")
            path = os.path.join(self.out, f"run-scene-stress-xx.{kind}")
            with open(path, "rb") as file:
                self.assertTrue(file.read().startswith(begins))
            self.assertTrue(made_by_us(path))
        with Image.open(os.path.join(self.out, "run-scene-stress-xx.png")) as image:
            self.assertAlmostEqual(image.info["dpi"][0], 300, delta=0.1)
        with open(os.path.join(self.out, "run-scene-stress-xx.svg"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn("stress xx, MPa", text)
        self.assertIn("t = 0.2000 ms", text)

    def test_movies(self):
        for kind in ("gif", "png"):
            said = self.draw("--show", "block", "--by", "velocity", "--animate", "--format", kind, "--resolution", "40")
            path = os.path.join(self.out, f"run-block-velocity.{kind}")
            self.assertEqual(said.strip(), path)
            with Image.open(path) as image:
                self.assertEqual(image.n_frames, 5)
            self.assertTrue(made_by_us(path))
        self.draw(
            "--by", "velocity", "--animate", "--from", "1e-4", "--to", "3e-4", "--frames", "2", "--resolution", "40"
        )
        with Image.open(os.path.join(self.out, "run-scene-velocity.gif")) as image:
            self.assertEqual(image.n_frames, 2)
        if shutil.which("ffmpeg"):
            self.draw("--by", "velocity", "--animate", "--format", "mp4", "--resolution", "40")
            self.assertTrue(made_by_us(os.path.join(self.out, "run-scene-velocity.mp4")))
        else:
            self.assertIn(
                "needs the program ffmpeg", self.draw("--by", "velocity", "--animate", "--format", "mp4", code=2)
            )

    def test_surfaces_and_places(self):
        self.draw("--show", "block.top,block.lower", "--by", "displacement:z", "--view", "top", "--resolution", "40")
        self.draw(
            "--by", "plastic_strain", "--around", "0.005,0.005,0.005", "--reach", "0.006", "--view=30,40",
            "--resolution", "40",
        )
        self.assertEqual(
            sorted(os.listdir(self.out)),
            ["run-block.top-block.lower-displacement-z.png", "run-scene-plastic_strain.png"],
        )

    def test_options_that_do_not_fit_are_reported(self):
        for arguments, words in (
            (["--view", "above"], "--view above: give iso, side"),
            (["--view", "1,95"], "--view 1,95"),
            (["--scale", "-1"], "--scale -1"),
            (["--scale", "nan"], "--scale nan"),
            (["--by", "stress", "--format", "gif"], "pictures are png, pdf, svg"),
            (["--by", "stress", "--animate", "--format", "pdf"], "movies are gif, png, mp4"),
            (["--range", "3,1"], "the lower end comes first"),
            (["--range", "0,inf"], "2 numbers with commas"),
            (["--around", "1,2"], "3 numbers with commas"),
            (["--by", "stress", "--only", "patch"], "of contacts' pictures"),
            (["--animate", "--time", "1e-4"], "give --from and --to"),
            (["--frames", "5"], "belongs to --animate"),
            (["--reach", "5"], "belongs to --around"),
            (["--resolution", "1000000"], "from 20 to 2400"),
        ):
            said = io.StringIO()
            with contextlib.redirect_stderr(said), self.assertRaises(SystemExit) as caught:
                parse(arguments=["run.h5", *arguments])
            self.assertEqual(caught.exception.code, 2, arguments)
            self.assertIn(words, said.getvalue(), arguments)

    def test_sides_of_a_contact(self):
        self.draw("--show", "contact tread slave", "--by", "pressure", "--view", "top", "--format", "svg")
        with open(os.path.join(self.out, "run-contact-tread-slave-pressure.svg"), encoding="utf-8") as file:
            self.assertIn("pressure, MPa", file.read())
        stage = Stage(Results(self.sample.path), ["contact tread slave"], "pressure", view="top")
        self.assertAlmostEqual(stage.most, 1e9, delta=0.05e9)  # the made-up peak, as the mean of the corners of faces
        self.assertEqual(stage.least, 0)

    def test_damaged_files_are_reported(self):
        damaged = os.path.join(self.out, "damaged.h5")
        for name in ("fields/block/connectivity", "fields/block/coordinates", "fields/block/time", "contact"):
            shutil.copy(self.sample.path, damaged)
            with h5py.File(damaged, "a") as file:
                del file[name]
            result = picture(damaged, "--by", "velocity", "--out", self.out)
            self.assertEqual(result.returncode, 2, name)
            self.assertIn("is damaged", result.stderr, name)
            self.assertNotIn("Traceback", result.stderr)

    def test_what_cannot_be_drawn_is_reported(self):
        for arguments, words in (
            (["--show", "nothing"], "there are scene, block, "),
            (["--by", "temperature"], "holds no 'temperature'; this file has acceleration, displacement"),
            (["--by", "stress", "--around", "9,9,9"], "there is no element within 0.3 m"),
            (["--by", "stress", "--animate", "--from", "1"], "no output lies from 1"),
        ):
            self.assertIn(words, self.draw(*arguments, code=2), arguments)
        self.assertEqual(os.listdir(self.out), [])

    def refused(self, path, words, overwrite=False, inputs=()):
        before = os.lstat(path)
        with self.assertRaises(BadFile) as caught:
            put(path, lambda name: pathlib.Path(name).write_text("new", encoding="utf-8"), overwrite, inputs)
        self.assertIn(words, str(caught.exception))
        self.assertEqual((os.lstat(path).st_ino, os.lstat(path).st_size), (before.st_ino, before.st_size))
        self.assertEqual([name for name in os.listdir(self.out) if name.startswith(".railwave")], [])

    def test_only_pictures_of_ours_are_replaced(self):
        path = os.path.join(self.out, "run-scene-stress.png")
        self.draw("--by", "stress", "--resolution", "40")
        self.draw("--by", "stress", "--resolution", "40")  # our own
        Image.new("RGB", (8, 8)).save(path)
        with open(path, "rb") as file:
            before = file.read()
        self.assertIn("these scripts did not write it", self.draw("--by", "stress", "--resolution", "40", code=2))
        with open(path, "rb") as file:
            self.assertEqual(file.read(), before)
        with open(path, "w", encoding="utf-8") as file:
            file.write(MARK)  # the words alone are no picture
        self.refused(path, "--overwrite")
        self.draw("--by", "stress", "--resolution", "40", "--overwrite")
        self.assertTrue(made_by_us(path))
        os.chmod(path, 0o444)
        self.refused(path, "read-only")
        self.refused(path, "read-only", overwrite=True)

    def test_links_are_followed_and_what_is_no_file_is_refused(self):
        path, target = os.path.join(self.out, "run-scene-stress.png"), os.path.join(self.out, "elsewhere.png")
        os.symlink(target, path)
        self.draw("--by", "stress", "--resolution", "40")
        self.assertTrue(os.path.islink(path) and made_by_us(target))
        with open(target, "w", encoding="utf-8") as file:
            file.write("notes")
        self.refused(path, "is a link to it")
        os.remove(path)
        os.mkfifo(path)
        self.refused(path, "no regular file", overwrite=True)
        os.remove(path)
        os.mkdir(path)
        self.refused(path, "no regular file", overwrite=True)
        os.rmdir(path)
        os.symlink(self.sample.path, path)
        self.refused(path, "this command reads", overwrite=True, inputs=[self.sample.path])

    def test_a_half_written_picture_is_none(self):
        path = os.path.join(self.out, "a.png")

        def breaks(name):
            pathlib.Path(name).write_bytes(b"half")
            raise OSError(28, "No space left on device")

        with self.assertRaises(BadFile) as caught:
            put(path, breaks)
        self.assertIn("No space left", str(caught.exception))
        self.assertEqual(os.listdir(self.out), [])

    def test_the_movie_of_the_patch_stays_what_it_was(self):
        contact = os.path.join(self.out, "contact.h5")
        program = os.path.join(os.environ.get("RAILWAVE_BIN_DIR", ""), "railwave")
        subprocess.run([program, "contact", self.sample.path, "--hdf5", contact], check=True, stdout=subprocess.DEVNULL)
        self.draw("--animate", "--contact", contact, "--resolution", "40", "--frames", "3", "--format", "png")
        with Image.open(os.path.join(self.out, "run-tread.png")) as image:
            self.assertEqual(image.n_frames, 3)


if __name__ == "__main__":
    unittest.main()
