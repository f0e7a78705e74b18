#!/usr/bin/env python3
"""Two feet of one surface slide over a plate, and the load passes from one to the other: `railwave contact` keeps their
numbers and finds the creepages that the prescribed motion gives. A foot that slides with V over a plate at rest has the
slip V and, as its patch goes with it, the rolling velocity V/2."""
import csv
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
SPEED = 24.0  # m/s
END = 0.25e-3
RADIUS, SIDE, HEIGHT, CELLS, LAYERS = 0.1, 8e-3, 4e-3, 10, 4


def feet():
    """Two blocks of 8 mm with a round sole that touch z = 0, at y = -8 and 8 mm, as Abaqus writes them."""
    nodes, elements, soles, tops = [], [], [], [[], []]
    for foot, middle in enumerate((-8e-3, 8e-3)):
        first = len(nodes) + 1
        for k in range(LAYERS + 1):
            for j in range(CELLS + 1):
                for i in range(CELLS + 1):
                    x, y = SIDE * (i / CELLS - 0.5), SIDE * (j / CELLS - 0.5)
                    sole = (x * x + y * y) / (2 * RADIUS)
                    nodes.append((x, y + middle, sole + (HEIGHT - sole) * k / LAYERS))
                    if k == LAYERS:
                        tops[foot].append(len(nodes))
        def at(i, j, k, first=first):
            return first + i + (CELLS + 1) * (j + (CELLS + 1) * k)
        for k in range(LAYERS):
            for j in range(CELLS):
                for i in range(CELLS):
                    elements.append(
                        [at(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                    )
                    if k == 0:
                        soles.append(len(elements))
    lines = ["*NODE"] + [f"{n}, {x:.9f}, {y:.9f}, {z:.9f}" for n, (x, y, z) in enumerate(nodes, 1)]
    lines += ["*ELEMENT, TYPE=C3D8, ELSET=all"] + [
        f"{e}, " + ", ".join(map(str, corners)) for e, corners in enumerate(elements, 1)
    ]
    lines += ["*ELSET, ELSET=low"] + [f"{e}," for e in soles] + ["*SURFACE, NAME=soles, TYPE=ELEMENT", "low, S1"]
    for foot, top in enumerate(tops):
        lines += [f"*NSET, NSET=top_{foot}"] + [f"{n}," for n in top]
    return "\n".join(lines) + "\n"


def case():
    text = """
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.feet]
type = "file"
path = "feet.inp"
[meshes.plate]
type = "box"
origin = [-0.0073, -0.0152, -0.005]
size = [0.0222, 0.0303, 0.005]
divisions = [20, 27, 4]
[parts.feet]
mesh = "feet"
material = "steel"
[parts.plate]
mesh = "plate"
material = "steel"
[constraints.floor]
target = "plate.z_min"
fixed = ["x", "y", "z"]
[contacts.soles]
slave = "feet.soles"
master = "plate.z_max"
"""
    # The first foot is pressed down and let go again while the second is pressed.
    for foot, curve in enumerate(
        ("[[0, 0], [6e-5, 1], [1.6e-4, 0.45], [1, 0.45]]", "[[0, 0], [6e-5, 0.45], [1.6e-4, 1], [1, 1]]")
    ):
        text += f"""
[curves.press_{foot}]
type = "table"
points = {curve}
[prescribed_motion.foot_{foot}]
target = "feet.top_{foot}"
velocity = [{SPEED}, 0, 0]
displacement = [0, 0, -4e-5]
displacement_curve = "press_{foot}"
"""
    return (
        text
        + f"[initial_motion.go]\nparts = [\"feet\"]\nvelocity = [{SPEED}, 0, 0]\n[time]\nend ="
        f" {END}\n[output]\nfield_interval = {END / 20}\nfile = \"run.h5\"\n"
    )


class TwoPatches(unittest.TestCase):
    def test_numbers_and_creepages(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            (pathlib.Path(folder) / "feet.inp").write_text(feet())
            (pathlib.Path(folder) / "case.toml").write_text(case())
            for arguments in (["run", "case.toml"], ["contact", "run.h5", "--csv", "patches.csv"]):
                result = subprocess.run([PROGRAM, *arguments], cwd=folder, capture_output=True, text=True, check=False)
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            with open(pathlib.Path(folder) / "patches.csv") as file:
                rows = [
                    {key: float(value) if value and key != "contact" else value for key, value in row.items()}
                    for row in csv.DictReader(file)
                ]
        patches = [row for row in rows if row["patch"] > 0]
        sides = {row["patch"]: row["centre_y"] > 0 for row in patches}
        self.assertEqual(len(sides), 2, patches)
        self.assertTrue(all(sides[row["patch"]] == (row["centre_y"] > 0) for row in patches))
        pressed = [row for row in patches if row["time"] > 0.3 * END]
        self.assertGreater(len(pressed), 20)
        larger = set()
        for row in pressed:
            larger.add(
                max((one for one in patches if one["time"] == row["time"]), key=lambda one: one["normal_force"])[
                    "patch"
                ]
            )
            self.assertAlmostEqual(row["rolling_velocity"], SPEED / 2, delta=0.02 * SPEED / 2, msg=row)
            self.assertAlmostEqual(row["longitudinal_creepage"], 2, delta=0.02 * 2, msg=row)
        self.assertEqual(len(larger), 2)  # the loads have crossed


if __name__ == "__main__":
    unittest.main()
