"""Panels that show one contact patch, after figures 4.19, 4.22, 4.24 and 5.6 of the thesis: each draws into given
axes."""

import numpy as np
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import LinearTriInterpolator, Triangulation, UniformTriRefiner

from . import style

ARROW_CELLS = 1.4  # length of the largest arrow, in distances of arrows
ARROWS_ACROSS = 24  # at most, over the patch's larger side


def nice(value):
    """The largest of 1, 2, 5 times a power of ten that is not above `value`."""
    if not value > 0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    return max(f * power for f in (1, 2, 5) if f * power <= value * (1 + 1e-12))


class Fine:
    """The patch on a finer triangulation, for smooth colours and edges."""

    def __init__(self, patch):
        self.coarse = Triangulation(patch.x, patch.y, patch.triangles())
        self._refiner = UniformTriRefiner(self.coarse)
        self.mesh, self.square_of_pressure = self.refine(patch.square_of_pressure())

    def refine(self, values):
        return self._refiner.refine_field(values, LinearTriInterpolator(self.coarse, values), subdiv=3)

    def inside(self, values):
        """Nodal values on the part of the fine triangulation that is in contact."""
        mesh, fine = self.refine(values)
        mesh.set_mask((self.square_of_pressure[mesh.triangles] < 0).all(axis=1))
        return mesh, fine


def pressure_levels(peak):
    levels = MaxNLocator(10).tick_values(0, peak)
    levels[0] = 1e-6 * peak
    return levels


def draw_pressure(axes, fine, levels):
    """Colours by pressure, and the edge of contact."""
    colours = axes.tricontourf(
        fine.mesh, np.sqrt(np.maximum(fine.square_of_pressure, 0)), levels=levels, cmap=style.PRESSURE_MAP
    )
    draw_edge(axes, fine)
    return colours


def draw_edge(axes, fine):
    axes.tricontour(fine.mesh, fine.square_of_pressure, levels=[0], colors="black", linewidths=0.9)


def parting_levels(patches):
    """None: the surfaces do not move along the normal but by rounding, or the results have no velocities."""
    fastest = max((np.abs(patch.parting).max() for patch in patches), default=0)
    return MaxNLocator(14, symmetric=True).tick_values(-fastest, fastest) if fastest > 1e-6 else None


def draw_parting(axes, patch, fine, levels):
    """Colours by the velocity at which the surfaces part (positive) or approach; None where there are no levels."""
    colours = None
    if levels is not None:
        colours = axes.tricontourf(*fine.refine(patch.parting), levels=levels, cmap=style.PARTING_MAP)
    draw_edge(axes, fine)
    return colours


def add_parting_bar(figure, colours, label, **options):
    if colours is not None:
        figure.colorbar(colours, label=label, **options)


def draw_stick_boundary(axes, patch, fine, slips):
    """The line between nodes that stick and nodes that slip; a node outside counts as its nearest touching one."""
    if not (patch.touching & ~slips).any() or not (patch.touching & slips).any():
        return
    sticking = (~slips).astype(float)
    inside = np.flatnonzero(patch.touching)
    for node in np.flatnonzero(~patch.touching):
        sticking[node] = sticking[
            inside[np.argmin(np.hypot(patch.x[inside] - patch.x[node], patch.y[inside] - patch.y[node]))]
        ]
    mesh, fine_sticking = fine.inside(sticking)
    axes.tricontour(mesh, fine_sticking, levels=[0.5], colors=style.STICK, linewidths=1.4, linestyles="--")


def draw_letters(axes, patch, slips):
    """A in the adhesion region, S in the slip region: at the node farthest from what is not of that region."""
    for letter, region in (("A", patch.touching & ~slips), ("S", patch.touching & slips)):
        if region.sum() < 3:
            continue
        mine, others = np.flatnonzero(region), np.flatnonzero(~region)
        distance = np.hypot(patch.x[mine][:, None] - patch.x[others], patch.y[mine][:, None] - patch.y[others]).min(
            axis=1, initial=1e3
        )
        # Of nodes as deep as each other, that in the middle.
        middle = np.hypot(patch.x[mine] - patch.x[mine].mean(), patch.y[mine] - patch.y[mine].mean())
        node = mine[np.argmax(distance - 1e-3 * middle)]
        axes.text(
            patch.x[node], patch.y[node], letter, ha="center", va="center", fontsize=style.TITLE, fontweight="bold",
            color=style.STICK, zorder=6,
            bbox={"boxstyle": "circle,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.75},
        )  # fmt: skip


def _thinned(patch, chosen):
    """Of the nodes chosen so many that their arrows can be told apart, and the distance of these, mm."""
    size = max(patch.cell_size(), 2 * max(patch.half_size()) / ARROWS_ACROSS)
    if size < 1.3 * patch.cell_size():
        return chosen, patch.cell_size()
    places = np.round(np.column_stack([patch.x, patch.y])[chosen] / size)
    _, first = np.unique(places, axis=0, return_index=True)
    thin = np.zeros_like(chosen)
    thin[np.flatnonzero(chosen)[first]] = True
    return thin, size


def draw_arrows(axes, patch, u, v, colour, largest=None, key=None):
    """Arrows at the touching nodes, that of length `largest` (default: the patch's own) as long as arrows are apart;
    `key`, a name and a unit: says beside the axes how long they are."""
    size = np.hypot(u, v)
    largest = largest or (size[patch.touching].max() if patch.touching.any() else 0)
    if not largest > 0:
        return
    chosen, distance = _thinned(patch, patch.touching & (size > 1e-3 * largest))
    arrows = axes.quiver(
        patch.x[chosen], patch.y[chosen], u[chosen], v[chosen], angles="xy", scale_units="xy",
        scale=largest / (ARROW_CELLS * distance),
        color=colour, width=0.0035, headwidth=3.6, headlength=4.5, headaxislength=4, zorder=5,
    )  # fmt: skip
    if key:
        name, unit = key
        length = nice(largest)
        axes.quiverkey(
            arrows, 0.8, 1.04, length, f"{name} {length:g} {unit}", labelpos="W", coordinates="axes",
            fontproperties={"size": style.TEXT},
        )


def set_window(axes, half, x_label=True, y_label=True):
    axes.set_xlim(-half[0], half[0])
    axes.set_ylim(-half[1], half[1])
    axes.set_aspect("equal")
    if x_label:
        axes.set_xlabel("rolling direction, mm")
    if y_label:
        axes.set_ylabel("lateral, mm")


def top_of(cut):
    """Of the axes that show it."""
    shown = cut["traction_bound"] if cut["traction_bound"].any() else cut["pressure"]
    return 1.18 * max(shown.max(initial=0), 1e-12)


def draw_cut(axes, cut, half, top, legend=True):
    """Traction bound and shear along a cut, with the letters of its adhesion and slip regions."""
    shear = np.hypot(cut["shear_along"], cut["shear_across"])
    if cut["traction_bound"].any():
        axes.plot(cut["distance"], cut["traction_bound"], color=style.BOUND, label="friction times pressure")
        axes.plot(cut["distance"], shear, color=style.SHEAR, label="shear, size")
        axes.plot(
            cut["distance"], cut["shear_along"], color=style.SHEAR, linewidth=0.8, linestyle=":",
            label="longitudinal shear",
        )
    else:
        axes.plot(cut["distance"], cut["pressure"], color=style.BOUND, label="pressure (no friction)")
    inside, slips = cut["pressure"] > 0, cut["slips_by_force"] > 0.5
    for letter, region in (("A", inside & ~slips), ("S", inside & slips)):
        for part in np.split(np.flatnonzero(region), np.flatnonzero(np.diff(np.flatnonzero(region)) > 1) + 1):
            if len(part) == 0:
                continue
            first, last = cut["distance"][part[0]], cut["distance"][part[-1]]
            if letter == "A":
                axes.axvspan(first, last, color=style.STICK, alpha=0.10, linewidth=0)
            if last - first > 0.06 * 2 * half:
                axes.text(
                    0.5 * (first + last), 0.93 * top, letter, ha="center", va="center", fontsize=style.TITLE,
                    fontweight="bold", color=style.STICK,
                )
    axes.axhline(0, color="black", linewidth=0.6)
    axes.set_xlim(-half, half)
    lowest = min(0.0, cut["shear_along"].min()) if len(cut["distance"]) else 0.0
    axes.set_ylim(1.1 * lowest, top)
    if legend:  # above, where it hides no letter
        axes.legend(fontsize=style.SMALL, loc="lower right", bbox_to_anchor=(1, 1), ncols=3, frameon=False)
