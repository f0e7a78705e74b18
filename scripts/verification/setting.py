"""What the verification cases have in common: the outcome of one, overrides of meshes and motion, errors. SI units."""

from dataclasses import dataclass, field

import numpy as np

RADIUS = 0.46


@dataclass
class Outcome:
    step: float  # s
    figures: list = field(default_factory=list)  # (what, computed, exact, unit); exact 0: `computed` is a share
    # pictures: (title, abscissa name, ordinate name, [(label, x, y, style)])
    curves: list = field(default_factory=list)


def zone(body, size, layers, start, end, width):
    """Overrides for a body and the block with cells of `size` at least from `start` to `end` and over `width`. The body
    has a node at 0; the block's nodes lie aside, for a contact of nodes that meet exactly is a special case."""
    values = dict(
        zone_size=size, zone_layers=layers, zone_start=-size * np.ceil(-start / size),
        zone_end=size * np.ceil(end / size), zone_width=2 * size * np.ceil(width / 2 / size),
    )
    aside = dict(values, zone_start=values["zone_start"] - 0.37 * size, zone_centre=0.23 * size)
    return [
        f"meshes.{mesh}.{key}={value:.12g}"
        for mesh, those in ((body, values), ("block", aside))
        for key, value in those.items()
    ]


def rms(error, exact, area):
    return float(np.sqrt(np.sum(area * error**2) / np.sum(area * exact**2)))


def rolling_motion(speed, sideways, turning, height, spinning=0):
    centre = f"[0,0,{height:.9g}]"
    motion = [
        ("velocity", f"[{speed:.9g},{sideways:.9g},0]"),
        ("angular_velocity", f"[0,{turning:.12g},{spinning:.9g}]"),
        ("centre", centre),
    ]
    return [f"parts.roller.position={centre}"] + [
        f"{section}.{key}={value}"
        for section in ("initial_motion.roll", "prescribed_motion.axle")
        for key, value in motion
    ]


def steady(results, share):
    """Tangential force along and across and normal force on the roller, their means over the last `share` of the run,
    and how far they swing there; output times in it."""
    time, normal, tangential = results.history()
    late = time >= (1 - share) * time[-1]
    force = np.column_stack([tangential[late][:, :2], normal[late][:, 2]])
    last = [k for k, t in enumerate(results.times()) if t >= (1 - share) * results.times()[-1]]
    return force.mean(axis=0), force.max(axis=0) - force.min(axis=0), last
