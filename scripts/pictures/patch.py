"""Pictures of the contact patch, after figures 4.19 and 4.20 of the thesis: depth of colour for the pressure, arrows for
the shear stress, and where the surfaces stick and slip."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import LinearTriInterpolator, Triangulation, UniformTriRefiner

PRESSURE_COLOURS = "YlOrRd"
ARROW_COLOUR = "#10407f"
STICK_COLOUR = "#0a7a4a"
ARROW_CELLS = 1.4  # length of the largest arrow, in mesh cells


def _nice(value):
    """The largest of 1, 2, 5 times a power of ten that is not above `value`."""
    if not value > 0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    return max(f * power for f in (1, 2, 5) if f * power <= value * (1 + 1e-12))


def _triangulation(patch):
    triangles = patch.triangles()
    return Triangulation(patch.x, patch.y, triangles) if len(triangles) else None


class _Fine:
    """The patch on a finer triangulation, for smooth colours and edges."""

    def __init__(self, patch, mesh):
        self._refiner, self._mesh = UniformTriRefiner(mesh), mesh
        self.mesh, self.square_of_pressure = self._refine(patch.square_of_pressure())

    def _refine(self, values):
        return self._refiner.refine_field(values, LinearTriInterpolator(self._mesh, values), subdiv=3)

    def inside(self, values):
        """Nodal values on the part of the fine triangulation that is in contact."""
        mesh, fine = self._refine(values)
        mesh.set_mask((self.square_of_pressure[mesh.triangles] < 0).all(axis=1))
        return mesh, fine


def _draw_pressure(axes, fine, peak):
    """Colours by pressure, and the edge of contact."""
    levels = MaxNLocator(10).tick_values(0, peak)
    levels[0] = 1e-6 * peak
    colours = axes.tricontourf(fine.mesh, np.sqrt(np.maximum(fine.square_of_pressure, 0)), levels=levels, cmap=PRESSURE_COLOURS)
    _draw_edge(axes, fine)
    return colours


def _draw_edge(axes, fine):
    axes.tricontour(fine.mesh, fine.square_of_pressure, levels=[0], colors="black", linewidths=0.9)


def _draw_stick_boundary(axes, patch, fine):
    """The line between nodes that stick and nodes that slip; a node outside counts as its nearest touching one."""
    if not (patch.touching & ~patch.slipping).any() or not (patch.touching & patch.slipping).any():
        return
    sticking = (~patch.slipping).astype(float)
    inside = np.flatnonzero(patch.touching)
    for node in np.setdiff1d(patch.triangles(), inside):
        sticking[node] = sticking[inside[np.argmin(np.hypot(patch.x[inside] - patch.x[node], patch.y[inside] - patch.y[node]))]]
    mesh, fine_sticking = fine.inside(sticking)
    axes.tricontour(mesh, fine_sticking, levels=[0.5], colors=STICK_COLOUR, linewidths=1.4, linestyles="--")


def _draw_arrows(axes, patch, u, v, unit="", label="", colour=ARROW_COLOUR):
    """Arrows at the touching nodes; with a label also a key that says how long they are."""
    size = np.hypot(u, v)
    largest = size[patch.touching].max() if patch.touching.any() else 0
    if not largest > 0:
        return
    chosen = patch.touching & (size > 1e-6 * largest)
    per_mm = largest / (ARROW_CELLS * patch.cell_size())
    arrows = axes.quiver(
        patch.x[chosen], patch.y[chosen], u[chosen], v[chosen], angles="xy", scale_units="xy", scale=per_mm,
        color=colour, width=0.0022, headwidth=4, headlength=5, headaxislength=4.5, zorder=5,
    )  # fmt: skip
    if label:
        length = _nice(largest)
        axes.quiverkey(arrows, 0.86, 1.05, length, f"{label} {length:g} {unit}", labelpos="W", coordinates="axes")


def _frame(axes, patch, half):
    axes.set_xlim(patch.centre[0] - half[0], patch.centre[0] + half[0])
    axes.set_ylim(patch.centre[1] - half[1], patch.centre[1] + half[1])
    axes.set_aspect("equal")
    axes.set_xlabel("x, rolling direction, mm")
    axes.set_ylabel("y, lateral, mm")


def _centre_line(axes, patch, mesh, half):
    x = np.linspace(patch.centre[0] - half[0], patch.centre[0] + half[0], 400)
    y = np.full_like(x, patch.centre[1])
    pressure, shear = (LinearTriInterpolator(mesh, values)(x, y).filled(0) for values in (patch.pressure, patch.shear_x))
    axes.plot(x, pressure, color="#b3261e", label="pressure")
    axes.plot(x, shear, color=ARROW_COLOUR, label="shear along x")
    if patch.friction > 0:
        bound = patch.friction * pressure
        axes.plot(x, bound, color="grey", linewidth=0.9, linestyle="--", label="friction bound")
        axes.plot(x, -bound, color="grey", linewidth=0.9, linestyle="--")
    axes.axhline(0, color="black", linewidth=0.6)
    axes.set_xlim(x[0], x[-1])
    axes.set_ylabel("MPa")
    axes.legend(fontsize=8, loc="upper right")
    axes.set_title(f"along the centre line, y = {round(patch.centre[1], 2) + 0.0:.2f} mm", fontsize=9)


def _forces(patch):
    return (
        f"normal {patch.normal_force:.1f} kN, longitudinal {patch.creep_force:+.2f} kN, lateral {patch.lateral_force:+.2f} kN, "
        f"tangential over normal {patch.traction_coefficient:.3f}"
    )


def _figure_for(ratio):
    """A figure with axes for the centre line, the stresses and the micro-slip of a patch whose width over length is `ratio`."""
    if ratio < 0.8:
        height = 6.2 * ratio
        figure = plt.figure(figsize=(8, 3.4 + 2 * height + 1.9), constrained_layout=True)
        grid = figure.add_gridspec(3, 1, height_ratios=[2.2, height, height])
        places = grid[0], grid[1], grid[2]
    else:
        height = 4.2 * min(ratio, 2)
        figure = plt.figure(figsize=(12, 3.4 + height + 0.8), constrained_layout=True)
        grid = figure.add_gridspec(2, 2, height_ratios=[2.2, height])
        places = grid[0, :], grid[1, 0], grid[1, 1]
    return figure, [figure.add_subplot(place) for place in places]


def draw_patch(results, contact, index):
    """One instant: the centre line, the patch with its stresses, the micro-slip. Returns a figure, or None without contact."""
    patch = contact.patch(index)
    mesh = _triangulation(patch)
    if mesh is None:
        return None
    half, peak, fine = patch.half_size(), patch.pressure.max(), _Fine(patch, mesh)
    figure, (line, stress, slip) = _figure_for(half[1] / half[0])
    figure.suptitle(
        f"{results.title}\ncontact {contact.name}, stresses on {contact.surface}, t = {1e3 * contact.times[index]:.4f} ms\n{_forces(patch)}",
        fontsize=10,
    )
    _centre_line(line, patch, mesh, half)

    colours = _draw_pressure(stress, fine, peak)
    figure.colorbar(colours, ax=stress, label="pressure, MPa", shrink=0.9)
    _draw_stick_boundary(stress, patch, fine)
    _draw_arrows(stress, patch, patch.shear_x, patch.shear_y, "MPa", "shear")
    _frame(stress, patch, half)
    handles = [Line2D([], [], color="black", linewidth=0.9, label="edge of contact"), Line2D([], [], color=STICK_COLOUR, linestyle="--", label="stick | slip")]
    stress.legend(handles=handles, fontsize=8, loc="upper left")

    speed = np.hypot(patch.slip_x, patch.slip_y)
    fastest = max(speed[patch.touching].max(), 1e-12)
    shown = np.where(patch.touching, speed, 0)
    colours = slip.tripcolor(mesh, shown, shading="gouraud", cmap="PuBu", vmin=0, vmax=fastest)
    figure.colorbar(colours, ax=slip, label="micro-slip, m/s", shrink=0.9)
    _draw_edge(slip, fine)
    _draw_stick_boundary(slip, patch, fine)
    _draw_arrows(slip, patch, patch.slip_x, patch.slip_y, "m/s", "micro-slip", colour="black")
    _frame(slip, patch, half)
    return figure


def draw_evolution(results, contact, count=8):
    """The patch at up to `count` output times, evenly spread, with one colour scale. Returns a figure, or None without contact."""
    # Look at no more states than needed: a long run holds thousands.
    indices = np.unique(np.linspace(0, len(contact.times) - 1, min(len(contact.times), count)).round().astype(int))
    patches = [(i, contact.patch(i)) for i in indices]
    patches = [(i, p) for i, p in patches if p.touching.any()]
    if len(patches) < 2:
        return None
    half = np.max([p.half_size() for _, p in patches], axis=0)
    peak = max(p.pressure.max() for _, p in patches)
    columns = min(4, len(patches))
    rows = -(-len(patches) // columns)
    width = 3.4
    figure, grid = plt.subplots(
        rows, columns, figsize=(columns * width + 1.2, rows * (0.85 * width * half[1] / half[0] + 0.75) + 0.6), squeeze=False, constrained_layout=True
    )
    figure.suptitle(f"{results.title}\ncontact {contact.name}, stresses on {contact.surface}; arrows: shear stress, each picture with a scale of its own", fontsize=10)
    for axes in grid.flat[len(patches) :]:
        axes.set_visible(False)
    for axes, (i, patch) in zip(grid.flat, patches):
        mesh = _triangulation(patch)
        fine = _Fine(patch, mesh)
        colours = _draw_pressure(axes, fine, peak)
        _draw_stick_boundary(axes, patch, fine)
        _draw_arrows(axes, patch, patch.shear_x, patch.shear_y)
        _frame(axes, patch, half)
        axes.tick_params(labelsize=7)
        axes.xaxis.label.set_size(8)
        axes.yaxis.label.set_size(8)
        axes.set_title(f"t = {1e3 * contact.times[i]:.4f} ms: {patch.normal_force:.1f} kN, {patch.creep_force:+.1f} kN", fontsize=8)
    figure.colorbar(colours, ax=grid, label="pressure, MPa", shrink=0.9)
    return figure
