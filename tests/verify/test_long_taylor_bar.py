"""Taylor's bar (cases/verify/taylor_bar.toml): final length and radius of the foot against published figures, within
2 %.

The benchmark is known as that of Kamoulakos (1990). Reprinted for it are final lengths of 21.42 to 21.47 mm and foot
radii of 7.02 to 7.21 mm, Hallquist's DYNA and NIKE among them (DYNA3D: 21.47 mm, 7.03 mm). Prints every figure.

RAILWAVE_OPTIONS   further --set options, divided by blanks, such as parts.bar.linear_bulk_viscosity=0.06
"""
import os
import sys
import subprocess
import tempfile

import h5py
import numpy as np

import figures

LENGTH = (21.42, 21.47)  # mm
RADIUS = (7.02, 7.21)


def outside(value, published):
    """How far a value lies outside what was published, as a share."""
    low, high = published
    return max(low - value, value - high, 0) / (low if value < low else high)


def main():
    case = os.path.join(figures.SOURCE, "cases", "verify", "taylor_bar.toml")
    with tempfile.TemporaryDirectory() as folder:
        results = os.path.join(folder, "taylor_bar.h5")
        options = [f"output.file={results}", *os.environ.get("RAILWAVE_OPTIONS", "").split()]
        done = subprocess.run(
            [figures.PROGRAM, "run", case, *(word for option in options for word in ("--set", option))],
            capture_output=True, text=True, check=False,
        )
        if done.returncode != 0:
            sys.exit(done.stdout[-3000:] + done.stderr[-3000:])
        print("\n".join(done.stdout.splitlines()[-25:]))
        with h5py.File(results, "r") as file:
            assert file.attrs["completed"] == 1, file.attrs["reason"]
            bar = file["fields/bar"]
            before = bar["coordinates"][:] * 1e3
            now = before + bar["displacement"][-1] * 1e3
            plastic = bar["plastic_strain"][-1]
            energy = {name: file["history/energy"][name][:] for name in file["history/energy"]}
    foot = before[:, 2] < 1e-6
    length = now[:, 2].max() - now[foot, 2].min()
    radius = np.hypot(now[foot, 0], now[foot, 1]).max()
    print(f"final length        {length:8.3f} mm   published {LENGTH[0]} to {LENGTH[1]} mm")
    print(f"radius of the foot  {radius:8.3f} mm   published {RADIUS[0]} to {RADIUS[1]} mm")
    print(f"largest equivalent plastic strain {plastic.max():.2f}")
    start = energy["kinetic"][0]
    for name in ("kinetic", "internal", "plastic", "hourglass", "damping", "contact"):
        print(f"energy at the end: {name:10s} {np.ravel(energy[name])[-1] / start:8.4f} of the impact's")
    figures.show("final length outside what was published", outside(length, LENGTH), 0.02)
    figures.show("radius of the foot outside what was published", outside(radius, RADIUS), 0.02)
    figures.show("energy balance error, of the impact's energy", np.abs(energy["balance_error"]).max() / start, 0.02)
    figures.conclude()


main()
