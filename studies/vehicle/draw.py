"""Pictures of the coupled runs."""

import matplotlib.pyplot as plt
import numpy as np

import one_way as ways
import two_masses as masses
from pictures import style

PLACE = 27.78  # m/s: how fast the wheel goes along
WELD = (60, 180)  # mm


def two_masses(found):
    """Distance of both masses beside the exact one, and what is left."""
    compared, _ = found
    figure, grid = plt.subplots(3, 2, figsize=(10, 6.4), sharex=True, constrained_layout=True)
    for name, one, (axes, rest) in zip(masses.AXES, compared, grid):
        exact = one.exact.distance(one.time)
        axes.plot(1e3 * one.time, 1e3 * exact, color=style.MARKED, linewidth=2.4, alpha=0.4, label="exact")
        axes.plot(1e3 * one.time, 1e3 * one.distance, color=style.CURVE, linewidth=0.9, label="coupled")
        rest.plot(1e3 * one.time, 1e9 * (one.distance - exact), color=style.CURVE, linewidth=0.9)
        axes.set_ylabel(f"distance along {name}, mm")
        rest.set_ylabel("coupled less exact, nm")
        for each in (axes, rest):
            each.grid(alpha=0.3)
    grid[0, 0].legend(fontsize=style.TINY, loc="upper right")
    for axes in grid[-1]:
        axes.set_xlabel("time, ms")
    return figure


def _over_place(axes, label):
    axes.axvspan(*WELD, color="0.9", zorder=0)
    axes.set_ylabel(label)
    axes.grid(alpha=0.3)


def weld(table):
    """Contact force, primary suspension, frame, energy over the interface: over the wheel's place."""
    figure, grid = plt.subplots(3, 2, figsize=(10, 7.2), sharex=True, constrained_layout=True)
    place = 1e3 * PLACE * table["time_s"]
    panels = (
        ("contact force, kN", 1e-3 * table["contact.tread.normal_force.z"]),
        ("suspension on the wheelset,\nvertical, less static, N", table["force_z_N"] - table["force_z_N"][0]),
        ("suspension on the wheelset,\nalong the rail, N", table["force_x_N"]),
        ("journal, vertical, mm", 1e3 * (table["displacement_z_m"] - table["displacement_z_m"][0])),
        ("frame, vertical, um", 1e6 * table["frame_z_m"]),
        ("work of the wheelset on the bogie, J", table["bogie_work_J"]),
    )
    for axes, (label, values) in zip(grid.flat, panels):
        axes.plot(place, values, color=style.CURVE, linewidth=0.9)
        _over_place(axes, label)
    grid.flat[5].plot(place, -table["wheelset_work_J"], color=style.MARKED, linestyle=":", linewidth=1.6,
                      label="by Railwave's account")
    grid.flat[5].legend(fontsize=style.TINY)
    for axes in grid[-1]:
        axes.set_xlabel("place of the wheel, mm; grey: the weld")
    return figure


def one_way(table, runs):
    """Contact force of the coupled run and of those by curves, and by how much these are off."""
    figure, (force, rest) = plt.subplots(2, 1, figsize=(8, 5.6), sharex=True, constrained_layout=True)
    place = 1e3 * PLACE * table["time_s"]
    normal = table["contact.tread.normal_force.z"]
    force.plot(place, 1e-3 * normal, color="0.6", linewidth=2.4, label="coupled")
    for colour, (name, what) in zip((style.CURVE, style.MARKED), ways.WAYS.items()):
        other = np.interp(table["time_s"], runs[name].time, runs[name].normal)
        force.plot(place, 1e-3 * other, color=colour, linewidth=0.8, label=f"one-way, {what}")
        rest.plot(place, other - normal, color=colour, linewidth=0.8, label=what)
    _over_place(force, "contact force, kN")
    _over_place(rest, "one-way less coupled, N")
    force.legend(fontsize=style.TINY)
    rest.set_xlabel("place of the wheel, mm; grey: the weld")
    return figure
