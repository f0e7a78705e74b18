"""Pictures of run time against error (verification.pareto_table): one of each scene and device, a panel for each figure
and one for the worst over its target; each method is a line over its meshes, the front is marked."""

import re

import matplotlib.pyplot as plt
from pictures import style
from pictures.output import check_places, put_figure

from verification.pareto_table import SHORT, TARGETS, errors, groups, order, spoken

style.apply()


def places(folder, rows):
    """By scene and device."""
    return {
        key: folder / ("-".join(["pareto", *re.findall(r"[a-z0-9.]+", " ".join(key).lower())]) + ".png")
        for key in groups(rows)
    }


def check(folder, rows, overwrite):
    check_places("contact_pareto", list(places(folder, rows).values()), overwrite)


def save(rows, folder, overwrite=False):
    """@return the files"""
    files = places(folder, rows)
    for (scene, device), group in groups(rows).items():
        names = ["worst_error", *(name for name in TARGETS if any(row[name] != "" for row in group))]
        columns = min(3, len(names))
        figure, axes = plt.subplots(-(-len(names) // columns), columns, squeeze=False,
                                    figsize=(4.6 * columns, 3.6 * -(-len(names) // columns)))
        for panel in axes.flat[len(names):]:
            panel.set_visible(False)
        for panel, name in zip(axes.flat, names):
            draw(panel, name, group)
        handles, labels = axes.flat[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="lower center", ncol=5, fontsize=style.TINY)
        figure.suptitle(f"{scene}, {device}", fontsize=style.TITLE)
        figure.tight_layout(rect=(0, 0.07, 1, 1))
        put_figure(figure, str(files[scene, device]), style.RESOLUTION, overwrite)
        plt.close(figure)
    return list(files.values())


def draw(panel, name, group):
    """Error, in percent or over its target, against time."""
    factor = 1 if name == "worst_error" else 100
    for k, method in enumerate(dict.fromkeys(spoken(row) for row in sorted(group, key=order))):
        mine = [row for row in sorted(group, key=order) if spoken(row) == method]
        panel.plot([row["cost"] for row in mine], [factor * size_of(row, name) for row in mine],
                   "s-" if mine[0]["algorithm"] == "multiplier" else "o--" if mine[0]["growth"] == "1" else "o-",
                   color=plt.get_cmap(style.LIST)(k % 10), markersize=4, label=method)
    front = [row for row in group if SHORT[name] in row["front"].split()]
    panel.plot([row["cost"] for row in front], [factor * size_of(row, name) for row in front], "o",
               markersize=9, fillstyle="none", color="black", label="front")
    target = 1 if name == "worst_error" else 100 * TARGETS[name][0]
    panel.axhline(target, color="grey", linewidth=0.8, linestyle=":", label="target for ten elements")
    panel.set_xscale("log")
    panel.set_yscale("log")
    seconds = "processor time, s" if group[0]["processor_s"] else "time of settling and steps, s"
    panel.set_xlabel(seconds if group[0]["unit"] == "s" else group[0]["unit"], fontsize=style.SMALL)
    panel.set_ylabel("largest error over its target" if name == "worst_error" else f"error of {SHORT[name]}, %",
                     fontsize=style.SMALL)
    panel.grid(alpha=0.3)


def size_of(row, name):
    return row["worst_error"] if name == "worst_error" else errors(row)[name]
