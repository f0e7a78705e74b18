#!/usr/bin/env python3
"""scripts/calibrate's fit on a model in closed form: a rail mass on a fastening on a sleeper on ballast. Values far
away are found again."""
import importlib.machinery
import importlib.util
import os
import pathlib
import sys

try:
    import numpy as np
except ImportError:
    sys.exit(77)

SOURCE = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])


def script():
    sys.dont_write_bytecode = True
    loader = importlib.machinery.SourceFileLoader("calibrate", str(SOURCE / "scripts" / "calibrate"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def track(frequencies, values):
    """Level of the accelerance of a mass of 33 kg on one of 143 kg."""
    stiffness, dashpot, bed, bed_dashpot = values
    w = 2 * np.pi * frequencies
    fastening, ballast = stiffness + 1j * w * dashpot, bed + 1j * w * bed_dashpot
    sleeper = ballast - 143 * w**2
    support = fastening * sleeper / (fastening + sleeper)
    return 20 * np.log10(np.abs(-(w**2) / (support - 33 * w**2)))


calibrate = script()
frequencies = np.geomspace(50, 2000, 60)
exact = np.array([195e6, 67.5e3, 45e6, 32e3])
target = track(frequencies, exact)
failed = 0
for factors in ([1.4, 0.7, 0.8, 1.3], [0.5, 1.5, 2.0, 0.6], [2.5, 0.4, 0.5, 2.0]):
    found, misfits, runs = calibrate.fit(
        lambda values: track(frequencies, values), target, exact * factors, 60, report=lambda text: None
    )
    off = np.abs(found / exact - 1).max()
    good = off < 0.01 and misfits[-1] < 0.05 * misfits[0] and runs < 40
    failed += not good
    print(
        f"{'ok' if good else 'FAILED':8s}from {factors}: {100 * off:.3f} % off after {runs} runs, misfit"
        f" {misfits[0]:.2f} dB to {misfits[-1]:.4f} dB"
    )

choice = calibrate.parse(["target.csv", "--start", "vertical_stiffness=150e6"])
said = calibrate.overrides(choice, choice.values)
good = (
    "sleepers.concrete.fastening_stiffness=[100000000, 100000000, 150000000]" in said
    and "sleepers.concrete.ballast_damping=32000" in said
)
failed += not good
print(f"{'ok' if good else 'FAILED':8s}what a run is given: {said}")
sys.exit(1 if failed else 0)
