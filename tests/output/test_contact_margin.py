#!/usr/bin/env python3
"""Contact surfaces that are written near the contact only, and some of their fields: what `railwave contact` makes of
them is what it makes of the whole surfaces, nothing that presses is left out, and pictures are drawn."""

import csv
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


CASES = {
    "whole": "",
    "near": f"contact_margin = {MARGIN}\n",
    "few": (
        'contact_margin = 0.011\ncontact_sides = ["slave"]\nprecision = "single"\n'
        'contact_fields = ["displacement", "normal_force", "tangential_force", "slip_velocity", "slipping"]\n'
    ),
    "digits": 'contact_margin = 0.011\nprecision = "single"\nsignificant_digits = 3\n',
    "all_digits": 'contact_margin = 0.011\nprecision = "single"\n',
    "no_forces": 'contact_fields = ["pressure"]\n',
}
ZERO = ("normal_force", "tangential_force", "pressure", "shear", "slipping")


def values_at(side, name, output):
    """A field of a side that has the nodes near the contact only: which nodes, and their values."""
    rows = side["rows"]
    first, last = (rows[output - 1] if output else 0), rows[output]
    return side["near/node"][first:last], side[f"near/{name}"][first:last]


class ContactMargin(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        for name, more in CASES.items():
            (cls.folder / name).mkdir()
            (cls.folder / name / "case.toml").write_text(SCENE + more)
            cls.command(name, PROGRAM, "run", "case.toml")

    @classmethod
    def command(cls, name, *words, code=0):
        done = subprocess.run(words, cwd=cls.folder / name, capture_output=True, text=True)
        if done.returncode != code:
            raise AssertionError(done.stdout + done.stderr)
        return done.stdout + done.stderr

    def contacts(self, *names):
        files = [h5py.File(self.folder / name / "results.h5", "r") for name in names]
        for file in files:
            self.addCleanup(file.close)
        return [file["contact/between"] for file in files]

    def table(self, name):
        self.command(name, PROGRAM, "contact", "results.h5", "--csv", "c.csv", "--overwrite")
        with open(self.folder / name / "c.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        return {column: numpy.array([float(row[column] or "nan") for row in rows]) for column in rows[0]
                if column != "contact"}

    def test_the_nodes_in_the_box_are_written_with_their_values(self):
        whole, near = self.contacts("whole", "near")
        numpy.testing.assert_array_equal(whole["time"], near["time"])
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
                for name in near[side]["near"]:
                    if name == "node":
                        continue
                    nodes, values = values_at(near[side], name, output)
                    numpy.testing.assert_array_equal(nodes, numpy.flatnonzero(inside))
                    numpy.testing.assert_array_equal(values, whole[side][name][output][inside])
                    if name in ZERO:  # nothing that presses is left out
                        self.assertFalse(whole[side][name][output][~inside].any(), name)
        self.assertGreater(touching, 5)
        self.assertLess(touching, len(whole["time"]), "the block is to be in flight at some output")
        everything = {name for name in whole["slave"]} - {"coordinates", "facets", "nodes"}
        self.assertEqual(everything, set(near["slave/near"]) - {"node"})

    def test_three_digits_of_all_but_places(self):
        whole, three = self.contacts("all_digits", "digits")
        for side in ("slave", "master"):
            for name, column in three[side]["near"].items():
                exact = whole[side]["near"][name]
                if name in ("node", "displacement", "position", "slipping"):
                    numpy.testing.assert_array_equal(column, exact, name)
                else:
                    numpy.testing.assert_allclose(column, exact, rtol=5e-4, atol=0, err_msg=name)
                    self.assertEqual((column[:] != exact[:]).any(), (exact[:] != 0).any(), name)
        stored = [sum(column.id.get_storage_size() for column in contact["slave/near"].values())
                  for contact in (whole, three)]
        self.assertLess(stored[1], 0.85 * stored[0])

    def test_contact_makes_the_same_of_it(self):
        tables = []
        for name in ("whole", "near"):
            said = self.command(name, PROGRAM, "contact", "results.h5", "--csv", "o.csv", "--nodes", "n.csv")
            tables.append([said, *((self.folder / name / table).read_text() for table in ("o.csv", "n.csv"))])
        self.assertGreater(len(tables[0][1].splitlines()), 5)
        for whole, near in zip(*tables):
            self.assertEqual(whole, near)

    def test_what_is_not_written_is_found_or_left_out(self):
        """Areas and normals follow from positions, the micro-slip is the run's own, creepages are not known."""
        whole, few = self.table("whole"), self.table("few")
        touching = whole["nodes_in_contact"] > 0
        self.assertGreater(touching.sum(), 5)
        for column, tolerance in (
            ("nodes_in_contact", 0), ("normal_force", 1e-6), ("creep_force", 1e-5), ("area", 1e-5),
            ("peak_shear", 1e-5), ("peak_nodal_pressure", 1e-5), ("semi_axis_along", 1e-4), ("slipping_by_solver", 0),
            ("normal_z", 1e-6),
        ):
            scale = numpy.nanmax(numpy.abs(whole[column]))
            numpy.testing.assert_allclose(
                few[column][touching], whole[column][touching], rtol=0, atol=tolerance * scale, err_msg=column
            )
        numpy.testing.assert_allclose(
            few["peak_micro_slip"][touching], whole["peak_micro_slip"][touching], rtol=1e-4, atol=1e-4
        )
        for column in ("longitudinal_creepage", "mean_velocity_along"):
            self.assertTrue(numpy.isfinite(whole[column]).any())
            self.assertTrue(numpy.isnan(few[column]).all(), column)
        _, few_group = self.contacts("whole", "few")
        self.assertEqual(set(few_group["master"]), {"coordinates", "facets", "nodes"})
        self.assertEqual(few_group["slave/near/normal_force"].dtype, numpy.float32)

    def test_what_a_contact_solution_needs_is_named(self):
        said = self.command("no_forces", PROGRAM, "contact", "results.h5", code=2)
        self.assertIn("no normal_force of the slave surface of contact 'between'; name it in output.", said)

    def test_takes_less_room(self):
        def stored(group):
            sizes = []
            group.visititems(
                lambda _, item: sizes.append(item.id.get_storage_size()) if isinstance(item, h5py.Dataset) else None
            )
            return sum(sizes)

        whole, near, few = [stored(group) for group in self.contacts("whole", "near", "few")]
        self.assertLess(near, 0.6 * whole)
        self.assertLess(few, 0.5 * near)

    def test_pictures_are_drawn(self):
        self.command(
            "near", sys.executable, PICTURE, "results.h5", "--show", "contact between master", "--by", "pressure",
            "--out", "pictures", "--resolution", "50",
        )
        self.assertTrue(list((self.folder / "near" / "pictures").glob("*.png")))


if __name__ == "__main__":
    unittest.main()
