"""Steady rolling of a straight roller on a crown against Kalker's theory: the six force sets of thesis table 5.2 as
CONTACT solved them, and longitudinal creepage, lateral creepage and spin alone as verification.half_space does. SI
units."""

import csv
import pathlib
from dataclasses import dataclass

import numpy as np

from verification.exact import Hertz
from verification.half_space import SteadyRolling, converged, creepage_for_force
from verification.measured import enclosed, outlines, stick_shares
from verification.setting import RADIUS, Outcome, rolling_motion, steady, zone

DATA = pathlib.Path(__file__).resolve().parents[2] / "data" / "contact"
SPEED, HEIGHT, WAY, RADIUS_ACROSS = 40.0, 0.4598815, 0.050, 0.30
# The pressed roller rolls freely on a radius that is smaller by this share, which `free` finds: half-spaces know
# nothing of it.
FREE_ROLLING = 4.28e-5
# Longitudinal, lateral, spin (1/m); friction. Some 55 % of the patch slip. Little friction lets little spin do that:
# the roller, which turns with it on its way, stays almost straight.
PURE = {"longitudinal": ((0.0040, 0, 0), 0.45), "lateral": ((0, 0.0045, 0), 0.45), "spin": ((0, 0, 0.35), 0.20)}


@dataclass
class Exact:
    """What a run came out with ought to be: tangential force over friction times normal force, its angle, the creepage
    that these forces need beside that which the run has, share of stick, and the shear on a grid (x, y, shear)."""
    share: float
    angle: float
    creepage: float
    needed: float
    stick: float
    grid: tuple
    source: str


class CreepLaw:
    """Vermeulen and Johnson's law, 1 - T / mu N = (1 - u)^3, its two stiffnesses fitted to one solution of CONTACT:
    turns a small difference of forces into one of creepages. Creepages go with the cube root of the normal force."""

    def __init__(self, row, friction):
        self.friction, self.normal = friction, row["normal_N"]
        force = np.array([row["longitudinal_N"], row["lateral_N"]])
        self.stiffness = self._reach(force, self.normal) / np.array(
            [row["longitudinal_creepage"], row["lateral_creepage"]]
        )

    def _reach(self, force, normal):
        size = np.hypot(*force)
        return (1 - (max(0, 1 - size / (self.friction * normal))) ** (1 / 3)) * force / size

    def creepage(self, force, normal):
        return self._reach(force, normal) / self.stiffness * (normal / self.normal) ** (1 / 3)


def table_5_2():
    with open(DATA / "table_5_2.csv", encoding="utf-8") as file:
        return {row["set"]: {k: float(v) for k, v in row.items() if k != "set"} for row in csv.DictReader(file)}


def reference_field(letter):
    """x, y in m, shear in Pa on CONTACT's grid, for interpolation; None where there is none."""
    path = DATA / f"field_{letter}.csv"
    if not path.exists():
        return None
    values = np.loadtxt(path, delimiter=",", skiprows=1)
    x, y = np.unique(values[:, 0]), np.unique(values[:, 1])
    shear = np.full((len(y), len(x), 2), np.nan)
    shear[np.searchsorted(y, values[:, 1]), np.searchsorted(x, values[:, 0])] = values[:, 3:5]
    return 1e-3 * x, 1e-3 * y, 1e6 * shear


def interpolate(grid, px, py):
    """Bilinear; nan outside."""
    x, y, values = grid
    i, j = np.searchsorted(x, px) - 1, np.searchsorted(y, py) - 1
    good = (i >= 0) & (i < len(x) - 1) & (j >= 0) & (j < len(y) - 1)
    i, j = np.clip(i, 0, len(x) - 2), np.clip(j, 0, len(y) - 2)
    s, t = ((px - x[i]) / (x[i + 1] - x[i]))[..., None], ((py - y[j]) / (y[j + 1] - y[j]))[..., None]
    result = (
        (1 - s) * (1 - t) * values[j, i]
        + s * (1 - t) * values[j, i + 1]
        + (1 - s) * t * values[j + 1, i]
        + s * t * values[j + 1, i + 1]
    )
    return np.where(good[..., None], result, np.nan)


def motion_of(creepages, normal, speed=SPEED):
    """Overrides. Spin: the roller turns at a constant rate about an axis that leans from y towards z, so that its
    lowest point has no velocity across. Its own axis meanwhile turns about z, by the spin times the way s, and about x,
    by spin s^2 / 2 R, which moves the patch off the crown's middle; the creepage along is made zero there at the middle
    of the last quarter."""
    longitudinal, lateral, spin = creepages
    height = HEIGHT + 0.9 * (
        Hertz(126680, RADIUS, RADIUS_ACROSS).approach - Hertz(normal, RADIUS, RADIUS_ACROSS).approach
    )
    aside = RADIUS_ACROSS * spin * (7 / 8 * WAY) ** 2 / (2 * RADIUS)
    turning = speed * (1 + longitudinal + FREE_ROLLING + spin * aside) / RADIUS
    return rolling_motion(speed, -lateral * speed, turning, height, spin * speed)


def exact_set(letter, hertz, force, solution):
    row = table_5_2()[letter]
    wished = np.array([row["longitudinal_N"], row["lateral_N"]])
    found = CreepLaw(row, 0.45).creepage(force, hertz.force)
    given = np.hypot(row["longitudinal_creepage"], row["lateral_creepage"])
    grid = reference_field(letter)
    if grid is None:
        grid, source = solution.grid(), "half-spaces"
    else:
        scale, source = hertz.a / Hertz(row["normal_N"], RADIUS, RADIUS_ACROSS).a, "CONTACT"
        grid = (grid[0] * scale, grid[1] * scale, grid[2] * scale)
    # Of the normal force that came out: at the set's own these creepages leave another share.
    at_set = SteadyRolling(Hertz(row["normal_N"], RADIUS, RADIUS_ACROSS), 0.45, solution.creepages, solution.cells)
    stick = row["adhesion_share"] * solution.stick_share / at_set.stick_share
    return Exact(
        np.hypot(*wished) / 0.45 / row["normal_N"], np.arctan2(*wished[::-1]), given, np.hypot(*found), stick, grid,
        source,
    )


def exact_pure(name, hertz, force, solution):
    creepages, friction = PURE[name]
    which = list(PURE).index(name)
    wished, stick = converged(hertz, friction, creepages, solution.cells)
    needed = creepage_for_force(hertz, friction, creepages, which, force[0 if which == 0 else 1])
    return Exact(
        np.hypot(*wished) / friction / hertz.force, np.arctan2(*wished[::-1]), creepages[which], needed, stick,
        solution.grid(), "half-spaces",
    )


def sampled_stick(solution, state, x, y):
    """Of the exact solution, known at the run's nodes only: stick shares as they are measured in the run, over the
    solution's own."""
    shear, sticks = (solution.nearest(values, x, y) for values in (solution.shear, ~solution.slips))
    pressure, friction = solution.hertz.pressure(x, y), solution.nearest(solution.coefficient, x, y)
    return np.array(stick_shares(x, y, pressure, shear, sticks, state.area, friction)) / solution.stick_share


def rolling(run, label, elements, overrides, points):
    outcome = None
    for name in points or [*"abcdef", *PURE]:
        if name == "free":
            creepages, friction, wished_normal = (-FREE_ROLLING, 0, 0), 0.45, 126680
        elif name in PURE:
            (creepages, friction), wished_normal = PURE[name], 126680
        else:
            row = table_5_2()[name]
            creepages, friction, wished_normal = (
                (row["longitudinal_creepage"], row["lateral_creepage"], 0),
                0.45,
                row["normal_N"],
            )
        size = 2 * Hertz(126680, RADIUS, RADIUS_ACROSS).b / elements
        outputs = [
            f"output.field_interval={1e-4 if elements <= 10 else 3e-4}",
            f"contacts.rolling.friction={friction:g}",
        ]
        results = run(
            f"{label}-{name}",
            "rolling",
            [
                *zone("roller", size, round(0.5 * elements), -10.4e-3, 60.4e-3, 16e-3),
                *motion_of(creepages, wished_normal), *outputs, *overrides,
            ],
        )
        if results is None:
            continue
        outcome = outcome or Outcome(results.step_size)
        if name == "free":
            outcome.figures += free_rolling(results, wished_normal)
            continue
        compare(outcome, results, name, creepages, friction, wished_normal, 4 * elements + 20)
    return outcome


rolling.contact = "rolling"


def free_rolling(results, wished_normal):
    """What is left of the creep force where a rigid roller would have none, and the creepage that would take it
    away."""
    force, swing, _ = steady(results, 0.25)
    small = 2e-4
    stiffness = SteadyRolling(Hertz(abs(force[2]), RADIUS, RADIUS_ACROSS), 0.45, (small, 0, 0)).force[0] / small
    return [("(free) normal force, N", abs(force[2]), wished_normal, ""), ("(free) creep force, N", force[0], 0.0, "N"),
            ("(free) its swing, N", swing[0], 0.0, "N"), ("(free) lateral force, N", force[1], 0.0, "N"),
            ("(free) creepage without creep force", -force[0] / stiffness, 0.0, "")]


def compare(outcome, results, name, creepages, friction, wished_normal, cells):
    force, swing, last = steady(results, 0.25)
    normal, tangential = abs(force[2]), force[:2]
    state = results.state(last[-1])
    x0, y0 = state.centre()
    x, y, shear = state.x - x0, state.y - y0, state.shear[..., :2]
    hertz = Hertz(normal, RADIUS, RADIUS_ACROSS)
    solution = SteadyRolling(hertz, friction, creepages, cells)
    exact = (exact_pure if name in PURE else exact_set)(name, hertz, tangential, solution)
    turn = np.degrees(np.angle(np.exp(1j * (np.arctan2(*tangential[::-1]) - exact.angle))))
    measured, sampled = [], []
    for k in last:
        one = results.state(k)
        px, py = one.centre()
        measured.append(one.stick_share())
        sampled.append(sampled_stick(solution, one, one.x - px, one.y - py))
    (by_line, by_count), (line_shows, count_shows) = np.mean(measured, axis=0), exact.stick * np.mean(sampled, axis=0)
    outcome.figures += [
        (f"({name}) normal force, N", normal, wished_normal, ""),
        (
            f"({name}) tangential over friction times normal force",
            np.hypot(*tangential) / friction / normal,
            exact.share,
            "",
        ),
        (f"({name}) creepage for these forces", exact.creepage, exact.needed, ""),
        (f"({name}) direction of the creep force, deg", turn, 0.0, "deg"),
        (f"({name}) swing of the creep force", swing[:2].max() / np.hypot(*tangential), 0, ""),
        (f"({name}) stick share of the patch, zero line", by_line, exact.stick, ""),
        (f"({name}) stick share of the patch, by count", by_count, exact.stick, ""),
        (f"({name}) the same of the exact solution at these nodes, zero line", line_shows, exact.stick, ""),
        (f"({name}) the same of the exact solution at these nodes, by count", count_shows, exact.stick, ""),
        (f"({name}) peak pressure, Pa", state.pressure.max(), hertz.peak, ""),
        (f"({name}) patch area, m2", enclosed(outlines(x, y, state.pressure)), hertz.area, ""),
    ]
    outcome.figures += creepages_of_motion(results, name, solution.creepages_round(1.5, 3))
    reference = interpolate(exact.grid, x, y)
    known = ~np.isnan(reference[..., 0]) & (state.slipping > 0)
    angle = np.angle((shear[known] @ [1, 1j]) / (reference[known] @ [1, 1j]), deg=True)
    weight = state.area[known] * np.linalg.norm(reference[known], axis=-1)
    outcome.figures += [
        (
            f"({name}) direction of the shear, mean off, deg",
            np.sum(weight * np.abs(angle)) / np.sum(weight),
            0.0,
            "deg",
        ),
        (
            f"({name}) shear over the patch, L2",
            float(
                np.sqrt(
                    np.sum(state.area[known, None] * (shear[known] - reference[known]) ** 2)
                    / np.sum(state.area[known, None] * reference[known] ** 2)
                )
            ),
            0,
            "",
        ),
    ]
    middle = int(np.argmin(np.abs(y[:, np.argmin(np.abs(x[0]))])))  # a row, which spin has turned a little
    inside = np.abs(x[middle]) < 1.2 * hertz.a
    line = interpolate(exact.grid, exact.grid[0], np.interp(exact.grid[0], x[middle], y[middle]))
    outcome.curves.append((f"({name}) shear along the centre line", "x, mm", "MPa", [
        (f"{exact.source}, along", 1e3 * exact.grid[0], 1e-6 * line[:, 0], "-"),
        (f"{exact.source}, across", 1e3 * exact.grid[0], 1e-6 * line[:, 1], "--"),
        ("along", 1e3 * x[middle][inside], 1e-6 * shear[middle, inside, 0], "o"),
        ("across", 1e3 * x[middle][inside], 1e-6 * shear[middle, inside, 1], "s")]))


def creepages_of_motion(results, name, creepages):
    """What `railwave contact` finds from the motion of both bodies round the patch, mean of the outputs between 0.4 and
    0.8 of the way: the ring of nodes that it takes them from lies in the fine mesh there. Its signs are those of the
    slip."""
    found = results.creepages(0.4, 0.8)
    if found is None:
        return []
    mean, scatter = found.mean(axis=0) * [-1, -1, 1], found.std(axis=0)
    figures = []
    for k, (what, unit) in enumerate(
        (("longitudinal creepage", ""), ("lateral creepage", ""), ("spin creepage, 1/m", "1/m"))
    ):
        figures.append((f"({name}) {what}, of the bodies' motion", mean[k], creepages[k], unit))
        figures.append((f"({name})     its scatter from output to output", scatter[k], 0, unit))
    return figures
