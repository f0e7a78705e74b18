#!/usr/bin/env python3
"""Hammer tests on bodies whose accelerance is known: a block on a spring and a dashpot, and a free bar struck at its
end. From the case file to what `railwave frf` writes."""
import cmath
import math
import sys
import tempfile

import hammers

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

# A block of 0.4 m x 0.4 m x 0.02 m, 24.96 kg, as good as rigid: the waves across it need 4 us.
BLOCK = hammers.STEEL.format(poissons_ratio=0) + """
[meshes.block]
type = "box"
size = [0.4, 0.4, 0.02]
divisions = [4, 4, 1]
[parts.block]
mesh = "block"
material = "steel"
stiffness_damping = 2e-7
[constraints.guide]
target = "block.z_min"
fixed = ["x", "y"]
[constraints.guide_above]
target = "block.z_max"
fixed = ["x", "y"]
[connectors.spring]
from = "ground"
to = "block.z_min"
stiffness = [0, 0, 2.5e8]
damping = [0, 0, 4e3]
[hammers.blow]
part = "block"
surface = "z_max"
position = [0.2, 0.2, 0.02]
radius = 1
direction = [0, 0, -1]
peak = 1000
duration = 2e-4
[solver]
step_estimate = "global"
renew_steps = 0
[time]
end = 0.12
[output]
history_interval = 5e-6
"""

# A bar of 1 m, with damping of 0.8 % of critical at its first frequency, 2594 Hz.
BAR = hammers.STEEL.format(poissons_ratio=0) + """
[meshes.bar]
type = "box"
size = [1, 0.02, 0.02]
divisions = [50, 1, 1]
[parts.bar]
mesh = "bar"
material = "steel"
stiffness_damping = 1e-6
[hammers.blow]
part = "bar"
surface = "x_min"
position = [0, 0.01, 0.01]
radius = 1
direction = [1, 0, 0]
peak = 1000
duration = 1e-4
[probes.far]
part = "bar"
surface = "x_max"
position = [1, 0.01, 0.01]
radius = 0.02
[time]
end = 0.06
[solver]
step_estimate = "eigenvalue"
[output]
history_interval = 4e-6
"""


def check_block(folder):
    mass, stiffness, dashpot = 24.96, 2.5e8, 4e3
    found, printed = hammers.responses([hammers.run(folder, "block", BLOCK)], "--to", "1500")
    assert "coherence is 1 by definition" in printed, printed
    lines = found["block.blow"]
    amplitude = phase = 0.0
    for frequency, value in lines:
        if frequency < 50:
            continue
        w = 2 * math.pi * frequency
        exact = -w * w / complex(stiffness - mass * w * w, dashpot * w)
        amplitude = max(amplitude, abs(abs(value) / abs(exact) - 1))
        phase = max(phase, abs(cmath.phase(value / exact)))
    hammers.show("block on a spring, 50 to 1500 Hz: amplitude against the exact accelerance", amplitude, 0.01)
    hammers.show("the same: phase, rad", phase, 0.01)
    (frequency, damping), = hammers.peaks(printed)
    exact_damping = dashpot / (2 * math.sqrt(stiffness * mass))
    hammers.show("resonance of the block", abs(frequency / (math.sqrt(stiffness / mass) / (2 * math.pi)) - 1), 0.005)
    hammers.show("damping of the block by half power", abs(damping / exact_damping - 1), 0.03)


def check_bar(folder):
    modulus, area, density, beta = 210e9, 4e-4, 7800, 1e-6
    found, printed = hammers.responses(
        [hammers.run(folder, "bar", BAR)], "--to", "9000", "--response", "blow", "--response", "far"
    )
    speed = math.sqrt(modulus / density)
    reported = hammers.peaks(printed)
    assert len(reported) == 6, printed
    for mode in (1, 2, 3):
        for frequency, damping in (reported[mode - 1], reported[mode + 2]):
            hammers.show(
                f"free bar, resonance {mode} at {mode * speed / 2:.0f} Hz",
                abs(frequency / (mode * speed / 2) - 1),
                0.002,
            )
            hammers.show("its damping", abs(damping / (0.5 * beta * math.pi * mode * speed) - 1), 0.05)
    for name, wave in (
        ("bar.blow", lambda kl: cmath.cos(kl) / cmath.sin(kl)),
        ("bar.far", lambda kl: 1 / cmath.sin(kl)),
    ):
        worst = 0.0
        for frequency, value in found[name]:
            if not 100 <= frequency <= 8500:
                continue
            w = 2 * math.pi * frequency
            complex_modulus = modulus * (1 + 1j * w * beta)
            k = w / cmath.sqrt(complex_modulus / density)
            exact = w * w / (complex_modulus * area * k) * wave(k)
            worst = max(worst, abs(value - exact) / max(abs(exact), 0.1 / (density * area)))
        hammers.show(f"{name}: accelerance, 100 to 8500 Hz, against cot(kL) and 1/sin(kL)", worst, 0.05)


LOADS = hammers.STEEL.format(poissons_ratio=0.3) + """
[meshes.block]
type = "box"
size = [0.4, 0.2, 0.1]
divisions = [4, 2, 2]
[parts.block]
mesh = "block"
material = "steel"
[constraints.floor]
target = "block.z_min"
fixed = ["x", "y", "z"]
[curves.blow]
type = "half_sine"
start = 2e-5
duration = 2e-4
[loads.push]
type = "pressure"
target = "block.z_max"
pressure = 1e5
curve = "blow"
[loads.drag]
type = "traction"
target = "block.z_max"
traction = [2e4, 0, -1e4]
[loads.twist]
type = "torque"
target = "block.z_max"
moment = 50
axis = [0, 0, 2]
curve = "blow"
[loads.pull]
type = "nodal_force"
target = "block.x_max"
force = [30, 0, 40]
curve = "blow"
[time]
end = 3e-4
"""


def check_loads(folder):
    with h5py.File(hammers.run(folder, "loads", LOADS), "r") as file:
        loads, time = file["history/load"], file["history/time"][:]
        blow = np.where((time > 2e-5) & (time < 2.2e-4), np.sin(np.pi * (time - 2e-5) / 2e-4), 0)[:, None]
        for name, exact in (("push", [0, 0, -8000]), ("pull", [30, 0, 40])):
            off = np.abs(loads[name]["force"][:] - blow * exact).max() / np.abs(exact).max()
            hammers.show(f"force of the load {name} in the results, of its peak", off, 1e-3)
        hammers.show("the same of a traction", np.abs(loads["drag/force"][:] - [1600, 0, -800]).max() / 1600, 1e-9)
        hammers.show("moment of a torque", np.abs(loads["twist/moment"][:] - 50 * blow[:, 0]).max() / 50, 1e-9)
        hammers.show("direction of the pull", np.abs(loads["pull/direction"][:] - [0.6, 0, 0.8]).max(), 1e-12)
        hammers.show("direction of the torque's axis", np.abs(loads["twist/direction"][:] - [0, 0, 1]).max(), 1e-12)
        if "direction" in loads["push"]:
            hammers.failures.append("a pressure has no direction, as it follows the surface")


with tempfile.TemporaryDirectory(prefix="railwave-") as place:
    check_loads(place)
    check_block(place)
    check_bar(place)
hammers.conclude()
