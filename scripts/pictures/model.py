"""A model that `railwave mesh` wrote: its surface by part, by stable step, and where the step is shortest; springs and
beams."""

import h5py
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from . import style
from .faces import exterior
from .results import BadFile

AZIMUTH, ELEVATION = np.radians(55), np.radians(24)  # seen from outside the track, ahead and above
NEAR = 0.25  # m around the shortest step


def lines_of(file, name):
    """Both ends of each line of a group; none where there is no such group."""
    return file[name]["coordinates"][:][file[name]["connectivity"][:]] if name in file else np.empty((0, 2, 3))


class Surface:
    """Faces of all parts that are on the outside, seen from one direction. `rank` is by face, None where the file has
    no ranks."""

    def __init__(self, path, keep=None):
        """@param keep which elements, from their centres (elements, 3); default: all"""
        try:
            file = h5py.File(path, "r")
        except OSError as error:
            raise BadFile(f"{path} cannot be read as an HDF5 file: {error}") from None
        with file:
            if "part_names" not in file.attrs:
                raise BadFile(f"{path} is no file that 'railwave mesh' wrote")
            self.title = file.attrs["title"]
            self.part_names = [str(name) for name in file.attrs["part_names"]]
            corners, parts, steps, centres, all_steps = [], [], [], [], []
            ranks, all_ranks = [], []
            for group in file["parts"].values():
                nodes, elements = group["coordinates"][:], group["connectivity"][:]
                kept = np.arange(len(elements))
                if keep is not None:
                    kept = kept[keep(nodes[elements].mean(axis=1))]
                faces, owner = exterior(elements[kept])
                owner = kept[owner]
                if "rank" in group:
                    ranks.append(group["rank"][:][owner])
                    all_ranks.append(group["rank"][:])
                corners.append(nodes[faces])
                parts.append(group["part"][:][owner])
                steps.append(group["stable_step"][:][owner])
                all_steps.append(group["stable_step"][:])
                centres.append(nodes[elements].mean(axis=1))
            self.lines = lines_of(file, "connectors")
            self.beams = lines_of(file, "beams")
        self.corners, self.part, self.step = np.concatenate(corners), np.concatenate(parts), np.concatenate(steps)
        all_steps, centres = np.concatenate(all_steps), np.concatenate(centres)
        self.rank = np.concatenate(ranks) if ranks else None
        if ranks:
            all_ranks = np.concatenate(all_ranks)
            self.elements_of_rank = np.bincount(all_ranks)
            self.ranks = len(self.elements_of_rank)
            of_rank_0 = all_ranks == 0
            self.middle_of_rank_0 = np.median(centres[of_rank_0 if of_rank_0.any() else ...][:, 1])
        self.least, self.place = all_steps.min(), centres[all_steps.argmin()]
        self.short = int(np.sum(all_steps < 1.1 * self.least))
        self._look()

    def _look(self):
        """Faces turned towards the eye, the farthest first."""
        towards = np.array(
            [np.cos(ELEVATION) * np.cos(AZIMUTH), np.cos(ELEVATION) * np.sin(AZIMUTH), np.sin(ELEVATION)]
        )
        right = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0])
        self.axes = np.stack([right, np.cross(towards, right)], axis=1)
        normal = np.cross(self.corners[:, 2] - self.corners[:, 0], self.corners[:, 3] - self.corners[:, 1])
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        order = np.argsort(self.corners.mean(axis=1) @ towards)
        order = order[normal[order] @ towards > 0]
        self.corners, self.part, self.step = self.corners[order], self.part[order], self.step[order]
        self.rank = None if self.rank is None else self.rank[order]
        self.shade = 0.55 + 0.45 * np.clip(normal[order] @ np.array([0.35, 0.55, 0.76]), 0, 1)

    def draw(self, axes, colours, lines=True, edges=0.0, box=None):
        shown = np.ones(len(self.corners), bool)
        if box is not None:
            shown = np.all(np.abs(self.corners.mean(axis=1) - box[0]) < box[1], axis=1)
        shaded = np.concatenate([colours[shown, :3] * self.shade[shown, None], np.ones((shown.sum(), 1))], axis=1)
        axes.add_collection(
            PolyCollection(
                self.corners[shown] @ self.axes, facecolors=shaded, edgecolors="black" if edges else shaded,
                linewidths=edges or 0.2,
            )
        )
        if lines and len(self.lines):
            axes.add_collection(LineCollection(self.lines @ self.axes, colors="crimson", linewidths=0.5))
        if lines and len(self.beams):
            axes.add_collection(LineCollection(self.beams @ self.axes, colors="black", linewidths=1.5))
        axes.set_aspect("equal")
        axes.autoscale_view()
        axes.axis("off")


def families(names):
    """Names without their last number: one colour for all sleepers."""
    return [name.rsplit("_", 1)[0] if name.rsplit("_", 1)[-1].isdigit() else name for name in names]


def draw_model(path):
    """The whole by part and by stable step, and the surroundings of the shortest step. Returns a figure."""
    surface = Surface(path)
    figure = plt.figure(figsize=(10, 8))
    grid = figure.add_gridspec(
        2, 2, height_ratios=[1, 1], hspace=0.05, wspace=0.02, left=0.02, right=0.98, top=0.93, bottom=0.1
    )
    whole, near, far = figure.add_subplot(grid[0, :]), figure.add_subplot(grid[1, 1]), figure.add_subplot(grid[1, 0])
    figure.suptitle(
        f"{surface.title}\nshortest stable step {1e9 * surface.least:.3g} ns, {surface.short} elements within a"
        " tenth of it",
        fontsize=style.TITLE,
    )

    family = families(surface.part_names)
    kinds = sorted(set(family), key=family.index)
    palette = plt.get_cmap(style.LIST)(np.arange(len(kinds)) % 10)
    surface.draw(whole, palette[[kinds.index(family[p]) for p in surface.part]], edges=0.1)
    handles = [plt.Line2D([], [], marker="s", linestyle="", color=colour) for colour in palette]
    for name, there, looks in (
        ("springs and dashpots", surface.lines, {"color": "crimson"}),
        ("beams", surface.beams, {"color": "black", "linewidth": 1.5}),
    ):
        if len(there):
            handles.append(plt.Line2D([], [], **looks))
            kinds.append(name)
    whole.legend(handles, kinds, fontsize=style.SMALL, loc="upper left", frameon=False)

    scale = plt.Normalize(0, np.log10(max(surface.step.max() / surface.least, 1.01)))
    colours = plt.get_cmap(style.SIZE_MAP)(scale(np.log10(surface.step / surface.least)))
    surface.draw(far, colours, lines=False)
    surface.draw(near, colours, lines=False, edges=0.15, box=(surface.place, NEAR))
    spot = surface.place @ surface.axes
    for axes in (far, near):
        axes.plot(*spot, marker="o", markersize=9, markerfacecolor="none", markeredgecolor="red")
    bar = figure.colorbar(
        plt.cm.ScalarMappable(scale, style.SIZE_MAP),
        cax=figure.add_axes([0.25, 0.075, 0.5, 0.018]),
        orientation="horizontal",
    )
    bar.ax.tick_params(labelsize=style.SMALL)
    bar.set_label("stable step over the shortest (in the ring), powers of ten", fontsize=style.SMALL)
    return figure
