"""Half a wheelset that nears the gauge corner with an angle of attack until its flange touches: the three angles of the
thesis's chapter 6, and what their results tell of each of the two contact patches."""

import dataclasses
import functools
import pathlib

import h5py
import numpy as np

import tables

HERE = pathlib.Path(__file__).resolve().parent
CASE = HERE / "flange.toml"
SPEED = 80 / 3.6  # m/s
CLEARANCE = 7.25e-3  # m, from where the wheel begins to where its flange touches: 0.29 m with 25 mrad (6.3.2)
BENDS = 1.3e-3  # m, by which the loaded axle and web bring the wheel's foot inwards
INNER = -0.5e-3  # m, y of the wheelset with which the flange touches at 0.29 m with 25 mrad
ANGLES = {15: 0.48, 20: 0.36, 25: 0.29}  # mrad: m, where the second contact begins with the same clearance
TAPE, JOURNAL = 0.75, 1.0  # m along the axle: of the tape circle, of the journal's middle
HEIGHT = 0.62  # m, of the axle before the gap is closed
BEFORE, BEHIND = 0.05, 0.13  # m, of the zone of fine elements about the second contact
LATER = {15: 0.02, 20: 0.07, 25: 0.33}  # m behind the zone: with 25 mrad until the flange carries all
CLIMBS = 3e-3  # m, along y beyond where the flange touches, for its band
COARSE_WAY = 0.05  # m, from where the wheel begins to the second contact
FRAME = 6.7e-3  # m, between the thesis's nine frames: five before the second contact, four from then on
STEEP = np.radians(45)  # what leans more is the flange's
SLIPS = 3e-3  # of the largest tangential force of a side, within which a node's is the bound's (eq. 3.6)
TOUCHING = 1e-3  # N, of a node
TOUCHES = 500.0  # N: with less the second patch is not there yet

COARSE = [
    "meshes.wheelset.zone_size=0.004", "meshes.wheelset.zone_layers=1", "meshes.wheelset.path_size=0.004",
    "meshes.wheelset.section_size=0.012", "meshes.wheelset.growth=1.5", "meshes.wheelset.web_columns=2",
    "meshes.wheelset.axle_size=0.06", "tracks.track.zone_size=0.004", "tracks.track.zone_layers=1",
    "tracks.track.path_size=0.004", "tracks.track.section_size=0.012", "tracks.track.growth=1.5",
    "tracks.track.web_columns=2", "tracks.track.start=-2.1", "tracks.track.end=2.7",
    "absorbing_layers.first.length=1.2", "absorbing_layers.last.length=1.2", "curves.ramp.duration=1e-3",
]


def axle_axes(angle):
    """Directions of the turned wheelset, as text of a case: along its plane, along its axle, up."""
    c, s = np.cos(angle), np.sin(angle)
    return f"[[{c:.12g}, {s:.12g}, 0], [{-s:.12g}, {c:.12g}, 0], [0, 0, 1]]"


def way_before(milliradians, coarse):
    """m that a coarse run leaves out."""
    return ANGLES[milliradians] - COARSE_WAY if coarse else 0.0


def settings(milliradians, coarse):
    """What an angle of attack changes in the case: places, directions, the zone about the second contact."""
    angle = 1e-3 * milliradians
    left_out = way_before(milliradians, coarse)
    event = ANGLES[milliradians] - left_out
    x, y = TAPE * np.sin(angle), INNER + left_out * np.tan(angle)
    across = JOURNAL * np.array([-np.sin(angle), np.cos(angle)])
    begins, zone_end = max(-0.03, event - BEFORE), event + BEHIND
    end = zone_end + (0 if coarse else LATER[milliradians])
    times = [max(0.0, event / SPEED - 2.5e-3), zone_end / SPEED, end / SPEED]
    return [
        *(COARSE if coarse else []),
        f"parts.wheelset.angle_of_attack={angle:.12g}",
        f"parts.wheelset.position=[{x:.9g}, {y:.9g}, {HEIGHT}]",
        f"points.sprung_mass.position=[{x + across[0]:.9g}, {y + across[1]:.9g}, {HEIGHT}]",
        f"prescribed_motion.inner.axes={axle_axes(angle)}",
        f"initial_motion.roll.velocity=[{SPEED * np.cos(angle):.9g}, {SPEED * np.sin(angle):.9g}, 0]",
        f"meshes.wheelset.zone_start={begins:.6g}", f"meshes.wheelset.zone_length={zone_end - begins:.6g}",
        f"meshes.wheelset.path_length={end + 0.13:.6g}",
        f"tracks.track.zone_start={begins:.6g}", f"tracks.track.zone_end={zone_end:.6g}",
        f"tracks.track.path_end={end + 0.1:.6g}",
        f"contacts.tread.zone_lateral_end={event * np.tan(angle) + CLIMBS:.6g}",
        f"output_windows.solutions.start={times[0]:.9g}", f"output_windows.solutions.end={times[1]:.9g}",
        f"output_windows.later.start={times[1]:.9g}", f"output_windows.later.end={times[2]:.9g}",
        f"time.end={times[2]:.9g}",
    ]


def simulate(steps, angles, coarse):
    """Runs the angles, mrad; their contact solutions. Returns a Passing for each."""
    found = {}
    for angle in angles:
        results = steps.run(f"angle_{angle}", CASE, settings(angle, coarse))
        nodes = steps.derive(steps.path(f"solution_{angle}.h5"), results, "contact", results, "--hdf5")
        found[angle] = Passing(angle, results, nodes, way_before(angle, coarse))
    return found


@dataclasses.dataclass(frozen=True)
class Side:
    """What one side, tread or flange, carries at an output: all its touching nodes together. Forces on the wheel in kN,
    along the rail and across it in the tangent plane, to the left or upwards; area in mm2, of the nodes; peaks in MPa;
    contact angle in degrees; share of the nodes that slip (eq. 3.6); centre in m."""

    normal: float
    longitudinal: float
    lateral: float
    area: float
    pressure: float
    shear: float
    contact_angle: float
    slipping: float
    centre: np.ndarray


NOTHING = Side(*[np.nan] * 8, np.full(3, np.nan))


def side_of(place, normal, tangential, area, friction):
    """The side that these touching nodes make: places in m, forces in N (nodes, 3), areas in m2."""
    sum_normal = normal.sum(axis=0)
    force = np.linalg.norm(sum_normal)
    if not force > 0:
        return NOTHING
    up = sum_normal / force
    along = np.array([1.0, 0, 0]) - up[0] * up
    along /= np.linalg.norm(along)
    across = np.cross(up, along)
    held, used = friction * np.linalg.norm(normal, axis=1), np.linalg.norm(tangential, axis=1)
    total = tangential.sum(axis=0)
    return Side(
        1e-3 * force, 1e-3 * float(total @ along), 1e-3 * float(total @ across), 1e6 * float(area.sum()),
        1e-6 * float((np.linalg.norm(normal, axis=1) / area).max()), 1e-6 * float((used / area).max()),
        float(np.degrees(np.arctan2(np.hypot(*up[:2]), abs(up[2])))),
        float((held - used < SLIPS * used.max()).mean()), np.average(place, axis=0, weights=held))


class Sides:
    """A side over the outputs: an array for each quantity of Side."""

    def __init__(self, sides):
        for field in dataclasses.fields(Side):
            setattr(self, field.name, np.array([getattr(side, field.name) for side in sides]))

    @property
    def theta(self):
        """Direction of the tangential force from the rolling direction, degrees."""
        return np.degrees(np.arctan2(np.abs(self.lateral), np.abs(self.longitudinal)))

    @property
    def touches(self):
        return np.nan_to_num(self.normal) > 1e-3 * TOUCHES

    def mean_shear(self):
        """Longitudinal and lateral, over the patch, MPa."""
        with np.errstate(invalid="ignore", divide="ignore"):
            return 1e3 * self.longitudinal / self.area, 1e3 * self.lateral / self.area


def sides_of(pair):
    """Times of the outputs, s, and what tread and flange carry then, of the group of a contact in a results file with
    `output.contact_margin`. Nodes are told apart by how much their normal force leans: where the flange's root touches
    too, both sides are one patch."""
    near, rows = pair["slave/near"], np.concatenate([[0], pair["slave/rows"][:]])
    normal, tangential, displacement = (near[name][:] for name in ("normal_force", "tangential_force", "displacement"))
    area, node, coordinates = near["area"][:], near["node"][:], pair["slave/coordinates"][:]
    leans = np.arctan2(np.hypot(normal[:, 0], normal[:, 1]), np.abs(normal[:, 2]))
    friction = float(pair.attrs["friction"])
    both = [], []
    for first, last in zip(rows[:-1], rows[1:]):
        here = np.arange(first, last)
        here = here[np.linalg.norm(normal[here], axis=1) > TOUCHING]
        for side, own in zip(both, (here[leans[here] <= STEEP], here[leans[here] > STEEP])):
            side.append(side_of(coordinates[node[own]] + displacement[own], normal[own], tangential[own], area[own],
                                friction))
    return pair["time"][:], Sides(both[0]), Sides(both[1])


class Passing:
    """One angle of attack, mrad: both sides over the outputs, and the wheel's place along the rail, m."""

    def __init__(self, angle, results, solution, left_out=0.0):
        self.angle, self.results, self.solution, self.left_out = angle, results, solution, left_out
        with h5py.File(results, "r") as file:
            self.time, self.tread, self.flange = sides_of(file["contact/tread"])
            history = file["history"]
            time = history["time"][:]
            bore = history["set/wheelset.bore"]
            # The bore's middle is that of the wheel: its place along the rail is the wheel's.
            place = bore["position"][0] + bore["displacement"][:, 0] + left_out
            self.balance = np.abs(history["energy/balance_error"][:]).max() / history["energy/internal"][:].max()
            self.seconds = float(file.attrs.get("wall_seconds", np.nan))
            self.unbalance = float(file.attrs.get("settled_unbalance", np.nan))
        self.place = np.interp(self.time, time, place)

    def touching(self, k):
        """Places of the wheel's nodes that touch at output k, m (nodes, 3)."""
        with h5py.File(self.results, "r") as file:
            slave = file["contact/tread/slave"]
            last = slave["rows"][:]
            own = slice(last[k - 1] if k else 0, last[k])
            near = slave["near"]
            touches = np.linalg.norm(near["normal_force"][own], axis=1) > TOUCHING
            return (slave["coordinates"][:][near["node"][own]] + near["displacement"][own])[touches]

    @functools.cached_property
    def first(self):
        """Number of the output at which the flange first touches; None: never."""
        touches = np.flatnonzero(self.flange.touches)
        return int(touches[0]) if len(touches) else None

    def frames(self):
        """Numbers of the outputs nearest to the thesis's nine frames: five before the flange touches, four from then
        on; fewer where the outputs end."""
        if self.first is None:
            return []
        places = self.place[self.first] + FRAME * np.arange(-5, 4)
        step = np.median(np.diff(self.place))
        return [int(np.abs(self.place - x).argmin()) for x in places if np.abs(self.place - x).min() < 0.6 * step]

    def unloaded(self):
        """Where the tread first carries less than a hundredth of what it did before, m; None: never."""
        if self.first is None:
            return None
        before = np.nanmean(self.tread.normal[:self.first])
        less = np.flatnonzero(np.nan_to_num(self.tread.normal[self.first:]) < 0.01 * before)
        return float(self.place[self.first + less[0]]) if len(less) else None


def _between(values, form="{:.0f}"):
    values = np.asarray(values)[np.isfinite(values)]
    if not len(values):
        return "none"
    low, high = form.format(values.min()), form.format(values.max())
    return low if low == high else f"{low} to {high}"


def findings(found):
    """Rows of the study's table: what, thesis, found, off by; each a text."""
    rows = []
    for angle, one in sorted(found.items()):
        where, tread, flange = f"{angle} mrad", one.tread, one.flange
        rows.append((f"{where}: energy balance; static start; wall time", "",
                     f"{100 * one.balance:.3f} %; {one.unbalance:.1e}; {one.seconds:.0f} s"))
        if one.first is None:
            rows.append((f"{where}: the flange touches at", f"{ANGLES[angle]:.2f} m", "never"))
            continue
        first, frames = one.first, one.frames()
        before = [k for k in frames if k < first]
        after = [k for k in frames if k >= first]
        place = one.place[first]
        later = slice(first, None)
        rows += [
            (f"{where}: the flange touches at", f"{ANGLES[angle]:.2f} m", f"{place:.3f} m",
             tables.off_by(place, ANGLES[angle])),
            (f"{where}: contact angle of patch 2", "65 to 75 deg", f"{_between(flange.contact_angle[later])} deg"),
            (f"{where}: normal force of patch 1 before, from then on", "falls",
             f"{_between(tread.normal[before])}; {', '.join(f'{v:.0f}' for v in tread.normal[after])} kN"),
            (f"{where}: normal force of patch 2", "grows", f"{', '.join(f'{v:.0f}' for v in flange.normal[after])} kN"),
            (f"{where}: lateral force of patch 1 before, from then on", "jumps",
             f"{_between(tread.lateral[before], '{:.1f}')}; {', '.join(f'{v:.1f}' for v in tread.lateral[after])} kN"),
            (f"{where}: lateral force of patch 2", "jumps",
             f"{', '.join(f'{v:.1f}' for v in flange.lateral[after])} kN"),
            (f"{where}: longitudinal force of patch 1 before, from then on", "falls",
             f"{_between(tread.longitudinal[before], '{:.1f}')};"
             f" {', '.join(f'{v:.1f}' for v in tread.longitudinal[after])} kN"),
            (f"{where}: longitudinal force of patch 2", "grows",
             f"{', '.join(f'{v:.1f}' for v in flange.longitudinal[after])} kN"),
            (f"{where}: theta of patch 1 before, from then on", "under 20 deg; about 70",
             f"{_between(tread.theta[before])}; {', '.join(f'{v:.0f}' for v in tread.theta[after])} deg"),
            (f"{where}: theta of patch 2", "60 to 70 deg", f"{', '.join(f'{v:.0f}' for v in flange.theta[after])} deg"),
            (f"{where}: nodes that slip in patch 1 before, from then on; in patch 2", "part; all; all",
             f"{_between(tread.slipping[before], '{:.2f}')};"
             f" {', '.join(f'{v:.2f}' for v in tread.slipping[after])};"
             f" {', '.join(f'{v:.2f}' for v in flange.slipping[after])}"),
            (f"{where}: areas of patch 1 before, from then on; of patch 2", "shrinks; grows",
             f"{_between(tread.area[before])}; {', '.join(f'{v:.0f}' for v in tread.area[after])};"
             f" {', '.join(f'{v:.0f}' for v in flange.area[after])} mm2"),
            (f"{where}: largest pressure and shear of patch 2", "1500, 450 MPa (of the three)",
             f"{np.nanmax(flange.pressure):.0f}, {np.nanmax(flange.shear):.0f} MPa"),
            (f"{where}: patch 1 is unloaded at", "yes" if angle == 25 else "",
             "never, to " + f"{one.place[-1]:.3f} m; least {np.nanmin(tread.normal[later]):.0f} kN"
             if one.unloaded() is None else f"{one.unloaded():.3f} m"),
        ]
    return rows
