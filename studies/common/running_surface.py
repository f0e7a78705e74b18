"""Velocity of a rail's running surface, less that of the whole: maps with the normal component as colour and the
tangential one as arrows (thesis fig. 4.25 to 4.28, 7.1 to 7.9), and movies of them."""

import h5py
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.tri import Triangulation
from PIL import Image

from pictures import style
from pictures.panels import nice

ARROWS = 2.5  # mm between them


class RunningSurface:
    """An output set on the running surface, at the outputs of its windows."""

    def __init__(self, results, name, start=0.0):
        """start: m, what is added to places along the rail in pictures"""
        with h5py.File(results, "r") as file:
            group = file[f"fields/{name}"]
            self._set(*(group[values][:] for values in ("time", "coordinates", "connectivity", "velocity")), start)

    @classmethod
    def of(cls, time, place, facets, velocity):
        """Of arrays as the results file has them."""
        made = cls.__new__(cls)
        made._set(time, place, facets, velocity, 0.0)
        return made

    def _set(self, time, place, facets, velocity, start):
        self.time, self.place, self.facets, self.velocity = time, place, facets, velocity  # m, in the case's axes
        edges = np.linalg.norm(place[facets[:, 0]] - place[facets[:, 1]], axis=1)
        self.size = float(np.median(edges))
        self.x, self.y = 1e3 * (place[:, 0] + start), 1e3 * place[:, 1]  # mm
        self.mesh = Triangulation(self.x, self.y, np.vstack([facets[:, [0, 1, 2]], facets[:, [0, 2, 3]]]))
        spots = np.round(np.column_stack([self.x, self.y]) / ARROWS)
        self.with_arrow = np.unique(spots, axis=0, return_index=True)[1]

    def nearest(self, time):
        return int(np.abs(self.time - time).argmin())

    def between(self, begin, end):
        return np.flatnonzero((self.time >= begin) & (self.time <= end))

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
        axes.set_aspect("equal")
        axes.set_xlim(self.x.min(), self.x.max())
        axes.set_ylim(self.y.min(), self.y.max())
        return drawn

    def frames(self, outputs, name, decorate=None):
        """Frames of a movie, one each output; `decorate` draws more into the axes at an output."""
        largest = self.largest(outputs)
        figure, axes = plt.subplots(figsize=(9, 3.4), dpi=style.MOVIE_RESOLUTION, constrained_layout=True)
        bar, frames = None, []
        for output in outputs:
            axes.clear()
            drawn = self.draw(axes, output, largest)
            if decorate:
                decorate(axes, output)
            bar = bar or figure.colorbar(drawn, ax=axes, label="normal velocity, m/s")
            axes.set_title(f"{name}: {1e3 * self.time[output]:.3f} ms", fontsize=style.SMALL)
            axes.set_xlabel("place along the rail, mm")
            axes.set_ylabel("lateral, mm")
            figure.canvas.draw()
            frames.append(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB"))
        plt.close(figure)
        return frames
