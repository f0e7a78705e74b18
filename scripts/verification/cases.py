"""The verification cases: how each is run, and what of it is compared with what is exact. A case is called with a
function that runs it, a label, the number of elements over the contact's minor axis, overrides, and the points asked
for."""

import numpy as np

from verification.exact import Carter, Hertz, HertzLine, Mindlin
from verification.falling import falling
from verification.measured import enclosed, outlines, shares
from verification.rolling import rolling
from verification.setting import RADIUS, Outcome, rms, rolling_motion, steady, zone


def hertz(name, part, across):
    minor = 2 * Hertz(126680, RADIUS, across).b

    def case(run, label, elements, overrides, points):
        results = run(
            label,
            name,
            [*zone(part, minor / elements, round(0.5 * elements), -10.1e-3, 10.1e-3, 1.4 * minor), *overrides],
        )
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
        for axis, x, p, reach in (
            ("x", state.x[row], state.pressure[row], exact.a),
            ("y", state.y[:, column], state.pressure[:, column], exact.b),
        ):
            inside = np.abs(x) < 1.3 * reach
            outcome.curves.append((f"pressure along {axis}", f"{axis}, mm", "MPa", [
                ("Hertz", 1e3 * fine * reach, 1e-6 * exact.peak * np.sqrt(np.maximum(0, 1 - fine**2)), "-"),
                ("computed", 1e3 * x[inside], 1e-6 * p[inside], "o")]))
        return outcome

    case.contact = "hertz"
    return case


def corrected_approaches(results, part, exact):
    """By how much points on the axis, two to four semi-axes under either surface, come nearer from first touch on; plus
    how far Hertz's half-spaces move there. Of distant points this is the approach: near the contact the bodies' far
    ends add no more than a rigid motion, which the difference does not see, and little strain."""
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
    results = run(
        label,
        "cattaneo",
        [*zone("sphere", minor / elements, round(0.5 * elements), -10.1e-3, 10.1e-3, 1.4 * minor), *overrides],
    )
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
        (
            "shear along the centre line, nodes' shares, L2",
            rms(shear[row, :, 0] - mean[row], mean[row], state.area[row]),
            0,
            "",
        ),
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


CARTER_RADIUS, CARTER_SPEED, CARTER_HEIGHT, CARTER_SHARES = 4.0, 24.0, 3.999986, ("0.2", "0.4", "0.6", "0.8", "0.95")


def carter(run, label, elements, overrides, points):
    outcome, curve = None, []
    guess = HertzLine(8.15e5, CARTER_RADIUS)
    for wish in points or CARTER_SHARES:
        creepage = Carter.creepage(guess, 0.45, float(wish))
        size = 0.012 / elements
        motion = rolling_motion(CARTER_SPEED, 0, CARTER_SPEED * (1 + creepage) / CARTER_RADIUS, CARTER_HEIGHT)
        width = [f"meshes.roller.side_end={size:g}", f"meshes.block.size=[0.3,{size:g},0.1]"]
        results = run(
            f"{label}-{wish}",
            "carter",
            [*zone("roller", size, round(0.5 * elements), -9.5e-3, 109.5e-3, size), *width, *motion, *overrides],
        )
        if results is None:
            continue
        force, swing, last = steady(results, 0.15)
        exact = Carter(HertzLine(abs(force[2]) / size, CARTER_RADIUS), 0.45, creepage)
        outcome = outcome or Outcome(results.step_size)
        outcome.figures += [
            (f"creep force, N/m, creepage {1e4 * creepage:.2f}e-4", force[0] / size, exact.force, ""),
            (
                "    creepage for this force",
                Carter.creepage(exact.line, 0.45, min(1, force[0] / size / 0.45 / exact.line.force)),
                creepage,
                "",
            ),
            ("    swing of the creep force", swing[0] / abs(force[0]), 0, ""),
        ]
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
        outcome.curves.append(
            (
                f"shear, creepage {1e4 * creepage:.1f}e-4 (peak pressure {100 * peak_error:+.1f} %)",
                "x, mm",
                "MPa",
                [
                    ("Carter", 1e3 * fine, 1e-6 * exact.shear(fine), "-"),
                    ("computed", 1e3 * x[inside], 1e-6 * both[inside], "o"),
                ],
            )
        )
    if outcome:
        shares_carried = np.linspace(0, 1, 200)
        outcome.curves.insert(0, ("creep force over normal force", "creepage, 1e-4", "", [
            ("Carter", 1e4 * Carter.creepage(exact.line, 0.45, shares_carried), 0.45 * shares_carried, "-"),
            ("computed", [1e4 * c for c, _, _ in curve], [q for _, q, _ in curve], "o")]))
    return outcome


carter.contact = "rolling"

CASES = {
    "hertz_sphere": hertz("hertz_sphere", "sphere", RADIUS),
    "hertz_ellipse": hertz("hertz_ellipse", "roller", 0.30),
    "cattaneo": cattaneo,
    "carter": carter,
    "rolling": rolling,
    "falling": falling,
}
