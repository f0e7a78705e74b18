"""The wheelset alone over the weld, by forces of the primary suspension that another program has written as curves."""

import re

import h5py
import numpy as np

import coupled

WAYS = {"recorded": "forces of the coupled run", "constant": "the static force"}


class Run:
    """Histories of a run without a bogie."""

    def __init__(self, results):
        with h5py.File(results, "r") as file:
            history = file["history"]
            self.time = history["time"][:]
            self.normal = history["contact/tread/normal_force"][:, 2]
            self.displacement = history["set/wheelset.journal/displacement"][:]


def recorded_case(steps):
    """The case with the CSV curves of the coupled run in place of its own."""
    text = coupled.CASE.read_text(encoding="utf-8")
    for axis in ("x", "z"):
        curve = f"suspension_{axis}"
        own = rf'(\[curves\.{curve}\]\ntype = "table"\n)points = .*'
        text, count = re.subn(own, rf'\1file = "curves/{curve}.csv"', text)
        assert count == 1
    weld = coupled.HERE / "dipped_weld.csv"
    return steps.write_case("one_way_recorded", text.replace('"dipped_weld.csv"', f'"{weld}"'))


def simulate(steps, end):
    """The runs by name. Samples as often as the coupled run has, so that steps are the same."""
    settings = [f"output.history_interval={coupled.WINDOW}"]
    if end is not None:
        settings.append(f"time.end={end}")
    cases = {"recorded": recorded_case(steps), "constant": coupled.CASE}
    return {name: Run(steps.run(f"one_way_{name}", cases[name], settings)) for name in WAYS}


def differences(table, run):
    """The largest of contact force, N, and of the journal's height, m, beside the coupled run."""
    normal = np.interp(table["time_s"], run.time, run.normal) - table["contact.tread.normal_force.z"]
    height = np.interp(table["time_s"], run.time, run.displacement[:, 2]) - table["displacement_z_m"]
    return np.abs(normal).max(), np.abs(height).max()


def rows(table, runs):
    found = []
    for name, what in WAYS.items():
        normal, height = differences(table, runs[name])
        found.append((f"one-way, {what}: contact force, height of the journal beside the coupled run, at most",
                      f"{normal:.3g} N, {1e6 * height:.3g} um", ""))
    return found
