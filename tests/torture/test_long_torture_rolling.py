#!/usr/bin/python3
"""The rolling case at 300 km/h and under ten times the load, at the default settings: bounded, and the contact carries
the load.

A coarser mesh than the case's own. Prints every figure.
"""
import functools
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


@functools.cache
def rise_of_wheel():
    """How far the centre of mass of the wheel's mesh lies above its axis, m."""
    with tempfile.TemporaryDirectory() as folder:
        model = os.path.join(folder, "model.h5")
        program("mesh", COARSE, "--out", model, capture_output=True)
        with h5py.File(model, "r") as file:
            x, cells = file["parts/wheel/coordinates"][:], file["parts/wheel/connectivity"][:]
    sign = np.array(
        [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]]
    )
    volume, moment = 0, 0
    for point in sign / np.sqrt(3):
        shape = np.prod(1 + sign * point, axis=1) / 8
        slope = np.stack([sign[:, i] * np.prod(np.delete(1 + sign * point, i, 1), axis=1) / 8 for i in range(3)], 1)
        part = np.linalg.det(np.einsum("eni,nj->eij", x[cells], slope))
        volume, moment = volume + part.sum(), moment + (part * (x[cells][:, :, 2] @ shape)).sum()
    # The axis: the middle of the circle on which the bore's nodes lie.
    around, middle = x[:, [0, 2]], np.array([0, moment / volume])
    for _ in range(5):
        radius = np.hypot(*(around - middle).T)
        bore = around[radius < radius.min() + 0.002]
        middle = np.linalg.lstsq(np.c_[2 * bore, np.ones(len(bore))], (bore**2).sum(1), rcond=None)[0][:2]
    return moment / volume - middle[1]


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
    turning = options.get("initial_motion.roll.velocity", [27.78, 0, 0])[0] / (27.78 / 60.41)
    sprung = -options.get("connectors.primary_suspension.preload", [0, 0, -SPRUNG])[2]
    unbalance = mass * turning**2 * rise_of_wheel()
    weight = mass * GRAVITY + sprung - unbalance
    error = np.abs(energy["balance_error"]).max()
    elastic = (energy["internal"] + energy["contact"]).max()
    print(
        f"{what}: {steps} steps, mean vertical contact force {vertical.mean():.0f} N, from {vertical.min():.0f} to"
        f" {vertical.max():.0f}, load {weight:.0f} N ({unbalance:.0f} N taken off: the wheel's mesh is not quite"
        " balanced)"
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
