"""The impact of simulation 3 by the size of the elements and by the step: the force's peak behind the gap. The wheel
begins 0.24 m before the gap, on its whole torque when it comes there: a fifth of the way, and the same for all."""

import matplotlib.pyplot as plt

import passing

SIZES = (2e-3, 1.4e-3, 1e-3)  # m, of the zone's elements
COARSE_SIZES = (7e-3, 6e-3, 5e-3)
SCALES = (0.9, 0.6)  # of the stable step, at the least size
START, END = 0.24, 10.6e-3  # m before the gap; s, 54 mm behind it
NEAR = [
    f"parts.wheelset.position=[-{START}, -0.0024, 0.62]", f"points.sprung_mass.position=[-{START}, 0.9976, 0.62]",
    f"meshes.wheelset.zone_start={START - 0.1:g}", f"meshes.wheelset.path_length={START + 0.18:g}",
    f"tracks.track.path_start=-{START + 0.03:g}", f"time.end={END}",
]
# The forces are in the histories. Windows may not begin behind a run's end.
NO_FIELDS = [f"output_windows.{window}.{key}" for window in ("passage", "approach", "landing", "slipping")
             for key in ("start=0", "end=1e-3", "interval=1")]


def sized(size):
    """No element on the way is smaller than those of the zone."""
    way = max(size, 3e-3)
    return [f"{mesh}.{key}={value}" for mesh in ("meshes.wheelset", "tracks.track")
            for key, value in (("zone_size", size), ("path_size", way))]


def run(steps, case, coarse):
    """Returns (size, m; scale; passing.History)."""
    sizes = COARSE_SIZES if coarse else SIZES
    listed = [(size, SCALES[0]) for size in sizes] + [(sizes[-1], scale) for scale in SCALES[1:]]
    start = passing.COARSE_START if coarse else START
    common = [*passing.settings(steps, 3, coarse), *([] if coarse else NEAR), *NO_FIELDS]
    found = []
    for size, scale in listed:
        name = f"convergence_{1e3 * size:g}_mm_{scale:g}"
        results = steps.run(name, case, [*common, *sized(size), f"time.step_scale={scale}"])
        found.append((size, scale, passing.History(results, start)))
    return found


def findings(found):
    """Rows of the study's table: the peak of each, and by how much it is off that of the finest."""
    finest = min(found, key=lambda one: (one[0], -one[1]))[2].peak_force()[0]
    rows = []
    for size, scale, one in found:
        force, place = one.peak_force()
        rows.append((
            f"simulation 3, elements of {1e3 * size:g} mm, {scale:g} of the stable step: force of the first impact",
            "", f"{force:.1f} kN, {1e3 * place:.1f} mm behind the gap ({100 * (force / finest - 1):+.1f} %)",
        ))
    return rows


def draw(found):
    """The force beside the gap, and its peak by the elements' size."""
    figure, (beside, by_size) = plt.subplots(1, 2, figsize=(11, 4), constrained_layout=True)
    for size, scale, one in found:
        beside.plot(1e3 * one.place(one.time), 1e-3 * one.force, label=f"{1e3 * size:g} mm, step {scale:g}")
    beside.set_xlim(-20, 50)
    beside.set_xlabel("wheel's place from the gap, mm")
    beside.set_ylabel("normal force, kN")
    beside.legend()
    for scale in SCALES:
        points = [(1e3 * size, one.peak_force()[0]) for size, own, one in found if own == scale]
        by_size.plot(*zip(*points), "o-", label=f"step {scale:g} of the stable one")
    by_size.set_xlim(left=0)
    by_size.set_xlabel("elements, mm")
    by_size.set_ylabel("force of the first impact, kN")
    by_size.legend()
    return figure
