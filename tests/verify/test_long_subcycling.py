"""The rolling case with and without subcycling: the same contact force, and the balance of energy that remains.

Prints every figure.

RAILWAVE_ZONE_SIZE  m, element size of both zones (0.004)
RAILWAVE_END        s of rolling (5e-4)
"""
import os
import re
import tempfile

import h5py
import numpy as np

from figures import conclude, program, show

ZONE_SIZE = os.environ.get("RAILWAVE_ZONE_SIZE", "0.004")
END = os.environ.get("RAILWAVE_END", "5e-4")


def roll(folder, subcycling, hourglass):
    results = os.path.join(folder, "rolling.h5")
    options = {"solver.subcycling": str(subcycling).lower(), "time.end": END, "output.file": results,
               "output.history_interval": "1e-6", "settle.tolerance": "2.5e-3"}
    for part in ("wheel", "rail"):
        options[f"meshes.{part}.zone_size"] = ZONE_SIZE
        options[f"parts.{part}.hourglass"] = hourglass
    said = program("run", options, capture_output=True, text=True).stdout
    print("\n".join(line for line in said.splitlines() if re.search("settled after|subcycling:|wall time", line)))
    with h5py.File(results, "r") as file:
        assert file.attrs["completed"] == 1, file.attrs["reason"]
        history = file["history"]
        force = history["contact/tread/normal_force"][:] + history["contact/tread/tangential_force"][:]
        energy = {name: history["energy"][name][:] for name in history["energy"]}
        return history["time"][:], force[:, 2], energy


def main():
    for hourglass in ("viscous", "stiffness"):
        print(f"{hourglass} hourglass control")
        with tempfile.TemporaryDirectory() as folder:
            time, plain, energy = roll(folder, False, hourglass)
            own_time, subcycled, own_energy = roll(folder, True, hourglass)
        difference = subcycled - np.interp(own_time, time, plain)
        show("mean vertical contact force against that without", abs(difference.mean()) / plain.mean(), 5e-3)
        show("vertical contact force at any instant", np.abs(difference).max() / plain.mean(), 5e-3)
        for name, account in (("without", energy), ("with", own_energy)):
            elastic = (account["internal"] + account["contact"]).max()
            show(f"energy balance error {name}, of the largest elastic energy",
                 np.abs(account["balance_error"]).max() / elastic, 5e-3 if hourglass == "viscous" else 5e-4)
    conclude()


main()
