#!/usr/bin/env python3
"""Contact surfaces that are written near the contact only: what `railwave contact` makes of them is what it makes of
the whole surfaces, nothing that presses is left out, and pictures are drawn."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy
except ImportError:
    sys.exit(77)

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import two_blocks  # noqa: E402

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
PICTURE = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"]) / "scripts" / "picture"
MARGIN = 0.08  # m, more than the ring in which creepages are fitted

# A block falls on a long plate, slides and jumps.
SCENE = two_blocks.two_blocks(
    ([0.6, 0.06, 0.01], [120, 12, 2]), ([0.02, 0.02, 0.01], [4, 4, 2]), [0.01, 0.02, 0.01002]
) + """
[initial_motion.slide]
parts = ["upper"]
velocity = [40, 0, -1]
[curves.begin]
type = "cosine_ramp"
start = 1e-4
duration = 1e-4
[loads.press]
type = "pressure"
target = "upper.z_max"
pressure = 2e7
curve = "begin"
[time]
end = 1e-3
[output]
file = "results.h5"
history_interval = 1e-5
field_interval = 7e-5
"""


class ContactMargin(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        for name, more in (("whole", ""), ("near", f"contact_margin = {MARGIN}\n")):
            (cls.folder / name).mkdir()
            (cls.folder / name / "case.toml").write_text(SCENE + more)
            cls.command(name, PROGRAM, "run", "case.toml")

    @classmethod
    def command(cls, name, *words):
        done = subprocess.run(words, cwd=cls.folder / name, capture_output=True, text=True)
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)
        return done.stdout

    def both(self):
        whole, near = [h5py.File(self.folder / name / "results.h5", "r") for name in ("whole", "near")]
        self.addCleanup(whole.close)
        self.addCleanup(near.close)
        return whole["contact/between"], near["contact/between"]

    def test_nodes_in_the_box_are_as_ever_and_the_others_have_no_values(self):
        whole, near = self.both()
        touching = 0
        for output in range(len(whole["time"])):
            # Box around the nodes that touch, of both sides.
            corners = []
            for side in ("slave", "master"):
                force = whole[side]["normal_force"][output]
                position = whole[side]["position"][output]
                corners.append(position[(force != 0).any(axis=1)])
            corners = numpy.concatenate(corners)
            touching += len(corners) > 0
            for side in ("slave", "master"):
                position = whole[side]["position"][output]
                inside = numpy.zeros(len(position), dtype=bool)
                if len(corners):
                    inside = (position >= corners.min(axis=0) - MARGIN).all(axis=1)
                    inside &= (position <= corners.max(axis=0) + MARGIN).all(axis=1)
                for name, values in near[side].items():
                    if values.shape[0] != len(near["time"]) or values.shape[1:2] != (len(position),):
                        continue
                    expected = whole[side][name][output]
                    if name in ("normal_force", "tangential_force", "pressure", "shear", "slipping"):
                        numpy.testing.assert_array_equal(values[output], expected)
                        continue
                    numpy.testing.assert_array_equal(values[output][inside], expected[inside])
                    self.assertTrue(numpy.isnan(values[output][~inside]).all(), name)
        self.assertGreater(touching, 5)
        self.assertLess(touching, len(whole["time"]), "the block is to be in flight at some output")

    def test_contact_makes_the_same_of_it(self):
        tables = []
        for name in ("whole", "near"):
            said = self.command(name, PROGRAM, "contact", "results.h5", "--csv", "c.csv", "--nodes", "n.csv")
            tables.append([said, *((self.folder / name / table).read_text() for table in ("c.csv", "n.csv"))])
        self.assertGreater(len(tables[0][1].splitlines()), 5)
        for whole, near in zip(*tables):
            self.assertEqual(whole, near)

    def test_takes_less_room(self):
        stored = [
            sum(group[side][name].id.get_storage_size() for side in ("slave", "master") for name in group[side])
            for group in self.both()
        ]
        self.assertLess(stored[1], 0.6 * stored[0])

    def test_pictures_are_drawn(self):
        self.command(
            "near", sys.executable, PICTURE, "results.h5", "--show", "contact between master", "--by", "pressure",
            "--out", "pictures", "--resolution", "50",
        )
        self.assertTrue(list((self.folder / "near" / "pictures").glob("*.png")))


if __name__ == "__main__":
    unittest.main()
