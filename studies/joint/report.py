"""The study's pictures, and the table of its scan."""

import matplotlib.pyplot as plt
import numpy as np

import hammer
import surface
from pictures import style
from pictures.output import put_movie
from pictures.signals import Signals, draw_wavelet
from tables import put, write_table


def write_scan(steps, scanned):
    """scan.md and scan.csv: a row for each setting, a column for each frequency in Hz."""
    listed = scanned[0][1]
    write_table(steps, "scan", [
        ["setting", *(what for what, *_ in listed)],
        ["thesis, simulated (measured)", *(f"{simulated} ({measured})" for _, simulated, measured, _ in listed)],
        *([name, *("" if found is None else f"{found:.0f}" for *_, found in findings)] for name, findings in scanned),
    ])


def draw_hammer(steps, tables):
    figure, panels = plt.subplots(1, 2, figsize=(11, 4.2), constrained_layout=True)
    for name, (_, _, along) in hammer.PLACES.items():
        response = hammer.Accelerance(tables[name])
        axes = panels[0 if along == "vertical" else 1]
        axes.semilogx(response.frequency, response.decibels, label=name.rsplit("_", 1)[0].replace("_", " "))
    for axes, along in zip(panels, ("vertical", "lateral")):
        axes.set_title(f"{along} direct accelerance")
        axes.set_xlabel("frequency, Hz")
        axes.set_ylabel("dB re 1 m/s2/N")
        axes.grid(which="both")
        axes.legend()
    put(steps, figure, "accelerance.png")


def draw_forces(steps, found):
    """Normal forces over the whole passage and beside the gap (fig. 4.18)."""
    figure, panels = plt.subplots(1, 2, figsize=(11, 4), constrained_layout=True)
    for number, one in sorted(found.items()):
        place = 1e3 * one.place(one.time)
        for axes in panels:
            axes.plot(place, 1e-3 * one.force, label=f"simulation {number}")
    panels[1].set_xlim(-40, 80)
    for axes in panels:
        axes.axvline(0, color="0.6", linestyle=":")
        axes.set_xlabel("place of the wheel from the gap, mm")
        axes.set_ylabel("normal contact force, kN")
        axes.grid()
        axes.legend()
    put(steps, figure, "forces.png")


def draw_footprint(steps, found):
    """Largest pressure, area, slip and length of the patch over the passage (fig. 4.21, 4.24)."""
    figure, panels = plt.subplots(4, 1, figsize=(8, 9), sharex=True, constrained_layout=True)
    for number, one in sorted(found.items()):
        patch = one.patch
        place = 1e3 * one.place(patch.time)
        for axes, values in zip(panels, (1e-6 * patch.peak_nodal_pressure, 1e-6 * patch.peak_shear, 1e6 * patch.area,
                                         one.slipping())):
            axes.plot(place, values, label=f"simulation {number}")
    for axes, label in zip(panels, ("largest pressure, MPa", "largest shear, MPa", "area, mm2", "share that slips")):
        axes.set_ylabel(label)
        axes.axvline(0, color="0.6", linestyle=":")
        axes.grid()
    panels[0].legend()
    panels[-1].set_xlabel("place of the wheel from the gap, mm")
    put(steps, figure, "footprint.png")


def draw_waves(steps, seen):
    """The impact's wave by time and by distance from the touch."""
    if not seen:
        return
    figure, panels = plt.subplots(1, len(seen), figsize=(5 * len(seen), 4), squeeze=False, constrained_layout=True)
    for axes, (number, wave) in zip(panels[0], sorted(seen.items())):
        largest = np.percentile(np.abs(wave.velocity), 98)
        drawn = axes.pcolormesh(1e3 * wave.radius, 1e6 * wave.time, wave.velocity, cmap=style.SIGNED_MAP,
                                vmin=-largest, vmax=largest, shading="nearest")
        axes.set_title(f"simulation {number}")
        axes.set_xlabel("distance from the touch, mm")
        axes.set_ylabel("time after it, \N{MICRO SIGN}s")
        figure.colorbar(drawn, ax=axes, label="normal velocity, m/s")
    put(steps, figure, "waves.png")


def draw_surface(steps, passing):
    """Maps and movies of the running surface's velocity."""
    if passing.touch is None:
        return
    if figure := surface.draw_maps(passing):
        put(steps, figure, f"surface_{passing.number}.png")
    for name, frames in surface.movies(passing):
        path = steps.path(f"{name}.gif")
        put_movie(frames, str(path), surface.MOVIE_RATE)
        print(path)


def draw_wavelets(steps, files):
    for name, path in files.items():
        put(steps, draw_wavelet(Signals(path)), f"{name}.png")
