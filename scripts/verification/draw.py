"""Pictures of computed against exact."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def save(outcome, path, title):
    count = len(outcome.curves)
    if count == 0:
        return
    columns = min(3, count)
    rows = (count + columns - 1) // columns
    figure, axes = plt.subplots(rows, columns, figsize=(4.6 * columns, 3.4 * rows), squeeze=False)
    for place in axes.flat[count:]:
        place.set_visible(False)
    for place, (name, abscissa, ordinate, curves) in zip(axes.flat, outcome.curves):
        for label, x, y, style in curves:
            place.plot(x, y, style, label=label, markersize=4, linewidth=1.2)
        place.set_title(name, fontsize=9)
        place.set_xlabel(abscissa, fontsize=8)
        place.set_ylabel(ordinate, fontsize=8)
        place.tick_params(labelsize=7)
        place.grid(alpha=0.3)
        place.legend(fontsize=7)
    figure.suptitle(title, fontsize=10)
    figure.tight_layout()
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=90)
    plt.close(figure)
    print(path)
