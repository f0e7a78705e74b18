"""Half a wheelset passes the joint: the simulations of the thesis's table 4.2, and what their results tell."""

import functools
import types

import h5py
import numpy as np

import worn_joint
from near_nodes import near_nodes
from steps import rows_of

START = 1.32  # m, from where the wheel begins to the gap's middle: the thesis's places count from there
SPEED = 27.78  # m/s
INTERVAL = 5e-5  # s, of the contact solutions that are kept node by node
# Places of the wheel, m from the gap's middle, between which it meets the rail behind it, and meets it again (4.5.2).
IMPACTS = {"first": (-0.01, 0.03), "second": (0.03, 0.08)}
# Where the footprint is narrow and where it is wide (4.5.2), m.
BANDS = ((1.310, 1.317), (1.330, 1.350), (1.380, 1.390))
ELASTIC = ["parts.wheelset.material=elastic", "tracks.track.rail_material=elastic"]
SETTLED = 0.3e-3  # s, from when on a run has forgotten its beginning
SIMULATIONS = {1: "elastic, nominal surface", 2: "bilinear, nominal surface", 3: "bilinear, worn surface"}
# Begins 40 mm before the gap, in elements of 5 mm: for two processors, to see that all is well.
COARSE_START = 0.04
COARSE = [
    "meshes.wheelset.zone_size=0.005", "meshes.wheelset.zone_start=-0.03", "meshes.wheelset.zone_length=0.15",
    "meshes.wheelset.path_start=-0.03", "meshes.wheelset.path_length=0.16", "meshes.wheelset.path_size=0.005",
    "meshes.wheelset.coarse_size=0.05", "meshes.wheelset.section_size=0.012", "meshes.wheelset.zone_layers=1",
    "meshes.wheelset.axle_size=0.06", "parts.wheelset.position=[-0.04, -0.0024, 0.62]",
    "points.sprung_mass.position=[-0.04, 0.9976, 0.62]", "tracks.track.start=-2.1", "tracks.track.end=2.1",
    "tracks.track.zone_size=0.006", "tracks.track.zone_layers=1", "tracks.track.zone_start=-0.07",
    "tracks.track.zone_end=0.07", "tracks.track.path_start=-0.07", "tracks.track.path_end=0.07",
    "tracks.track.path_size=0.006", "tracks.track.section_size=0.012", "tracks.track.coarse_size=0.05",
    "tracks.track.core_size=0.06", "absorbing_layers.first.length=1.2", "absorbing_layers.last.length=1.2",
    "curves.ramp.duration=1e-3", "settle.friction=true",
    "settle.tolerance=3e-3", "output.contact_margin=0.012", "time.end=2.9e-3",
    "output_windows.passage.start=0", "output_windows.passage.end=2.8e-3", "output_windows.passage.interval=1e-5",
    "output_windows.approach.start=1e-4", "output_windows.approach.end=3e-4",
    "output_windows.approach.interval=5e-6", "output_windows.landing.start=1.0e-3",
    "output_windows.landing.end=2.0e-3", "output_windows.landing.interval=5e-6",
    "output_windows.slipping.start=2.4e-3", "output_windows.slipping.end=2.6e-3",
    "output_windows.slipping.interval=5e-6",
]


def worn_surface(steps):
    """The height map of simulation 3, as the defaults of worn_joint.py have it."""
    shape = worn_joint.default_shape()
    path = steps.path("worn_joint.csv")
    steps.once("worn_joint", [worn_joint.__file__], sorted(vars(shape).items()), lambda: worn_joint.write(path, shape))
    return path


def settings(steps, number, coarse):
    """What a simulation changes in the case."""
    overrides = list(COARSE if coarse else [])
    if number == 1:
        overrides += ELASTIC
    if number == 3:
        overrides.append(f"tracks.track.height_map={worn_surface(steps)}")
    return overrides


def run(steps, case, number, coarse):
    """The results file of a simulation."""
    return steps.run(f"simulation_{number}", case, settings(steps, number, coarse))


def simulate(steps, case, coarse, numbers):
    """Runs the simulations; their contact solutions. Returns a Passing for each."""
    found = {}
    for number in numbers:
        results = run(steps, case, number, coarse)
        table = steps.derive(steps.path(f"contact_{number}.csv"), results, "contact", results, "--csv")
        nodes = steps.derive(steps.path(f"solution_{number}.h5"), results,
                             "contact", results, "--interval", INTERVAL, "--hdf5")
        found[number] = Passing(number, results, table, nodes, COARSE_START if coarse else START)
    return found


def wavelets(steps, found):
    """Wavelet power of the acceleration of the foot behind the joint (fig. 4.17): files by name."""
    files = {}
    for number, one in sorted(found.items()):
        low = max(100, 2 / one.time[-1])
        for name, axis in (("vertical", "z"), ("lateral", "y")):
            path = files[f"wavelet_{number}_{name}"] = steps.path(f"wavelet_{number}_{name}.h5")
            steps.derive(path, one.results, "signal", "wavelet", one.results, "--channel",
                         f"track_rail_2.behind.acceleration.{axis}", "--low", f"{low:.0f}", "--high", 10e3, "--hdf5")
    return files


class History:
    """What one simulation's histories tell."""

    def __init__(self, results, start):
        self.results, self.start = results, start
        with h5py.File(results, "r") as file:
            history = file["history"]
            self.time = history["time"][:]
            self.force = np.linalg.norm(history["contact/tread/normal_force"][:], axis=1)
            self.balance = np.abs(history["energy/balance_error"][:]).max() / history["energy/internal"][:].max()
            self.seconds = float(file.attrs.get("wall_seconds", np.nan))
            self.unbalance = float(file.attrs.get("settled_unbalance", np.nan))
            self.outputs_share = float(file.attrs.get("output_seconds", np.nan)) / self.seconds
            self.friction = float(file["contact/tread"].attrs["friction"])
            self.megabytes = results.stat().st_size / 1e6

    def place(self, time):
        """Of the wheel's centre along the track, from the gap's middle, m."""
        return SPEED * time - self.start

    def peak_force(self, impact="first"):
        """Largest normal force of an impact: kN, and where, m from the gap; nan: it has no peak there."""
        first, last = IMPACTS[impact]
        place = self.place(self.time)
        within = np.flatnonzero((place > first) & (place < last))
        k = within[self.force[within].argmax()] if len(within) else None
        if k is None or k in (within[0], within[-1]):
            return np.nan, np.nan
        return 1e-3 * self.force[k], place[k]


class Passing(History):
    """Besides, the patches' table, and the nodes' forces at each output."""

    def __init__(self, number, results, table, solution, start):
        super().__init__(results, start)
        self.number, self.solution = number, solution
        rows = [row for row in rows_of(table) if row["patch"] == "0"]
        self.patch = types.SimpleNamespace(
            **{
                column: np.array([float(row[column] or "nan") for row in rows])
                for column in (
                    "time", "nodes_in_contact", "area", "peak_nodal_pressure", "peak_shear", "normal_force",
                    "creep_force", "centre_x", "centre_y", "slipping_by_force", "slipping_by_velocity",
                    "semi_axis_along", "semi_axis_across",
                )
            }
        )

    def at(self, time):
        """The patch at the output nearest to a time; None: nothing touches then."""
        if not len(self.patch.time):
            return None
        k = int(np.abs(self.patch.time - time).argmin())
        here = types.SimpleNamespace(**{name: float(values[k]) for name, values in vars(self.patch).items()})
        return here if here.nodes_in_contact > 0 else None

    def mean_before(self, column, nearest=0.02):
        """Mean of a column of the patches while the whole patch is on the first rail."""
        before = (self.patch.centre_x < -nearest) & (self.patch.nodes_in_contact > 0)
        return float(getattr(self.patch, column)[before].mean()) if before.any() else float("nan")

    def in_bands(self, column):
        """Means of a column of the patches in each of BANDS, over that before the gap; nan: none there."""
        x, values = self.patch.centre_x + START, getattr(self.patch, column)
        means = [values[(x > first) & (x < last)] for first, last in BANDS]
        return [float(of.mean() / self.mean_before(column, 0.04)) if len(of) else np.nan for of in means]

    def slipping(self):
        """Share of the patch's nodes that slip, by output."""
        with np.errstate(invalid="ignore"):
            return self.patch.slipping_by_force / self.patch.nodes_in_contact

    def near_nodes(self, *more):
        """Of each output at which there are any: time, s; of the wheel's nodes near the patch their places, m from the
        gap, normal force, N, and the named fields beside these."""
        return near_nodes(self.results, "tread", *more)

    def front(self, time):
        """x of the foremost node that touches at the output nearest to a time, m from the gap."""
        with h5py.File(self.results, "r") as file:
            contact = file["contact/tread"]
            rows = np.concatenate([[0], contact["slave/rows"][:]])
            k = int(np.abs(contact["time"][:] - time).argmin())
            here, near = slice(rows[k], rows[k + 1]), contact["slave/near"]
            touching = np.linalg.norm(near["normal_force"][here], axis=1) > 1e-3
            x = contact["slave/coordinates"][:][near["node"][here], 0] + near["displacement"][here, 0]
            return float(x[touching].max())

    @functools.cached_property
    def _first_touch(self):
        for time, places, normal in self.near_nodes():
            touching = (places[:, 0] > 0) & (normal > 1e-3)
            if self.place(time) >= -0.05 and touching.any():
                return time, places[touching, :2].mean(axis=0)
        return None, None

    @property
    def touch(self):
        """When the wheel first touches the rail behind the gap, s; None: never."""
        return self._first_touch[0]

    @property
    def touched(self):
        """Where: x and y, m."""
        return self._first_touch[1]

    def positive_shear(self, share=0.1):
        """Where and when the rail behind the gap is pushed along the rolling direction, by nodes whose tangential force
        is more than a share of friction's bound: first and last time, s, least and largest place, m; None: never."""
        times, places = [], []
        for time, near, normal, tangential in self.near_nodes("tangential_force"):
            x = near[:, 0]
            if not -0.02 < self.place(time) < 0.02:
                continue
            along = -tangential[:, 0]  # the wheel's is opposite
            pushed = (x > 0) & (normal > 1) & (along > share * self.friction * normal)
            if pushed.any():
                times.append(time)
                places += [x[pushed].min(), x[pushed].max()]
        return (min(times), max(times), min(places), max(places)) if times else None

    def disturbances(self):
        """Of each output from SETTLED to 0.1 ms before the touch: time, s, and by how much the slip of a node in the
        leading half of the patch changed since the output before, at most, m/s."""
        found, before = [], {}
        for time, places, normal, node, slip in self.near_nodes("node", "slip_velocity"):
            if not SETTLED < time < self.touch - 1e-4:
                continue
            leads = (normal > 20) & (places[:, 0] > places[normal > 20, 0].mean())
            now = dict(zip(node[leads].tolist(), slip[leads]))
            changes = [np.linalg.norm(now[n] - before[n]) for n in now.keys() & before.keys()]
            if changes:
                found.append((time, max(changes)))
            before = now
        return np.array(found).reshape(-1, 2).T


def impact_text(force, place):
    return "no peak there" if np.isnan(force) else f"{force:.1f} kN at {1e3 * (START + place):.0f} mm"


def findings(found):
    """Rows of the study's table: what, thesis, found; each a text."""
    rows = []
    peaks = {number: one.peak_force() for number, one in found.items()}
    for number, one in sorted(found.items()):
        name = f"simulation {number}"
        pressure, area = 1e-6 * one.mean_before("peak_nodal_pressure"), 1e6 * one.mean_before("area")
        rows += [
            (f"{name}: force of the first impact", "at 1330 to 1350 mm",
             impact_text(*peaks[number])),
            (f"{name}: force of the second", "at 1380 to 1390 mm", impact_text(*one.peak_force("second"))),
            (f"{name}: largest pressure before the gap, mean", "", f"{pressure:.0f} MPa"),
            (f"{name}: area of the patch before the gap, mean", "", f"{area:.0f} mm2"),
            (f"{name}: largest pressure of the passage", "", f"{1e-6 * one.patch.peak_nodal_pressure.max():.0f} MPa"),
        ]
        bands = ", ".join(f"{1e3 * first:.0f} to {1e3 * last:.0f}" for first, last in BANDS)
        for what, column in (("area", "area"), ("width", "semi_axis_across")):
            rows.append((f"{name}: {what} of the patch at {bands} mm, over before",
                         "small, large, large" if number == 3 else "",
                         ", ".join("none" if np.isnan(ratio) else f"{ratio:.2f}" for ratio in one.in_bands(column))))
        slipping = one.slipping()
        landed = one.place(one.patch.time) > 0
        if np.isfinite(slipping[landed]).any():
            least = np.flatnonzero(landed)[np.nanargmin(slipping[landed])]
            most = np.flatnonzero(landed)[np.nanargmax(slipping[landed])]
            rows.append((
                f"{name}: least and most slip behind the gap",
                "nearly none 46.8 ms, most 47.7 ms (simulation 3)" if number == 3 else "",
                f"{slipping[least]:.2f} of the nodes at {1e3 * one.patch.time[least]:.2f} ms, {slipping[most]:.2f} at"
                f" {1e3 * one.patch.time[most]:.2f} ms",
            ))
        positive = one.positive_shear()
        rows.append((
            f"{name}: shear along the rolling direction behind the gap", "1323 to 1329 mm",
            "none" if positive is None else
            f"{1e3 * (START + positive[2]):.1f} to {1e3 * (START + positive[3]):.1f} mm, {1e3 * positive[0]:.3f} to"
            f" {1e3 * positive[1]:.3f} ms",
        ))
        rows += [
            (f"{name}: static start, unbalanced force over all forces", "", f"{one.unbalance:.1e}"),
            (f"{name}: energy balance over the largest elastic energy", "", f"{100 * one.balance:.4f} %"),
            (f"{name}: results, wall time of the loop, of which outputs", "",
             f"{one.megabytes:.1f} MB, {one.seconds:.0f} s, {100 * one.outputs_share:.1f} %"),
        ]
    if len(found) > 1:
        order = sorted(peaks, key=lambda number: -peaks[number][0])
        rows.append(("order of the forces of the first impact", "3 > 2 > 1", " > ".join(str(n) for n in order)))
        pressure = sorted(found, key=lambda number: -found[number].mean_before("peak_nodal_pressure"))
        rows.append(("order of the pressures before the gap", "1 is highest", " > ".join(str(n) for n in pressure)))
    return rows
