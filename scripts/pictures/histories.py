"""Forces and energies against time."""

import matplotlib.pyplot as plt
import numpy as np

from . import style

LARGE = ("kinetic", "external_work")  # usually far above the others


def draw_forces(results):
    """Contact forces and traction coefficient of every contact. Returns a figure, or None without a contact."""
    time, _, contacts = results.history()
    if not contacts or len(time) == 0:
        return None
    figure, (forces, ratio) = plt.subplots(
        2, 1, figsize=(8, 6.5), sharex=True, constrained_layout=True, gridspec_kw={"height_ratios": [2, 1]}
    )
    figure.suptitle(f"{results.title}\nforces on the slave surfaces, global axes", fontsize=style.TITLE)
    for name, (normal, tangential) in contacts.items():
        prefix = f"{name}: " if len(contacts) > 1 else ""
        size = np.linalg.norm(normal, axis=1)
        forces.plot(1e3 * time, 1e-3 * size, label=prefix + "normal")
        forces.plot(1e3 * time, 1e-3 * tangential[:, 0], label=prefix + "longitudinal (creep)")
        forces.plot(1e3 * time, 1e-3 * tangential[:, 1], label=prefix + "lateral")
        touching = size > 0
        coefficient = np.full(len(time), np.nan)
        coefficient[touching] = np.linalg.norm(tangential[touching], axis=1) / size[touching]
        (line,) = ratio.plot(1e3 * time, coefficient, label=prefix + "tangential over normal")
        if name in results.contacts():
            friction = results.friction(name)
            ratio.axhline(
                friction, color=line.get_color(), linewidth=0.8, linestyle="--", label=f"{prefix}friction {friction:g}"
            )
    forces.axhline(0, color="black", linewidth=0.6)
    forces.set_ylabel("force, kN")
    ratio.set_ylabel("force over force")
    ratio.set_ylim(bottom=0)
    ratio.set_xlabel("time, ms")
    for axes in (forces, ratio):
        axes.legend(fontsize=style.SMALL)
        axes.grid(alpha=0.3)
    return figure


def draw_energies(results):
    """Every term of the energy account. Returns a figure, or None without a history."""
    time, energies, _ = results.history()
    if len(time) == 0:
        return None
    figure, (large, small, error) = plt.subplots(
        3, 1, figsize=(8, 9), sharex=True, constrained_layout=True, gridspec_kw={"height_ratios": [1, 1.6, 0.8]}
    )
    figure.suptitle(f"{results.title}\nenergies", fontsize=style.TITLE)
    for name in LARGE:
        if name in energies:
            large.plot(
                1e3 * time,
                energies[name] - energies[name][0],
                label=f"{name.replace('_', ' ')}, since the start ({energies[name][0]:.5g} J)",
            )
    for name, values in energies.items():
        if name not in LARGE and name != "balance_error" and np.any(values != 0):
            small.plot(1e3 * time, values, label=name)
    if "balance_error" in energies:
        error.plot(1e3 * time, energies["balance_error"], color="black", label="balance error")
    for axes in (large, small, error):
        axes.set_ylabel("energy, J")
        axes.grid(alpha=0.3)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=style.SMALL)
    error.set_xlabel("time, ms")
    return figure
