"""Velocity of the running surface beside the gap: maps (fig. 4.25 to 4.28) and movies of them."""

import functools

import matplotlib.pyplot as plt
import numpy as np

from instants import show_gap
from passing import SETTLED, START
from pictures import style
from running_surface import RunningSurface

BEFORE, BEHIND, AHEAD = "track_rail.before_gap", "track_rail_2.behind_gap", "track_rail_2.ahead"
# After the first touch of the second rail, s: the wave of the impact (fig. 4.27), longer ones (4.28).
LANDING = (0, 5e-6, 10e-6, 350e-6, 372e-6)
APPROACH = (-12e-6, 0, 25e-6)  # before and after the strongest disturbance (fig. 4.25, 4.26)
FRAMES = 50  # of a movie, one each output
MOVIE_RATE = 10  # frames a second


class Surface(RunningSurface):
    """Beside the gap: places in pictures are from where the wheel began."""

    def __init__(self, results, name):
        super().__init__(results, name, START)

    def last_window(self):
        """Begin and end of the last outputs that follow each other closely, s; those at the run's ends stand alone."""
        starts = np.flatnonzero(np.diff(self.time) > 10e-6) + 1
        pieces = [piece for piece in np.split(self.time, starts) if len(piece) > 2]
        return (float(pieces[-1][0]), float(pieces[-1][-1])) if pieces else (0.0, 0.0)

    def disturbed(self, begin, end):
        """The output at which the velocity changes most from one to the next, and the node; None: fewer than ten
        outputs."""
        chosen = self.between(begin, end)
        if len(chosen) < 10:
            return None
        change = np.abs(np.diff(self.velocity[chosen], axis=0)).max(axis=2)
        output, node = np.unravel_index(change.argmax(), change.shape)
        return int(chosen[1 + output]), int(node)

    def draw(self, axes, output, largest):
        drawn = super().draw(axes, output, largest)
        show_gap(axes)
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
        yield f"{name}_{passing.number}", surface.frames(chosen, f"simulation {passing.number}")
