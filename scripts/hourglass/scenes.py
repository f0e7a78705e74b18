"""The scenes of scripts/hourglass_table: case, what is changed in it, and what of its results is known from theory. SI
units."""

from dataclasses import dataclass, field
from typing import Callable

import numpy as np

YOUNG, DENSITY, POISSON = 210e9, 7800.0, 0.3
FOLDER = "benchmarks/cases/hourglass"


@dataclass
class Scene:
    case: str
    parts: tuple
    overrides: list = field(default_factory=list)
    explicit: bool = False  # the case names its control, so that 'default' says nothing of it
    # (what, computed, exact) of a run's histories; exact 0: there is none, `computed` is a share
    measure: Callable = lambda history: []

    def results(self, run, overrides, program):
        """Runs the case by `run`; what makes figures of its histories."""
        run(self.case, [*overrides, "output.field_sets=[]"])
        return self.measure


class Strip(Scene):
    """A case of scripts/verify_contact, which brings its own figures."""

    def results(self, run, overrides, program):
        from verification.cases import CASES
        from verification.measured import Run

        outcome = CASES["carter"](
            lambda name, case, more: Run(run(f"cases/verify/{case}.toml", more), program), "table", 10, overrides,
            ["0.8"],
        )
        figures = [(what.split(",")[0].strip(), computed, exact) for what, computed, exact, _ in outcome.figures]
        return lambda history: figures


# ---- a cantilever, by Timoshenko ----
LENGTH, HEIGHT, PRESSURE = 0.2, 0.02, 1e5
RIGIDITY, AREA = YOUNG * HEIGHT**4 / 12, HEIGHT**2
SHEAR = 10 * (1 + POISSON) / (12 + 11 * POISSON) * YOUNG / (2 * (1 + POISSON)) * AREA  # Cowper


def cantilever_frequency():
    """Hz, the first: the lowest root of the determinant of a Timoshenko beam's boundary conditions, found by
    bisection."""
    mass, turning = DENSITY * AREA, DENSITY * HEIGHT**4 / 12

    def determinant(omega):
        # w = exp(s x): EI s^4 + (m EI/kGA + turning) omega^2 s^2 + (turning m omega^2 / kGA - m) omega^2 = 0
        b = (mass * RIGIDITY / SHEAR + turning) * omega**2
        c = (turning * mass * omega**2 / SHEAR - mass) * omega**2
        roots = np.sqrt(np.roots([RIGIDITY, b, c]).astype(complex))
        s = np.array([roots[0], -roots[0], roots[1], -roots[1]])
        turn = s + mass * omega**2 / (SHEAR * s)  # rotation over deflection
        end = np.exp(s * LENGTH)
        return np.linalg.det(np.array([np.ones(4), turn, turn * s * end, (s - turn) * end])).imag

    euler = 3.516 * np.sqrt(RIGIDITY / mass) / LENGTH**2
    low, high = 0.8 * euler, euler
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if determinant(low) * determinant(middle) > 0 else (low, middle)
    return low / (2 * np.pi)


def frequency(time, value):
    """Hz, from the first to the last upward crossing of the mean."""
    value = value - value.mean()
    up = np.flatnonzero((value[:-1] < 0) & (value[1:] >= 0))
    at = time[up] - value[up] * (time[up + 1] - time[up]) / (value[up + 1] - value[up])
    return (len(at) - 1) / (at[-1] - at[0]) if len(at) > 1 else 0.0


def swinging(history):
    time, tip = history["time"], history["set/beam.x_max/displacement"][:, 2]
    free = time > 2.1e-3
    swing = [np.ptp(tip[(time > a) & (time <= a + 2.5e-3)]) for a in (2.1e-3, time[-1] - 2.5e-3)]
    return [
        ("frequency", frequency(time[free], tip[free]), cantilever_frequency()),
        ("swing left after nine periods", swing[1], swing[0]),
    ]


def bent(history):
    load = PRESSURE * HEIGHT
    tip = history["set/beam.x_max/displacement"][-1, 2]
    return [("deflection", -tip, load * LENGTH**4 / (8 * RIGIDITY) + load * LENGTH**2 / (2 * SHEAR))]


# ---- impact of bars, by Saint-Venant ----
def struck(history):
    time, contact = history["time"], history["contact/between/normal_force"]
    pressed = time[np.abs(contact[:, 2]) > 0.02 * np.abs(contact[:, 2]).max()]
    left = history["set/lower.lower_all/velocity"][-1, 2]
    return [
        ("velocity passed on", -left, 1.0),
        ("duration", pressed[-1] - pressed[0], 2 * 0.1 / np.sqrt(YOUNG / DENSITY)),
    ]


def fallen(history):
    kinetic = history["energy/kinetic"]
    return [("kinetic energy left", kinetic[-1] / kinetic[0], 0)]


def rolled(history):
    late = history["time"] > 0.6 * history["time"][-1]
    force = np.column_stack([history["contact/tread/normal_force"], history["contact/tread/tangential_force"]])[late]
    weight = (10900 + 385.16) * 9.81  # sprung mass and wheel
    return [("mean normal force", force[:, 2].mean(), weight), ("its swing over it", force[:, 2].std() / weight, 0)]


def beam(thick, *overrides, measure=swinging):
    return Scene(
        f"{FOLDER}/beam.toml",
        ("beam",),
        [f"meshes.beam.divisions=[{10 * thick},{thick},{thick}]", *overrides],
        measure=measure,
    )


STATIC = ("curves.push.type=cosine_ramp", "curves.push.duration=8e-3", "parts.beam.mass_damping=3000", "time.end=15e-3")
COARSE = ["meshes.wheel.zone_size=0.004", "meshes.rail.zone_size=0.004", "time.end=1.5e-3", "settle.tolerance=2.5e-3"]
SCENES = {
    "drop, 10 mm": Scene(f"{FOLDER}/drop.toml", ("upper", "lower"), measure=fallen),
    "drop, 5 mm": Scene(
        f"{FOLDER}/drop.toml",
        ("upper", "lower"),
        ["meshes.upper.divisions=[8,8,8]", "meshes.lower.divisions=[12,12,4]"],
        measure=fallen,
    ),
    "bars": Scene(f"{FOLDER}/bars.toml", ("upper", "lower"), measure=struck),
    "hammer": Scene(f"{FOLDER}/hammer.toml", ("rail",)),
    **{f"beam swings, {thick} thick": beam(thick) for thick in (1, 2, 4)},
    **{f"beam bent, {thick} thick": beam(thick, *STATIC, measure=bent) for thick in (1, 2, 4)},
    "rolling strip": Strip("cases/verify/carter.toml", ("roller", "block"), explicit=True),
    "rolling wheel": Scene("cases/rolling.toml", ("wheel", "rail"), COARSE, True, rolled),
}
