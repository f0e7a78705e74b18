"""The rolling case as a user runs it, held against what statics and friction demand.

Prints every figure. Set RAILWAVE_RESULTS to a results file of cases/rolling.toml to skip the run.
"""
import os
import re
import tempfile
import time
import tomllib

import h5py
import numpy as np

from figures import CASE, conclude, program, show



def wheel_weight(case):
    """N: the wheel's own weight and what the suspension presses on it."""
    said = program("check", capture_output=True, text=True).stdout
    mass = float(re.search(r"wheel: .*?, ([0-9.]+) kg", said).group(1))
    return mass * -case["gravity"]["acceleration"][2] - case["connectors"]["primary_suspension"]["preload"][2]


def check(results, case):
    weight = wheel_weight(case)
    with h5py.File(results, "r") as file:
        assert file.attrs["completed"] == 1, file.attrs["reason"]
        history = file["history"]
        moment = history["time"][:]
        contact = history["contact/tread"]
        normal, tangential = contact["normal_force"][:], contact["tangential_force"][:]
        on_wheel, on_rail = normal + tangential, contact["master_force"][:]

        show("settled: vertical contact force against total weight", abs(on_wheel[0, 2] / weight - 1), 0.01)
        show("rolling: mean vertical contact force against total weight", abs(on_wheel[:, 2].mean() / weight - 1), 0.01)
        size = np.abs(on_wheel).max()
        show(
            "forces on wheel and rail: largest sum, of the largest force",
            np.abs(on_wheel + on_rail).max() / size,
            1e-14,
        )

        # Torque is full after the ramp; the wheel's spin and the contact swing in after it. The last millisecond
        # counts.
        drive = case["loads"]["drive"]
        radius = case["meshes"]["wheel"].get("radius", 0.46)
        settled = moment > moment[-1] - 1e-3
        creep = on_wheel[settled, 0].mean()
        print(f"mean creep force {creep:.0f} N, torque over radius {drive['moment'] / radius:.0f} N")
        show("creep force against torque over radius", abs(creep * radius / drive["moment"] - 1), 0.03)

        patch = file["contact/tread"]
        friction = case["contacts"]["tread"]["friction"]
        pressed = np.linalg.norm(patch["slave/normal_force"][:], axis=-1)
        rubbed = np.linalg.norm(patch["slave/tangential_force"][:], axis=-1)
        touching = pressed > 0
        show("largest tangential over mu times normal force of a node, minus 1",
             (rubbed[touching] / (friction * pressed[touching])).max() - 1, 1e-12)

        energy = {name: history["energy"][name][:] for name in history["energy"]}
        error = np.abs(energy.pop("balance_error")).max()
        largest = max(np.abs(values).max() for values in energy.values())
        elastic = (energy["internal"] + energy["contact"]).max()
        show("energy balance error, of the largest energy", error / largest, 0.01)
        show("energy balance error, of the largest elastic energy", error / elastic, 0.01)


def main():
    with open(CASE, "rb") as file:
        case = tomllib.load(file)
    results = os.environ.get("RAILWAVE_RESULTS")
    if results:
        check(results, case)
    else:
        with tempfile.TemporaryDirectory() as folder:
            results = os.path.join(folder, "rolling.h5")
            began = time.monotonic()
            program("run", {"output.file": results})
            print(f"the run took {time.monotonic() - began:.0f} s")
            check(results, case)
    conclude()


main()
