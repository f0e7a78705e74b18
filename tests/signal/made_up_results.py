"""A results file with histories made up here, and the program that looks at them."""

import os
import subprocess

import h5py
import numpy as np

SOURCE_DIR = os.environ.get("RAILWAVE_SOURCE_DIR", os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
PROGRAM = os.path.join(os.environ.get("RAILWAVE_BIN_DIR", ""), "railwave")
INTERVAL, SPEED, TONE = 1e-6, 3000.0, 40e3


def burst(t, x):
    """Of 40 kHz, when it comes past the place x at 3 km/s; upright and along, backwards at the top."""
    since = t - 1.5e-4 - x / SPEED
    size = np.exp(-((since / 4e-5) ** 2))
    return size * np.cos(2 * np.pi * TONE * since), 2 / 3 * size * np.cos(2 * np.pi * TONE * since + np.pi / 2)


def write_results(path, sets, count=16):
    """Sets rail.p_1 and so on, 5 mm apart; `sets` adds others: name to velocity along z."""
    length = len(next(iter(sets.values()))) if sets else 400
    t = INTERVAL * np.arange(length)
    with h5py.File(path, "w") as file:
        file.attrs.update(
            {
                "format": "Railwave results",
                "format_version": 1,
                "title": "made up",
                "program": "railwave 0",
                "completed": 1,
                "reason": "completed",
            }
        )
        file["history/time"] = t
        for name in ("energy", "contact"):
            file.create_group(f"history/{name}")
        for p in range(1, count + 1):
            up, along = burst(t, 0.005 * p)
            velocity = np.stack([along, 0 * up, up], axis=1)
            group = file.create_group(f"history/set/rail.p_{p}")
            group["position"] = [0.005 * p, 0.0, 0.0]
            for quantity in ("displacement", "velocity", "acceleration"):
                group[quantity] = velocity
        for name, values in sets.items():
            group = file.create_group(f"history/set/{name}")
            group["velocity"] = np.stack([0 * t, 0 * t, values], axis=1)


def signal(kind, results, *options):
    result = subprocess.run([PROGRAM, "signal", kind, results, *options], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    return result.stdout
