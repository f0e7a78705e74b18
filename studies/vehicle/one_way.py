"""The wheelset alone over the weld, by forces of the primary suspension that another program has written as curves."""

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


def recorded(steps):
    """What makes loads of the case follow the CSV curves of the coupled run."""
    settings = []
    for axis in ("x", "z"):
        curve = f"recorded_{axis}"
        settings += [f"curves.{curve}.type=table", f"curves.{curve}.file={steps.path('curves')}/suspension_{axis}.csv",
                     f"loads.suspension_{axis}.curve={curve}"]
    return settings


def simulate(steps, end):
    """The runs by name. Samples as often as the coupled run has, so that steps are the same."""
    settings = [f"output.history_interval={coupled.WINDOW}"]
    if end is not None:
        settings.append(f"time.end={end}")
    forces = {"recorded": recorded(steps), "constant": []}
    return {name: Run(steps.run(f"one_way_{name}", coupled.CASE, settings + forces[name])) for name in WAYS}


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
