"""Velocity of the running surface beside the gap, less that of the whole: maps with the normal component as colour and
the tangential one as arrows (fig. 4.25 to 4.28), and movies of them."""

import functools

import h5py
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.tri import Triangulation
from PIL import Image

from instants import show_gap
from passing import SETTLED, START
from pictures import style
from pictures.panels import nice

BEFORE, BEHIND, AHEAD = "track_rail.before_gap", "track_rail_2.behind_gap", "track_rail_2.ahead"
# After the first touch of the second rail, s: the wave of the impact (fig. 4.27), longer ones (4.28).
LANDING = (0, 5e-6, 10e-6, 350e-6, 372e-6)
APPROACH = (-12e-6, 0, 25e-6)  # before and after the strongest disturbance (fig. 4.25, 4.26)
ARROWS = 2.5  # mm between them
FRAMES = 50  # of a movie, one each output
MOVIE_RATE = 10  # frames a second


class Surface:
    """An output set on the running surface, at the outputs of its windows: places in mm from where the wheel began."""

    def __init__(self, results, name):
        with h5py.File(results, "r") as file:
            group = file[f"fields/{name}"]
            place = group["coordinates"][:]
            facets = group["connectivity"][:]
            self.time, self.velocity = group["time"][:], group["velocity"][:]
        self.place = place  # m, from the gap
        edges = np.linalg.norm(place[facets[:, 0]] - place[facets[:, 1]], axis=1)
        self.size = float(np.median(edges))
        self.x, self.y = 1e3 * (place[:, 0] + START), 1e3 * place[:, 1]
        self.mesh = Triangulation(self.x, self.y, np.vstack([facets[:, [0, 1, 2]], facets[:, [0, 2, 3]]]))
        spots = np.round(np.column_stack([self.x, self.y]) / ARROWS)
        self.with_arrow = np.unique(spots, axis=0, return_index=True)[1]

    def nearest(self, time):
        return int(np.abs(self.time - time).argmin())

    def last_window(self):
        """Begin and end of the last outputs that follow each other closely, s; those at the run's ends stand alone."""
        starts = np.flatnonzero(np.diff(self.time) > 10e-6) + 1
        pieces = [piece for piece in np.split(self.time, starts) if len(piece) > 2]
        return (float(pieces[-1][0]), float(pieces[-1][-1])) if pieces else (0.0, 0.0)

    def between(self, begin, end):
        return np.flatnonzero((self.time >= begin) & (self.time <= end))

    def disturbed(self, begin, end):
        """The output at which the velocity changes most from one to the next, and the node; None: fewer than ten
        outputs."""
        chosen = self.between(begin, end)
        if len(chosen) < 10:
            return None
        change = np.abs(np.diff(self.velocity[chosen], axis=0)).max(axis=2)
        output, node = np.unravel_index(change.argmax(), change.shape)
        return int(chosen[1 + output]), int(node)

    def moving(self, output):
        """Velocity less that of the surface as a whole."""
        return self.velocity[output] - np.median(self.velocity[output], axis=0)

    def largest(self, outputs):
        """Normal and tangential velocity that all but a hundredth of the nodes stay below, m/s."""
        velocity = np.array([self.moving(output) for output in outputs])
        return (max(np.percentile(np.abs(velocity[..., 2]), 99), 1e-9),
                max(np.percentile(np.hypot(velocity[..., 0], velocity[..., 1]), 99), 1e-9))

    def draw(self, axes, output, largest):
        """@return the colours' mappable"""
        normal, tangential = largest
        velocity, at = self.moving(output), self.with_arrow
        drawn = axes.tripcolor(self.mesh, velocity[:, 2], cmap=style.SIGNED_MAP, vmin=-normal, vmax=normal,
                               shading="gouraud")
        arrows = axes.quiver(self.x[at], self.y[at], velocity[at, 0], velocity[at, 1], angles="xy",
                             scale_units="xy", scale=tangential / (2 * ARROWS), color="black", width=0.0015)
        length = nice(tangential)
        axes.quiverkey(arrows, 0.9, 1.06, length, f"{length:g} m/s", labelpos="W", fontproperties={"size": style.TINY})
        show_gap(axes)
        axes.set_aspect("equal")
        axes.set_xlim(self.x.min(), self.x.max())
        axes.set_ylim(self.y.min(), self.y.max())
        return drawn


@functools.cache
def surface_of(results, name):
    """The same Surface for all that ask for it: it holds every output's velocities."""
    return Surface(results, name)


def strongest_disturbance(before, passing):
    """Of the surface before the gap in its window before the touch: output and node; None: it has none."""
    return before.disturbed(SETTLED, passing.touch - 1e-4)


def _instants(passing):
    """(surface, outputs) of the approach and of the landing; without those that no window has."""
    before, behind = surface_of(passing.results, BEFORE), surface_of(passing.results, BEHIND)
    listed = []
    if found := strongest_disturbance(before, passing):
        strongest, _ = found
        listed.append((before, sorted({before.nearest(before.time[strongest] + dt) for dt in APPROACH})))
    # Every window's end is an output too far away.
    near = [behind.nearest(passing.touch + dt) for dt in LANDING]
    near = sorted({k for k, dt in zip(near, LANDING) if abs(behind.time[k] - passing.touch - dt) < 6e-6})
    if near:
        listed.append((behind, near))
    return listed


def draw_maps(passing):
    """Figure with a map for each instant; None: no window has one."""
    panels = [(surface, output, surface.largest([output])) for surface, outputs in _instants(passing)
              for output in outputs]
    if not panels:
        return None
    figure, grid = plt.subplots(len(panels), 1, figsize=(9, 3.1 * len(panels)), squeeze=False, constrained_layout=True)
    for axes, (surface, output, largest) in zip(grid[:, 0], panels):
        drawn = surface.draw(axes, output, largest)
        later = 1e6 * (surface.time[output] - passing.touch)
        axes.set_title(f"simulation {passing.number}: {1e3 * surface.time[output]:.3f} ms,"
                       f" {later:+.0f} \N{MICRO SIGN}s from the touch", fontsize=style.SMALL, loc="left")
        axes.set_ylabel("lateral, mm")
        figure.colorbar(drawn, ax=axes, label="normal velocity, m/s")
    grid[-1, 0].set_xlabel("place along the rail, mm")
    return figure


def movies(passing):
    """(name, frames) of the approach, about the strongest disturbance, and of the landing, from the touch on."""
    names = {BEFORE: "approach", BEHIND: "impact"}
    for (surface, outputs), name in zip(_instants(passing), names.values()):
        first = max(outputs[0] - 3, 0)
        chosen = list(range(first, min(first + FRAMES, len(surface.time))))
        largest = surface.largest(chosen)
        figure, axes = plt.subplots(figsize=(9, 3.4), dpi=style.MOVIE_RESOLUTION, constrained_layout=True)
        bar, frames = None, []
        for output in chosen:
            axes.clear()
            drawn = surface.draw(axes, output, largest)
            bar = bar or figure.colorbar(drawn, ax=axes, label="normal velocity, m/s")
            axes.set_title(f"simulation {passing.number}: {1e3 * surface.time[output]:.3f} ms", fontsize=style.SMALL)
            axes.set_xlabel("place along the rail, mm")
            axes.set_ylabel("lateral, mm")
            figure.canvas.draw()
            frames.append(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB"))
        plt.close(figure)
        yield f"{name}_{passing.number}", frames
