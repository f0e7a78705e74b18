#!/usr/bin/env python3
"""The default hourglass control holds under 2 % of the energy in scenes of scripts/hourglass_table, and what the
monitor advises about a large share of hourglass energy makes that share smaller: each advice is followed."""

import os
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

SOURCE, PROGRAM = os.environ["RAILWAVE_SOURCE_DIR"], os.path.join(os.environ["RAILWAVE_BIN_DIR"], "railwave")
sys.path.insert(0, os.path.join(SOURCE, "scripts"))
import hourglass.scenes as scenes  # noqa: E402

CASES = os.path.join(SOURCE, "benchmarks", "cases", "hourglass")
SAID = r"hourglass energy of a part, .*?; likely cause: (.*?)(?: \(worst .*)?\n"
FINER = "meshes.beam.divisions=[40,4,4]"


def control(parts, **values):
    return [f"parts.{part}.{key}={value}" for part in parts for key, value in values.items()]


def run(case, overrides):
    """What the program said, and the results' energies by name."""
    with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
        command = [PROGRAM, "run", os.path.join(CASES, case)]
        for override in [*overrides, f"output.file={folder}/results.h5"]:
            command += ["--set", override]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        assert done.returncode == 0, done.stdout
        with h5py.File(f"{folder}/results.h5", "r") as file:
            return done.stdout, {name: values[:] for name, values in file["history/energy"].items()}


def share(said):
    """The worst that the monitor saw of any part."""
    return float(re.search(r"hourglass_share (\S+) \(", said).group(1))


def taken(energy):
    """By hourglass control, of the energy given: mean of the last twentieth of the run."""
    given = energy["kinetic"][0] + energy["external_work"].max()
    return energy["hourglass"][-max(1, len(energy["hourglass"]) // 20):].mean() / given


class Default(unittest.TestCase):
    def test_it_takes_under_two_per_cent(self):
        for name in ("drop, 10 mm", "drop, 5 mm", "bars", "hammer", "beam swings, 4 thick"):
            scene = scenes.SCENES[name]
            with self.subTest(name):
                said, energy = run(os.path.basename(scene.case), scene.overrides)
                self.assertLess(taken(energy), 0.02)
                # so what it holds is stored, not lost
                self.assertIn("viscous hourglass control: element kernels read no velocities", said)
                self.assertLess(
                    abs(energy["balance_error"]).max(), 0.02 * (energy["kinetic"][0] + energy["external_work"].max())
                )

    def test_a_beam_two_elements_thick_swings_on(self):
        for control_of, least, most in (("stiffness", 0.99, 1.01), ("viscous", 0, 0.95)):
            with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
                command = [
                    PROGRAM, "run", os.path.join(CASES, "beam.toml"), "--set", f"parts.beam.hourglass={control_of}",
                    "--set", f"output.file={folder}/results.h5",
                ]
                subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
                with h5py.File(f"{folder}/results.h5", "r") as file:
                    time, tip = file["history/time"][:], file["history/set/beam.x_max/displacement"][:, 2]
            first, last = (
                np.ptp(tip[(time > start) & (time <= start + 2.5e-3)]) for start in (2.1e-3, time[-1] - 2.5e-3)
            )
            self.assertGreater(last / first, least)
            self.assertLess(last / first, most)

    def test_bars_of_matching_meshes_gain_no_energy(self):
        for divisions in ("[2,2,20]", "[3,3,30]", "[4,4,40]"):
            with self.subTest(divisions):
                _, energy = run("bars.toml", [f"meshes.bar.divisions={divisions}"])
                self.assertLess(abs(energy["balance_error"]).max(), 0.01 * energy["kinetic"][0])

    def test_a_dropped_box_keeps_what_viscous_control_took(self):
        _, viscous = run("drop.toml", control(("upper", "lower"), hourglass="viscous"))
        _, default = run("drop.toml", [])
        self.assertGreater(taken(viscous), 0.1)
        self.assertGreater(default["kinetic"][-1], viscous["kinetic"][-1])


class Advice(unittest.TestCase):
    def advised(self, case, overrides):
        """The share, and what is advised."""
        said, _ = run(case, overrides)
        found = re.search(SAID, said)
        self.assertIsNotNone(found, said)
        return share(said), found.group(1)

    def test_of_viscous_control_is_the_default_and_no_higher_coefficient(self):
        before, advice = self.advised("drop.toml", control(("upper", "lower"), hourglass="viscous"))
        self.assertNotIn("raise", advice)
        part, kind = re.search(r'set parts\.(\w+)\.hourglass = "(\w+)"', advice).groups()
        self.assertIn(part, ("upper", "lower"))
        after, _ = run("drop.toml", control(("upper", "lower"), hourglass=kind))
        self.assertLess(share(after), 0.5 * before)

    def test_of_a_coefficient_of_ones_own_goes_with_it(self):
        _, advice = self.advised(
            "drop.toml", control(("upper", "lower"), hourglass="viscous", hourglass_coefficient=0.3)
        )
        self.assertIn("leave hourglass_coefficient out", advice)

    def test_of_stiff_control_is_a_lower_coefficient_or_a_finer_mesh(self):
        stiff = control(("beam",), hourglass="stiffness", hourglass_coefficient=0.25)
        before, advice = self.advised("beam.toml", stiff)
        self.assertIn("refine it there", advice)
        lower = float(re.search(r"lower parts\.beam\.hourglass_coefficient \(0\.25\) to (\S+)", advice).group(1))
        lowered, _ = run("beam.toml", control(("beam",), hourglass="stiffness", hourglass_coefficient=lower))
        self.assertLess(share(lowered), 0.5 * before)
        refined, _ = run("beam.toml", [*stiff, FINER])
        self.assertLess(share(refined), 0.5 * before)


if __name__ == "__main__":
    unittest.main()
