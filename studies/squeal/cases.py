"""Half a wheelset that is moved sideways while it rolls: the five cases of the thesis's table 5.1, and what the thesis
has of their forces (table 5.2)."""

import dataclasses
import functools
import json
import pathlib

import h5py
import numpy as np

import tables
from verification.falling import DECAY, DYNAMIC, STATIC  # of case 5

HERE = pathlib.Path(__file__).resolve().parent
CASE = HERE / "squeal.toml"
SIDEWAYS = 16e-3  # s, when the lateral motion begins
ZONE = (16.5e-3, 18.7e-3)  # s, while the patch is on elements of 1 mm
NAMES = {1: "no lateral motion", 2: "small", 3: "medium", 4: "large", 5: "medium, falling friction"}


@dataclasses.dataclass(frozen=True)
class Motion:
    """Of the ends of the half axle along y: m, inwards; s, of the cosine ramp."""

    displacement: float
    duration: float


def read_motions(path):
    """Motions by case of a file like motions.json: displacement, m, and duration, s. Case 1 has none; case 5 that of
    case 3."""
    motions = {int(number): Motion(*motion) for number, motion in json.loads(pathlib.Path(path).read_text()).items()}
    return {1: Motion(0.0, 2.5e-3), **motions, **({5: motions[3]} if 3 in motions else {})}


MOTIONS = read_motions(HERE / "motions.json")  # as fit.py found them from table 5.2


@dataclasses.dataclass(frozen=True)
class Solution:
    """A contact solution of figure 5.6. Forces in kN, on the wheel."""

    case: int
    time: float
    normal: float
    lateral: float
    longitudinal: float

    @property
    def direction(self):
        """Of the tangential force, from the rolling direction, degrees."""
        return np.degrees(np.arctan2(self.lateral, self.longitudinal))

    def used(self, friction):
        """Share of friction's bound."""
        return np.hypot(self.lateral, self.longitudinal) / (friction * self.normal)


SOLUTIONS = {
    "a": Solution(1, 17.58e-3, 126.68, 2.19, 39.46), "b": Solution(2, 17.58e-3, 125.61, 9.30, 39.19),
    "c": Solution(3, 17.58e-3, 123.87, 20.27, 38.12), "d": Solution(4, 17.07e-3, 102.60, 18.41, 33.59),
    "e": Solution(3, 18.54e-3, 116.19, 36.83, 34.01), "f": Solution(4, 17.94e-3, 106.46, 47.04, 6.09),
}
# The lateral motion begins after 3.5 ms of rolling, a way of 0.2 m: the table's instants for two processors, but not
# what comes later. All times are as much earlier. The longitudinal force swings otherwise after so short a ramp of the
# torque, which is less for that.
EARLIER = 12.5e-3
SHORT = [
    "meshes.wheelset.axle_size=0.06", "meshes.wheelset.zone_start=0.09", "meshes.wheelset.zone_length=0.1",
    "meshes.wheelset.path_start=-0.03", "meshes.wheelset.path_length=0.3", "meshes.wheelset.coarse_size=0.05",
    "tracks.track.start=-1.8", "tracks.track.end=2.1", "tracks.track.zone_start=0.09", "tracks.track.zone_end=0.19",
    "tracks.track.path_end=0.27", "tracks.track.coarse_size=0.05", "tracks.track.core_size=0.06",
    "absorbing_layers.first.length=1.2", "absorbing_layers.last.length=1.2", "curves.ramp.duration=3e-3",
    "loads.drive.moment=16500",
    f"curves.sideways.start={SIDEWAYS - EARLIER}", "time.end=6.5e-3",
    f"output_windows.solutions.start={16.5e-3 - EARLIER}", f"output_windows.solutions.end={18.72e-3 - EARLIER}",
]
# Besides, elements of 4 mm.
COARSE = [
    *SHORT, "meshes.wheelset.zone_size=0.004", "meshes.wheelset.zone_start=-0.03", "meshes.wheelset.zone_length=0.24",
    "meshes.wheelset.path_size=0.004", "meshes.wheelset.section_size=0.012", "meshes.wheelset.zone_layers=1",
    "meshes.wheelset.growth=1.5", "meshes.wheelset.web_columns=2", "tracks.track.zone_size=0.004",
    "tracks.track.zone_layers=1", "tracks.track.zone_start=-0.03", "tracks.track.zone_end=0.21",
    "tracks.track.path_size=0.004", "tracks.track.section_size=0.012", "tracks.track.growth=1.5",
    "tracks.track.web_columns=2",
]
EXTENTS = {"full": [], "short": SHORT, "coarse": COARSE}


def settings(number, motion=None):
    """What a case changes in the file; its own motion where none is given."""
    motion = motion or MOTIONS[number]
    changed = [f"prescribed_motion.{end}.displacement=[0, {motion.displacement:.6g}, 0]" for end in ("inner", "outer")]
    changed.append(f"curves.sideways.duration={motion.duration:.6g}")
    if number == 5:
        changed += [f"contacts.tread.friction={STATIC}", f"contacts.tread.dynamic_friction={DYNAMIC}",
                    f"contacts.tread.friction_decay={DECAY}"]
    return changed


def earlier(extent):
    """By how much the times of a run are before the thesis's, s."""
    return 0.0 if extent == "full" else EARLIER


def run(steps, number, extent):
    """The results file of a case; extent: of EXTENTS."""
    return steps.run(f"case_{number}", CASE, [*EXTENTS[extent], *settings(number)])


def simulate(steps, extent, numbers):
    """Runs the cases. Returns a Rolling for each."""
    return {number: Rolling(number, run(steps, number, extent), earlier(extent)) for number in numbers}


class Rolling:
    """What one case's histories tell. Times are the thesis's: those of the file, and `earlier`."""

    def __init__(self, number, results, earlier=0.0):
        self.number, self.results, self.earlier = number, results, earlier
        with h5py.File(results, "r") as file:
            history = file["history"]
            self.time = history["time"][:] + earlier
            contact = history["contact/tread"]
            self.normal = 1e-3 * np.linalg.norm(contact["normal_force"][:], axis=1)
            self.longitudinal, self.lateral = 1e-3 * contact["tangential_force"][:, :2].T
            self.balance = np.abs(history["energy/balance_error"][:]).max() / history["energy/internal"][:].max()
            self.seconds = float(file.attrs.get("wall_seconds", np.nan))
            self.unbalance = float(file.attrs.get("settled_unbalance", np.nan))
            self.friction = float(file["contact/tread"].attrs["friction"])
            self.displaced = history["set/wheelset.middle/displacement"][:, 1]

    @property
    def creep(self):
        return np.hypot(self.longitudinal, self.lateral)

    def at(self, time):
        """Forces at the sample nearest to a time, as a Solution."""
        k = int(np.abs(self.time - time).argmin())
        return Solution(self.number, float(self.time[k]), self.normal[k], self.lateral[k], self.longitudinal[k])

    @functools.cached_property
    def saturated(self):
        """When the creep force first reaches 0.98 of what friction holds, s; None: never."""
        reached = np.flatnonzero((self.time > SIDEWAYS) & (self.creep > 0.98 * self.friction * self.normal))
        return float(self.time[reached[0]]) if len(reached) else None


def findings(found):
    """Rows of the study's table: what, thesis, found, off by; each a text."""
    rows = []
    for name, thesis in SOLUTIONS.items():
        if thesis.case not in found:
            continue
        one = found[thesis.case]
        own, where = one.at(thesis.time), f"{name}: case {thesis.case}, {1e3 * thesis.time:.2f} ms"
        for what in ("normal", "lateral", "longitudinal"):
            want, have = getattr(thesis, what), getattr(own, what)
            rows.append((f"{where}, {what} force", f"{want:.2f} kN", f"{have:.2f} kN", tables.off_by(have, want)))
        rows += [
            (f"{where}, direction of the force", f"{thesis.direction:.0f} deg", f"{own.direction:.1f} deg",
             f"{own.direction - thesis.direction:+.1f} deg"),
            (f"{where}, share of friction used", f"{thesis.used(0.45):.2f}", f"{own.used(one.friction):.3f}",
             f"{own.used(one.friction) - thesis.used(0.45):+.3f}"),
        ]
    for number, one in sorted(found.items()):
        rolling = (one.time > ZONE[0]) & (one.time < ZONE[1])
        saturated = "never" if one.saturated is None else f"{1e3 * one.saturated:.2f} ms"
        rows += [
            (f"case {number}: traction bound in the zone", "about 50 kN" if number == 1 else "",
             f"{one.friction * one.normal[rolling].mean():.1f} kN"
             + (", friction at rest" if number == 5 else "")),
            (f"case {number}: friction is used up first", {3: "about 19 ms"}.get(number, ""), saturated),
            (f"case {number}: displacement of the axle's ends", "", f"{1e3 * one.displaced[-1]:.3g} mm"),
            (f"case {number}: energy balance; static start; wall time", "",
             f"{100 * one.balance:.3f} %; {one.unbalance:.1e}; {one.seconds:.0f} s"),
        ]
    return rows
