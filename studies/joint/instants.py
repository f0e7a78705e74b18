"""The contact at instants of its way over the joint: patches with pressure and shear (fig. 4.20), footprints (4.21),
shear along the rolling direction while the wheel lands (4.23), adhesion and slip (4.24)."""

import copy

import matplotlib.pyplot as plt
import numpy as np

from passing import INTERVAL, START
from pictures import style
from pictures.contact_solution import ContactSolution
from pictures.panels import Fine, draw_arrows, draw_edge, draw_pressure, pressure_levels
from pictures.patch import draw_row

TOUCH = 46.39e-3  # s, when the thesis's wheel touches the second rail: its instants are found again by that
PATCHES = TOUCH + 0.77e-3 * np.arange(-3, 5) + 0.1e-3  # eight; the fourth lies over the gap
FOOTPRINTS = 0.3e-3
LANDING = TOUCH + 0.1e-3 * np.arange(8)
ADHESION = 44.4e-3 + 0.3e-3 * np.arange(15)
MOST = 8  # instants side by side


def on_rail(patch):
    """The patch by places along the rail, mm from where the wheel began, and the shear on the rail, which is opposite
    to the wheel's."""
    moved, half = copy.copy(patch), patch.half_size()
    moved.half_size = lambda: half
    moved.x, moved.y = patch.x + patch.centre[0] + 1e3 * START, patch.y + patch.centre[1]
    moved.shear_x, moved.shear_y = -patch.shear_x, -patch.shear_y
    return moved


class Instants:
    """One simulation's contact solutions, by the thesis's clock; those of which the mesh shows the shape."""

    def __init__(self, passing):
        self.number = passing.number
        self.contact = ContactSolution(passing.solution).contacts()[0]
        self._later = passing.touch - TOUCH  # our clock's reading less the thesis's

    def index(self, time):
        return self.contact.nearest(time + self._later)

    def own(self, time):
        """s, our clock's reading at the solution nearest to a time of the thesis."""
        return self.contact.times[self.index(time)]

    def covers(self, time):
        times = self.contact.times
        return times[0] - INTERVAL <= time + self._later <= times[-1] + INTERVAL

    def at(self, time):
        return [on_rail(patch) for patch in self.contact.patches(self.index(time)) if not patch.small]

    def between_ends(self, interval):
        """Times of the thesis's clock, an interval apart, from the first of PATCHES to the last."""
        return [time for time in np.arange(PATCHES[0], PATCHES[-1], interval) if self.covers(time)]


def show_window(axes, patches):
    """All of the patches, whose edges lie between nodes, and the gap."""
    touching = np.vstack([np.column_stack([p.x, p.y])[p.touching] for p in patches])
    apart = np.linalg.norm(touching[:, None] - touching[None], axis=2)
    between = np.median(np.partition(apart, 1, axis=1)[:, 1]) if len(touching) > 1 else 1
    low, high = touching.min(axis=0) - 1.5 * between, touching.max(axis=0) + 1.5 * between
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_aspect("equal")
    show_gap(axes)
    axes.tick_params(labelsize=style.TINY)


def show_gap(axes):
    axes.axvspan(1e3 * START - 3, 1e3 * START + 3, color="0.85", linewidth=0, zorder=0)


def draw_patches(instants):
    """Pressure and shear on the rail, a row for each simulation, a column for each instant; None: there are none."""
    shown = {one: [(t, one.at(t)) for t in PATCHES if one.covers(t)] for one in instants}
    shown = {one: [(t, patches) for t, patches in row if patches] for one, row in shown.items()}
    everything = [patch for row in shown.values() for _, patches in row for patch in patches]
    if not everything:
        return None
    levels = pressure_levels(max(patch.pressure.max() for patch in everything))
    largest = max(np.hypot(patch.shear_x, patch.shear_y).max() for patch in everything)
    columns = max(len(row) for row in shown.values())
    figure, grid = plt.subplots(len(shown), columns, figsize=(2 * columns + 1, 2.6 * len(shown) + 0.5), squeeze=False,
                                constrained_layout=True)
    for axes in grid.flat:
        axes.set_visible(False)
    for row, (one, listed) in zip(grid, shown.items()):
        for axes, (time, patches) in zip(row, listed):
            axes.set_visible(True)
            for patch in patches:
                colours = draw_pressure(axes, Fine(patch), levels)
                draw_arrows(axes, patch, patch.shear_x, patch.shear_y, style.SHEAR, largest=largest)
            show_window(axes, patches)
            axes.set_title(f"{one.number}: {1e3 * one.own(time):.2f} ms", fontsize=style.SMALL)
        row[0].set_ylabel(f"simulation {one.number}\nlateral, mm")
    figure.colorbar(colours, ax=grid, label="pressure, MPa", shrink=0.8)
    figure.supxlabel("place along the rail, mm; arrows: shear on the rail", fontsize=style.TEXT)
    return figure


def draw_footprints(instants):
    """Outlines of the patches on their way, coloured by their largest pressure; None: there are none."""
    figure, panels = plt.subplots(len(instants), 1, figsize=(10, 2.2 * len(instants) + 0.6), squeeze=False,
                                  sharex=True, constrained_layout=True)
    prints = {one: [patch for t in one.between_ends(FOOTPRINTS) for patch in one.at(t)] for one in instants}
    peaks = [patch.pressure.max() for patches in prints.values() for patch in patches]
    if not peaks:
        plt.close(figure)
        return None
    colour = plt.cm.ScalarMappable(plt.Normalize(min(peaks), max(peaks)), style.PRESSURE_MAP)
    for axes, (one, patches) in zip(panels[:, 0], prints.items()):
        for patch in patches:
            fine = Fine(patch)
            axes.tricontourf(fine.mesh, fine.square_of_pressure, levels=[0, 1e30], alpha=0.6,
                             colors=[colour.to_rgba(patch.pressure.max())])
            draw_edge(axes, fine)
        show_window(axes, patches)
        axes.set_ylabel(f"simulation {one.number}\nlateral, mm")
    panels[-1, 0].set_xlabel("place along the rail, mm")
    figure.colorbar(colour, ax=panels, label="largest pressure, MPa", shrink=0.8)
    return figure


def draw_landing(one):
    """Shear along the rail while the wheel lands: with the rolling direction positive; None: there are none."""
    shown = [(t, one.at(t)) for t in LANDING if one.covers(t)]
    shown = [(t, patches) for t, patches in shown if patches]
    if not shown:
        return None
    largest = max(np.abs(patch.shear_x).max() for _, patches in shown for patch in patches)
    levels = np.linspace(-largest, largest, 21)
    rows = -(-len(shown) // 4)
    figure, grid = plt.subplots(rows, 4, figsize=(11, 3 * rows + 0.4), squeeze=False, constrained_layout=True)
    for axes in grid.flat[len(shown):]:
        axes.set_visible(False)
    for k, (axes, (time, patches)) in enumerate(zip(grid.flat, shown)):
        for patch in patches:
            fine = Fine(patch)
            colours = axes.tricontourf(*fine.inside(patch.shear_x), levels=levels, cmap=style.SIGNED_MAP)
            draw_edge(axes, fine)
            draw_arrows(axes, patch, patch.shear_x, patch.shear_y, "black", largest=largest)
        show_window(axes, patches)
        axes.set_title(f"T{k + 1}: {1e3 * one.own(time):.2f} ms", fontsize=style.SMALL)
    figure.colorbar(colours, ax=grid, label="shear on the rail along the rolling direction, MPa", shrink=0.8)
    figure.suptitle(f"simulation {one.number}", fontsize=style.TEXT)
    return figure


def draw_adhesion(one):
    """Shear and its bound along the centre line, adhesion and slip by both criteria; pictures of eight instants."""
    times = [t for t in ADHESION if one.covers(t)]
    pictures = [draw_row(f"simulation {one.number}", one.contact, indices=[one.index(t) for t in times[k:k + MOST]])
                for k in range(0, len(times), MOST)]
    return [picture for picture in pictures if picture]


def pictures(instants):
    """(name, figure) of all of them."""
    if not instants:
        return
    listed = [("patches", draw_patches(instants)), ("footprints", draw_footprints(instants))]
    for one in instants:
        listed.append((f"landing_{one.number}", draw_landing(one)))
        listed += [(f"adhesion_{one.number}_{k}", figure) for k, figure in enumerate(draw_adhesion(one), 1)]
    yield from ((name, figure) for name, figure in listed if figure)


def adhesion_rows(instants):
    """Rows of the study's table: least and most slip of the fifteen instants, by both criteria."""
    rows = []
    for one in instants:
        shares = []
        for k, time in enumerate(ADHESION):
            patches = one.at(time) if one.covers(time) else []
            count = sum(patch.touching.sum() for patch in patches)
            if count:
                by = [sum((patch.touching & getattr(patch, which)).sum() for patch in patches) / count
                      for which in ("slips", "slips_by_velocity")]
                shares.append((k + 1, *by))
        if not shares:
            continue
        behind = [share for share in shares if share[0] >= 8] or shares
        least, most = min(behind, key=lambda s: s[1]), max(behind, key=lambda s: s[1])
        rows += [
            (f"simulation {one.number}: least slip from t8 on, by force and by micro-slip",
             "t9: adhesion nearly everywhere" if one.number == 3 else "",
             f"t{least[0]}: {least[1]:.2f} and {least[2]:.2f} of the nodes"),
            (f"simulation {one.number}: most slip", "t12, the trough of the force" if one.number == 3 else "",
             f"t{most[0]}: {most[1]:.2f} and {most[2]:.2f} of the nodes"),
        ]
    return rows
