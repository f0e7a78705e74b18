"""A model that `railwave mesh --ranks N` wrote, by the rank that computes each element."""

import matplotlib.pyplot as plt
import numpy as np

from . import style
from .model import Surface

REACH = 0.1  # m, about the shortest step
MOST_NAMED = 16  # ranks with a name in the legend


def colours_of(count):
    """By rank; neighbours are often of near numbers, so those have colours far apart."""
    if count <= 10:
        return plt.get_cmap(style.LIST)(np.arange(count))
    hues = np.arange(count) * 0.618034 % 1
    return plt.get_cmap("hsv")(hues) * [0.85, 0.85, 0.85, 1]


def draw_ranks(path):
    """From outside, cut lengthways through the middle of what rank 0 has, and near the shortest step. Returns a figure;
    None where the file has no ranks."""
    whole = Surface(path)
    if whole.rank is None:
        return None
    count = whole.ranks
    middle = whole.middle_of_rank_0
    cut = Surface(path, keep=lambda centres: centres[:, 1] <= middle)
    colours = colours_of(count)
    figure = plt.figure(figsize=(10, 8))
    grid = figure.add_gridspec(2, 2, hspace=0.08, wspace=0.02, left=0.02, right=0.86, top=0.92, bottom=0.02)
    near = whole.place, REACH
    for place, surface, name, edges, box in (
        (grid[0, :], whole, "from outside", 0, None),
        (grid[1, 0], cut, f"cut at y = {middle:.4g} m", 0, None),
        (grid[1, 1], whole, "where the step is shortest", 0.1, near),
    ):
        axes = figure.add_subplot(place)
        surface.draw(axes, colours[surface.rank], lines=False, edges=edges, box=box)
        axes.set_title(name, fontsize=style.SMALL, loc="left")
    share = 100 * whole.elements_of_rank / whole.elements_of_rank.sum()
    named = range(min(count, MOST_NAMED))
    handles = [plt.Line2D([], [], marker="s", linestyle="", color=colours[rank]) for rank in named]
    texts = [f"rank {rank}: {share[rank]:.3g} %" for rank in named]
    if count > MOST_NAMED:
        handles.append(plt.Line2D([], [], linestyle=""))
        texts.append(f"and {count - MOST_NAMED} more")
    figure.legend(handles, texts, fontsize=style.SMALL, loc="center right", frameon=False, title="elements")
    figure.suptitle(f"{whole.title}\n{count} ranks", fontsize=style.TITLE)
    return figure
