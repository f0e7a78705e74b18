"""The contact at the instants of figure 5.6 beside half-spaces that have the run's own forces, profiles as they meet
and rigid motions (scripts/half_space)."""

import matplotlib.pyplot as plt
import numpy as np

from cases import SOLUTIONS
from pictures import style
from verification.draw import centre_line
from verification.exact import Steel
from verification.measured import largest_patches
from verification.of_run import Beside


def beside(steps, found):
    """Name of the solution to a Beside, of those whose case was run."""
    compared = {}
    for name, solution in SOLUTIONS.items():
        if solution.case in found:
            one = found[solution.case]
            # Outputs are whole steps away from the instants.
            time = solution.time - one.earlier
            rows = largest_patches(steps.program, one.results, "tread", time - 1.6e-5, time + 1.6e-5)
            row = min(rows, key=lambda row: abs(float(row["time"]) - time))
            compared[name] = Beside(one.results, "tread", row, Steel)
    return compared


def findings(compared):
    """Rows of the study's table."""
    rows = []
    for name, one in compared.items():
        of = {what: (own, theory) for what, own, theory in one.figures()}
        line, whole = (of[f"shear {where}, L2 off"][0] for where in ("along the centre line", "over the patch"))
        own, theory = of["stick share, by force"]
        rows += [
            (f"{name} beside half-spaces: shear along the centre line, over the patch (L2)", "8 %",
             f"{100 * line:.1f}, {100 * whole:.1f} %"),
            (f"{name}: share that sticks", f"{theory:.3f}", f"{own:.3f}", f"{own - theory:+.3f}"),
            (f"{name}: direction of the shear, mean off", "5 deg",
             f"{of['direction of the shear, mean off, deg'][0]:.1f} deg"),
            (f"{name}: peak pressure, peak shear", *(
                f"{1e-6 * of['peak pressure, Pa'][k]:.0f}, {1e-6 * of['peak shear, Pa'][k]:.0f} MPa" for k in (1, 0))),
            (f"{name}: creepages of half-spaces, along and across", "", ", ".join(
                f"{100 * one.solution.creepages[c]:+.3f} %" for c in (0, 1))),
        ]
    return rows


def draw(compared):
    """Of each solution the shear along the centre line, and the shear of the run and of half-spaces over the patch with
    what sticks and slips."""
    figure, grid = plt.subplots(3, len(compared), figsize=(3.2 * len(compared) + 1, 9), squeeze=False, sharey="row",
                                constrained_layout=True, gridspec_kw={"height_ratios": [1, 1.2, 1.2]})
    longest = max(np.linalg.norm(one.shear[one.own], axis=1).max() for one in compared.values())
    for (line, run, theory), (name, one) in zip(grid.T, compared.items()):
        centre_line(line, one)
        line.set_title(f"{name}: case {SOLUTIONS[name].case}, {1e3 * SOLUTIONS[name].time:.2f} ms", fontsize=style.TEXT)
        place, shear = 1e3 * one.place[one.own], one.shear[one.own]
        slips = one.slipping[one.own] != 1
        for axes, x, y, arrows, slip in (
            (run, *place[:, :2].T, shear, slips),
            (theory, *thinned(one.solution)),
        ):
            for which, colour in ((~slip, "tab:blue"), (slip, "tab:red")):
                axes.quiver(x[which], y[which], *arrows[which].T, color=colour, angles="xy", scale_units="xy",
                            scale=longest / 2.5, width=0.004)
            axes.set_aspect("equal")
            axes.grid(alpha=0.3)
        theory.set_xlabel("along, mm")
    grid[0, 0].set_ylabel("shear on the wheel, MPa")
    grid[0, 0].legend(fontsize=style.TINY)
    grid[1, 0].set_ylabel("run: across, mm\nblue sticks, red slips")
    grid[2, 0].set_ylabel("half-spaces: across, mm")
    return figure


def thinned(solution):
    """Cells about a millimetre apart: places, mm, shear, slip."""
    every = [max(1, round(1e-3 / size)) for size in (solution.h, solution.k)]
    kept = (solution.column % every[0] == 0) & (solution.row % every[1] == 0)
    return 1e3 * solution.x[kept], 1e3 * solution.y[kept], solution.shear[kept], solution.slips[kept]
