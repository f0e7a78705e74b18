"""Run time against error: a table of the methods that no other beats in both, and a log-log picture."""

import math
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

COLOURS = {"double": "#10407f", "mixed": "#0a7a4a", "float": "#c46a00"}
MEASURES = {
    "bar wave": "velocity, L2",
    "graded pulse": "displacement, L2",
    "Rayleigh pulse": "displacement, L2",
    "Hertz press": "pressure, L2",
    "Cattaneo shift": "shear, L2",
}
UNSTABLE = 2.0  # a relative error above this is no solution


class Run:
    def __init__(self, row):
        self.row = row
        self.problem = row["problem"]
        self.size = float(row["element_size"])
        self.seconds = float(row["seconds"])
        self.error = float(row["error"])
        self.penalty = float(row["penalty_scale"])
        self.multiplier = row.get("contact", "penalty") == "multiplier"
        self.coefficient = float(row["hourglass_coefficient"])
        self.scale = float(row["step_scale"])
        self.subcycled = row.get("subcycling") == "1"

    @property
    def stable(self):
        return math.isfinite(self.error) and self.error < UNSTABLE

    @property
    def changes(self):
        """What differs from the program's own choice, in words."""
        row, words = self.row, []
        if row["precision"] != "double":
            words.append(row["precision"])
        if row["hourglass"] != "viscous":
            words.append(row["hourglass"])
        if self.coefficient > 0:
            words.append(f"hourglass coefficient {self.coefficient:g}")
        if row["step_rule"] != "element":
            words.append(f"{row['step_rule']} step")
        if self.scale != 0.9:
            words.append(f"step scale {self.scale:g}")
        if self.subcycled:
            words.append(f"subcycling ({float(row['updates_saved']):.2f} times fewer updates)")
        if self.multiplier:
            words.append("contact by multipliers")
        if self.penalty != 1:
            words.append(f"penalty scale {self.penalty:g}")
        return ", ".join(words) or "own choice"


def front(runs):
    """The runs that no other beats in both time and error, quickest first."""
    best, result = math.inf, []
    for run in sorted(runs, key=lambda r: (r.seconds, r.error)):
        if run.error < best:
            best = run.error
            result.append(run)
    return result


def marker(run):
    if run.subcycled:
        return "^"
    if run.multiplier:
        return "h"
    if run.penalty != 1:
        return "v" if run.penalty < 0.3 else "D"
    if run.row["step_rule"] == "global":
        return "P"
    if run.row["step_rule"] == "eigenvalue":
        return "X"
    if run.scale != 0.9:
        return "<"
    return "s" if run.row["hourglass"] == "stiffness" else "o"


MARKERS = [("o", "viscous, element step"), ("s", "stiffness hourglass"), ("X", "eigenvalue step"), ("P", "global step"),
           ("<", "step scale 0.6"), ("^", "subcycling"), ("D", "penalty scale 0.5"), ("v", "penalty scale 0.1"),
           ("h", "contact by multipliers")]


def picture(results, path):
    runs = [Run(row) for row in results.rows]
    problems = list(dict.fromkeys(run.problem for run in runs))
    columns = min(2, len(problems))
    lines = (len(problems) + columns - 1) // columns
    height = 4.2 * lines + 1.2
    figure, axes = plt.subplots(lines, columns, figsize=(5.6 * columns, height), squeeze=False)
    used = set()
    for axis, problem in zip(axes.flat, problems):
        mine = [run for run in runs if run.problem == problem and run.stable]
        edge = front(mine)
        axis.plot(
            [r.seconds for r in edge], [100 * r.error for r in edge], color="0.6", linewidth=5, alpha=0.5, zorder=1
        )
        for run in mine:
            used.add(marker(run))
            filled = run.coefficient == 0
            colour = COLOURS[run.row["precision"]]
            axis.scatter(run.seconds, 100 * run.error, marker=marker(run), s=34, edgecolors=colour, linewidths=1,
                         facecolors=colour if filled else "none", alpha=0.85, zorder=2)
        for size in sorted({run.size for run in mine}):
            group = [run for run in mine if run.size == size]
            low = min(group, key=lambda r: r.error)
            axis.annotate(
                f"{1e3 * size:.3g} mm",
                (low.seconds, 100 * low.error),
                textcoords="offset points", xytext=(-4, -11), fontsize=8, ha="right", color="0.25",
            )
        axis.set(
            xscale="log", yscale="log", title=problem, xlabel="run time, s",
            ylabel=f"error ({MEASURES.get(problem, 'L2')}), %",
        )
        axis.margins(x=0.18, y=0.12)
        axis.grid(which="both", color="0.9", linewidth=0.6)
        axis.set_axisbelow(True)
    for axis in list(axes.flat)[len(problems):]:
        axis.set_visible(False)
    precisions = [p for p in COLOURS if any(run.row["precision"] == p for run in runs)]
    handles = [Line2D([], [], color=COLOURS[p], marker="o", linestyle="", label=p) for p in precisions]
    handles += [Line2D([], [], color="0.3", marker=m, linestyle="", label=text) for m, text in MARKERS if m in used]
    handles.append(
        Line2D([], [], color="0.3", marker="o", fillstyle="none", linestyle="", label="other hourglass coefficient")
    )
    handles.append(Line2D([], [], color="0.6", linewidth=5, alpha=0.5, label="Pareto front"))
    figure.legend(handles=handles, loc="lower center", ncol=5 if columns > 1 else 2, fontsize=8, frameon=False)
    threads = results.facts.get("threads")
    where = results.facts.get("device", "") + (f", {threads} threads" if threads else "")
    figure.suptitle(f"Run time against error, {where}", fontsize=10)
    figure.tight_layout(rect=(0, 0.8 / height, 1, 1))
    figure.savefig(path, dpi=130)
    plt.close(figure)


def section(files, folder):
    text = [
        "## Run time against error\n\nProblems with a known solution (`benchmarks/problems/`). Tables: the methods that"
        " no other beats in both run time and error. *Own choice*: double, viscous hourglass control 0.1, element step"
        " times 0.9, penalty scale 1.\n"
    ]
    for results in files:
        name = f"{results.name}.png"
        picture(results, os.path.join(folder, name))
        text.append(f"### {results.name}: {results.back_end}\n\n![Run time against error]({name})\n")
        runs = [Run(row) for row in results.rows]
        for problem in dict.fromkeys(run.problem for run in runs):
            mine = [run for run in runs if run.problem == problem]
            text.append(f"**{problem}**: error of the {MEASURES.get(problem, 'solution')}\n")
            text.append("| element, mm | method | elements | steps | run time, s | error |\n|---|---|---|---|---|---|")
            for run in front([run for run in mine if run.stable]):
                text.append(
                    f"| {1e3 * run.size:.3g} | {run.changes} | {run.row['elements']} | {run.row['steps']} |"
                    f" {run.seconds:.3f} | {100 * run.error:.3f} % |"
                )
            text.append("")
            lost = [f"{run.changes} at {1e3 * run.size:.3g} mm" for run in mine if not run.stable]
            if lost:
                text.append(f"Unstable: {'; '.join(lost)}.\n")
    return "\n".join(text)
