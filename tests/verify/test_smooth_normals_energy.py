#!/usr/bin/env python3
"""Contact with smooth normals keeps the account of energy: a crowned roller strikes a block, straight and aslant, the
roller's surface or the block's being the master, by springs and by multipliers. Between facets of other normals than
the surfaces bend to, half a per cent had been missing."""
import itertools
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"

CASE = """
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.roller]
type = "roller"
radius = 0.02
crown_radius = 0.02
bore_radius = 0.012
side_start = -0.006
side_end = 0.006
arc_start = -0.006
arc_end = 0.006
zone_size = 0.2e-3
zone_start = -0.8e-3
zone_end = 0.8e-3
zone_width = 1.6e-3
zone_layers = 2
growth = 1.8
coarse_size = 0.003
[meshes.block]
type = "crowned_block"
origin = [-0.006, -0.006, -0.006]
size = [0.012, 0.012, 0.006]
zone_size = 0.2e-3
zone_start = -0.87e-3
zone_end = 0.8e-3
zone_centre = 0.00006
zone_width = 1.6e-3
zone_layers = 2
growth = 1.8
coarse_size = 0.003
[parts.roller]
mesh = "roller"
material = "steel"
position = [0, 0, 0.0200005]
[parts.block]
mesh = "block"
material = "steel"
[contacts.hertz]
slave = "{slave}.zone"
master = "{master}.zone"
normals = "{normals}"
friction = {friction}
{more}
[constraints.far]
target = "block.bottom"
fixed = ["x", "y", "z"]
[initial_motion.go]
parts = ["roller"]
velocity = [{along}, 0, -1]
[time]
end = 4.5e-5
step_scale = 0.5
[output]
history_interval = 1e-7
"""


class Energy(unittest.TestCase):
    def impact(self, **changes):
        said = {
            "slave": "roller",
            "master": "block",
            "normals": "smooth",
            "friction": 0,
            "along": 0,
            "more": "",
            **changes,
        }
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "case.toml").write_text(CASE.format(**said))
            done = subprocess.run(
                [PROGRAM, "run", "case.toml", "--set", "output.file=r.h5"],
                capture_output=True, text=True, cwd=folder, check=False,
            )
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with h5py.File(pathlib.Path(folder) / "r.h5") as results:
                history = results["history"]
                energy = {name: history["energy"][name][()] for name in history["energy"]}
                force = np.linalg.norm(history["contact/hertz/normal_force"][()], axis=1)
        self.assertGreater(force.max(), 300)
        self.assertEqual(force[-1], 0)
        missing = np.abs(energy["balance_error"]).max() / energy["internal"].max()
        print(
            f"{said['master']:6s} is master, {said['normals']:6s} {said['more']:28s} friction {said['friction']},"
            f" {said['along']} m/s along: {missing:.1e} of the elastic energy missing"
        )
        return missing, energy

    def test_straight(self):
        for (slave, master), algorithm in itertools.product(
            (("roller", "block"), ("block", "roller")), ("penalty", "multiplier")
        ):
            with self.subTest(master=master, algorithm=algorithm):
                missing, energy = self.impact(slave=slave, master=master, more=f'algorithm = "{algorithm}"')
                # Facets leave 2e-5 to 6e-5; the gap's bend over the facets alone, which nobody booked, 5e-3.
                self.assertLess(missing, 2e-4)
                if algorithm == "penalty":
                    self.assertLess(np.abs(energy["contact"][-1]), 1e-12)

    def test_aslant_with_friction(self):
        for (slave, master), more in itertools.product(
            (("roller", "block"), ("block", "roller")),
            ("damping = 0.1", "symmetric = true", 'algorithm = "multiplier"'),
        ):
            with self.subTest(master=master, more=more):
                missing, energy = self.impact(slave=slave, master=master, more=more, friction=0.3, along=2)
                # Facets leave 7e-5 to 1.1e-4, and half of it at half the step.
                self.assertLess(missing, 4e-4)
                self.assertGreater(energy["friction"][-1], 0.01 * energy["internal"].max())


if __name__ == "__main__":
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM} is missing")
    unittest.main()
