"""The rolling case for 100 000 steps of the global estimate: what it gains over the element estimate, and no
instability.

The wheel rolls so slowly that it stays in its zone for all the steps. Prints every figure.

RAILWAVE_STEPS      steps to make, about (100000)
RAILWAVE_ZONE_SIZE  m, element size of both zones (the case's own); 0.004 is quick
"""
import os
import re
import tempfile
import time
import tomllib

import h5py
import numpy as np

from figures import CASE, conclude, program, show

STEPS = int(os.environ.get("RAILWAVE_STEPS", "100000"))
DISTANCE = 0.12  # m, of the zone's 0.155 m that lie ahead of the start


def main():
    with open(CASE, "rb") as file:
        case = tomllib.load(file)
    options = {"solver.step_estimate": "global"}
    if "RAILWAVE_ZONE_SIZE" in os.environ:
        options.update({f"meshes.{part}.zone_size": os.environ["RAILWAVE_ZONE_SIZE"] for part in ("wheel", "rail")})
    said = program("check", options, capture_output=True, text=True).stdout
    by_elements = float(re.search(r"element heights: ([0-9.e+-]+) s", said).group(1))
    stable = float(re.search(r"highest frequency: ([0-9.e+-]+) s", said).group(1))
    mass = float(re.search(r"wheel: .*?, ([0-9.]+) kg", said).group(1))
    weight = mass * -case["gravity"]["acceleration"][2] - case["connectors"]["primary_suspension"]["preload"][2]
    print(
        f"stable step by element heights {by_elements:.4g} s, by the global estimate {stable:.4g} s: gain"
        f" {stable / by_elements:.3f}"
    )

    end = STEPS * case["time"].get("step_scale", 0.9) * stable
    speed = min(DISTANCE / end, case["initial_motion"]["roll"]["velocity"][0])
    with tempfile.TemporaryDirectory() as folder:
        results = os.path.join(folder, "rolling.h5")
        options.update({"time.end": end, "output.file": results, "output.history_interval": end / 1000,
                        "output.field_interval": end / 4,
                        "initial_motion.roll.velocity": [speed, 0, 0]})  # it rolls
        began = time.monotonic()
        program("run", options)
        print(f"the run took {time.monotonic() - began:.0f} s")
        with h5py.File(results, "r") as file:
            assert file.attrs["completed"] == 1, file.attrs["reason"]
            steps = int(file.attrs["steps"])
            history = file["history"]
            normal = history["contact/tread/normal_force"][:]
            tangential = history["contact/tread/tangential_force"][:]
            energy = {name: history["energy"][name][:] for name in history["energy"]}
    vertical = (normal + tangential)[:, 2]
    print(
        f"{steps} steps; mean step over the element estimate's"
        f" {end / steps / (case['time'].get('step_scale', 0.9) * by_elements):.3f}"
    )
    show("steps short of those asked for, of them", 1 - steps / STEPS, 0.1)
    show("mean vertical contact force against total weight", abs(vertical.mean() / weight - 1), 0.01)
    last = vertical[len(vertical) // 2:]
    show("swing of the vertical contact force in the second half, of the weight", np.abs(last / weight - 1).max(), 0.1)
    error = np.abs(energy["balance_error"]).max()
    elastic = (energy["internal"] + energy["contact"]).max()
    show("energy balance error, of the largest elastic energy", error / elastic, 0.01)
    conclude()


main()
