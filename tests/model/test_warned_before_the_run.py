#!/usr/bin/env python3
"""What is said of seams, overlaps at the start, stiff multipliers, hourglass coefficients, ends and layers before a
run: by `check`, `mesh`, `modes` and at the run's beginning."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from two_blocks import STEEL  # noqa: E402

PLATE = STEEL + """
[meshes.plate]
type = "box"
size = [0.06, 0.01, 0.01]
divisions = [30, 5, 5]
[parts.plate]
mesh = "plate"
material = "steel"
[time]
end = 1e-6
"""
BOXES = STEEL + """
[meshes.box]
type = "box"
size = [0.01, 0.01, 0.01]
divisions = [4, 4, 4]
[parts.low]
mesh = "box"
material = "steel"
[parts.up]
mesh = "box"
material = "steel"
position = [0.0003, 0.0002, HEIGHT]
[constraints.held]
target = "low.z_min"
fixed = ["x", "y", "z"]
[contacts.touch]
slave = "up.z_min"
master = "low.z_max"
CONTACT
[time]
end = END
"""


def boxes(height, contact="", more="", end="1e-6"):
    return BOXES.replace("HEIGHT", str(height)).replace("CONTACT", contact).replace("END", end) + more


def seam(place=(0.03, 0.005, 0.01), length=0.02, depth=0.0045):
    return f'[seams.crack]\nmesh = "plate"\nplace = {list(place)}\nlength = {length}\ndepth = {depth}\n'


class Said(unittest.TestCase):
    def railwave(self, text, *words, mesh=""):
        with tempfile.TemporaryDirectory() as folder:
            if mesh:
                (pathlib.Path(folder) / "mesh.inp").write_text(mesh)
            (pathlib.Path(folder) / "case.toml").write_text(text)
            done = subprocess.run(
                [PROGRAM, words[0], "case.toml", *words[1:]], capture_output=True, text=True, cwd=folder, check=False
            )
            written = sorted(str(p.relative_to(folder)) for p in pathlib.Path(folder).rglob("*") if p.is_file())
        return done.returncode, done.stdout, done.stderr, written

    def assert_all_say(self, text, wanted, commands=("check", "mesh", "run"), may_end_as_fault=False):
        for command in commands:
            with self.subTest(command):
                code, out, error, _ = self.railwave(text, command)
                self.assertIn(code, (0, 3) if may_end_as_fault and command == "run" else (0,), error)
                self.assertIn(wanted, out)

    def assert_refused(self, text, pattern):
        for command in ("check", "run"):
            code, out, error, written = self.railwave(text, command)
            self.assertEqual(code, 2, out + error)
            self.assertRegex(error, r"case\.toml:\d+: ")
            self.assertRegex(error, pattern)
            self.assertEqual(written, ["case.toml"])

    def test_seams_say_what_they_opened(self):
        # Five faces wide and two deep: the mesh is 10 mm wide.
        self.assert_all_say(
            PLATE + seam(),
            "note: [seams.crack] (line 16) opens 12 nodes of mesh plate between 10 pairs of element faces: 0.01 m"
            " long (0.02 m asked for), 0.004 m deep (0.0045 m asked for)",
            ("check", "mesh", "run", "modes"),
        )

    def test_seams_that_open_nothing_cut_through_or_lie_elsewhere_are_refused(self):
        self.assert_refused(
            PLATE + seam(length=0.003),
            r"\[seams\.crack\]: opens no node: .* make it at least two elements \(0\.004 m\) long and one \(0\.002"
            r" m\) deep",
        )
        self.assert_refused(PLATE + seam(depth=0.0005), r"\[seams\.crack\]: no layer of element faces")
        self.assert_refused(
            PLATE + seam(depth=0.02), r"\[seams\.crack\]: cuts the body in two: it became 0\.01 m long and 0\.01 m deep"
        )
        self.assert_refused(
            PLATE + seam(place=(0.03, 0.005, 0.004), depth=0.002),
            r"is 0\.006 m below the mesh's upper surface.* the nearest place on it is \[0\.03, 0\.005, 0\.01\]",
        )
        self.assert_refused(
            PLATE + seam(place=(0.03, 0.016, 0.01)),
            r"lies beside the mesh: .* the nearest place on it is \[0\.03, 0\.01, 0\.01\]",
        )
        self.assert_refused(
            PLATE + seam(place=(0.2, 0.005, 0.01)), r"the nearest place on it is \[0\.06, 0\.005, 0\.01\]"
        )

    def test_a_deep_overlap_is_reported_with_depth_place_and_mend(self):
        for contact in ("", 'algorithm = "penalty"', 'algorithm = "multiplier"', "symmetric = true"):
            with self.subTest(contact):
                self.assert_all_say(
                    boxes(0.009, contact),
                    (
                        "warning: [contacts.touch] (line 21): 16 nodes of 'up.z_min' lie inside the body of 'low.z_max'"
                        " when the run begins, the deepest 0.001 m (0.4 of the size of a face there) at (0.0003,"
                        " 0.0002, 0.009) m: more than a contact can push apart without a blow; shift parts.up.position"
                        " by [0, 0, 0.001] m, or place it farther off and give contacts.touch.close_gap = [0, 0, -1]"
                        if "symmetric" not in contact
                        else "the deepest 0.001 m (0.4 of the size of a face there)"
                    ),
                    ("check", "run"),
                    may_end_as_fault=True,
                )

    def test_the_mends_work(self):
        shifted = boxes(0.009).replace("position = [0.0003, 0.0002, 0.009]", "position = [0.0003, 0.0002, 0.01]")
        closed = boxes(0.012, "close_gap = [0, 0, -1]")
        for text in (shifted, closed):
            code, out, error, _ = self.railwave(text, "check")
            self.assertEqual(code, 0, error)
            self.assertNotIn("warning", out)

    def test_a_small_overlap_is_only_noted(self):
        code, out, error, _ = self.railwave(boxes(0.00999), "check")
        self.assertEqual(code, 0, error)
        self.assertNotIn("warning", out)
        self.assertIn(
            "the deepest 1e-05 m (0.004 of the size of a face there) at (0.0003, 0.0002, 0.00999) m: its forces"
            " push them apart in the first steps",
            out,
        )
        code, out, error, _ = self.railwave(boxes(0.00999, "", "[settle]\nactive = true\n"), "check")
        self.assertIn("settling pushes them apart", out)
        # Multipliers close a gap within a step: 10 micrometres in less than a microsecond.
        code, out, error, _ = self.railwave(boxes(0.00999, 'algorithm = "multiplier"'), "check")
        self.assertIn("more than a contact can push apart without a blow", out)

    def test_the_diagnosis_names_a_deep_overlap(self):
        code, out, error, _ = self.railwave(boxes(0.009, 'algorithm = "multiplier"', end="2e-6"), "run")
        self.assertIn(
            "the run begins with contact touch pressed in by 0.4 of a face's size, 0.001 m at (0.0003, 0.0002,"
            " 0.009) m: shift parts.up.position by [0, 0, 0.001] m",
            out + error,
        )

    def test_multipliers_between_surfaces_that_no_force_moves_are_refused(self):
        drive = '[prescribed_motion.drive]\ntarget = "{}"\nvelocity = [0, 0, -1]\n'
        top = '[constraints.top]\ntarget = "{}"\nfixed = ["x", "y", "z"]\n'
        multiplier = 'algorithm = "multiplier"'
        pattern = (
            r"\[contacts\.touch\]: algorithm: multipliers press surfaces apart by moving them, but \[.*\] \(line \d+\)"
            r" holds or drives 'up\.z_min'.* set algorithm = \"penalty\""
        )
        self.assert_refused(boxes(0.01, multiplier, drive.format("up.z_min") + top.format("low.z_max")), pattern)
        self.assert_refused(
            boxes(0.01, multiplier, drive.format("up.z_min") + drive.format("low.z_max").replace("drive", "other")),
            pattern,
        )
        self.assert_refused(
            boxes(0.01, multiplier, top.format("up.z_min") + top.format("low.z_max").replace("top", "bottom")), pattern
        )
        # A part of both surfaces.
        corner = '[node_sets.{0}_side]\npart = "{0}"\nsurface = "{1}"\nbox = [[-1, -1, -1], [0.006, 1, 1]]\n'
        part = corner.format("up", "z_min") + corner.format("low", "z_max")
        self.assert_refused(
            boxes(0.01, multiplier, part + drive.format("up.up_side") + top.format("low.low_side")), pattern
        )

    def test_multipliers_where_one_side_gives_way_are_not(self):
        drive = '[prescribed_motion.drive]\ntarget = "{}"\nvelocity = [0, 0, -1]\n'
        top = '[constraints.top]\ntarget = "low.z_max"\nfixed = {}\n'
        multiplier = 'algorithm = "multiplier"'
        for more in (
            drive.format("up.z_min"),
            drive.format("up.z_max") + top.format('["x", "y", "z"]'),
            drive.format("up.z_min") + top.format('["x", "y"]'),
        ):
            code, out, error, _ = self.railwave(boxes(0.01, multiplier, more), "check")
            self.assertEqual(code, 0, error)
        # Sides of the two boxes that stand over each other are held alike.
        sides = '[constraints.{0}]\ntarget = "{0}.x_min"\nfixed = ["x", "y", "z"]\n'
        flush = boxes(0.01, multiplier, sides.format("up") + sides.format("low")).replace(
            "position = [0.0003, 0.0002,", "position = [0, 0,"
        )
        code, out, error, _ = self.railwave(flush, "check")
        self.assertEqual(code, 0, error)

    def test_an_hourglass_coefficient_without_hourglass_is_reported(self):
        text = PLATE.replace('material = "steel"\n', 'material = "steel"\nhourglass_coefficient = 0.3\n')
        code, out, _, _ = self.railwave(text, "check")
        self.assertEqual(code, 0)
        self.assertRegex(
            out,
            r"warning: case\.toml:\d+: \[parts\.plate\] hourglass_coefficient: is given without hourglass, and so"
            r" is one of stiffness control",
        )
        for kind in ("viscous", "stiffness"):
            code, out, _, _ = self.railwave(
                text.replace("hourglass_coefficient", f'hourglass = "{kind}"\nhourglass_coefficient'), "check"
            )
            self.assertNotIn("given without hourglass", out)

    def test_modes_warns_of_meshes_as_runs_do(self):
        beam = PLATE.replace("divisions = [30, 5, 5]", "divisions = [30, 1, 1]").replace(
            "size = [0.06, 0.01, 0.01]", "size = [0.06, 0.002, 0.002]"
        )
        code, out, error, _ = self.railwave(beam, "modes", "--up-to", "20000")
        self.assertEqual(code, 0, error)
        self.assertRegex(
            out,
            r"warning: \[parts\.plate\] \(line \d+\) is bent over few elements: its hourglass control holds more"
            r" than 0\.1 \(monitor\.hourglass_share\)",
        )
        code, out, error, _ = self.railwave(PLATE, "modes", "--up-to", "20000")
        self.assertEqual(code, 0, error)
        self.assertNotIn("warning", out)
        two = PLATE.replace(
            "[time]", '[parts.again]\nmesh = "plate"\nmaterial = "steel"\nposition = [0.0005, 0.0005, 0.0005]\n[time]'
        )
        code, out, error, _ = self.railwave(two, "modes", "--up-to", "20000")
        self.assertRegex(out, r"warning: \[parts\.plate\] \(line \d+\) and \[parts\.again\] \(line \d+\) overlap")

    def test_parts_of_one_mesh_that_nothing_joins_are_reported(self):
        places = [(x, y, z) for z in range(3) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        mesh = "*NODE\n" + "".join(f"{n},{x},{y},{z}\n" for n, (x, y, z) in enumerate(places, 1))
        mesh += (
            "*ELEMENT,TYPE=C3D8R,ELSET=LOW\n1,1,2,3,4,5,6,7,8\n*ELEMENT,TYPE=C3D8R,ELSET=UP\n2,5,6,7,8,9,10,11,12\n"
            "*SURFACE,NAME=TOP,TYPE=ELEMENT\n1,S2\n*SURFACE,NAME=BOTTOM,TYPE=ELEMENT\n2,S1\n"
        )
        text = STEEL + '[meshes.two]\ntype = "file"\npath = "mesh.inp"\nscale = 0.01\n[time]\nend = 1e-6\n'
        for name in ("low", "up"):
            text += f'[parts.{name}]\nmesh = "two"\nmaterial = "steel"\nelement_set = "{name}"\n'
        apart = (
            r"warning: \[parts\.low\] \(line \d+\) and \[parts\.up\] \(line \d+\) are of one mesh and have a face in"
            r" common, one of their corners at \(0, 0, 0\.01\) m, but nothing joins them"
        )
        for more, command, warned in (
            ("", ["check"], True),
            ("", ["modes", "--up-to", "1e5"], True),
            ('[ties.glue]\nslave = "up.bottom"\nmaster = "low.top"\n', ["check"], False),
        ):
            code, out, error, _ = self.railwave(text + more, *command, mesh=mesh)
            self.assertEqual(code, 0, error)
            (self.assertRegex if warned else self.assertNotRegex)(out, apart)

    def test_ends_of_slender_parts_and_layers_are_reported(self):
        end = '[non_reflecting.far]\ntarget = "plate.x_max"\n'
        code, out, _, _ = self.railwave(PLATE + end, "check")
        self.assertEqual(code, 0)
        self.assertRegex(
            out,
            r"note: \[non_reflecting\.far\] \(line \d+\) lets out waves of the continuum .* part plate is slender"
            r" .* \[absorbing_layers\.far\]",
        )
        layer = '[absorbing_layers.far]\ntarget = "plate.x_max"\nlength = 0.03\n'
        code, out, _, _ = self.railwave(PLATE + end + layer, "check")
        self.assertEqual(code, 0)
        self.assertNotIn("lets out waves of the continuum", out)
        self.assertRegex(
            out,
            r"\[absorbing_layers\.far\]: 540 nodes of plate within 0\.03 m of 'plate\.x_max', 15\.0 elements deep,"
            r" damped by up to .* above 1\.73e\+05 Hz.* it sends back 2 % at most",
        )
        self.assert_refused(
            PLATE + layer.replace("0.03", "0.001"),
            r"\[absorbing_layers\.far\] length: 0\.001 m is less than the elements",
        )
        self.assert_refused(PLATE + layer.replace("0.03", "0.1"), r"leaves nothing of part plate undamped")

    def test_a_scenes_doubts_are_said_once_at_the_beginning_and_once_in_the_summary(self):
        _, out, _, _ = self.railwave(boxes(0.0098), "run")
        self.assertEqual(len(re.findall("16 nodes of 'up.z_min' lie inside", out)), 2, out)


if __name__ == "__main__":
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM} is missing")
    unittest.main()
