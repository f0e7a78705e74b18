"""Pictures of computed against exact."""

import matplotlib.pyplot as plt
import numpy as np
from pictures import style
from pictures.output import check_places, put_figure

style.apply()


def check(path, overwrite):
    """Before the run: whether its picture may be written."""
    if path.parent.is_dir():
        check_places("verify_contact", [path], overwrite)


def save(outcome, path, title, overwrite=False):
    count = len(outcome.curves)
    if count == 0:
        return
    columns = min(3, count)
    rows = (count + columns - 1) // columns
    figure, axes = plt.subplots(rows, columns, figsize=(4.6 * columns, 3.4 * rows), squeeze=False)
    for place in axes.flat[count:]:
        place.set_visible(False)
    for place, (name, abscissa, ordinate, curves) in zip(axes.flat, outcome.curves):
        for label, x, y, line in curves:
            place.plot(x, y, line, label=label, markersize=4, linewidth=1.2)
        place.set_title(name, fontsize=style.TEXT)
        place.set_xlabel(abscissa, fontsize=style.SMALL)
        place.set_ylabel(ordinate, fontsize=style.SMALL)
        place.tick_params(labelsize=style.TINY)
        place.grid(alpha=0.3)
        place.legend(fontsize=style.TINY)
    figure.suptitle(title, fontsize=style.TITLE)
    figure.tight_layout()
    path.parent.mkdir(parents=True, exist_ok=True)
    put_figure(figure, str(path), style.RESOLUTION, overwrite)
    plt.close(figure)
    print(path)


def centre_line(axes, one):
    """Shear and its bound along the centre line of a Beside, of the run and of half-spaces."""
    solution = one.solution
    y = np.average(solution.y, weights=solution.pressure)
    row = np.flatnonzero(solution.row == solution.row[np.abs(solution.y - y).argmin()])
    row = row[np.argsort(solution.x[row])]
    node = one.own & (np.abs(one.place[:, 1] - y) < 0.5 * np.sqrt(one.area))
    node = np.flatnonzero(node)[np.argsort(one.place[node, 0])]
    axes.plot(1e3 * solution.x[row], 1e-6 * solution.friction * solution.pressure[row], "k:", label="bound")
    for c, (name, colour) in enumerate((("along", "tab:red"), ("across", "tab:blue"))):
        axes.plot(1e3 * solution.x[row], 1e-6 * solution.shear[row, c], color=colour, label=f"half-spaces, {name}")
        axes.plot(1e3 * one.place[node, 0], 1e-6 * one.shear[node, c], "o", ms=3, color=colour, label=name)
    axes.set_title(f"{1e3 * one.time:.3f} ms", fontsize=10)
    axes.set_xlabel("along, mm")
    axes.grid(alpha=0.3)
