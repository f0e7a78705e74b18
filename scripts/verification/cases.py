"""The verification cases: how each is run, and what of it is compared with what is exact. A case is called with a function that
runs it, a label, the number of elements over the contact's minor axis, overrides, and the points asked for."""

import csv
import pathlib
from dataclasses import dataclass, field

import numpy as np

from verification.exact import Carter, Hertz, HertzLine, Mindlin
from verification.measured import enclosed, outlines, shares

DATA = pathlib.Path(__file__).resolve().parents[2] / "data" / "contact"
RADIUS = 0.46


@dataclass
class Outcome:
    step: float  # s
    figures: list = field(default_factory=list)  # (what, computed, exact, unit); exact 0: `computed` is a share
    curves: list = field(default_factory=list)  # pictures: (title, abscissa name, ordinate name, [(label, x, y, style)])


def zone(body, size, layers, start, end, width):
    """Overrides for a body and the block with cells of `size` at least from `start` to `end` and over `width`. The body has a
    node at 0; the block's nodes lie aside, for a contact of nodes that meet exactly is a special case."""
    values = dict(zone_size=size, zone_layers=layers, zone_start=-size * np.ceil(-start / size), zone_end=size * np.ceil(end / size),
                  zone_width=2 * size * np.ceil(width / 2 / size))
    aside = dict(values, zone_start=values["zone_start"] - 0.37 * size, zone_centre=0.23 * size)
    return [f"meshes.{mesh}.{key}={value:.12g}" for mesh, those in ((body, values), ("block", aside)) for key, value in those.items()]


def rms(error, exact, area):
    return float(np.sqrt(np.sum(area * error**2) / np.sum(area * exact**2)))


def hertz(name, part, across):
    minor = 2 * Hertz(126680, RADIUS, across).b

    def case(run, label, elements, overrides, points):
        results = run(label, name, [*zone(part, minor / elements, round(0.5 * elements), -10.1e-3, 10.1e-3, 1.4 * minor), *overrides])
        if results is None:
            return None
        state = results.state(0)
        exact = Hertz(np.linalg.norm(state.normal_force.sum(axis=(0, 1))), RADIUS, across)
        patch = enclosed(outlines(state.x, state.y, state.pressure))
        outcome = Outcome(results.step_size)
        approaches = corrected_approaches(results, part, exact)
        mean = shares(state.x, state.y, exact.pressure)
        outcome.figures = [
            ("peak pressure, Pa", state.pressure.max(), exact.peak, ""),
            ("patch area, m2", patch, exact.area, ""),
            ("approach, m", np.mean(approaches), exact.approach, ""),
            ("pressure over the patch, L2", rms(state.pressure - mean, mean, state.area), 0, ""),
        ]
        fine = np.linspace(-1.05, 1.05, 801)
        row, column = np.argmin(np.abs(state.y[:, 0])), np.argmin(np.abs(state.x[0]))
        for axis, x, p, reach in (("x", state.x[row], state.pressure[row], exact.a), ("y", state.y[:, column], state.pressure[:, column], exact.b)):
            inside = np.abs(x) < 1.3 * reach
            outcome.curves.append((f"pressure along {axis}", f"{axis}, mm", "MPa", [
                ("Hertz", 1e3 * fine * reach, 1e-6 * exact.peak * np.sqrt(np.maximum(0, 1 - fine**2)), "-"),
                ("computed", 1e3 * x[inside], 1e-6 * p[inside], "o")]))
        return outcome

    case.contact = "hertz"
    return case


def corrected_approaches(results, part, exact):
    """By how much points on the axis, two to four semi-axes under either surface, come nearer from first touch on; plus how far
    Hertz's half-spaces move there. Of distant points this is the approach: near the contact the bodies' far ends add no more
    than a rigid motion, which the difference does not see, and little strain."""
    centre = results.file["fields"][part]["coordinates"][:][:, 2].min()  # the lowest point of the upper body
    below, moved_below = results.on_axis("block")
    above, moved_above = results.on_axis(part)
    approaches = []
    for depth in np.linspace(2, 4, 9) * np.sqrt(exact.a * exact.b):
        w_below = np.interp(-depth, below, moved_below)
        w_above = np.interp(centre + depth, above, moved_above)
        approaches.append(-centre + w_below - w_above + 2 * exact.displacement(depth))
    return approaches


def cattaneo(run, label, elements, overrides, points):
    minor = 2 * Hertz(126680, RADIUS, RADIUS).a
    results = run(label, "cattaneo", [*zone("sphere", minor / elements, round(0.5 * elements), -10.1e-3, 10.1e-3, 1.4 * minor), *overrides])
    if results is None:
        return None
    quiet = [k for k, t in enumerate(results.times()) if t > 1.0e-3]
    states = [results.state(k) for k in quiet]
    state = states[-1]
    shear, pressure = np.mean([s.shear for s in states], axis=0), np.mean([s.pressure for s in states], axis=0)
    normal = np.mean([np.sum(s.normal_force[..., 2]) for s in states])
    tangential = np.mean([np.sum(s.tangential_force[..., 0]) for s in states])
    exact = Mindlin(Hertz(abs(normal), RADIUS, RADIUS), tangential, state.friction)
    x0 = np.mean([s.centre()[0] for s in states])
    x, y = state.x - x0, state.y
    stick = np.mean([enclosed(outlines(s.x - x0, s.y, s.bound_left)) for s in states])
    row = int(np.argmin(np.abs(y[:, 0])))
    mean = shares(x, y, lambda x, y: exact.shear(np.hypot(x, y)))
    line = exact.shear(np.abs(x[row]))
    outcome = Outcome(results.step_size)
    swing = [np.sum(s.tangential_force[..., 0]) for s in states]
    outcome.figures = [
        ("tangential over friction times normal force", exact.share, exact.share, ""),
        ("its swing after the shift", (max(swing) - min(swing)) / abs(np.mean(swing)), 0, ""),
        ("shear along the centre line, nodes' shares, L2", rms(shear[row, :, 0] - mean[row], mean[row], state.area[row]), 0, ""),
        ("shear along the centre line, at the nodes, L2", rms(shear[row, :, 0] - line, line, state.area[row]), 0, ""),
        ("shear over the patch, nodes' shares, L2", rms(shear[..., 0] - mean, mean, state.area), 0, ""),
        ("stick radius, m", np.sqrt(stick / np.pi), exact.stick_radius, ""),
        ("peak pressure, Pa", pressure.max(), exact.hertz.peak, ""),
    ]
    fine = np.linspace(-1.05, 1.05, 801) * exact.hertz.a
    inside = np.abs(x[row]) < 1.3 * exact.hertz.a
    outcome.curves = [("shear along the centre line", "x, mm", "MPa", [
        ("Mindlin", 1e3 * fine, 1e-6 * exact.shear(np.abs(fine)), "-"),
        ("friction times Hertz's pressure", 1e3 * fine, 1e-6 * exact.friction * exact.hertz.pressure(fine, 0), ":"),
        ("computed", 1e3 * x[row][inside], 1e-6 * shear[row, inside, 0], "o")])]
    return outcome


cattaneo.contact = "shift"


def rolling_motion(speed, sideways, turning, height):
    centre = f"[0,0,{height:.9g}]"
    motion = [("velocity", f"[{speed:.9g},{sideways:.9g},0]"), ("angular_velocity", f"[0,{turning:.12g},0]"), ("centre", centre)]
    return [f"parts.roller.position={centre}"] + [f"{section}.{key}={value}" for section in ("initial_motion.roll", "prescribed_motion.axle")
                                                 for key, value in motion]


def steady(results, share):
    """Tangential force along and across and normal force on the roller, their means over the last `share` of the run, and how
    far they swing there; output times in it."""
    time, normal, tangential = results.history()
    late = time >= (1 - share) * time[-1]
    force = np.column_stack([tangential[late][:, :2], normal[late][:, 2]])
    last = [k for k, t in enumerate(results.times()) if t >= (1 - share) * results.times()[-1]]
    return force.mean(axis=0), force.max(axis=0) - force.min(axis=0), last


CARTER_RADIUS, CARTER_SPEED, CARTER_HEIGHT, CARTER_SHARES = 4.0, 24.0, 3.999986, ("0.2", "0.4", "0.6", "0.8", "0.95")


def carter(run, label, elements, overrides, points):
    outcome, curve = None, []
    guess = HertzLine(8.15e5, CARTER_RADIUS)
    for wish in points or CARTER_SHARES:
        creepage = Carter.creepage(guess, 0.45, float(wish))
        size = 0.012 / elements
        motion = rolling_motion(CARTER_SPEED, 0, CARTER_SPEED * (1 + creepage) / CARTER_RADIUS, CARTER_HEIGHT)
        width = [f"meshes.roller.side_end={size:g}", f"meshes.block.size=[0.3,{size:g},0.1]"]
        results = run(f"{label}-{wish}", "carter", [*zone("roller", size, round(0.5 * elements), -9.5e-3, 109.5e-3, size), *width, *motion, *overrides])
        if results is None:
            continue
        force, swing, last = steady(results, 0.15)
        exact = Carter(HertzLine(abs(force[2]) / size, CARTER_RADIUS), 0.45, creepage)
        outcome = outcome or Outcome(results.step_size)
        outcome.figures += [
            (f"creep force, N/m, creepage {1e4 * creepage:.2f}e-4", force[0] / size, exact.force, ""),
            ("    creepage for this force", Carter.creepage(exact.line, 0.45, min(1, force[0] / size / 0.45 / exact.line.force)), creepage, ""),
            ("    swing of the creep force", swing[0] / abs(force[0]), 0, "")]
        curve.append((creepage, force[0] / abs(force[2]), exact.force / exact.line.force))
        states = [results.state(k) for k in last]
        x = np.mean([s.x[0] - s.centre()[0] for s in states[-1:]], axis=0)
        state = states[-1]
        peak_error = state.pressure.max() / exact.line.peak - 1
        outcome.figures.append(("    peak pressure, Pa", state.pressure.max(), exact.line.peak, ""))
        both = 0.5 * (state.shear[0, :, 0] + state.shear[-1, :, 0])
        mean = shares(np.stack([x, x]), np.stack([0 * x, 0 * x + size]), lambda x, y: exact.shear(x))[0]
        outcome.figures.append(("    shear, nodes' shares, L2", rms(both - mean, mean, state.area[0]), 0, ""))
        fine = np.linspace(-1.05, 1.05, 801) * exact.line.half_width
        inside = np.abs(x) < 1.3 * exact.line.half_width
        outcome.curves.append((f"shear, creepage {1e4 * creepage:.1f}e-4 (peak pressure {100 * peak_error:+.1f} %)", "x, mm", "MPa", [
            ("Carter", 1e3 * fine, 1e-6 * exact.shear(fine), "-"), ("computed", 1e3 * x[inside], 1e-6 * both[inside], "o")]))
    if outcome:
        shares_carried = np.linspace(0, 1, 200)
        outcome.curves.insert(0, ("creep force over normal force", "creepage, 1e-4", "", [
            ("Carter", 1e4 * Carter.creepage(exact.line, 0.45, shares_carried), 0.45 * shares_carried, "-"),
            ("computed", [1e4 * c for c, _, _ in curve], [q for _, q, _ in curve], "o")]))
    return outcome


carter.contact = "rolling"

ROLLING_SPEED, ROLLING_HEIGHT = 40.0, 0.459884


class CreepLaw:
    """Vermeulen and Johnson's law, 1 - T / mu N = (1 - u)^3, its two stiffnesses fitted to one solution of CONTACT: turns a small
    difference of forces into one of creepages. Creepages go with the cube root of the normal force."""

    def __init__(self, row, friction):
        self.friction, self.normal = friction, row["normal_N"]
        force = np.array([row["longitudinal_N"], row["lateral_N"]])
        self.stiffness = self._reach(force, self.normal) / np.array([row["longitudinal_creepage"], row["lateral_creepage"]])

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
    result = (1 - s) * (1 - t) * values[j, i] + s * (1 - t) * values[j, i + 1] + (1 - s) * t * values[j + 1, i] + s * t * values[j + 1, i + 1]
    return np.where(good[..., None], result, np.nan)


def rolling(run, label, elements, overrides, points):
    outcome = None
    for letter in points or "abcdef":
        row = table_5_2()[letter]
        exact = Hertz(row["normal_N"], RADIUS, 0.30)
        size = 2 * Hertz(126680, RADIUS, 0.30).b / elements
        creepage = np.array([row["longitudinal_creepage"], row["lateral_creepage"]])
        height = ROLLING_HEIGHT + 0.9 * (Hertz(126680, RADIUS, 0.30).approach - exact.approach)
        motion = rolling_motion(ROLLING_SPEED, -creepage[1] * ROLLING_SPEED, ROLLING_SPEED * (1 + creepage[0]) / RADIUS, height)
        outputs = [f"output.field_interval={1e-4 if elements <= 10 else 3e-4}"]
        results = run(f"{label}-{letter}", "rolling", [*zone("roller", size, round(0.5 * elements), -10.4e-3, 60.4e-3, 16e-3), *motion, *outputs, *overrides])
        if results is None:
            continue
        force, swing, last = steady(results, 0.25)
        normal, tangential = abs(force[2]), force[:2]
        law = CreepLaw(row, 0.45)
        found = law.creepage(tangential, normal)
        wished = np.array([row["longitudinal_N"], row["lateral_N"]])
        state = results.state(last[-1])
        x0, y0 = state.centre()
        x, y = state.x - x0, state.y - y0
        hertz_now = Hertz(normal, RADIUS, 0.30)
        shear = state.shear[..., :2]
        turn = np.degrees(np.arctan2(tangential[1], tangential[0]) - np.arctan2(wished[1], wished[0]))
        by_line, by_count = np.mean([results.state(k).stick_share() for k in last], axis=0)
        outcome = outcome or Outcome(results.step_size)
        outcome.figures += [
            (f"({letter}) normal force, N", normal, row["normal_N"], ""),
            (f"({letter}) tangential over friction times normal force", np.hypot(*tangential) / 0.45 / normal, np.hypot(*wished) / 0.45 / row["normal_N"], ""),
            (f"({letter}) creepage for these forces", np.hypot(*creepage), np.hypot(*found), ""),
            (f"({letter}) direction of the creep force, deg", turn, 0.0, "deg"),
            (f"({letter}) swing of the creep force", swing[:2].max() / np.hypot(*tangential), 0, ""),
            (f"({letter}) stick share of the patch, zero line", by_line, row["adhesion_share"], ""),
            (f"({letter}) stick share of the patch, by count", by_count, row["adhesion_share"], ""),
            (f"({letter}) peak pressure, Pa", state.pressure.max(), hertz_now.peak, ""),
            (f"({letter}) patch area, m2", enclosed(outlines(x, y, state.pressure)), hertz_now.area, ""),
        ]
        grid = reference_field(letter)
        if grid is not None:
            scale = hertz_now.a / exact.a
            reference = interpolate(grid, x / scale, y / scale) * scale
            known = ~np.isnan(reference[..., 0]) & (state.slipping > 0)
            angle = np.angle((shear[known] @ [1, 1j]) / (reference[known] @ [1, 1j]), deg=True)
            weight = state.area[known] * np.linalg.norm(reference[known], axis=-1)
            outcome.figures += [
                (f"({letter}) direction of the shear, mean off, deg", np.sum(weight * np.abs(angle)) / np.sum(weight), 0.0, "deg"),
                (f"({letter}) shear over the patch, L2", float(np.sqrt(np.sum(state.area[known, None] * (shear[known] - reference[known]) ** 2)
                                                                     / np.sum(state.area[known, None] * reference[known] ** 2))), 0, ""),
            ]
            middle = int(np.argmin(np.abs(y[:, 0])))
            inside = np.abs(x[middle]) < 1.2 * hertz_now.a
            line = interpolate(grid, grid[0], np.full(len(grid[0]), y[middle, 0] / scale))
            outcome.curves.append((f"({letter}) shear along the centre line", "x, mm", "MPa", [
                ("CONTACT, along", 1e3 * grid[0] * scale, 1e-6 * line[:, 0] * scale, "-"), ("CONTACT, across", 1e3 * grid[0] * scale, 1e-6 * line[:, 1] * scale, "--"),
                ("along", 1e3 * x[middle][inside], 1e-6 * shear[middle, inside, 0], "o"),
                ("across", 1e3 * x[middle][inside], 1e-6 * shear[middle, inside, 1], "s")]))
    return outcome


rolling.contact = "rolling"

CASES = {
    "hertz_sphere": hertz("hertz_sphere", "sphere", RADIUS),
    "hertz_ellipse": hertz("hertz_ellipse", "roller", 0.30),
    "cattaneo": cattaneo,
    "carter": carter,
    "rolling": rolling,
}
