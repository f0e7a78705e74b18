#!/usr/bin/env python3
"""Ends of contact surfaces: foreseen by `railwave check`, reported in the run, fatal where a closed contact loses its
last nodes over one; and not reported where whole faces touch, contacts lift off, or a surface goes on behind a gap.
Each case is a scene, how long it runs, and what must and must not be said."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"

FORESEEN = "if its parts go on as initial and prescribed motions say"
AT_END = "a contact's patch is at the end of its surface"
OUTSIDE = "a contact's patch is outside the fine mesh"
LOST = "FAULT: a closed contact has lost all its nodes over the end of its surface"
NEVER = "never closed"
ALL = (FORESEEN, AT_END, OUTSIDE, LOST, NEVER)

STEEL = """
[materials.s]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
"""


def box(name, size, divisions, position):
    return f"""
[meshes.{name}]
type = "box"
size = {size}
divisions = {divisions}
[parts.{name}]
mesh = "{name}"
material = "s"
position = {position}
"""


def held(target, directions=("x", "y", "z"), name="held"):
    return f"[constraints.{name}]\ntarget = \"{target}\"\nfixed = {list(directions)}\n".replace("'", '"')


def slider(plates, contacts, end, start=0.0103, velocity="[20, 0, 0]"):
    """A block of 10 mm that is pressed on plates along x and slides."""
    return (
        STEEL
        + plates
        + box("slider", [0.0101, 0.009, 0.01], [5, 5, 5], [start, 0.0015, 0.01])
        + contacts
        + '[loads.p]\ntype = "pressure"\ntarget = "slider.z_max"\npressure = 20e6\n[initial_motion.go]\nparts ='
        f' ["slider"]\nvelocity = {velocity}\n[time]\nend = {end}\n'
    )


PLATE = box("plate", [0.03, 0.012, 0.01], [15, 6, 5], [0, 0, 0]) + held("plate.z_min")
NEXT_PLATE = box("next", [0.03, 0.012, 0.01], [15, 6, 5], [0.031, 0, 0]) + held("next.z_min", name="held_too")
ON_PLATE = '[contacts.slide]\nslave = "slider.z_min"\nmaster = "plate.z_max"\n'
ON_NEXT = '[contacts.slide_on]\nslave = "slider.z_min"\nmaster = "next.z_max"\n'
SWAPPED = '[contacts.slide]\nslave = "plate.z_max"\nmaster = "slider.z_min"\n'


def slab(position, size, divisions, velocity, end):
    """Dropped or laid on a small block."""
    return (
        STEEL
        + box("low", [0.01, 0.01, 0.01], [4, 4, 4], [0, 0, 0])
        + box("up", size, divisions, position)
        + held("low.z_min")
        + '[contacts.c]\nslave = "up.z_min"\nmaster = "low.z_max"\n[initial_motion.go]\nparts = ["up"]\nvelocity ='
        f' {velocity}\n[time]\nend = {end}\n'
    )


def roller(master, end, keys="", slave="roller.tread", aside=0):
    """A roller of 50 mm that rolls over a crowned block to its end at x = 30 mm; the block's fine zone reaches to 14
    mm. Its own fine zone reaches 4 mm to both sides of its middle, which may be `aside` of the block's crown, m."""
    return STEEL + f"""
[meshes.roller]
type = "roller"
radius = 0.05
bore_radius = 0.04
side_start = -0.008
side_end = 0.008
ring = true
zone_size = 2e-3
zone_start = -0.008
zone_end = 0.008
zone_width = 0.008
zone_layers = 2
coarse_size = 0.003
[meshes.block]
type = "crowned_block"
origin = [-0.012, -0.01, -0.01]
size = [0.042, 0.02, 0.01]
radius_across = 0.1
zone_size = 2e-3
zone_start = -0.008
zone_end = 0.014
zone_width = 0.008
zone_layers = 2
coarse_size = 0.008
[parts.roller]
mesh = "roller"
material = "s"
position = [0, {aside}, 0.05]
[parts.block]
mesh = "block"
material = "s"
{held("block.bottom")}{held("roller.bore", ["y"], "axle")}
[contacts.roll]
slave = "{slave}"
master = "{master}"
close_gap = [0, 0, -1]
[gravity]
acceleration = [0, 0, -5e3]
[settle]
[initial_motion.go]
parts = ["roller"]
velocity = [30, 0, 0]
rolling = true
{keys}
[time]
end = {end}
"""


# name: (case, exit code, said by check, said by the run; of ALL the others must not be said)
SCENES = {
    "slides off a plate": (slider(PLATE, ON_PLATE, 1.4e-3), 3, {FORESEEN}, {FORESEEN, AT_END, LOST}),
    "stays on it": (slider(PLATE, ON_PLATE, 0.3e-3), 0, set(), set()),
    "stays on it, roles swapped": (slider(PLATE, SWAPPED, 0.3e-3), 0, set(), set()),
    "stays on it, symmetric": (slider(PLATE, ON_PLATE + "symmetric = true\n", 0.3e-3), 0, set(), set()),
    "bounces off it": (
        slider(PLATE, ON_PLATE, 0.3e-3, velocity="[20, 0, -2]")
        .replace("pressure = 20e6", "pressure = 1")
        .replace("0.0015, 0.01]", "0.0015, 0.010005]"),
        0,
        set(),
        set(),
    ),
    "goes on to the next plate": (slider(PLATE + NEXT_PLATE, ON_PLATE + ON_NEXT, 0.9e-3), 0, set(), set()),
    "a wide slab bounces on a block": (
        slab([-0.01, -0.01, 0.01001], [0.03, 0.03, 0.006], [12, 12, 3], "[0, 0, -2]", 2e-4),
        0,
        set(),
        set(),
    ),
    "a slab that overhangs at one side bounces": (
        slab([0.004, 0.0002, 0.01001], [0.01, 0.01, 0.006], [4, 4, 3], "[0, 0, -2]", 1e-4),
        0,
        set(),
        set(),
    ),
    "two alike": (slab([0, 0, 0.01001], [0.01, 0.01, 0.006], [4, 4, 3], "[0, 0, -2]", 1e-4), 0, set(), set()),
    "never closes": (slab([0, 0, 0.0102], [0.01, 0.01, 0.006], [4, 4, 3], "[0, 0, 1]", 2e-5), 0, set(), {NEVER}),
    "rolls off a block": (roller("block.top", 1.6e-3), 3, {FORESEEN}, {FORESEEN, AT_END, OUTSIDE, LOST}),
    "rolls out of a set": (roller("block.zone", 0.8e-3), 3, {FORESEEN}, {FORESEEN, AT_END, LOST}),
    "rolls within the zone": (roller("block.top", 0.1e-3), 0, set(), set()),
    "rolls beside the fine zone": (
        roller("block.top", 0.1e-3, aside=0.022)
        .replace("side_start = -0.008", "side_start = -0.04")
        .replace("coarse_size = 0.003", "coarse_size = 0.01"),
        0,
        set(),
        {OUTSIDE},
    ),
    "rolls on the side of a set": (roller("block.top", 0.07e-3, slave="roller.zone", aside=0.004), 0, set(), {AT_END}),
}


def railwave(folder, *arguments):
    return subprocess.run([PROGRAM, *arguments], cwd=folder, capture_output=True, text=True, check=False)


class Ends(unittest.TestCase):
    def said(self, text, wanted):
        self.assertEqual({one for one in ALL if one in text}, wanted, text)


def add_test(name, case, exit_code, checked, run):
    def test(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            (pathlib.Path(folder) / "case.toml").write_text(case)
            result = railwave(folder, "check", "case.toml")
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.said(result.stdout, checked)
            result = railwave(folder, "run", "case.toml")
            self.assertEqual(result.returncode, exit_code, result.stdout + result.stderr)
            self.said(result.stdout + result.stderr, run)
            if exit_code == 3:
                # Soon after: at 20 to 30 m/s the middle of what slid or rolled is at most its own half length and 3 mm
                # past the end.
                time = float(re.search(r"lost all its nodes.*?t = ([0-9.e+-]+) s", result.stdout + result.stderr)[1])
                self.assertLess(time, float(re.search(r"\[time\]\nend = (\S+)", case)[1]))
                self.assertTrue((pathlib.Path(folder) / "results/case/case.fault.h5").exists())

    setattr(Ends, "test_" + re.sub(r"\W+", "_", name), test)


for scene_name, scene in SCENES.items():
    add_test(scene_name, *scene)


if __name__ == "__main__":
    unittest.main()
