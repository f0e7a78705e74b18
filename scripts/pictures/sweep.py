"""The table of `railwave sweep` (docs/sweep.md): each figure against each parameter."""

import h5py
import matplotlib.pyplot as plt
import numpy as np

from . import style
from .results import BadFile
from .style import scale_of

MOST_COLUMNS = 3
MOST_LINES = 12  # of members that differ in the drawn parameter only; with more of them the points say enough
MARGIN = 0.06
PREFIXED = ("m", "m/s", "m/s2", "N", "N m", "N/m", "Pa", "J", "Hz", "s", "kg")


class Column:
    """A parameter or a figure: its name, unit and values; of texts also these."""

    def __init__(self, name, values, unit, choices=()):
        self.name, self.values, self.unit, self.choices = name, values, unit, choices

    def drawn(self):
        """Values and label, with a prefix where the unit takes one."""
        if self.unit == "1":
            return self.values, self.name
        known = self.values[np.isfinite(self.values)]
        factor, prefix = scale_of(abs(known).max(initial=0)) if self.unit in PREFIXED else (1.0, "")
        return factor * self.values, f"{self.name}, {prefix}{self.unit}"


class Sweep:
    def __init__(self, path):
        try:
            with h5py.File(path, "r") as file:
                if file.attrs.get("format") != "Railwave sweep":
                    raise BadFile(f"{path} is no table that 'railwave sweep' wrote")
                self.title = str(file.attrs["title"])
                self.completed = file["status"][:] == 0
                self.parameters = self._columns(file["parameters"])
                self.figures = self._columns(file["figures"])
        except (OSError, KeyError) as error:
            raise BadFile(f"{path} cannot be read as the table of a sweep: {error}") from None

    @staticmethod
    def _columns(group):
        return [
            Column(name, data[:], str(data.attrs["unit"]), [str(one) for one in group.attrs.get(name, ())])
            for name, data in group.items()
        ]


def lines(parameters, drawn, completed):
    """Members that are alike but for the drawn parameter, each list of them ordered by that."""
    others = [column.values for column in parameters if column is not drawn]
    groups = {}
    for member in np.flatnonzero(completed):
        groups.setdefault(tuple(values[member] for values in others), []).append(member)
    return [sorted(members, key=lambda m: drawn.values[m]) for members in groups.values()]


def draw_panel(axes, sweep, figure, parameter):
    across, across_label = parameter.drawn()
    up, up_label = figure.drawn()
    alike = lines(sweep.parameters, parameter, sweep.completed)
    joined = len(alike) <= MOST_LINES
    others = [column for column in sweep.parameters if column is not parameter]
    colours = plt.get_cmap(style.SIZE_MAP)(np.linspace(0, 0.9, max(len(alike), 1)))
    for members, colour in zip(alike, colours):
        label = ", ".join(
            f"{other.name.split('.')[-1]} {other.choices[int(other.values[members[0]])]}"
            if other.choices
            else f"{other.name.split('.')[-1]} {other.values[members[0]]:.4g}"
            for other in others
        )
        axes.plot(
            across[members], up[members], "o-" if joined and len(members) > 1 else "o", markersize=3, linewidth=1,
            color=colour if joined else style.CURVE, alpha=1 if joined else 0.6, label=label if joined else None,
        )
    if parameter.choices:
        axes.set_xticks(range(len(parameter.choices)), parameter.choices)
    axes.set(xlabel=across_label, ylabel=up_label)
    axes.margins(MARGIN)
    axes.grid(alpha=0.3)
    if joined and others and len(alike) > 1:
        axes.legend(fontsize=style.TINY)


def draw_figure(sweep, figure):
    """None where no member has this figure."""
    if not np.isfinite(figure.values[sweep.completed]).any():
        return None
    columns = min(MOST_COLUMNS, len(sweep.parameters))
    rows = -(-len(sweep.parameters) // columns)
    picture, axes = plt.subplots(
        rows, columns, figsize=(4.2 * columns, 3.4 * rows), squeeze=False, constrained_layout=True
    )
    for panel in axes.flat[len(sweep.parameters) :]:
        panel.axis("off")
    for panel, parameter in zip(axes.flat, sweep.parameters):
        draw_panel(panel, sweep, figure, parameter)
    left_out = np.count_nonzero(~sweep.completed)
    note = f" ({left_out} of {len(sweep.completed)} members did not complete)" if left_out else ""
    picture.suptitle((sweep.title or figure.name) + note, fontsize=style.TEXT)
    return picture


def draw_sweep(path):
    """(name, picture) of each figure that a member has."""
    sweep = Sweep(path)
    if not sweep.parameters:
        raise BadFile(f"{path} has no parameters: all members are the case as it is")
    for figure in sweep.figures:
        yield figure.name, draw_figure(sweep, figure)
