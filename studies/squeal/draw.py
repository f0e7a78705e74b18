"""Pictures of the five cases: forces (thesis fig. 5.4), contact solutions (5.5 to 5.7)."""

import matplotlib.pyplot as plt
import numpy as np

from cases import NAMES, SIDEWAYS, SOLUTIONS, ZONE
from pictures import style
from pictures.contact_solution import ContactSolution
from pictures.patch import draw_patch, draw_row
from verification.falling import SPEED

# Of figure 5.5: eight instants 0.06 ms apart, of one swing of the creep force in the zone.
SWING = 17.46e-3 + 0.06e-3 * np.arange(8)
FALLING = 16.68e-3  # of figure 5.7


def forces(found):
    """Traction bound and contact forces over time; below, the zone by itself."""
    figure, grid = plt.subplots(2, len(found), figsize=(3.6 * len(found) + 1, 7), squeeze=False, sharey="row",
                                constrained_layout=True)
    for (whole, zone), (number, one) in zip(grid.T, sorted(found.items())):
        for axes in (whole, zone):
            if number != 5:
                axes.plot(1e3 * one.time, one.friction * one.normal, "c", linewidth=0.8, label="traction bound")
            axes.plot(1e3 * one.time, one.creep, "r", linewidth=0.8, label="creep force")
            axes.plot(1e3 * one.time, one.longitudinal, "g", linewidth=0.8, label="longitudinal")
            axes.plot(1e3 * one.time, one.lateral, "b", linewidth=0.8, label="lateral")
            axes.axvline(1e3 * SIDEWAYS, color="0.6", linestyle=":")
            axes.grid(alpha=0.3)
        for name, solution in SOLUTIONS.items():
            if solution.case == number:
                zone.plot(1e3 * solution.time, solution.lateral, "bs", markersize=4)
                zone.plot(1e3 * solution.time, solution.longitudinal, "gs", markersize=4)
                zone.annotate(name, (1e3 * solution.time, solution.lateral), fontsize=style.SMALL)
        zone.set_xlim(1e3 * ZONE[0] - 0.5, 1e3 * ZONE[1])
        whole.set_title(f"case {number}: {NAMES[number]}", fontsize=style.TEXT)
        zone.set_xlabel("time, ms")
    grid[0, 0].set_ylabel("force on the wheel, kN")
    grid[1, 0].set_ylabel("in the zone, kN; squares: thesis, table 5.2")
    grid[0, 0].legend(fontsize=style.TINY)
    return figure


def solutions(steps, found):
    """Contact solutions of the cases by number, as `railwave contact --hdf5` finds them."""
    read = {}
    for number, one in found.items():
        path = steps.derive(steps.path(f"solution_{number}.h5"), one.results, "contact", one.results, "--hdf5")
        read[number] = ContactSolution(path).contacts()[0]
    return read


def contact_pictures(found, read):
    """(name, figure) of figures 5.5 to 5.7."""
    def index(number, time):
        return read[number].nearest(time - found[number].earlier)

    if 1 in read:
        times, place, shear = along_centre(read[1], *(time - found[1].earlier for time in ZONE))
        if len(times) > 2:
            yield "carried", draw_carried(times + found[1].earlier, place, shear)
        yield "swing", draw_row("case 1", read[1], indices=[index(1, time) for time in SWING])
    for number in sorted(set(read) - {5}):
        times = sorted({solution.time for solution in SOLUTIONS.values() if solution.case == number})
        yield f"solutions_{number}", draw_row(f"case {number}", read[number], indices=[index(number, t) for t in times])
    if 5 in read:
        patches = read[5].patches(index(5, FALLING))
        if patches:
            yield "falling", draw_patch("case 5", read[5], patches[0])


def along_centre(contact, first, last):
    """Of the largest patch at each output between two times of the file: times, s; places along its centre line from
    its centre, mm, the rolling direction positive; shear there by time and place, MPa."""
    times, cuts = [], []
    for k, time in enumerate(contact.times):
        patches = contact.patches(k) if first <= time <= last else []
        if patches:
            times.append(time)
            cuts.append(patches[0].cut())
    if not cuts:
        return np.empty(0), np.empty(0), np.empty((0, 0))
    reach = min(np.abs(cut["distance"][cut["pressure"] > 0]).max() for cut in cuts)
    place = np.linspace(-reach, reach, 61)
    shear = [np.interp(place, cut["distance"], np.hypot(cut["shear_along"], cut["shear_across"])) for cut in cuts]
    return np.array(times), place, np.array(shear)


def above_trend(times, shear):
    """Shear less, at each place, its parabola in time: what goes with the forces of the whole patch is left out."""
    clock = (times - times.mean()) / np.ptp(times)
    powers = np.vander(clock, 3)
    return shear - powers @ np.linalg.lstsq(powers, shear, rcond=None)[0]


def delay(times, place, shear, leading=0.8, inner=0.3, most=0.4e-3):
    """By how much what the shear has above its trend comes later at a place in the leading half of the patch than near
    the leading edge, both in halves of its length from its centre: s, at which both are most alike; their correlation
    then; how long what rolls needs from one to the other at 27.78 m/s, s. nan: there are too few outputs."""
    above, step = above_trend(times, shear), np.median(np.diff(times))
    before, after = (above[:, np.abs(place - share * place[-1]).argmin()] for share in (leading, inner))
    alike = [np.corrcoef(before[:len(before) - lag], after[lag:])[0, 1]
             for lag in range(min(len(times) // 2, int(most / step)))]
    carried = 1e-3 * (leading - inner) * place[-1] / SPEED
    if len(alike) < 3:
        return np.nan, np.nan, carried
    k = int(np.argmax(alike))
    shift = 0.0
    if 0 < k < len(alike) - 1:
        low, top, high = alike[k - 1:k + 2]
        shift = 0.5 * (low - high) / (low - 2 * top + high)
    return step * (k + shift), alike[k], carried


def draw_carried(times, place, shear):
    """What the shear on the centre line has above its trend, by place and time (fig. 5.5)."""
    figure, axes = plt.subplots(figsize=(6, 6), constrained_layout=True)
    above = above_trend(times, shear)
    largest = np.percentile(np.abs(above), 99)
    drawn = axes.pcolormesh(place, 1e3 * times, above, cmap=style.SIGNED_MAP, vmin=-largest, vmax=largest,
                            shading="nearest")
    axes.set_xlabel("along the centre line, mm; it rolls to the right")
    axes.set_ylabel("time, ms")
    figure.colorbar(drawn, ax=axes, label="shear less its trend, MPa")
    return figure


def findings(found, read):
    """Rows of the study's table: how the forces of case 1 swing, how its shear moves, how case 5 slips."""
    rows = []
    if 1 in read:
        one = found[1]
        zone = (one.time > ZONE[0]) & (one.time < ZONE[1])
        bound, creep = one.friction * one.normal[zone], one.creep[zone]
        time = one.time[zone]
        swing = [values - np.polyval(np.polyfit(time, values, 2), time) for values in (bound, creep)]
        together = np.sum(swing[0] * swing[1]) / np.sqrt(np.sum(swing[0] ** 2) * np.sum(swing[1] ** 2))
        rows.append(("case 1 in the zone: swing of bound and creep force, how alike", "not in phase",
                     f"{swing[0].std():.2f}, {swing[1].std():.2f} kN; correlation {together:+.2f}"))
        times, place, shear = along_centre(read[1], *(time - one.earlier for time in ZONE))
        if len(times) > 2:
            late, alike, carried = delay(times, place, shear)
            rows.append(("case 1: shear at 0.3 of the patch's half length follows that at 0.8 by",
                         f"material needs {1e6 * carried:.0f} us", f"{1e6 * late:.0f} us (correlation {alike:.2f})"))
    if 5 in read:
        patches = read[5].patches(read[5].nearest(FALLING - found[5].earlier))
        if patches:
            patch = patches[0]
            slips = patch.slips_by_velocity & patch.touching
            leads = patch.x > 0
            turned = np.degrees(np.arctan2(patch.lateral_force, patch.creep_force))
            rows.append((f"case 5 at {1e3 * FALLING:.2f} ms: direction of the force", "small", f"{turned:.1f} deg"))
            rows.append((f"case 5 at {1e3 * FALLING:.2f} ms: nodes that slip, in the leading half, in the trailing one",
                         "scattered over the trailing part", ", ".join(
                             f"{(slips & half).sum()} of {(patch.touching & half).sum()}" for half in (leads, ~leads))))
    return rows
