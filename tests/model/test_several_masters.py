#!/usr/bin/env python3
"""A contact whose master is a list of surfaces: how it is read, what is refused, and that it presses as one surface
does."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from roller_and_block import MESHES  # noqa: E402
from two_blocks import STEEL  # noqa: E402

# One plate of 60 mm and two of 30 mm, with the same nodes; rigid, so that all that matters is on which faces the
# slider's nodes lie.
ONE = """
[meshes.plate]
type = "box"
size = [0.06, 0.01, 0.002]
divisions = [20, 5, 1]
[parts.plate]
mesh = "plate"
material = "steel"
[constraints.under]
target = "plate.z_min"
fixed = ["x", "y", "z"]
[constraints.over]
target = "plate.z_max"
fixed = ["x", "y", "z"]
"""
TWO = """
[meshes.plate]
type = "box"
size = [0.03, 0.01, 0.002]
divisions = [10, 5, 1]
""" + "".join(f"""
[parts.{name}]
mesh = "plate"
material = "steel"
position = [{x}, 0, 0]
[constraints.under_{name}]
target = "{name}.z_min"
fixed = ["x", "y", "z"]
[constraints.over_{name}]
target = "{name}.z_max"
fixed = ["x", "y", "z"]
""" for name, x in (("first", 0), ("second", 0.03)))
TWO_MASTERS = '["first.z_max", "second.z_max"]'


def slider(master, x, speed, more=""):
    return f"""
[meshes.slider]
type = "box"
size = [0.0101, 0.008, 0.008]
divisions = [3, 4, 3]
[parts.slider]
mesh = "slider"
material = "steel"
position = [{x}, 0.0011, 0.002]
[contacts.slide]
slave = "slider.z_min"
master = {master}
friction = 0.2
{more}
[loads.press]
type = "pressure"
target = "slider.z_max"
pressure = 5e6
[initial_motion.go]
parts = ["slider"]
velocity = [{speed}, 0, 0]
[time]
end = 6e-5
[output]
history_interval = 1e-6
field_interval = 2e-5
"""


def call(folder, *arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, cwd=folder, check=False)


class SeveralMasters(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)

    def check(self, text, *more):
        (self.folder / "case.toml").write_text(text)
        return call(self.folder, "check", "case.toml", *more)

    def run_case(self, text, name):
        (self.folder / "case.toml").write_text(text)
        done = call(self.folder, "run", "case.toml", "--set", f"output.file={name}.h5")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return h5py.File(self.folder / f"{name}.h5"), done.stdout

    def forces(self, text, name):
        with self.run_case(text, name)[0] as results:
            contact = results["history/contact/slide"]
            return [contact[key][()] for key in ("normal_force", "tangential_force", "master_force")]

    def test_what_is_refused(self):
        two = STEEL + TWO
        tie = '[ties.bond]\nslave = "slider.z_min"\nmaster = "second.z_max"\n'
        twice = '[contacts.more]\nslave = "slider.z_min"\nmaster = "second.z_max"\n'
        turned = '[contacts.more]\nslave = "first.z_max"\nmaster = ["slider.z_min"]\n'
        table = {
            "one named twice": (
                slider('["first.z_max", "first.z_max"]', 0.01, 0),
                "[contacts.slide] master: has 'first.z_max' twice",
            ),
            "the slave among them": (
                slider('["first.z_max", "slider.z_min"]', 0.01, 0),
                "master: has 'slider.z_min', which is the `slave`",
            ),
            "none": (slider("[]", 0.01, 0), "master: is empty, must be a name in quotes or a list of such"),
            "an empty name": (slider('""', 0.01, 0), "master: is empty, must be a name in quotes or a list of such"),
            "a number": (slider("3", 0.01, 0), "must be a name in quotes or a list of such"),
            "a number among them": (
                slider('["first.z_max", 3]', 0.01, 0),
                "must be a name in quotes or a list of such",
            ),
            "an unknown part": (
                slider('["first.z_max", "secund.z_max"]', 0.01, 0),
                "there is no part 'secund'; did you mean 'second.z_max'?",
            ),
            "an unknown surface": (
                slider('["first.z_max", "second.z_top"]', 0.01, 0),
                "there is no set 'second.z_top'",
            ),
            "a contact with one of them": (
                slider(TWO_MASTERS, 0.01, 0) + twice,
                "[contacts.more]: has 'second.z_max' and 'slider.z_min' like [contacts.slide]",
            ),
            "a contact with one of them, exchanged": (
                slider(TWO_MASTERS, 0.01, 0) + turned,
                "[contacts.more]: has 'first.z_max' and 'slider.z_min' like [contacts.slide]",
            ),
            "a tie to one of them": (
                slider(TWO_MASTERS, 0.01, 0) + tie,
                "[ties.bond]: has 'second.z_max' and 'slider.z_min' like [contacts.slide]",
            ),
            "the gap closed towards the own part": (
                slider('["first.z_max", "slider.x_max"]', 0.01, 0, "close_gap = [0, 0, -1]"),
                "one of the masters are of the part 'slider'",
            ),
            "nodes of the slave among them": (
                slider('["first.z_max", "slider.x_max"]', 0.01, 0),
                "'slider.z_min' and 'first.z_max, slider.x_max' share 5 nodes",
            ),
        }
        for what, (sections, wanted) in table.items():
            with self.subTest(what):
                done = self.check(two + sections)
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn(wanted, done.stderr)
                self.assertRegex(done.stderr, r"case\.toml:\d+: ")
        crowned = (
            '[meshes.crowned]\ntype = "crowned_block"\n[parts.crowned]\nmesh = "crowned"\nmaterial = "steel"\n'
            'position = [1, 0, 0]\n'
        )
        done = self.check(two + crowned + slider('["crowned.top", "crowned.zone"]', 0.01, 0))
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn(
            "[contacts.slide] master: 'crowned.top' and 'crowned.zone' have faces in common, which would press twice",
            done.stderr,
        )

    def test_check_names_them_and_one_may_stand_in_a_list(self):
        done = self.check(STEEL + TWO + slider(TWO_MASTERS, 0.01, 0))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("contact slide on first.z_max, second.z_max", done.stdout)
        alone = self.check(STEEL + ONE + slider('"plate.z_max"', 0.01, 0)).stdout
        self.assertEqual(self.check(STEEL + ONE + slider('["plate.z_max"]', 0.01, 0)).stdout, alone)
        self.assertIn("contact slide, friction", alone)
        done = self.check(
            STEEL + TWO + slider('"first.z_max"', 0.01, 0), "--set", f"contacts.slide.master={TWO_MASTERS}"
        )
        self.assertIn("contact slide on first.z_max, second.z_max", done.stdout)

    def test_presses_as_one_surface(self):
        # On the first plate, and over both with no node of the slider within half a facet of the line between them.
        for x, speed in ((0.003, 30.0), (0.02495, 0.0)):
            with self.subTest(x=x):
                wanted = self.forces(STEEL + ONE + slider('"plate.z_max"', x, speed), f"one{x}")
                found = self.forces(STEEL + TWO + slider(TWO_MASTERS, x, speed), f"two{x}")
                largest = np.abs(wanted[0]).max()
                self.assertGreater(largest, 300)
                self.assertGreater(np.abs(wanted[1]).max(), 0.01 * largest if speed else 0)
                for one, other in zip(wanted, found):
                    np.testing.assert_allclose(other, one, rtol=0, atol=1e-9 * largest)

    def test_symmetric_contacts_balance(self):
        wanted = self.forces(STEEL + ONE + slider('"plate.z_max"', 0.02495, 0, "symmetric = true"), "one")
        found = self.forces(STEEL + TWO + slider(TWO_MASTERS, 0.02495, 0, "symmetric = true"), "two")
        largest = np.abs(wanted[0]).max()
        self.assertGreater(largest, 300)
        np.testing.assert_allclose(found[0] + found[1] + found[2], 0, rtol=0, atol=1e-9 * largest)
        # At the line between the plates two nodes press in the place of one.
        np.testing.assert_allclose(
            found[0][-10:].mean(axis=0), wanted[0][-10:].mean(axis=0), rtol=0, atol=0.2 * largest
        )

    def test_results_say_which_facet_is_whose(self):
        results, said = self.run_case(STEEL + TWO + slider(TWO_MASTERS, 0.02495, 0), "two")
        self.assertIn("contact slide on first.z_max, second.z_max, mean over", said)
        with results:
            master = results["contact/slide/master"]
            self.assertEqual(master.attrs["surface"], "first.z_max, second.z_max")
            self.assertEqual(list(master.attrs["surfaces"]), ["first.z_max", "second.z_max"])
            of_facet, x = master["surface_of_facet"][()], master["coordinates"][:, 0]
            np.testing.assert_array_equal(of_facet, x[master["facets"][()]].mean(axis=1) > 0.03)
        results, _ = self.run_case(STEEL + ONE + slider('"plate.z_max"', 0.02495, 0), "one")
        with results:
            self.assertNotIn("surface_of_facet", results["contact/slide/master"])
            self.assertNotIn("surfaces", results["contact/slide/master"].attrs)

    def test_the_stiffness_is_that_of_the_material_under_each_face(self):
        soft = TWO.replace(
            '[parts.second]\nmesh = "plate"\nmaterial = "steel"', '[parts.second]\nmesh = "plate"\nmaterial = "soft"'
        ) + STEEL.replace("steel", "soft").replace("210e9", "105e9")
        springs = slider(TWO_MASTERS, 0.02495, 0, 'algorithm = "penalty"')
        results, _ = self.run_case(STEEL + soft + springs, "two")
        with results:
            slave = results["contact/slide/slave"]
            force, gap = np.linalg.norm(slave["normal_force"][-1], axis=1), slave["gap"][-1]
            stiffness = force / np.where(gap < 0, -gap, np.inf)
            on_second = slave["position"][-1, :, 0] > 0.03
            for mine, other in ((on_second, ~on_second),):
                self.assertGreater(stiffness[mine].max(), 0)
                self.assertAlmostEqual(stiffness[mine].max() / stiffness[other].max(), 0.5, delta=1e-9)

    def test_modes_leave_the_contact_out(self):
        (self.folder / "case.toml").write_text(
            (STEEL + TWO + slider(TWO_MASTERS, 0.02495, 0)).replace('["x", "y", "z"]', '["x"]')
        )
        for part in ("second", "slider"):
            done = call(self.folder, "modes", "case.toml", "--part", part, "--up-to", "1")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("contacts are left out: slide", done.stdout)

    def test_a_roller_rolls_on_the_nearest_of_its_masters_whose_gap_it_closes(self):
        text = STEEL + MESHES + """[parts.roller]
mesh = "roller"
material = "steel"
position = [0, 0, 0.401]
[parts.ahead]
mesh = "block"
material = "steel"
position = [0.3, 0, 0]
[parts.under]
mesh = "block"
material = "steel"
[contacts.tread]
slave = "roller.tread"
master = ["ahead.z_max", "under.z_max"]
friction = 0.3
close_gap = [0, 0, -1]
[initial_motion.start]
parts = ["roller"]
velocity = [20, 0, 0]
rolling = true
[time]
end = 1e-6
"""
        done = self.check(text)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("warning: ", done.stdout)
        self.assertRegex(
            done.stdout, r"\[initial_motion\.start\] rolls at \[0, 50(\.00\d*)?, 0\] rad/s|rolls at \[0, 49\.99\d*, 0\]"
        )


if __name__ == "__main__":
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM} is missing")
    unittest.main()
