#!/usr/bin/python3
"""The rolling case at 300 km/h and under ten times the load, at the default settings: bounded, and the contact carries
the load.

A coarser mesh than the case's own. Prints every figure.
"""
import os
import re
import sys
import tempfile

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.environ["RAILWAVE_SOURCE_DIR"], "tests", "verify"))
from figures import conclude, program, show  # noqa: E402

COARSE = {
    "meshes.wheel.zone_size": 0.004,
    "meshes.rail.zone_size": 0.004,
    "meshes.wheel.zone_length": 0.12,
    "meshes.rail.zone_end": 0.1,
    "meshes.wheel.section_size": 0.012,
    "meshes.rail.section_size": 0.012,
    "meshes.wheel.core_size": 0.15,
    "meshes.rail.core_size": 0.05,
    "meshes.wheel.growth": 1.5,
    "meshes.rail.growth": 1.5,
}
GRAVITY, SPRUNG = 9.81, 106929.0


def run(what, end, options):
    with tempfile.TemporaryDirectory() as folder:
        results = os.path.join(folder, "rolling.h5")
        said = program(
            "run",
            {
                **COARSE,
                "settle.method": "automatic",
                "settle.tolerance": 1e-3,
                "settle.cache": "false",
                "time.end": end,
                "output.file": results,
                "output.history_interval": end / 200,
                "output.field_interval": end,
                **options,
            },
            capture_output=True,
            text=True,
        ).stdout
        with h5py.File(results, "r") as file:
            completed = int(file.attrs["completed"])
            steps = int(file.attrs["steps"])
            history = file["history"]
            vertical = (history["contact/tread/normal_force"][:] + history["contact/tread/tangential_force"][:])[:, 2]
            energy = {name: history["energy"][name][:] for name in history["energy"]}
    mass = float(
        re.search(r"wheel: .*?, ([0-9.]+) kg", program("check", COARSE, capture_output=True, text=True).stdout).group(1)
    )
    sprung = -options.get("connectors.primary_suspension.preload", [0, 0, -SPRUNG])[2]
    weight = mass * GRAVITY + sprung
    error = np.abs(energy["balance_error"]).max()
    elastic = (energy["internal"] + energy["contact"]).max()
    print(
        f"{what}: {steps} steps, mean vertical contact force {vertical.mean():.0f} N, from {vertical.min():.0f} to"
        f" {vertical.max():.0f}, load {weight:.0f} N"
    )
    for line in said.splitlines():
        if "warning" in line.lower():
            print("  " + line.strip())
    show(f"{what}: ended early", 1 - completed, 0)
    show(f"{what}: mean vertical contact force against the load", abs(vertical.mean() / weight - 1), 0.02)
    show(f"{what}: energy balance error, of the largest elastic energy", error / elastic, 0.01)


def main():
    run("300 km/h", 1.2e-3, {"initial_motion.roll.velocity": [300 / 3.6, 0, 0]})
    run(
        "10 times the load",
        1e-3,
        {
            "connectors.primary_suspension.preload": [0, 0, -10 * SPRUNG],
            "points.sprung_mass.mass": 10 * SPRUNG / GRAVITY,
        },
    )
    conclude()


main()
