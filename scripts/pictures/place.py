"""A place of a model that `railwave mesh` wrote: parts by colour with the edges of elements, springs and beams."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

from . import style
from .model import Surface, families
from .results import BadFile


def draw_place(path, place, reach):
    """What lies within `reach` (m) of a place along each axis. Returns a figure."""
    surface = Surface(path)
    box = (np.asarray(place), reach)

    def inside(points):
        return np.all(np.abs(points - box[0]) < reach, axis=-1)

    shown = surface.part[inside(surface.corners.mean(axis=1))]
    if not len(shown):
        raise BadFile(f"{path} has no element within {reach:g} m of ({', '.join(f'{x:g}' for x in place)})")
    family = families(surface.part_names)
    kinds = sorted({family[p] for p in shown}, key=family.index)
    palette = plt.get_cmap(style.LIST)(np.arange(len(kinds)) % 10)
    colour_of = {kind: palette[k] for k, kind in enumerate(kinds)}
    figure, axes = plt.subplots(figsize=(10, 6), layout="constrained")
    surface.draw(
        axes, np.array([colour_of.get(name, palette[0]) for name in family])[surface.part], lines=False, edges=0.12,
        box=box,
    )
    handles = [plt.Line2D([], [], marker="s", linestyle="", color=colour_of[kind]) for kind in kinds]
    for name, lines, looks in (
        ("springs and dashpots", surface.lines, {"color": "crimson", "linewidth": 0.8}),
        ("beams", getattr(surface, "beams", np.empty((0, 2, 3))), {"color": "black", "linewidth": 1.5}),
    ):
        lines = lines[inside(lines).all(axis=1)] if len(lines) else lines
        if len(lines):
            axes.add_collection(LineCollection(lines @ surface.axes, **looks))
            handles.append(plt.Line2D([], [], **looks))
            kinds.append(name)
    axes.autoscale_view()
    axes.legend(handles, kinds, fontsize=style.SMALL, loc="upper left", frameon=False)
    axes.set_title(surface.title, fontsize=style.TITLE)
    return figure
