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


def value_text(column, member):
    value = column.values[member]
    return f"{column.name.split('.')[-1]} {column.choices[int(value)] if column.choices else f'{value:.4g}'}"


def draw_lines(axes, across, up, alike, others):
    """Members that are alike but for one parameter, joined."""
    colours = plt.get_cmap(style.SIZE_MAP)(np.linspace(0, 0.9, len(alike)))
    for members, colour in zip(alike, colours):
        label = ", ".join(value_text(other, members[0]) for other in others)
        axes.plot(across[members], up[members], "o-", markersize=3, linewidth=1, color=colour, label=label)


def draw_points(axes, across, up, completed, others):
    """All members, coloured by the parameter that takes the fewest values."""
    def values_of(column):
        return np.unique(column.values[np.isfinite(column.values)])

    by = min(others, key=lambda column: (len(values_of(column)) < 2, len(values_of(column))))
    values = values_of(by)
    if len(values) > MOST_LINES:
        axes.plot(across[completed], up[completed], "o", markersize=3, color=style.CURVE, alpha=0.6)
        return
    for value, colour in zip(values, plt.get_cmap(style.SIZE_MAP)(np.linspace(0, 0.9, len(values)))):
        members = np.flatnonzero(completed & (by.values == value))
        if len(members):
            label = value_text(by, members[0])
            axes.plot(across[members], up[members], "o", markersize=3, color=colour, alpha=0.7, label=label)


def draw_panel(axes, sweep, figure, parameter):
    across, across_label = parameter.drawn()
    up, up_label = figure.drawn()
    alike = lines(sweep.parameters, parameter, sweep.completed)
    others = [column for column in sweep.parameters if column is not parameter]
    if len(alike) <= MOST_LINES or not others:
        draw_lines(axes, across, up, alike, others)
    else:
        draw_points(axes, across, up, sweep.completed, others)
    if parameter.choices:
        axes.set_xticks(range(len(parameter.choices)), parameter.choices)
    else:
        axes.ticklabel_format(useOffset=False)
        axes.tick_params(axis="x", labelrotation=20)
    axes.set(xlabel=across_label, ylabel=up_label)
    axes.margins(MARGIN)
    axes.grid(alpha=0.3)
    if others and axes.get_legend_handles_labels()[0]:
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
