#!/usr/bin/python3
"""Draws docs/pictures/stability.png and writes the tables of docs/stability.md from results/stability-*.csv."""

import argparse
import os
import sys

sys.dont_write_bytecode = True
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from report import Results  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
DOCS = os.path.join(HERE, "..", "docs")
ESTIMATES = {"element": "#c46a00", "eigenvalue": "#0a7a4a", "global": "#10407f", "automatic": "#8a1538"}
DEFAULT_SCALE = 0.9
BEGIN, END = "<!-- tables of benchmarks/report_stability.py -->", "<!-- end of tables -->"


class Scene:
    def __init__(self, row):
        self.kind, self.mesh, self.hourglass, self.precision = (
            row["kind"],
            row["mesh"],
            row["hourglass"],
            row["precision"],
        )
        for name in (
            "coefficient",
            "penalty_scale",
            "calm",
            "wild",
            "exact",
            "element",
            "eigenvalue",
            "global",
            "automatic",
            "calm_in_twice",
        ):
            if name in row:  # results of programs before that estimate have no such column
                setattr(self, name, float(row[name]))
        self.elements = int(row["elements"])

    def ratio(self, estimate):
        return getattr(self, estimate) / self.calm

    @property
    def own(self):
        """With the hourglass control and the penalty scale that a case has by default."""
        return (self.hourglass, self.coefficient) in (("viscous", 0.1), ("stiffness", 0.05)) and self.penalty_scale in (
            0,
            1,
        )


def spread(values):
    values = list(values)
    return f"{min(values):.3f}" if max(values) - min(values) < 5e-4 else f"{min(values):.3f} to {max(values):.3f}"


def groups(scenes):
    found = {}
    for scene in scenes:
        found.setdefault((scene.kind, scene.mesh), []).append(scene)
    return found


def picture(scenes, path):
    pressed = any(scene.kind == "contact" for scene in scenes)
    panels = 3 if pressed else 2
    figure, axes = plt.subplots(1, panels, figsize=(5 * panels, 7), gridspec_kw={"width_ratios": [1.5, 1, 1][:panels]})
    left, middle = axes[:2]
    named = groups(scenes)
    for place, ((kind, mesh), members) in enumerate(named.items()):
        for offset, (estimate, colour) in zip((-0.27, -0.09, 0.09, 0.27), ESTIMATES.items()):
            values = [scene.ratio(estimate) for scene in members]
            left.plot(
                [min(values), max(values)],
                [place + offset] * 2,
                color=colour, linewidth=4, alpha=0.35, solid_capstyle="butt",
            )
            left.plot(values, [place + offset] * len(values), "|", color=colour, markersize=6)
    left.axvline(1, color="0.2", linewidth=1)
    left.set_yticks(
        range(len(named)), [f"{mesh}" + (" (contact)" if kind == "contact" else "") for kind, mesh in named]
    )
    left.invert_yaxis()
    left.set(xlabel="predicted over observed critical step", title="every scene; beyond 1 is unsafe")
    left.grid(axis="x", color="0.9")
    left.legend(
        handles=[plt.Line2D([], [], color=colour, linewidth=4, label=name) for name, colour in ESTIMATES.items()],
        fontsize=8,
        loc="lower left",
    )

    def curves(axis, members, across, styles):
        for (label, chosen), style in zip(members.items(), styles):
            chosen = sorted((s for s in chosen), key=lambda s: getattr(s, across))
            if not chosen:
                continue
            x = [getattr(s, across) for s in chosen]
            axis.plot(x, [s.calm / s.element for s in chosen], style, markersize=4, label=label)
        axis.axhline(DEFAULT_SCALE, color="0.3", linewidth=1, linestyle="--")
        axis.text(
            0.98, DEFAULT_SCALE, "default step_scale", transform=axis.get_yaxis_transform(), ha="right", va="top",
            fontsize=8,
        )
        axis.set(xscale="log", ylabel="observed critical step over the element estimate")
        axis.grid(color="0.9")
        axis.legend(fontsize=7)

    double = [s for s in scenes if s.precision == "double"]
    bodies = {
        f"{mesh}, {kind}": [s for s in double if s.kind == "body" and s.mesh == mesh and s.hourglass == kind]
        for mesh in ("cubes", "warped", "warped plate", "plate", "skewed to 20 degrees")
        for kind in ("viscous", "stiffness")
    }
    curves(middle, bodies, "coefficient", [f"{c}{l}" for c in ("C0o", "C1o", "C2o", "C3o", "C4o") for l in ("-", "--")])
    middle.set(xlabel="hourglass coefficient", title="hourglass control")
    if pressed:
        contacts = {
            f"{mesh}, {kind}": [s for s in double if s.kind == "contact" and s.mesh == mesh and s.hourglass == kind]
            for mesh in ("matched", "flat elements", "nodes between nodes", "plate on plate")
            for kind in ("viscous", "stiffness")
        }
        curves(
            axes[2], contacts, "penalty_scale", [f"{c}{l}" for c in ("C0o", "C1o", "C2o", "C3o") for l in ("-", "--")]
        )
        axes[2].set(xlabel="penalty scale", title="contact springs")
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    plt.close(figure)


def tables(results, scenes):
    text = [
        "; ".join(f"`{one.facts['command']}`, {one.facts['date']}" for one in results) + f": {len(scenes)} scenes.\n",
        f"| scene | scenes | {' | '.join(ESTIMATES)} | exact |",
        "|---|---|" + "---|" * (len(ESTIMATES) + 1),
    ]
    for (kind, mesh), members in groups(scenes).items():
        exact = [s.exact / s.calm for s in members if s.exact > 0]
        text.append(
            f"| {'contact: ' if kind == 'contact' else ''}{mesh} | {len(members)} | "
            + " | ".join(spread(s.ratio(e) for s in members) for e in ESTIMATES)
            + f" | {spread(exact) if exact else ''} |"
        )
    text.append(
        "| **all** | "
        + f"{len(scenes)} | "
        + " | ".join(f"**{spread(s.ratio(e) for s in scenes)}**" for e in ESTIMATES)
        + " | |"
    )
    for precision in ("double", "mixed", "float"):
        same = [s for s in scenes if s.precision == precision and s.own]
        if same:
            text.append(
                f"| defaults, {precision} | {len(same)} | "
                + " | ".join(spread(s.ratio(e) for s in same) for e in ESTIMATES)
                + " | |"
            )
    twice = min(s.calm_in_twice / s.calm for s in scenes)
    text.append(f"\nOver twice the steps the border is lower by at most {100 * (1 - twice):.2f} %.\n")
    text.append("| with the default step_scale 0.9 | used over observed critical step, most |\n|---|---|")
    for estimate in ESTIMATES:
        text.append(f"| {estimate} | {DEFAULT_SCALE * max(s.ratio(estimate) for s in scenes):.3f} |")
    return "\n".join(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "results",
        nargs="*",
        default=[os.path.join(HERE, "results", f"stability-{kind}.csv") for kind in ("body", "contact", "rolling")],
    )
    parser.add_argument("--docs", default=DOCS, help="folder of stability.md and pictures/")
    arguments = parser.parse_args()
    results = [Results(path) for path in arguments.results]
    scenes = [Scene(row) for one in results for row in one.rows]
    for estimate in list(ESTIMATES):
        if not all(hasattr(scene, estimate) for scene in scenes):
            del ESTIMATES[estimate]
    picture(scenes, os.path.join(arguments.docs, "pictures", "stability.png"))
    page = os.path.join(arguments.docs, "stability.md")
    with open(page, encoding="utf-8") as file:
        before, rest = file.read().split(BEGIN)
        after = rest.split(END)[1]
    with open(page, "w", encoding="utf-8") as file:
        file.write(before + BEGIN + "\n" + tables(results, scenes) + "\n" + END + after)


main()
