"""The patch on its way over the solution zone, as an animated picture."""

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

from . import style
from .panels import (
    Fine,
    draw_arrows,
    draw_cut,
    draw_edge,
    draw_letters,
    draw_parting,
    draw_pressure,
    parting_levels,
    pressure_levels,
    set_window,
    top_of,
)


def patch_frames(title, contact, outputs, resolution):
    """RGB images: above, where the patch is on its way and the forces so far; below, the patch from near by. `outputs`
    picks of the numbers of the output times at which something touches those that become frames. None where nothing
    touches."""
    touching = [i for i in range(len(contact.times)) if contact.patches(i)]
    if not touching:
        return []
    touching = np.array(touching)
    chosen = touching[outputs(contact.times[touching])]
    shown = [contact.patches(i) for i in chosen]
    everything = [patch for patches in shown for patch in patches]
    half = np.max([patches[0].half_size() for patches in shown], axis=0)
    levels = pressure_levels(max(p.pressure.max() for p in everything))
    shear = max(np.hypot(p.shear_x, p.shear_y).max() for p in everything)
    speed = max(np.hypot(p.slip_x, p.slip_y)[p.touching].max() for p in everything)
    parting = parting_levels(everything)
    top = max(top_of(patches[0].cut()) for patches in shown)
    way = [min(p.centre[0] + p.x.min() for p in everything), max(p.centre[0] + p.x.max() for p in everything)]
    sides = [min(p.centre[1] + p.y.min() for p in everything), max(p.centre[1] + p.y.max() for p in everything)]

    figure = plt.figure(figsize=(8, 6), dpi=resolution)
    grid = figure.add_gridspec(
        3, 2, height_ratios=[0.8, 0.9, 2.6], hspace=0.5, wspace=0.3, left=0.1, right=0.97, top=0.92, bottom=0.09
    )
    track, forces, line = figure.add_subplot(grid[0, :]), figure.add_subplot(grid[1, 0]), figure.add_subplot(grid[1, 1])
    stress, slip = figure.add_subplot(grid[2, 0]), figure.add_subplot(grid[2, 1])
    times = 1e3 * contact.times
    normal, creep, lateral = (1e-3 * contact.history(f"{name}_force") for name in ("normal", "creep", "lateral"))

    def draw(frame):
        for axes in (track, forces, line, stress, slip):
            axes.clear()
        patches, index = shown[frame], chosen[frame]
        figure.suptitle(f"{title}: {contact.name}, t = {times[index]:.3f} ms", fontsize=style.TITLE)
        for patch in patches:
            _draw_on_track(track, patch, levels)
        track.set_xlim(*way)
        track.set_ylim(*sides)
        track.set_xlabel("x, mm", fontsize=style.SMALL, labelpad=1)
        track.set_ylabel("y, mm", fontsize=style.SMALL)
        for values, name in ((normal, "normal"), (creep, "longitudinal"), (lateral, "lateral")):
            forces.plot(times, values, color="lightgrey", linewidth=0.8)
            forces.plot(times[: index + 1], values[: index + 1], label=name)
        forces.legend(fontsize=style.TINY, loc="upper left")
        forces.set_ylabel("force, kN", fontsize=style.SMALL)
        forces.set_xlabel("time, ms", fontsize=style.SMALL, labelpad=1)
        patch = patches[0]
        fine = Fine(patch)
        draw_cut(line, patch.cut(), half[0], top, legend=False)
        line.set_xlabel("along the centre line, mm", fontsize=style.SMALL, labelpad=1)
        line.set_ylabel("stress, MPa", fontsize=style.SMALL)
        draw_pressure(stress, fine, levels)
        draw_arrows(stress, patch, patch.shear_x, patch.shear_y, style.SHEAR, largest=shear)
        stress.set_title("pressure, shear", fontsize=style.SMALL)
        draw_parting(slip, patch, fine, parting)
        draw_arrows(slip, patch, patch.slip_x, patch.slip_y, style.SLIP, largest=speed)
        draw_letters(slip, patch, patch.slips_by_velocity)
        slip.set_title("micro-slip" if parting is None else "micro-slip, parting", fontsize=style.SMALL)
        for axes in (stress, slip):
            set_window(axes, half)
            axes.xaxis.label.set_size(style.SMALL)
            axes.yaxis.label.set_size(style.SMALL)
        for axes in (track, forces, line, stress, slip):
            axes.tick_params(labelsize=style.TINY)

    images = []
    for frame in range(len(chosen)):
        draw(frame)
        figure.canvas.draw()
        images.append(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB"))
    plt.close(figure)
    return images


def _draw_on_track(axes, patch, levels):
    fine = Fine(patch)
    fine.mesh.x, fine.mesh.y = fine.mesh.x + patch.centre[0], fine.mesh.y + patch.centre[1]
    axes.tricontourf(fine.mesh, np.sqrt(np.maximum(fine.square_of_pressure, 0)), levels=levels, cmap=style.PRESSURE_MAP)
    draw_edge(axes, fine)
