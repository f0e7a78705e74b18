#!/usr/bin/python3
"""Is it the run or the measure of its stick area that is off? The exact solutions of the force sets of thesis table
5.2, known only at nodes as far apart as a run's, measured as a run is (measured.stick_shares): mean and scatter over
positions of the nodes.
    scripts/verification/stick_measure.py"""

import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from verification.exact import Hertz  # noqa: E402
from verification.half_space import SteadyRolling  # noqa: E402
from verification.measured import stick_shares  # noqa: E402
from verification.rolling import RADIUS_ACROSS, table_5_2  # noqa: E402
from verification.setting import RADIUS  # noqa: E402


def sampled(solution, spacing, positions, seed=1):
    """Stick shares (zero line, count) over the solution's own share, (positions, 2)."""
    random, shares = np.random.default_rng(seed), []
    for _ in range(positions):
        along, across = (
            np.arange(-np.ceil(reach / spacing) - 1, np.ceil(reach / spacing) + 2) * spacing
            + spacing * (random.random() - 0.5)
            for reach in (solution.hertz.a, solution.hertz.b)
        )
        x, y = np.meshgrid(along, across)
        shear, sticks = (solution.nearest(values, x, y) for values in (solution.shear, ~solution.slips))
        pressure = solution.hertz.pressure(x, y)
        shares.append(stick_shares(x, y, pressure, shear, sticks, np.full(x.shape, spacing**2), solution.friction))
    return np.array(shares) / solution.stick_share


def main():
    minor = 2 * Hertz(126680, RADIUS, RADIUS_ACROSS).b
    print(
        "| set | zero line, ten elements | zero line, twenty | by count, ten | by count, twenty"
        " |\n|---|---|---|---|---|"
    )
    for letter, row in table_5_2().items():
        hertz = Hertz(row["normal_N"], RADIUS, RADIUS_ACROSS)
        solution = SteadyRolling(hertz, 0.45, (row["longitudinal_creepage"], row["lateral_creepage"], 0), 100)
        found = [100 * (sampled(solution, minor / elements, 40) - 1) for elements in (10, 20)]
        cells = [f"{f[:, k].mean():+.1f} +- {f[:, k].std():.1f} %" for k in (0, 1) for f in found]
        print(f"| ({letter}) | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
