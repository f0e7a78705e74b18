"""Pictures of the transition from one to two contact points (thesis figs 6.2 to 6.12)."""

import matplotlib.pyplot as plt
import numpy as np

from angles import ANGLES, STEEP
from pictures import style
from pictures.contact_solution import ContactSolution
from pictures.patch import draw_row

SIDES = (("patch 1, tread", "tread"), ("patch 2, flange", "flange"))
COLOURS = {15: "#1b7837", 20: "#10407f", 25: "#b3261e"}


def forces(found):
    """Normal, lateral and longitudinal force of both patches over the wheel's place (fig. 6.3)."""
    figure, grid = plt.subplots(3, 2, figsize=(10, 8), sharex=True, constrained_layout=True)
    for column, (title, side) in enumerate(SIDES):
        for row, quantity in enumerate(("normal", "lateral", "longitudinal")):
            axes = grid[row, column]
            for angle, one in sorted(found.items()):
                # The first output is that at the beginning, long before the others.
                values = np.nan_to_num(getattr(getattr(one, side), quantity))[1:]
                axes.plot(one.place[1:], values, color=COLOURS[angle], linewidth=0.9, label=f"{angle} mrad")
                axes.axvline(ANGLES[angle], color=COLOURS[angle], linestyle=":", linewidth=0.7)
            axes.set_ylabel(f"{quantity} force, kN")
            axes.grid(alpha=0.3)
        grid[0, column].set_title(f"{title}; dotted: the thesis's second contact", fontsize=style.TEXT)
        grid[-1, column].set_xlabel("place of the wheel, m")
    grid[0, 0].legend(fontsize=style.TINY)
    return figure


def shear(found):
    """Mean shear of both patches and its direction at the thesis's nine frames (fig. 6.6)."""
    figure, grid = plt.subplots(3, 1, figsize=(7, 8), sharex=True, constrained_layout=True)
    for angle, one in sorted(found.items()):
        frames = one.frames()
        numbers = np.arange(1, len(frames) + 1) + 9 - len(frames) if one.first is not None else []
        for side, mark in ((one.tread, "o-"), (one.flange, "s--")):
            along, across = (values[frames] for values in side.mean_shear())
            for axes, values in zip(grid, (across, along, side.theta[frames])):
                axes.plot(numbers, np.abs(values), mark, color=COLOURS[angle], markersize=4, linewidth=0.9,
                          label=f"{angle} mrad, patch {1 if side is one.tread else 2}")
    for axes, label in zip(grid, ("lateral shear, mean, MPa", "longitudinal, MPa", "theta, deg")):
        axes.set_ylabel(label)
        axes.grid(alpha=0.3)
    grid[-1].set_xlabel("frame, 6.7 mm apart; the flange touches at 6")
    grid[0].legend(fontsize=style.TINY, ncols=3)
    return figure


def _sides(contact, k):
    """The largest patch of the tread and that of the flange at an output; None where it has none."""
    own = {True: None, False: None}
    for patch in contact.patches(k):
        steep = np.arctan2(np.hypot(patch.row["normal_x"], patch.row["normal_y"]), abs(patch.row["normal_z"])) > STEEP
        if own[bool(steep)] is None and not patch.small:
            own[bool(steep)] = patch
    return own[False], own[True]


def frames(found):
    """(name, figure) of pressure, shear, adhesion and slip, relative velocities at the nine frames (figs 6.4, 6.5, 6.8
    to 6.12): of each angle and patch."""
    for angle, one in sorted(found.items()):
        contact = ContactSolution(one.solution).contacts()[0]
        pairs = [_sides(contact, k) for k in one.frames()]
        for number, title in ((0, "patch 1"), (1, "patch 2")):
            patches = [pair[number] for pair in pairs if pair[number] is not None]
            if patches:
                yield (f"frames_{angle}_patch_{number + 1}",
                       draw_row(f"{angle} mrad, {title}", contact, patches=patches))


def footprints(found):
    """Which nodes of the wheel touch at the frames, from above and from the gauge side (fig. 6.2)."""
    figure, grid = plt.subplots(2, len(found), figsize=(4.2 * len(found) + 0.6, 6), squeeze=False,
                                constrained_layout=True)
    for (above, beside), (angle, one) in zip(grid.T, sorted(found.items())):
        for k in one.frames():
            x, y, z = 1e3 * one.touching(k).T
            colour = style.BOUND if k >= one.first else style.SHEAR
            for axes, other in ((above, y), (beside, z)):
                axes.plot(x + 1e3 * one.left_out, other, ".", markersize=2, color=colour)
        above.set_title(f"{angle} mrad; red: two patches", fontsize=style.TEXT)
        beside.set_xlabel("x, mm")
        for axes in (above, beside):
            axes.grid(alpha=0.3)
    grid[0, 0].set_ylabel("from above: y, mm (inwards is down)")
    grid[1, 0].set_ylabel("from the gauge side: z, mm")
    return figure
