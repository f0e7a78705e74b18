#!/usr/bin/env python3
"""Ranks of a scene that rank 0 does not need as a whole make and keep the arrays of their own blocks alone: results are
those of one process bit for bit whatever is written of them, and memory falls with the number of ranks."""

import re
import shutil
import subprocess
import unittest

from test_ranks import PROGRAM, Ranks

BAR = """title = "a bar"
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
{material}
[meshes.bar]
type = "box"
size = [{length}, 0.01, 0.01]
divisions = [{along}, {across}, {across}]
[parts.bar]
mesh = "bar"
material = "steel"
{part}
[loads.hit]
type = "pressure"
target = "bar.x_min"
pressure = {pressure}
[solver]
step_estimate = "element"
{solver}
[time]
end = {end}
[output]
file = "results.h5"
history_interval = 2e-7
field_interval = 1e-6
field_sets = {sets}
fields = {fields}
{output}
{more}
"""
MIDDLE = """[element_sets.middle]
part = "bar"
box = [[-1, -1, -1], [1, 1, 0.001]]
[node_sets.along]
part = "bar"
box = [[-1, -1, -1], [1, 1, 0]]"""
MOTIONS = '["displacement", "velocity", "acceleration"]'
ALL = '["displacement", "velocity", "acceleration", "stress", "mises"]'


def bar(along=40, across=10, **given):
    values = {"material": "", "part": "", "pressure": 1e8, "solver": "", "end": 4e-6, "sets": '["bar"]',
              "fields": '["displacement"]', "output": "", "more": ""}
    values.update(given)
    return BAR.format(along=along, across=across, length=along * 0.01 / across, **values)


KINDS = {
    "places_of_a_side": {"sets": '["bar.x_min", "bar.x_max"]'},
    "places_of_all": {},
    "motions": {"fields": MOTIONS},
    "stresses": {"fields": ALL},
    "stresses_of_mixed_precision": {"fields": ALL, "solver": 'precision = "mixed"'},
    "plasticity": {"fields": ALL, "material": "yield_stress = 50e6\ntangent_modulus = 1e9"},
    "damping": {"part": "stiffness_damping = 1e-8\nmass_damping = 100", "fields": MOTIONS},
    "hourglass_stiffness": {"part": 'hourglass = "stiffness"'},
    "histories": {"output": 'history_sets = ["bar.x_max", "bar.middle", "bar.along"]', "more": MIDDLE},
    "constraints": {"more": '[constraints.held]\ntarget = "bar.x_max"\nfixed = ["x", "y", "z"]'},
    "ends": {"more": '[non_reflecting.far]\ntarget = "bar.x_max"'},
}


class SameResults(Ranks):
    """Made below: one test for each kind."""


def add(kind, options):
    def test(self):
        self.write(bar(**options))
        self.run_to_end(1)
        alone = self.kept("alone.h5")
        for ranks in (2, 3):
            self.run_to_end(ranks)
            self.assert_same(alone, self.kept(f"{ranks}.h5"))
    setattr(SameResults, f"test_{kind}", test)


for name, wanted in KINDS.items():
    add(name, wanted)


class Faults(Ranks):
    def test_what_a_fault_leaves(self):
        """Its file has stresses of whole blocks, whoever computed them."""
        self.write(bar(pressure=4e11, end=2e-5))
        kept = {}
        for ranks in (1, 3):
            self.run_to_end(ranks, code=3)
            kept[ranks] = self.kept(f"{ranks}.h5"), self.folder / f"{ranks}.fault.h5"
            shutil.move(self.folder / "results.fault.h5", kept[ranks][1])
        for one, other in zip(kept[1], kept[3]):
            self.assert_same(one, other)


class TakenUp(Ranks):
    def test_from_a_checkpoint_of_ranks(self):
        self.write(bar(fields=ALL))
        self.run_to_end(1)
        alone = self.kept("alone.h5")
        self.run_to_end(3, "--set", "time.end=2e-6", "--keep-state")
        for ranks in (2, 1):
            self.run_to_end(ranks, "--restart", "--keep-state", *([] if ranks == 1 else ["--set", "time.end=3e-6"]))
        self.assert_same(alone, self.results)


class Memory(Ranks):
    """Peaks beside what a tiny scene takes on as many processes. A rank that makes arrays of the whole scene takes as
    much as one process."""

    RANKS = 4
    LARGEST_SHARE = 0.45  # of one process's; 0.34 of a million elements, 0.38 of these

    def peaks(self, ranks, text):
        self.write(text)
        said = self.run_to_end(ranks, "--overwrite")
        line = re.search(r"memory taken at most(?:, by rank)?: (.*)", said)[1]
        unit = {"kB": 1e3, "MB": 1e6, "GB": 1e9}
        return [float(value) * unit[name] for value, name in (one.split() for one in line.split(", "))]

    def test_falls_with_the_number_of_ranks(self):
        tiny = bar(along=4, across=4, end=1e-8)
        large = bar(along=140, across=35, end=2e-8, sets='["bar.x_min"]')
        alone = self.peaks(1, large)[0] - self.peaks(1, tiny)[0]
        empty = self.peaks(self.RANKS, tiny)
        for peak, beside in zip(self.peaks(self.RANKS, large), empty):
            self.assertLess(peak - beside, self.LARGEST_SHARE * alone)

    def test_is_foreseen(self):
        self.write(bar(along=140, across=35, end=2e-8, sets='["bar.x_min"]'))
        run = self.run_command("check", "case.toml", "--ranks", str(self.RANKS))
        found = re.search(r"memory at most, about, by rank: (.*); one process alone: (.*)", run)
        foreseen = [float(one.split()[0]) for one in found[1].split(", ")]
        measured = [1e-6 * one for one in self.peaks(self.RANKS, (self.folder / "case.toml").read_text())]
        self.assertEqual(len(foreseen), self.RANKS)
        for one, other in zip(foreseen, measured):
            self.assertLess(abs(one / other - 1), 0.25)  # "about": processes differ by what MPI takes

    def run_command(self, *words):
        done = subprocess.run(
            [str(PROGRAM), *words], cwd=self.folder, capture_output=True, text=True, check=True
        )
        return done.stdout


if __name__ == "__main__":
    unittest.main(verbosity=2)
