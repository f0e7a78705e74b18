"""A crack in the rail's head that the wheel crosses (thesis 7.3): force, contact and energy against the run without it,
and the waves that go out from it: the normal velocity of the surface less that of the sound rail's."""

import functools

import matplotlib.pyplot as plt
import numpy as np

from creepage import patch_edge
from pictures import style
from pictures.output import put_movie
from scenes import SPEED
from spectrum import at_even_times, even

CLEAR = 0.003  # m, about the patch that is left out
NEAREST, FARTHEST = 0.004, 0.026  # m from the mouth, where its waves are looked for
LOWEST, HIGHEST = 3e4, 4e5  # Hz, of them: outputs each microsecond tell nothing above 0.5 MHz
SMOOTH = 2e-5  # s
FAR = 0.010  # m, of the patch's front from the mouth, from which on the wheel nears it
SPEEDS = np.arange(1500.0, 7000.0, 50.0)  # m/s
FRAMES, MOVIE_RATE = 30, 8
WHEN = ("before", "nearing", "over it", "behind")


@functools.lru_cache(maxsize=1)
def crossing_of(sound, cracked):
    """The Crossing of two runs, which table, pictures and movies share."""
    return Crossing(sound, cracked)


class Crossing:
    """The run with the crack beside that without."""

    def __init__(self, sound, cracked):
        self.sound, self.cracked = sound, cracked
        surface, without = cracked.surface, sound.surface
        self.mouth = mouth_of(surface)
        self.middle = self.mouth.mean(axis=0)
        self.half = 0.5 * np.ptp(self.mouth[:, 1])
        # On the nodes of the sound rail: the nearest of the cracked one's; two at the mouth.
        nearest = [int(np.argmin(np.hypot(*(surface.place[:, :2] - at[:2]).T))) for at in without.place]
        begin, end = max(surface.time[0], without.time[0]), min(surface.time[-1], without.time[-1])
        self.time = even(without.time[(without.time >= begin) & (without.time <= end)])
        self.place = without.place[:, :2]
        normal = at_even_times(surface.time, self.time, surface.velocity[:, nearest, 2])
        self.own = at_even_times(without.time, self.time, without.velocity[..., 2])
        # The band's edges reach half a period of the lowest frequency into both ends.
        inside = slice(*(sign * round(0.5 / LOWEST / (self.time[1] - self.time[0])) for sign in (1, -1)))
        self.wave, self.own = self._band(normal - self.own)[inside], self._band(self.own)[inside]
        self.time = self.time[inside]
        aside = np.maximum(np.abs(self.place[:, 1] - self.middle[1]) - self.half, 0)
        self.away = np.hypot(self.place[:, 0] - self.middle[0], aside)
        patch = np.array([cracked.patch_at(time) for time in self.time])
        self.patch = patch
        # Half axes about the patch's centre that hold it and CLEAR about it.
        grown = patch[:, 2:4] + CLEAR
        covered = np.hypot(*((self.place[None] - patch[:, None, :2]) / grown[:, None]).transpose(2, 0, 1)) < 1
        self.looked_at = ~covered & (self.away > NEAREST)[None] & (self.away < FARTHEST)[None]

    def _band(self, values):
        step = self.time[1] - self.time[0]
        clock = np.linspace(-1, 1, len(values))
        line = np.outer(clock, clock @ values / np.sum(clock**2))
        spectrum = np.fft.rfft(values - values.mean(axis=0) - line, axis=0)
        frequency = np.fft.rfftfreq(len(values), step)
        spectrum[(frequency < LOWEST) | (frequency > HIGHEST)] = 0
        return np.fft.irfft(spectrum, len(values), axis=0)

    def when(self, time, patch):
        """Numbers of WHEN by time."""
        front = patch[:, 0] + patch[:, 2] - self.middle[0]
        return np.select([front < -FAR, front < 0, patch[:, 0] - patch[:, 2] < self.middle[0]], [0, 1, 2], 3)

    def deviation(self, values, which):
        """Of the nodes that are looked at in the outputs `which`, m/s; nan: there are none."""
        looked_at = self.looked_at & which[:, None]
        return float(np.sqrt(np.mean(values[looked_at] ** 2))) if looked_at.any() else np.nan

    def levels(self):
        """By output: mean square of the wave where it is looked for, smoothed; its root, m/s."""
        counts = np.maximum(self.looked_at.sum(axis=1), 1)
        square = np.where(self.looked_at, self.wave**2, 0).sum(axis=1) / counts
        width = max(1, round(SMOOTH / (self.time[1] - self.time[0])))
        return np.sqrt(np.convolve(square, np.ones(width) / width, mode="same"))

    def moving(self, which):
        """Of the wave ahead of the mouth in the outputs `which`: m/s, and the share of the power that goes
        outwards at it; the same inwards. nan: too few outputs or places."""
        chosen = np.flatnonzero(which)
        size = self.sound.surface.size
        edges = np.arange(NEAREST, FARTHEST + size, size)
        rings, away = [], []
        for a, b in zip(edges, edges[1:]):
            ring = (self.away >= a) & (self.away < b) & (np.abs(self.place[:, 1] - self.middle[1]) < self.half)
            ring = ring & (self.place[:, 0] > self.middle[0])  # ahead, where the wheel comes last
            if ring.any() and len(chosen) and self.looked_at[chosen][:, ring].mean() > 0.9:
                rings.append(self.wave[chosen][:, ring].mean(axis=1))
                away.append(0.5 * (a + b))
        if len(rings) < 4 or len(chosen) < 40:
            return (np.nan, np.nan), (np.nan, np.nan)
        time, total = self.time[chosen], np.mean(np.square(rings))

        def share(speed):
            late = [np.interp(time + distance / speed, time, ring) for distance, ring in zip(away, rings)]
            margin = int(abs(away[-1] / speed) / (time[1] - time[0])) + 1
            kept = slice(0, len(time) - margin) if speed > 0 else slice(margin, None)
            return np.mean(np.mean(late, axis=0)[kept] ** 2) / total

        both = []
        for sign in (1, -1):
            shares = [share(sign * speed) for speed in SPEEDS]
            both.append((float(SPEEDS[int(np.argmax(shares))]), float(max(shares))))
        return tuple(both)


def mouth_of(surface):
    """Places x and y of the mouth: of nodes that have another within a third of an element's size."""
    order = np.argsort(surface.place[:, 0])
    place = surface.place[order, :2]
    found = set()
    for k, at in enumerate(place):
        near = slice(k + 1, np.searchsorted(place[:, 0], at[0] + 0.34 * surface.size, side="right"))
        if (np.hypot(*(place[near] - at).T) < 0.34 * surface.size).any():
            found.add(k)
    if not found:
        raise ValueError("the surface has no mouth of a crack: no two nodes are at one place")
    return place[sorted(found)]


def study(found):
    """Rows of the study's table, and (name, figure)."""
    crossing = crossing_of(found["traction"], found["crack"])
    sound, cracked = crossing.sound, crossing.cracked
    patch = np.array([cracked.patch_at(time) for time in cracked.time])
    phase = crossing.when(cracked.time, patch)
    known = (cracked.time > cracked.patches[0, 0]) & (cracked.time < cracked.patches[-1, 0])
    over = (phase == 2) & known
    without = np.interp(cracked.time, sound.time, sound.normal)
    off = cracked.normal / without - 1
    nodes = cracked["history_nodes_in_contact"].astype(float)
    nodes_without = np.interp(cracked.time, sound.time, sound["history_nodes_in_contact"])
    tangential = cracked.longitudinal - np.interp(cracked.time, sound.time, sound.longitudinal)
    rows = [
        ("crack: its mouth, from the wheel's first place; across the rail", "not printed",
         f"{1e3 * (crossing.middle[0] + SPEED * cracked.earlier):.1f} mm; {2e3 * crossing.half:.0f} mm wide at least"),
        ("crack: normal force over that of the sound rail while the patch is over the mouth, most off; mean",
         "within 5 %", f"{100 * off[over][np.abs(off[over]).argmax()]:+.2f} %; {100 * off[over].mean():+.2f} %"),
        ("crack: longitudinal force less that of the sound rail there, most", "",
         f"{tangential[over][np.abs(tangential[over]).argmax()]:+.2f} kN"),
        ("crack: nodes in contact over those of the sound rail, fewest before; over the mouth", "no node lost",
         f"{(nodes / nodes_without)[known & (phase < 2)].min():.2f}; {(nodes / nodes_without)[over].min():.2f}"),
        ("crack: error of the energy balance, largest; at the end; without crack", "no energy made",
         f"{cracked.balance[np.abs(cracked.balance).argmax()]:+.3g}; {cracked.balance[-1]:+.3g};"
         f" {sound.balance[np.abs(sound.balance).argmax()]:+.3g} J"),
    ]
    surface_phase = crossing.when(crossing.time, crossing.patch)
    waves = {name: crossing.deviation(crossing.wave, surface_phase == k) for k, name in enumerate(WHEN)}
    own = {name: crossing.deviation(crossing.own, surface_phase == k) for k, name in enumerate(WHEN)}
    rows.append((f"crack: normal velocity {1e3 * NEAREST:.0f} to {1e3 * FARTHEST:.0f} mm from the mouth less that of"
                 " the sound rail, deviation (the sound rail's own)", "stronger over it than nearing",
                 ", ".join(f"{name} {waves[name]:.4f} ({own[name]:.4f})" for name in WHEN) + " m/s"))
    for k in (1, 2):
        # Over the mouth, until its middle is there: later it covers the surface ahead.
        (speed, out), (back, inwards) = crossing.moving((surface_phase == k)
                                                        & (crossing.patch[:, 0] < crossing.middle[0]))
        rows.append((f"crack, {WHEN[k]}: waves ahead of the mouth: outwards, share of their power; inwards, share",
                     "leave the crack", f"{1e-3 * speed:.2f} km/s, {out:.2f}; {1e-3 * back:.2f} km/s, {inwards:.2f}"))
    return rows, [("crack_force", draw_force(crossing, phase, without)), ("crack_waves", draw_maps(crossing)),
                  ("crack_ways", draw_ways(crossing))]


def draw_force(crossing, phase, without):
    """Forces with and without the crack; the wave's strength."""
    cracked = crossing.cracked
    figure, (force, wave) = plt.subplots(2, 1, figsize=(8, 6), sharex=True, constrained_layout=True)
    shown = (cracked.time > crossing.time[0]) & (cracked.time < crossing.time[-1])
    force.plot(1e3 * cracked.time[shown], cracked.normal[shown], color=style.MARKED, label="normal, crack")
    force.plot(1e3 * cracked.time[shown], without[shown], color=style.CURVE, linestyle="--", label="normal, sound")
    force.set_ylabel("force on the wheel, kN")
    force.legend()
    wave.plot(1e3 * crossing.time, crossing.levels(), color=style.CURVE)
    wave.set(xlabel="time, ms", ylabel="normal velocity less the sound rail's, m/s")
    for axes in (force, wave):
        over = cracked.time[shown & (phase == 2)]
        if len(over):
            axes.axvspan(1e3 * over[0], 1e3 * over[-1], color="0.9", zorder=0, label="over the mouth")
        axes.grid()
    return figure


def instants(crossing):
    """Outputs, by the crossing's time: the strongest wave while the wheel nears the mouth and while it is over it."""
    level, phase = crossing.levels(), crossing.when(crossing.time, crossing.patch)
    return [int(np.flatnonzero(phase == k)[level[phase == k].argmax()]) for k in (1, 2) if (phase == k).any()]


def draw_maps(crossing):
    """The surface at both instants: as it moves, and less the sound rail (fig. 7.9)."""
    chosen = instants(crossing)
    surface = crossing.cracked.surface
    figure, grid = plt.subplots(max(len(chosen), 1), 2, figsize=(13, 3.2 * max(len(chosen), 1)), squeeze=False,
                                constrained_layout=True)
    for (raw, less), output in zip(grid, chosen):
        time = crossing.time[output]
        near = surface.nearest(time)
        drawn = surface.draw(raw, near, surface.largest([near]))
        figure.colorbar(drawn, ax=raw, label="normal velocity, m/s")
        largest = max(np.percentile(np.abs(crossing.wave[output]), 99.5), 1e-9)
        drawn = less.tripcolor(crossing.sound.surface.mesh, crossing.wave[output], cmap=style.SIGNED_MAP,
                               vmin=-largest, vmax=largest, shading="gouraud")
        less.set_aspect("equal")
        figure.colorbar(drawn, ax=less, label="less the sound rail's, m/s")
        for axes in (raw, less):
            patch_edge(axes, crossing.patch[output])
            draw_mouth(axes, crossing.mouth)
            axes.set(xlabel="along the rail, mm", ylabel="lateral, mm", xlim=(surface.x.min(), surface.x.max()),
                     ylim=(surface.y.min(), surface.y.max()))
        raw.set_title(f"{1e3 * time:.3f} ms", fontsize=style.SMALL, loc="left")
    return figure


def draw_mouth(axes, mouth):
    axes.plot(1e3 * mouth[:, 0], 1e3 * mouth[:, 1], "k-", linewidth=2)


def draw_ways(crossing):
    """The wave on the line along the rail through the mouth's middle, by time: what goes out from the mouth."""
    size = crossing.sound.surface.size
    line = np.abs(crossing.place[:, 1] - crossing.middle[1]) < 0.75 * size
    x = np.unique(crossing.place[line, 0].round(5))
    wave = np.array([crossing.wave[:, line & (np.abs(crossing.place[:, 0] - at) < 1e-5)].mean(axis=1) for at in x]).T
    figure, axes = plt.subplots(figsize=(7, 8), constrained_layout=True)
    largest = max(np.percentile(np.abs(wave), 97), 1e-9)
    drawn = axes.pcolormesh(1e3 * x, 1e3 * crossing.time, wave, cmap=style.SIGNED_MAP, vmin=-largest, vmax=largest,
                            shading="nearest")
    axes.axvline(1e3 * crossing.middle[0], color="black", linewidth=0.8)
    for side in (-1, 1):
        axes.plot(1e3 * (crossing.patch[:, 0] + side * crossing.patch[:, 2]), 1e3 * crossing.time, "k--", linewidth=0.8)
    axes.set(xlabel="along the rail, mm; dashed: the patch", ylabel="time, ms", xlim=(1e3 * x[0], 1e3 * x[-1]))
    figure.colorbar(drawn, ax=axes, label="normal velocity less the sound rail's, m/s")
    return figure


def put_movies(steps, found):
    """The surface about both instants, an output each frame."""
    crossing = crossing_of(found["traction"], found["crack"])
    surface = crossing.cracked.surface

    def decorate(axes, output):
        patch_edge(axes, crossing.cracked.patch_at(surface.time[output]))
        draw_mouth(axes, crossing.mouth)

    for name, output in zip(("nearing", "over"), instants(crossing)):
        near = surface.nearest(crossing.time[output])
        first = max(near - FRAMES // 2, 0)
        frames = surface.frames(range(first, min(first + FRAMES, len(surface.time))), f"crack, {name}", decorate)
        path = steps.path(f"crack_{name}.gif")
        put_movie(frames, str(path), MOVIE_RATE)
        print(path)
