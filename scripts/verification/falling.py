"""Steady rolling with friction that falls with the speed of slip (thesis eq. 2.29): the roller of verification.rolling
against half-spaces under the same law. SI units."""

import numpy as np

from verification.exact import Hertz
from verification.half_space import FallingFriction, SteadyRolling, converged
from verification.measured import shares
from verification.rolling import RADIUS_ACROSS, WAY, motion_of, sampled_stick
from verification.setting import RADIUS, Outcome, steady, zone

# Of case 5 of the thesis's table 5.1, at its speed.
STATIC, DYNAMIC, DECAY, SPEED, NORMAL, MEMORY = 0.5, 0.32, 6.0, 27.78, 110e3, 4e-5
# Viscous control lets twenty elements' hourglass modes grow under this friction.
HOURGLASS = [f"parts.{part}.{key}" for part in ("roller", "block") for key in (
    'hourglass="stiffness"', "hourglass_coefficient=0.05")]
# A node whose coefficient is within this of that at rest has not slid within its memory.
AT_REST = 0.005
# Longitudinal, lateral, spin (1/m).
POINTS = {
    "along 0.2 %": (0.002, 0, 0), "along 0.5 %": (0.005, 0, 0), "along 1 %": (0.01, 0, 0),
    "across 0.5 %": (0, 0.005, 0), "both 0.35 %": (0.0035, 0.0035, 0), "spin 0.35/m": (0, 0, 0.35),
}


def falling(run, label, elements, overrides, points):
    """Runs with the usual memory; with another where the overrides give friction_memory."""
    memory = MEMORY
    for override in [*overrides, *run.choice.overrides]:
        key, _, value = override.partition("=")
        if key == "contacts.rolling.friction_memory":
            memory = float(value)
    law = FallingFriction(STATIC, DYNAMIC, DECAY, SPEED, memory)
    outcome = None
    for name in points or POINTS:
        creepages = POINTS[name]
        size = 2 * Hertz(126680, RADIUS, RADIUS_ACROSS).b / elements
        results = run(
            f"{label}-{name.replace(' ', '-').replace('%', 'percent').replace('/', '-per-')}", "rolling",
            [
                *zone("roller", size, round(0.5 * elements), -10.4e-3, 60.4e-3, 16e-3),
                *motion_of(creepages, NORMAL, SPEED), f"contacts.rolling.friction={STATIC}",
                f"contacts.rolling.dynamic_friction={DYNAMIC}", f"contacts.rolling.friction_decay={DECAY}",
                f"contacts.rolling.friction_memory={memory}", f"time.end={WAY / SPEED:.6g}",
                "output.field_interval=3e-5", "settle.method=newton", *HOURGLASS, *overrides,
            ],
        )
        if results is None:
            continue
        outcome = outcome or Outcome(results.step_size)
        compare(outcome, results, name, creepages, law, 4 * elements + 20)
    return outcome


falling.contact = "rolling"


def compare(outcome, results, name, creepages, law, cells):
    force, swing, last = steady(results, 0.25)
    normal, tangential = abs(force[2]), force[:2]
    hertz = Hertz(normal, RADIUS, RADIUS_ACROSS)
    solution = SteadyRolling(hertz, law, creepages, cells)
    exact, stick = converged(hertz, law, creepages, cells)
    at_once, _ = converged(hertz, FallingFriction(law.static, law.dynamic, law.decay, law.speed), creepages, cells)
    size = np.linalg.norm(solution.shear, axis=-1)
    peaks, measured, sampled, rests = [], [], [], []
    for k in last:
        state = results.state(k)
        x0, y0 = state.centre()
        x, y = state.x - x0, state.y - y0
        mean = [shares(x, y, lambda x, y, c=c: solution.nearest(solution.shear[:, c], x, y)) for c in (0, 1)]
        peaks.append((np.linalg.norm(state.shear, axis=-1).max(), np.hypot(*mean).max()))
        measured.append(state.stick_share())
        sampled.append(sampled_stick(solution, state, x, y) * solution.stick_share)
        touches, rest = state.pressure > 0, law.static - AT_REST
        shown = solution.nearest(solution.coefficient, x, y)
        rests.append((state.area[touches & (state.friction > rest)].sum() / state.area[touches].sum(),
                      state.area[shown > rest].sum() / state.area[shown > 0].sum()))
    (peak, peak_shown), (by_line, by_count) = np.mean(peaks, axis=0), np.mean(measured, axis=0)
    (line_shows, count_shows), (at_rest, rest_shows) = np.mean(sampled, axis=0), np.mean(rests, axis=0)
    turn = np.degrees(np.angle(np.exp(1j * (np.arctan2(*tangential[::-1]) - np.arctan2(*exact[::-1])))))
    outcome.figures += [
        (f"({name}) normal force, N", normal, NORMAL, ""),
        (f"({name}) creep force over normal force", np.hypot(*tangential) / normal, np.hypot(*exact) / normal, ""),
        (f"({name})     of half-spaces without memory", np.hypot(*at_once) / normal, np.hypot(*exact) / normal, ""),
        (f"({name}) direction of the creep force, deg", turn, 0.0, "deg"),
        (f"({name}) swing of the creep force", swing[:2].max() / np.hypot(*tangential), 0, ""),
        (f"({name}) peak shear, nodes' shares, Pa", peak, peak_shown, ""),
        (f"({name})     of half-spaces, at a point, Pa", size.max(), size.max(), ""),
        (f"({name}) stick share of the patch, zero line", by_line, line_shows, ""),
        (f"({name}) stick share of the patch, by count", by_count, count_shows, ""),
        (f"({name})     of half-spaces", stick, stick, ""),
        (f"({name}) share of the patch that has not slid", at_rest, rest_shows, ""),
    ]
    middle = int(np.argmin(np.abs(y[:, np.argmin(np.abs(x[0]))])))
    inside = np.abs(x[middle]) < 1.2 * hertz.a
    row = np.flatnonzero(np.abs(solution.y) < 0.51 * solution.k)
    row = row[np.argsort(solution.x[row])]
    outcome.curves.append((f"({name}) shear along the centre line", "x, mm", "MPa", [
        ("half-spaces, along", 1e3 * solution.x[row], 1e-6 * solution.shear[row, 0], "-"),
        ("half-spaces, across", 1e3 * solution.x[row], 1e-6 * solution.shear[row, 1], "--"),
        ("along", 1e3 * x[middle][inside], 1e-6 * state.shear[middle, inside, 0], "o"),
        ("across", 1e3 * x[middle][inside], 1e-6 * state.shear[middle, inside, 1], "s")]))
