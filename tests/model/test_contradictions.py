#!/usr/bin/env python3
"""Pairs of entries that cannot both hold, or are rarely meant: which are refused, which are warned of by `railwave
check`, which are fine; and rolling motions. Each line of TABLE is an input and what is said of it."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from roller_and_block import MESHES  # noqa: E402
from two_blocks import STEEL  # noqa: E402

BLOCKS = STEEL + """[meshes.block]
type = "box"
size = [0.03, 0.03, 0.03]
divisions = [3, 3, 3]
[parts.lower]
mesh = "block"
material = "steel"
[parts.upper]
mesh = "block"
material = "steel"
position = [0.001, 0.001, 0.03]
[time]
end = 1e-6
"""
CONTACT = '[contacts.touch]\nslave = "upper.z_min"\nmaster = "lower.z_max"\nfriction = 0.3\n'
TIE = '[ties.bond]\nslave = "upper.z_min"\nmaster = "lower.z_max"\nmax_distance = 0.01\n'


def section(name, **keys):
    text = {
        key: str(value).lower()
        if isinstance(value, bool)
        else str(value)
        if not isinstance(value, str)
        else f'"{value}"'
        for key, value in keys.items()
    }
    return f"[{name}]\n" + "".join(f"{key} = {value}\n" for key, value in text.items())


def fixed(target="lower.z_min", directions=("x", "y", "z"), name="hold"):
    return section(f"constraints.{name}", target=target, fixed=list(directions)).replace("'", '"')


def prescribed(target, name="drive", **keys):
    return section(f"prescribed_motion.{name}", target=target, **keys)


def along(direction, name="drive", **keys):
    return prescribed("lower.z_min", name, **keys).rstrip("\n") + f'\ndirections = ["{direction}"]\n'


def initial(part, name="start", **keys):
    return f'[initial_motion.{name}]\nparts = ["{part}"]\n' + "".join(
        f"{key} = {value}\n" for key, value in keys.items()
    )


def surface(name, part, low, high):
    return f'[node_sets.{name}]\npart = "{part}"\nsurface = "z_max"\nbox = [{low}, {high}]\n'


# A surface of z_max under another name.
AGAIN = surface("again", "lower", [-1, -1, -1], [1, 1, 1])
# What: sections besides the two blocks, what is said: "refused: ..." exits with 2, "warned: ..." warns, "" says nothing
# of it.
TABLE = {
    "initial motion across a constraint": (
        fixed() + initial("lower", velocity=[1, 0, 0]),
        "refused: [constraints.hold] holds the node at .* along (1, 0, 0), in which an initial motion gives it 1 m/s",
    ),
    "initial motion along what a constraint leaves free": (
        fixed(directions=("y",)) + initial("lower", velocity=[1, 0, 0]),
        "",
    ),
    "prescribed motion across a constraint": (
        fixed() + prescribed("lower.z_min", velocity=[1, 0, 0]),
        (
            "refused: [constraints.hold]: holds the node at .* along (1, 0, 0), in which [prescribed_motion.drive]"
            " (line .*) moves it by 1 m/s"
        ),
    ),
    "prescribed motion along free directions": (
        fixed(directions="z") + prescribed("lower.z_min", velocity=[1, 0, 0]),
        "",
    ),
    "prescribed rotation in the plane that is held across": (
        fixed(directions="y") + prescribed("lower.z_min", angular_velocity=[0, 5, 0]),
        "",
    ),
    "prescribed rotation out of the held plane": (
        fixed(directions="y") + prescribed("lower.z_min", angular_velocity=[0, 0, 5]),
        "refused: [constraints.hold]: holds the node",
    ),
    "prescribed rest of what is held": (fixed() + prescribed("lower.z_min"), ""),
    "prescribed displacement of what is held": (
        fixed(directions="z")
        + prescribed("lower.z_min", displacement=[0, 0, 1e-4], displacement_curve="up")
        + section("curves.up", type="cosine_ramp", duration=1e-3),
        "refused: [constraints.hold]: holds the node .* moves it by 0.0001 m;",
    ),
    "prescribed motion of other nodes that share an edge with held ones": (
        fixed() + prescribed("lower.x_min", velocity=[1, 0, 0]),
        "refused: [constraints.hold]: holds the node",
    ),
    "prescribed motion along one direction only": (
        fixed(directions="x")
        + prescribed("lower.z_min", velocity=[1, 0, 0]).replace("velocity", 'directions = ["y"]\nvelocity'),
        "",
    ),
    "two prescribed motions of one set": (
        prescribed("lower.z_min", velocity=[1, 0, 0]) + prescribed("lower.z_min", "more", velocity=[0, 1, 0]),
        (
            "refused: [prescribed_motion.more] target: 'lower.z_min' is moved in the same directions by"
            " [prescribed_motion.drive] (line .*); motions of common nodes must have perpendicular `directions`"
        ),
    ),
    "two prescribed motions with common nodes": (
        prescribed("lower.z_min", velocity=[1, 0, 0]) + prescribed("lower.x_min", "more", velocity=[0, 1, 0]),
        (
            "refused: [prescribed_motion.more]: the node of 'lower.x_min' at .* is moved in the same directions by"
            " [prescribed_motion.drive] (line .*), whose 'lower.z_min' has it too; leave it out of one of the two sets"
        ),
    ),
    "two prescribed motions of one set along perpendicular directions": (
        along("x", velocity=[1, 0, 0]) + along("z", "more", velocity=[0, 0, 1]),
        "",
    ),
    "two prescribed motions of one set along directions that are oblique to one another": (
        along("x", velocity=[1, 0, 0])
        + along("x", "more", velocity=[0, 0, 1])
        + "axes = [[0.8, 0, 0.6], [0, 1, 0], [-0.6, 0, 0.8]]\n",
        "refused: [prescribed_motion.more] target: 'lower.z_min' is moved in the same directions by",
    ),
    "two prescribed motions, one of them across a constraint": (
        fixed(directions="z") + along("x", velocity=[1, 0, 0]) + along("z", "more", velocity=[0, 0, 1]),
        "refused: [constraints.hold]: holds the node at .* along (0, 0, 1), in which [prescribed_motion.more]",
    ),
    "two prescribed motions along what a constraint leaves free": (
        fixed(directions="y") + along("x", velocity=[1, 0, 0]) + along("z", "more", velocity=[0, 0, 1]),
        "",
    ),
    "two initial motions of one part": (
        initial("upper", velocity=[1, 0, 0]) + initial("upper", "more", angular_velocity=[0, 1, 0]),
        (
            "refused: [initial_motion.more] parts: 'upper' has an initial motion already, [initial_motion.start] (line"
            " .*), and the two would add up"
        ),
    ),
    "initial motions of two parts": (
        initial("upper", velocity=[1, 0, 0]) + initial("lower", "more", velocity=[0, 1, 0]),
        "",
    ),
    "initial motion unlike a prescribed one": (
        initial("upper", velocity=[1, 0, 0]) + prescribed("upper.z_max", velocity=[2, 0, 0]),
        (
            "warned: [prescribed_motion.drive] (line .*) moves 'upper.z_max' at 2 m/s when the run begins, where"
            " [initial_motion.start] (line .*) gives it 1 m/s"
        ),
    ),
    "initial motion like a prescribed one": (
        initial("upper", velocity=[1, 0, 0]) + prescribed("upper.z_max", velocity=[1, 0, 0]),
        "",
    ),
    "tie and contact of one pair": (
        CONTACT + TIE,
        (
            "refused: [ties.bond]: has the same two surfaces as [contacts.touch] (line .*), but what is tied neither"
            " opens nor slides"
        ),
    ),
    "tie and contact of one pair, exchanged": (
        CONTACT + section("ties.bond", slave="lower.z_max", master="upper.z_min"),
        "refused: [ties.bond]: has the same two surfaces as [contacts.touch]",
    ),
    "tie and contact of one pair under another name": (
        CONTACT + AGAIN + TIE.replace("lower.z_max", "lower.again"),
        (
            "refused: [ties.bond]: 'upper.z_min' and 'lower.again' have faces in common with both surfaces of"
            " [contacts.touch]"
        ),
    ),
    "tie and contact of two sides": (CONTACT.replace("z_min", "x_min").replace("z_max", "x_max") + TIE, ""),
    "tie twice": (TIE + TIE.replace("bond", "more"), "refused: [ties.more]: has the same two surfaces as [ties.bond]"),
    "tie twice, exchanged": (
        TIE + section("ties.more", slave="lower.z_max", master="upper.z_min"),
        "refused: [ties.more]: has the same two surfaces as [ties.bond]",
    ),
    "tie twice under another name": (
        AGAIN + TIE + TIE.replace("bond", "more").replace("lower.z_max", "lower.again"),
        "refused: is tied by [ties.bond] already",
    ),
    "contact twice": (
        CONTACT + CONTACT.replace("touch", "more"),
        "refused: [contacts.more]: has the same two surfaces as [contacts.touch]",
    ),
    "contact twice, exchanged": (
        CONTACT + section("contacts.more", slave="lower.z_max", master="upper.z_min"),
        "refused: [contacts.more]: has the same two surfaces as [contacts.touch]",
    ),
    "contact twice under another name": (
        AGAIN + CONTACT + CONTACT.replace("touch", "more").replace("lower.z_max", "lower.again"),
        (
            "refused: [contacts.more]: 'upper.z_min' and 'lower.again' have faces in common with both surfaces of"
            " [contacts.touch] (line .*), where their forces would count twice"
        ),
    ),
    "contact of a surface with itself": (
        CONTACT.replace("upper.z_min", "lower.z_max"),
        "refused: a surface cannot touch itself",
    ),
    "contact of surfaces that share nodes": (
        CONTACT.replace("upper.z_min", "lower.x_max"),
        "refused: [contacts.touch]: 'lower.x_max' and 'lower.z_max' share 4 nodes",
    ),
    "contact with a held side": (CONTACT + fixed("lower.z_max"), ""),
    "contact with a prescribed side": (CONTACT + prescribed("lower.z_max", velocity=[0, 0, 1]), ""),
    "tie of a held slave": (
        TIE + fixed("upper.z_min"),
        "refused: is held by a constraint that does not hold the face under it",
    ),
    "tie of a prescribed slave": (
        TIE + prescribed("upper.z_min", velocity=[1, 0, 0]),
        "refused: moves as [prescribed_motion.drive] says; tie other nodes",
    ),
    "non-reflecting end that is held": (
        fixed() + section("non_reflecting.end", target="lower.z_min"),
        (
            "warned: [non_reflecting.end] (line .*): constraints hold all nodes of 'lower.z_min', so that it reflects"
            " as a fixed end"
        ),
    ),
    "non-reflecting end that is held across": (
        fixed(directions="y") + section("non_reflecting.end", target="lower.z_min"),
        "",
    ),
    "non-reflecting end that is prescribed": (
        prescribed("lower.z_min", velocity=[1, 0, 0]) + section("non_reflecting.end", target="lower.z_min"),
        "refused: moves as [prescribed_motion.drive] says",
    ),
    "non-reflecting end in contact by multipliers": (
        CONTACT + 'algorithm = "multiplier"\n' + section("non_reflecting.end", target="lower.z_max"),
        "refused: belongs to [contacts.touch]",
    ),
    "connector of a set with itself": (
        section("connectors.spring", **{"from": "lower.z_min", "to": "lower.z_min", "stiffness": [1, 1, 1]}),
        "refused: the two ends must differ",
    ),
    "connector of a set with itself under another name": (
        AGAIN + section("connectors.spring", **{"from": "lower.z_max", "to": "lower.again", "stiffness": [1, 1, 1]}),
        "refused: [connectors.spring]: 'lower.z_max' and 'lower.again' are the same nodes",
    ),
    "connector between held sets": (
        fixed()
        + fixed("upper.z_max", name="top")
        + section("connectors.spring", **{"from": "lower.z_min", "to": "upper.z_max", "stiffness": [1, 1, 1]}),
        "warned: [connectors.spring] (line .*): 'lower.z_min' and 'upper.z_max' are held, so that it is never"
        " stretched",
    ),
    "beam of a set with itself": (
        section("beams.rod", **{"from": "lower.z_min", "to": "lower.z_min", "material": "steel", "radius": 0.01}),
        "refused: the two ends must differ",
    ),
    "force on a held set": (
        fixed() + section("loads.push", type="nodal_force", target="lower.z_min", force=[0, 0, 1]),
        "warned: [loads.push] (line .*) acts on 'lower.z_min', of whose 16 nodes all are held where it pushes",
    ),
    "force on a set that is held across": (
        fixed(directions="x") + section("loads.push", type="nodal_force", target="lower.z_min", force=[0, 0, 1]),
        "",
    ),
    "force on a set that is held in part": (
        fixed() + section("loads.push", type="nodal_force", target="lower.x_min", force=[0, 0, 1]),
        "warned: of whose 16 nodes 4 are held",
    ),
    "pressure on a held surface": (
        fixed() + section("loads.push", type="pressure", target="lower.z_min", pressure=1e3),
        "warned: [loads.push] .* it moves nothing and does no work",
    ),
    "traction on a prescribed surface": (
        prescribed("lower.z_min", velocity=[0, 0, 1])
        + section("loads.push", type="traction", target="lower.z_min", traction=[1, 0, 0]),
        "warned: [loads.push]",
    ),
    "torque on a held set": (
        fixed() + section("loads.turn", type="torque", target="lower.z_min", moment=1),
        "warned: [loads.turn]",
    ),
    "hammer on a held place": (
        fixed() + section("hammers.blow", part="lower", position=[0.01, 0.01, 0], radius=0.005, peak=1, duration=1e-4),
        "refused: [hammers.blow]: strikes .* where constraints or prescribed motions hold all that it strikes",
    ),
    "hammer on a free place": (
        fixed()
        + section("hammers.blow", part="lower", position=[0.01, 0.01, 0.03], radius=0.01, peak=1, duration=1e-4),
        "",
    ),
    "two parts in one place": (
        '[parts.twin]\nmesh = "block"\nmaterial = "steel"\n',
        "refused: [parts.twin]: lies in the place of [parts.lower] (line .*), node on node",
    ),
    "two parts that overlap": (
        '[parts.twin]\nmesh = "block"\nmaterial = "steel"\nposition = [0.013, -0.002, -0.003]\n',
        "warned: [parts.lower] (line .*) and [parts.twin] (line .*) overlap: ",
    ),
    "two parts side by side": ('[parts.twin]\nmesh = "block"\nmaterial = "steel"\nposition = [-0.03, 0, 0]\n', ""),
    "gravity on free bodies": (section("gravity", acceleration=[0, 0, -9.81]), ""),
    "output sets twice": (
        '[output]\nhistory_sets = ["lower.z_min", "lower.z_min"]\n',
        "refused: has 'lower.z_min' twice",
    ),
    "a probe far from all": (
        section("probes.far", part="lower", position=[1, 1, 1]),
        "warned: lower.far (line .*) is asked for at",
    ),
}

INNER = """*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
9, 0, 0, 2
10, 1, 0, 2
11, 1, 1, 2
12, 0, 1, 2
*ELEMENT, TYPE=C3D8R, ELSET=all
1, 1, 2, 3, 4, 5, 6, 7, 8
2, 5, 6, 7, 8, 9, 10, 11, 12
*SURFACE, NAME=inner
1, S2
*SURFACE, NAME=top
2, S2
"""
COLUMN = (
    '[meshes.column]\ntype = "file"\npath = "inner.inp"\n[parts.column]\nmesh = "column"\nmaterial = "steel"\n'
    'position = [0, 0, -2]\n'
)
TABLE.update(
    {
        "interior surface as master": (
            COLUMN + CONTACT.replace("lower.z_max", "column.inner"),
            (
                "refused: [contacts.touch] master: 1 of the 1 faces of 'column.inner' lie inside the body, between two"
                " elements"
            ),
        ),
        "interior surface as slave": (
            COLUMN + section("contacts.touch", slave="column.inner", master="upper.z_min"),
            "refused: [contacts.touch] slave: 1 of the 1 faces of 'column.inner'",
        ),
        "surface on the outside as master": (COLUMN + CONTACT.replace("lower.z_max", "column.top"), ""),
        "interior surface as non-reflecting end": (
            COLUMN + section("non_reflecting.end", target="column.inner"),
            "refused: [non_reflecting.end] target: 1 of the 1 faces",
        ),
        "pressure on an interior surface": (
            COLUMN + section("loads.push", type="pressure", target="column.inner", pressure=1),
            "warned: [loads.push] (line .*) target: 1 of the 1 faces of 'column.inner'",
        ),
    }
)

ROLLER = STEEL + MESHES + """[meshes.bar]
type = "cylinder"
[parts.roller]
mesh = "roller"
material = "steel"
position = [0, 0, 0.401]
[parts.block]
mesh = "block"
material = "steel"
[contacts.tread]
slave = "roller.tread"
master = "block.z_max"
friction = 0.3
close_gap = [0, 0, -1]
[time]
end = 1e-6
"""


def rolls(said):
    found = re.search(r"\[initial_motion\.start\] rolls at \[(.*), (.*), (.*)\] rad/s", said)
    return [float(word) for word in found.groups()] if found else None


class Inputs(unittest.TestCase):
    def check(self, text):
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder) / "case.toml"
            case.write_text(text)
            (pathlib.Path(folder) / "inner.inp").write_text(INNER)
            done = subprocess.run([PROGRAM, "check", case], capture_output=True, text=True, cwd=folder, check=False)
        return done.returncode, done.stdout, done.stderr

    def assert_said(self, pattern, text):
        # Brackets stand for themselves, .* for anything.
        self.assertRegex(text, ".*".join(re.escape(piece) for piece in pattern.split(".*")))

    def test_pairs(self):
        for what, (sections, wanted) in TABLE.items():
            with self.subTest(what):
                code, out, error = self.check(BLOCKS + sections)
                kind, _, pattern = wanted.partition(": ")
                if kind == "refused":
                    self.assertEqual(code, 2, out + error)
                    self.assertRegex(error, r"case\.toml:\d+: ")
                    self.assert_said(pattern, error)
                    continue
                self.assertEqual(code, 0, error)
                if kind == "warned":
                    self.assertIn("warning: ", out)
                    self.assert_said(pattern, out)
                else:
                    self.assertNotIn("warning: ", out)

    def rolling(self, motion, sections=""):
        code, out, error = self.check(ROLLER.replace("[time]", sections + "[time]") + motion)
        self.assertEqual(code, 0, error)
        self.assertNotIn("warning: ", out)
        return rolls(out)

    def refused(self, motion, wanted, sections=""):
        code, out, error = self.check(ROLLER.replace("[time]", sections + "[time]") + motion)
        self.assertEqual(code, 2, out)
        self.assert_said(wanted, error)

    def assert_spin(self, spin, wanted):
        # Six digits are printed; the roller's nodes lie on its circle.
        for one, other in zip(spin, wanted):
            self.assertAlmostEqual(one, other, delta=2e-5 * max(map(abs, wanted)))

    def test_rolls_at_velocity_over_radius_about_its_axle_in_the_sense_that_does_not_slide(self):
        self.assert_spin(self.rolling(initial("roller", velocity=[20, 0, 0], rolling="true")), [0, 50, 0])
        self.assert_spin(self.rolling(initial("roller", velocity=[-20, 0, 0], rolling="true")), [0, -50, 0])

    def test_what_goes_across_the_axle_rolls_and_the_rest_slides(self):
        yawed = ROLLER.replace("position = [0, 0, 0.401]", "position = [0, 0, 0.401]\nangle_of_attack = 0.1")
        code, out, error = self.check(yawed + initial("roller", velocity=[20, 0, 0], rolling="true"))
        self.assertEqual(code, 0, error)
        self.assertNotIn("warning: ", out)
        # In the mesh's axes, turned with the part: 20 cos(0.1) / 0.4.
        self.assert_spin(rolls(out), [0, 49.75021, 0])
        self.assert_spin(self.rolling(initial("roller", velocity=[20, 1, 0], rolling="true")), [0, 50, 0])

    def test_rolls_on_what_moves_itself(self):
        self.assert_spin(
            self.rolling(
                initial("roller", velocity=[20, 0, 0], rolling="true") + initial("block", "belt", velocity=[5, 0, 0])
            ),
            [0, 37.5, 0],
        )
        self.assert_spin(
            self.rolling(initial("roller", rolling="true") + initial("block", "belt", velocity=[5, 0, 0])),
            [0, -12.5, 0],
        )

    def test_a_radius_may_be_given_and_must_be_for_meshes_that_are_not_known_to_be_round(self):
        code, out, _ = self.check(ROLLER + initial("roller", velocity=[20, 0, 0], rolling="true", rolling_radius=0.41))
        self.assertEqual(code, 0)
        self.assert_spin(rolls(out), [0, 20 / 0.41, 0])
        code, out, _ = self.check(ROLLER + initial("block", velocity=[0, 3, 0], rolling="true", rolling_radius=0.5))
        self.assertEqual(code, 0)
        self.assert_spin(rolls(out), [-6, 0, 0])
        self.refused(
            initial("block", velocity=[1, 0, 0], rolling="true"),
            "[initial_motion.start] rolling: 'block' is no wheel, wheelset, roller or cylinder, so that no radius"
            " is known",
        )
        self.refused(
            initial("column", velocity=[1, 0, 0], rolling="true"),
            "rolling: 'column' is no wheel, wheelset, roller or cylinder",
            COLUMN,
        )
        self.refused(
            initial("mass", velocity=[1, 0, 0], rolling="true"),
            "rolling: only parts roll, not points",
            "[points.mass]\nmass = 1\nposition = [0, 0, 1]\n",
        )

    def test_contradictions_of_rolling(self):
        self.refused(
            initial("roller", velocity=[20, 0, 0], angular_velocity=[0, 50, 0], rolling="true"),
            "rolling: is true beside angular_velocity",
        )
        self.refused(
            initial("roller", velocity=[20, 0, 0], rolling_radius=0.4),
            "rolling_radius: has no effect without rolling = true",
        )
        self.refused(
            initial("roller", rolling="true"),
            "neither its velocity nor an initial motion of what it touches makes 'roller' roll",
        )
        self.refused(initial("roller", velocity=[0, 1, 0], rolling="true"), "give a velocity across its axle")
        self.refused(
            initial("roller", velocity=[20, 0, 0], rolling="true", centre=[0, 0, 0.3]),
            "the centre of the rotation is 0.1 m off the axis of 'roller'",
        )
        self.refused(
            initial("bar", velocity=[20, 0, 0], rolling="true"),
            "the axis of 'bar' points down and it has no contact",
            '[parts.bar]\nmesh = "bar"\nmaterial = "steel"\nposition = [0, 0, 2]\n',
        )

    def test_what_begins_by_sliding_is_reported_with_both_numbers(self):
        wanted_lines = {
            "the old angular velocity at a new speed": (
                dict(velocity=[40, 0, 0], angular_velocity=[0, 50, 0]),
                "a creepage of 50 %; it rolls at ",
            ),
            "no rotation": (dict(velocity=[40, 0, 0]), "a creepage of 100 %"),
            "rotation without travel": (
                dict(angular_velocity=[0, 50, 0]),
                "'roller' travels at .* over 'block' but turns at 50 rad/s",
            ),
            "the wrong sense": (
                dict(velocity=[20, 0, 0], angular_velocity=[0, -50, 0]),
                "it begins by sliding at 40 m/s",
            ),
            "6 per cent": (dict(velocity=[20, 0, 0], angular_velocity=[0, 47, 0]), "a creepage of 6 %"),
        }
        silent = {
            "4 per cent": dict(velocity=[20, 0, 0], angular_velocity=[0, 48, 0]),
            "a lift": dict(velocity=[0, 0, 1]),
            "across": dict(velocity=[20, 1, 0], angular_velocity=[0, 50, 0]),
        }
        for what, (motion, wanted) in wanted_lines.items():
            with self.subTest(what):
                code, out, error = self.check(
                    ROLLER + initial("roller", centre=[0, 0, 0.4], **motion)
                    if "angular_velocity" in motion
                    else ROLLER + initial("roller", **motion)
                )
                self.assertEqual(code, 0, error)
                self.assert_said("warning: [contacts.tread] (line", out)
                self.assert_said(wanted, out)
                self.assert_said("write rolling = true in place of angular_velocity in [initial_motion.start]", out)
        for what, motion in silent.items():
            with self.subTest(what):
                centre = {"centre": [0, 0, 0.4]} if "angular_velocity" in motion else {}
                code, out, error = self.check(ROLLER + initial("roller", **centre, **motion))
                self.assertEqual(code, 0, error)
                self.assertNotIn("warning: ", out)
        code, out, _ = self.check(
            (ROLLER + initial("roller", velocity=[40, 0, 0])).replace("friction = 0.3", "friction = 0")
        )
        self.assertEqual(code, 0)
        self.assertNotIn("warning: ", out)


if __name__ == "__main__":
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM} is missing")
    unittest.main()
