"""What the study keeps of a run, in one small file: velocity of the running surface, nodes of the wheel that touch,
forces. All that the study finds comes from these files, which can be taken elsewhere."""

import functools

import h5py
import numpy as np

from near_nodes import near_nodes
from running_surface import RunningSurface

LEAST_FORCE = 1e-3  # N, of a node that touches
COLUMNS = ("node", "place", "normal", "tangential", "slip")  # places from the mean of those that touch
ATTRIBUTES = ("wall_seconds", "output_seconds", "settled_unbalance", "completed")


def write(path, results, tangential):
    """Reduces a results file. The surface's velocity is less its median, which is kept beside it; the tangential one,
    unless `tangential`, only at nodes that have an arrow in pictures."""
    surface = RunningSurface(results, "track_rail.waves")
    chosen = in_windows(surface.time)
    velocity = surface.velocity[chosen].astype(np.float32)
    swaying = np.median(velocity, axis=1)
    velocity = velocity - swaying[:, None]
    if not tangential:
        bare = np.ones(velocity.shape[1], bool)
        bare[surface.with_arrow] = False
        velocity[:, bare, :2] = 0
    kept = {"time": surface.time[chosen], "place": surface.place, "facets": surface.facets, "swaying": swaying,
            "velocity": velocity.astype(np.float16)}
    times, rows, origins, columns = [], [], [], []
    for time, place, normal, node, tangent, slip in near_nodes(results, "tread", "node", "tangential_force",
                                                               "slip_velocity"):
        touching = normal > LEAST_FORCE
        times.append(time)
        rows.append(touching.sum())
        origins.append(place[touching, :2].mean(axis=0) if touching.any() else np.zeros(2))
        columns.append([node[touching], place[touching, :2] - origins[-1], normal[touching], tangent[touching, :2],
                        slip[touching, :2]])
    chosen = in_windows(np.array(times))
    columns = [column for column, inside in zip(columns, chosen) if inside]
    kept["contact_time"], kept["contact_rows"] = np.array(times)[chosen], np.cumsum(np.array(rows)[chosen])
    kept["contact_origin"] = np.array(origins)[chosen]
    for name, values in zip(COLUMNS, zip(*columns)):
        kept[f"contact_{name}"] = np.concatenate(values).astype(np.int32 if name == "node" else np.float16)
    with h5py.File(results, "r") as file:
        history = file["history"]
        kept["history_time"] = history["time"][:]
        for force in ("normal_force", "tangential_force", "nodes_in_contact"):
            kept[f"history_{force}"] = history[f"contact/tread/{force}"][:]
        kept["balance"] = history["energy/balance_error"][:]
        kept["internal"] = history["energy/internal"][:]
        kept["friction"] = file["contact/tread"].attrs["friction"]
        for name in ATTRIBUTES:
            kept[name] = float(file.attrs.get(name, np.nan))
    np.savez_compressed(path, **kept)


def in_windows(time):
    """Which outputs have another nearby: those of the run's ends stand alone."""
    near = np.diff(time) < 5e-5
    return np.append(near, False) | np.insert(near, 0, False)


class Rolled:
    """A run's reduced data. Times are those of the whole way: those of the file, and `earlier`."""

    def __init__(self, name, path, earlier=0.0):
        self.name, self.path, self.earlier = name, path, earlier
        with np.load(path) as file:
            self._kept = {key: file[key] for key in file.files}
        self.normal = 1e-3 * np.linalg.norm(self._kept["history_normal_force"], axis=1)  # kN
        self.longitudinal, self.lateral = 1e-3 * self._kept["history_tangential_force"][:, :2].T
        self.time = self._kept["history_time"] + earlier
        self.friction = float(self._kept["friction"])
        self.balance = self._kept["balance"]
        self.energy_share = np.abs(self.balance).max() / self._kept["internal"].max()

    def __getitem__(self, key):
        return self._kept[key]

    @functools.cached_property
    def surface(self):
        """The RunningSurface, its times those of the whole way."""
        return RunningSurface.of(self["time"] + self.earlier, self["place"], self["facets"],
                                 self["velocity"].astype(np.float32))

    def contacts(self):
        """Of each output: time, s; nodes; their x and y, m; normal force, N; tangential force on the wheel, N; slip,
        m/s."""
        first = 0
        outputs = zip(self["contact_time"] + self.earlier, self["contact_rows"], self["contact_origin"])
        for time, last, origin in outputs:
            if last > first:
                node, *rest = (self[f"contact_{name}"][first:last] for name in COLUMNS)
                place, normal, tangential, slip = (values.astype(float) for values in rest)
                yield float(time), node, place + origin, normal, tangential, slip
            first = last

    @functools.cached_property
    def patches(self):
        """Of each output: time; the forces' centre, x and y; half length and half width; mean slip along x and y,
        weighted by the normal force; all by rows."""
        rows = []
        for time, _, place, normal, _, slip in self.contacts():
            centre = normal @ place / normal.sum()
            spread = np.sqrt(5 * (normal @ (place - centre) ** 2) / normal.sum())  # of a half-ellipsoid
            rows.append((time, *centre, *spread, *(normal @ slip / normal.sum())))
        return np.array(rows)

    def patch_at(self, time):
        """x, y, half length, half width, slip along x and y at a time, between outputs."""
        return np.array([np.interp(time, self.patches[:, 0], column) for column in self.patches.T[1:]])
