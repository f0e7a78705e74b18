"""Pictures of the contact patch: one instant in full, several in a row, and its evolution."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

from . import style
from .panels import (Fine, add_parting_bar, draw_arrows, draw_cut, draw_letters, draw_parting, draw_pressure,
                     draw_stick_boundary, parting_levels, pressure_levels, set_window, top_of)


MOST_PATCHES = 10  # that one picture tells apart


def _forces(patch):
    return (
        f"normal {patch.normal_force:.1f} kN, longitudinal {patch.creep_force:+.2f} kN, lateral"
        f" {patch.lateral_force:+.2f} kN, tangential over normal {patch.traction_coefficient:.3f}"
    )


def _creepages(patch):
    """A line on creepages, agreement and where the patch is."""
    row = patch.row
    text = (
        f"centre at x {patch.centre[0]:.1f} mm, y {patch.centre[1]:.2f} mm; criteria of slip agree on"
        f" {100 * row['agreement_force_velocity']:.0f} % of {int(row['nodes_in_contact'])} nodes"
    )
    if np.isfinite(row["longitudinal_creepage"]):
        text += (
            f"\ncreepage {100 * row['longitudinal_creepage']:+.3f} % along, {100 * row['lateral_creepage']:+.3f} %"
            f" across, spin {row['spin_creepage']:+.2f}/m"
        )
    return text


def _places(ratio):
    """A figure with axes for the cut, the stresses and the micro-slip of a patch whose width over length is `ratio`."""
    if ratio < 0.8:
        height = 5.6 * ratio
        figure = plt.figure(figsize=(7.2, 2.9 + 2 * height + 1.9), constrained_layout=True)
        grid = figure.add_gridspec(3, 1, height_ratios=[2, height, height])
        places = grid[0], grid[1], grid[2]
    else:
        height = 3.6 * min(ratio, 2)
        figure = plt.figure(figsize=(10, 2.9 + height + 0.8), constrained_layout=True)
        grid = figure.add_gridspec(2, 2, height_ratios=[2, height])
        places = grid[0, :], grid[1, 0], grid[1, 1]
    return figure, [figure.add_subplot(place) for place in places]


def draw_patch(title, contact, patch):
    """One instant: the cut along the centre, the patch with its stresses, the micro-slip. Returns a figure."""
    half, fine, cut = patch.half_size(), Fine(patch), patch.cut()
    figure, (line, stress, slip) = _places(half[1] / half[0])
    which = f"contact {contact.name}" + (f", patch {patch.number}" if len(contact.numbers()) > 1 else "")
    if patch.small:
        which += f" of {patch.nodes} node{'s' if patch.nodes > 1 else ''}, too few for the mesh to show its shape"
    figure.suptitle(
        f"{title}\n{which}, stresses on {contact.surface}, t = {1e3 * patch.time:.4f} ms\n{_forces(patch)}\n"
        f"{_creepages(patch)}",
        fontsize=style.TEXT,
    )

    draw_cut(line, cut, half[0], top_of(cut))
    line.set_ylabel("stress, MPa")
    line.set_xlabel("rolling direction, mm")
    line.set_title("along the centre line; A adhesion, S slip (eq. 3.6)", fontsize=style.TEXT, loc="left")

    colours = draw_pressure(stress, fine, pressure_levels(patch.pressure.max()))
    figure.colorbar(colours, ax=stress, label="pressure, MPa", shrink=0.9)
    draw_stick_boundary(stress, patch, fine, patch.slips)
    draw_arrows(stress, patch, patch.shear_x, patch.shear_y, style.SHEAR, key=("shear", "MPa"))
    set_window(stress, half)
    handles = [
        Line2D([], [], color="black", linewidth=0.9, label="edge"),
        Line2D([], [], color=style.STICK, linestyle="--", label="stick | slip"),
    ]
    stress.legend(handles=handles, fontsize=style.TINY, loc="upper left")

    colours = draw_parting(slip, patch, fine, parting_levels([patch]))
    add_parting_bar(figure, colours, "surfaces part (+), approach (-), m/s", ax=slip, shrink=0.9)
    draw_stick_boundary(slip, patch, fine, patch.slips_by_velocity)
    draw_arrows(slip, patch, patch.slip_x, patch.slip_y, style.SLIP, key=("micro-slip", "m/s"))
    draw_letters(slip, patch, patch.slips_by_velocity)
    set_window(slip, half)
    return figure


def _largest_patches(contact, count, indices=None):
    """The largest patch at the output times numbered, or at up to `count`, evenly spread; without those where nothing
    touches."""
    # Look at no more states than needed: a long run holds thousands.
    if indices is None:
        indices = np.linspace(0, len(contact.times) - 1, min(len(contact.times), count)).round().astype(int)
    found = [contact.patches(i) for i in np.unique(indices)]
    return [patches[0] for patches in found if patches]


def draw_row(title, contact, count=6, indices=None, patches=None):
    """Several instants side by side, after figure 5.6 of the thesis: the cut, the stresses, the micro-slip, with one
    scale each; of the largest patches, or of those given. Returns a figure, or None without contact."""
    patches = _largest_patches(contact, count, indices) if patches is None else patches
    if not patches:
        return None
    half = np.max([p.half_size() for p in patches], axis=0)
    levels = pressure_levels(max(p.pressure.max() for p in patches))
    shear = max(np.hypot(p.shear_x, p.shear_y).max() for p in patches)
    speed = max(np.hypot(p.slip_x, p.slip_y)[p.touching].max() for p in patches)
    parting, cuts = parting_levels(patches), [p.cut() for p in patches]
    top = max(top_of(cut) for cut in cuts)
    width, n = 2.1, len(patches)
    height = max(width * half[1] / half[0], 0.9)  # room for the bars' labels beside a narrow patch
    figure, grid = plt.subplots(
        3, n, figsize=(n * width + 2.0, 1.5 + 2 * height + 1.9), squeeze=False, constrained_layout=True,
        gridspec_kw={"height_ratios": [1.5, height, height]},
    )
    figure.suptitle(
        f"{title}\ncontact {contact.name}, stresses on {contact.surface}; above: friction times pressure (red),"
        " shear (blue); A adhesion, S slip (eq. 3.6)",
        fontsize=style.TEXT,
    )
    for column, (patch, cut) in enumerate(zip(patches, cuts)):
        fine, first = Fine(patch), column == 0
        line, stress, slip = grid[:, column]
        draw_cut(line, cut, half[0], top, legend=False)
        line.set_title(
            f"t = {1e3 * patch.time:.3f} ms\n{patch.normal_force:.1f} kN; {patch.creep_force:+.1f},"
            f" {patch.lateral_force:+.1f} kN",
            fontsize=style.SMALL,
        )
        pressure_colours = draw_pressure(stress, fine, levels)
        draw_stick_boundary(stress, patch, fine, patch.slips)
        draw_arrows(stress, patch, patch.shear_x, patch.shear_y, style.SHEAR, largest=shear)
        set_window(stress, half, False, first)
        parting_colours = draw_parting(slip, patch, fine, parting)
        draw_arrows(
            slip, patch, patch.slip_x, patch.slip_y, style.SLIP, largest=speed,
            key=("", "m/s") if column == n - 1 else None,
        )
        draw_stick_boundary(slip, patch, fine, patch.slips_by_velocity)
        draw_letters(slip, patch, patch.slips_by_velocity)
        set_window(slip, half, True, first)
        for axes in (line, stress, slip):
            axes.tick_params(labelsize=style.TINY, labelleft=first)
            axes.xaxis.label.set_size(style.SMALL)
    lowest = min(line.get_ylim()[0] for line in grid[0])
    for line in grid[0]:  # one scale, which the first one's ticks are for
        line.set_ylim(lowest, top)
    grid[0, 0].set_ylabel("stress, MPa")
    figure.colorbar(pressure_colours, ax=grid[1, :], label="pressure, MPa")
    add_parting_bar(figure, parting_colours, "surfaces part (+),\napproach (-), m/s", ax=grid[2, :])
    return figure


def draw_patches(title, contact):
    """Where each of several patches is, its normal force and its creepage along the rolling direction, against time;
    hollow marks: fewer than four nodes. Returns a figure, or None where there never was more than one patch."""
    numbers = contact.numbers()
    if len(numbers) < 2:
        return None
    shown = sorted(sorted(numbers, key=lambda n: -np.nanmax(contact.history("normal_force", n)))[:MOST_PATCHES])
    figure, panels = plt.subplots(4, 1, figsize=(8, 9), sharex=True, constrained_layout=True)
    more = f"; the {MOST_PATCHES} with the largest forces of {len(numbers)}" if len(numbers) > MOST_PATCHES else ""
    figure.suptitle(
        f"{title}\ncontact {contact.name}, patches by number{more}; hollow: fewer than four nodes", fontsize=style.TITLE
    )
    columns = (
        ("centre_x", 1e3, "centre x, mm"),
        ("centre_y", 1e3, "centre y, mm"),
        ("normal_force", 1e-3, "normal force, kN"),
        ("longitudinal_creepage", 100, "creepage along, %"),
    )
    colours = plt.get_cmap(style.LIST)
    for k, number in enumerate(shown):
        small = contact.small(number)
        for axes, (column, scale, _) in zip(panels, columns):
            values = scale * contact.history(column, number)
            (line,) = axes.plot(
                1e3 * contact.times, values, color=colours(k % 10), linewidth=0.8, label=f"patch {number}"
            )
            axes.plot(1e3 * contact.times[~small], values[~small], "o", markersize=3, color=line.get_color())
            axes.plot(
                1e3 * contact.times[small], values[small], "o", markersize=3, color=line.get_color(),
                markerfacecolor="white",
            )
    for axes, (_, _, label) in zip(panels, columns):
        axes.set_ylabel(label)
        axes.grid(alpha=0.3)
    panels[0].legend(fontsize=style.SMALL, ncols=min(5, len(shown)), loc="lower left", bbox_to_anchor=(0, 1.0))
    panels[-1].set_xlabel("time, ms")
    return figure


def draw_evolution(title, contact, count=8):
    """The stresses at up to `count` output times, evenly spread, with one colour scale. Returns a figure, or None
    without contact."""
    patches = _largest_patches(contact, count)
    if len(patches) < 2:
        return None
    half = np.max([p.half_size() for p in patches], axis=0)
    levels = pressure_levels(max(p.pressure.max() for p in patches))
    columns = min(4, len(patches))
    rows = -(-len(patches) // columns)
    width = 2.8
    figure, grid = plt.subplots(
        rows, columns, figsize=(columns * width + 1.2, rows * (0.85 * width * half[1] / half[0] + 0.75) + 0.6),
        squeeze=False, constrained_layout=True
    )
    figure.suptitle(
        f"{title}\ncontact {contact.name}, stresses on {contact.surface}; arrows: shear stress, each picture with a"
        " scale of its own",
        fontsize=style.TITLE,
    )
    for axes in grid.flat[len(patches) :]:
        axes.set_visible(False)
    for axes, patch in zip(grid.flat, patches):
        fine = Fine(patch)
        colours = draw_pressure(axes, fine, levels)
        draw_stick_boundary(axes, patch, fine, patch.slips)
        draw_arrows(axes, patch, patch.shear_x, patch.shear_y, style.SHEAR)
        set_window(axes, half)
        axes.tick_params(labelsize=style.TINY)
        axes.xaxis.label.set_size(style.SMALL)
        axes.yaxis.label.set_size(style.SMALL)
        axes.set_title(
            f"t = {1e3 * patch.time:.4f} ms: {patch.normal_force:.1f} kN, {patch.creep_force:+.1f} kN",
            fontsize=style.SMALL,
        )
    figure.colorbar(colours, ax=grid, label="pressure, MPa", shrink=0.9)
    return figure
