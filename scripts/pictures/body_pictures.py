"""Bodies or the whole scene coloured by a field, deformed: a picture of one instant, or the frames of a movie."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from PIL import Image

from . import style
from .bodies import read_bodies
from .quantities import Quantity
from .view import View, read_view

EDGES_UP_TO = 6000  # faces: with more the lines of the mesh would hide the colours
SMOOTH_UP_TO = 20000  # faces: with more a PDF or SVG holds them as an image
DARKEST = 0.85  # of a face turned from the light


class Stage:
    """What is drawn, from where, with which colours: the same for all frames."""

    def __init__(self, results, show, by="displacement", scale=1.0, view="iso", outputs=None, limits=None, box=None):
        """`outputs`: a function from the times of all outputs to the numbers of those wanted."""
        self.title, self.scale = results.title, scale
        self.bodies, count = read_bodies(results, show, box)
        self.times = self.bodies[0].group["time"][:count]
        self.outputs = np.atleast_1d(outputs(self.times) if outputs else np.arange(count))
        groups = [body.group for body in self.bodies]
        # What has no displacement is drawn where it began.
        self.quantity = Quantity(by, groups) if by else None
        self.view = View(*read_view(view))
        if scale != 1:
            for body in self.bodies:
                body.check_whether_it_travels(self.outputs)
        self._survey(limits, box)

    def _survey(self, limits, box):
        """Bounds on the picture, and of the values of faces turned towards the eye, over all outputs."""
        low, high = np.full(2, np.inf), np.full(2, -np.inf)
        least, most = np.inf, -np.inf
        for output in self.outputs:
            for body in self.bodies:
                corners = body.corners(output, self.scale)
                flat = self.view.flat(corners).reshape(-1, 2)
                flat = flat[np.isfinite(flat).all(axis=1)]
                if len(flat):
                    low, high = np.minimum(low, flat.min(axis=0)), np.maximum(high, flat.max(axis=0))
                if self.quantity:
                    values = body.values(self.quantity, output)[self.view.painted(corners, body.is_surface)[0]]
                    values = values[np.isfinite(values)]
                    if len(values):
                        least, most = min(least, values.min()), max(most, values.max())
        margin = 0.03 * max(*(high - low), 1e-9)
        self.low, self.high = low - margin, high + margin
        if not np.isfinite(least):
            least, most = 0.0, 1.0
        if limits is not None:
            self.least, self.most = limits
        elif self.quantity and self.quantity.signed:
            self.most = max(abs(least), abs(most)) or 1.0
            self.least = -self.most
        else:
            self.least, self.most = min(0.0, least), most if most > 0 else 1.0
        self.beyond = (least < self.least, most > self.most)

    def faces(self):
        return sum(len(body.faces) for body in self.bodies)

    def notes(self):
        """What the picture does that nobody asked for."""
        if self.scale != 1:
            for body in self.bodies:
                if body.travels:
                    yield (
                        f"{body.name} travels or turns: its rigid motion is drawn as it is, its deformation"
                        f" {self.scale:g} times"
                    )
        for body in self.bodies:
            if not body.moves:
                yield f"{body.name} is drawn undeformed: the run wrote no displacement of it (output.fields)"

    def colours(self):
        """Colours (m, 4) of values, the mapping for a colour bar, its factor and its label."""
        size = max(abs(self.least), abs(self.most))
        factor, unit = style.unit_of(size, self.quantity.unit)
        norm = plt.Normalize(factor * self.least, factor * self.most)
        return (
            plt.cm.ScalarMappable(norm, style.SIGNED_MAP if self.quantity.signed else style.SIZE_MAP),
            factor,
            style.label_of(self.quantity.name, unit),
        )


class Frame:
    """A figure that shows one output after another."""

    def __init__(self, stage, resolution=100):
        self.stage = stage
        width, height = stage.high - stage.low
        ratio = np.clip(height / width, 0.18, 1.2)
        self.figure = plt.figure(figsize=(8, 8 * 0.78 * ratio + 1.35), dpi=resolution)
        space = self.figure.get_figheight()
        self.axes = self.figure.add_axes([0.09, 0.65 / space, 0.74, 1 - 1.3 / space])
        self.heading = self.figure.suptitle("", y=1 - 0.12 / space, va="top")
        self._set_axes()
        self.map, self.factor, label = stage.colours()
        self.both_sides = np.concatenate([np.full(len(body.faces), body.is_surface) for body in stage.bodies])
        self.faces = PolyCollection([], rasterized=stage.faces() > SMOOTH_UP_TO)
        self.axes.add_collection(self.faces)
        bar = self.figure.colorbar(
            self.map,
            cax=self.figure.add_axes([0.86, 0.65 / space, 0.022, 1 - 1.3 / space]),
            extend={(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}[
                stage.beyond
            ],
        )
        bar.set_label(label)

    def _set_axes(self):
        axes, stage = self.axes, self.stage
        axes.set_xlim(stage.low[0], stage.high[0])
        axes.set_ylim(stage.low[1], stage.high[1])
        axes.set_aspect("equal", anchor="C")
        factor, unit = style.unit_of(max(stage.high - stage.low) / 3, "m")
        across = stage.view.along()
        if across:
            for (name, sign), axis in zip(across, (axes.xaxis, axes.yaxis)):
                axis.set_major_formatter(
                    lambda x, _, sign=sign: f"{sign * factor * x + 0.0:.6g}".replace("-", "\N{MINUS SIGN}")
                )
                axis.set_label_text(style.label_of(name, unit))
            return
        axes.axis("off")
        self._draw_triad(factor, unit)

    def _draw_triad(self, factor, unit):
        """The global axes as seen from here, and a length to compare with, in the lower left corner."""
        view, inset = self.stage.view, self.figure.add_axes(
            [0.005, 0.005, 0.8 / self.figure.get_figwidth(), 0.8 / self.figure.get_figheight()]
        )
        for name, direction in zip("xyz", view.flat(np.eye(3))):
            inset.annotate("", direction, (0, 0), arrowprops={"arrowstyle": "->", "linewidth": 1})
            inset.text(*(1.25 * direction), name, ha="center", va="center", fontsize=style.SMALL)
        inset.set(xlim=(-1.3, 1.3), ylim=(-1.3, 1.3), aspect="equal")
        inset.axis("off")
        length = _round(0.2 * (self.stage.high - self.stage.low)[0] * factor)
        x, y = self.axes.get_xlim()[0], self.axes.get_ylim()[0]
        bar = self.axes.plot(
            [x + 0.04 * np.diff(self.axes.get_xlim())[0] + t * length / factor for t in (0, 1)],
            [y, y],
            color="black", linewidth=2, clip_on=False,
        )[0]
        self.axes.annotate(
            f"{length:g} {unit}",
            (np.mean(bar.get_xdata()), y),
            xytext=(0, -4), textcoords="offset points", ha="center", va="top", fontsize=style.SMALL,
            annotation_clip=False,
        )

    def show(self, output):
        stage = self.stage
        corners = np.concatenate([body.corners(output, stage.scale) for body in stage.bodies])
        values = np.concatenate([body.values(stage.quantity, output) for body in stage.bodies])
        seen, polygons, light = stage.view.painted(corners, self.both_sides)
        colours = self.map.to_rgba(self.factor * values[seen])
        colours[~np.isfinite(values[seen])] = (0.6, 0.6, 0.6, 1)
        colours[:, :3] *= (DARKEST + (1 - DARKEST) * light)[:, None]
        self.faces.set_verts(polygons, closed=True)
        self.faces.set_facecolor(colours)
        lines = stage.faces() <= EDGES_UP_TO
        self.faces.set_edgecolor((0, 0, 0, 0.45) if lines else colours)
        self.faces.set_linewidth(0.25 if lines else 0.2)
        magnified = f", deformation {stage.scale:g} times" if stage.scale != 1 else ""
        self.heading.set_text(f"{stage.title}\nt = {1e3 * stage.times[output]:.4f} ms{magnified}")

    def image(self):
        self.figure.canvas.draw()
        return Image.fromarray(np.asarray(self.figure.canvas.buffer_rgba())).convert("RGB")

    def close(self):
        plt.close(self.figure)


def _round(value):
    """The largest of 1, 2, 5 times a power of ten that is not above it."""
    power = 10.0 ** np.floor(np.log10(value))
    return max(f * power for f in (1, 2, 5) if f * power <= value * (1 + 1e-12))


def movie_frames(stage, resolution):
    """RGB images of all outputs of a stage."""
    frame = Frame(stage, resolution)
    images = []
    for output in stage.outputs:
        frame.show(output)
        images.append(frame.image())
    frame.close()
    return images
