"""Reads what the pictures need from a results file (docs/results-file.md)."""

import os

import h5py
import numpy as np


class BadFile(Exception):
    """The file cannot be used; the text says why, and what to do."""


class Results:
    def __init__(self, path):
        self.path = path
        if not os.path.isfile(path):
            raise BadFile(f"there is no results file {path}")
        try:
            self._file = h5py.File(path, "r")
        except OSError as error:
            raise BadFile(f"{path} cannot be read as an HDF5 file: {error}") from None
        if self._file.attrs.get("format") != "Railwave results":
            raise BadFile(f"{path} is an HDF5 file, but no results file of Railwave")
        if self._file.attrs.get("format_version", 0) > 1:
            raise BadFile(f"{path} was written by a newer program ({self._file.attrs.get('program')})")

    @property
    def title(self):
        return self._file.attrs.get("title", "")

    @property
    def completed(self):
        return bool(self._file.attrs.get("completed", 0))

    def _get(self, name):
        try:
            return self._file[name]
        except KeyError:
            raise BadFile(f"{self.path} is damaged: it has no {name}") from None

    def contacts(self):
        return list(self._get("contact"))

    def history(self):
        """Time (n), energies by name (n), and by contact the normal and the tangential force (n, 3)."""
        group = self._get("history")
        energies = {name: data[:] for name, data in self._get("history/energy").items()}
        contacts = {
            name: (self._get(f"history/contact/{name}/normal_force")[:], self._get(f"history/contact/{name}/tangential_force")[:])
            for name in self._get("history/contact")
        }
        time = group["time"][:]
        # A kill in the middle of a write may leave the arrays with different lengths.
        n = min([len(time)] + [len(e) for e in energies.values()] + [len(f) for pair in contacts.values() for f in pair])
        return time[:n], {k: e[:n] for k, e in energies.items()}, {k: (a[:n], b[:n]) for k, (a, b) in contacts.items()}

    def contact(self, name):
        return Contact(self, name)


class Contact:
    """One contact pair, its slave side."""

    ARRAYS = ("position", "area", "normal", "normal_force", "tangential_force", "slip_velocity", "slipping")

    def __init__(self, results, name):
        self.name = name
        group = results._get(f"contact/{name}")
        self._slave = results._get(f"contact/{name}/slave")
        self.friction = float(group.attrs.get("friction", 0))
        self.surface = self._slave.attrs.get("surface", "the slave surface")
        self.facets = results._get(f"contact/{name}/slave/facets")[:]
        missing = [a for a in self.ARRAYS if a not in self._slave]
        if missing:
            raise BadFile(f"{results.path} is damaged: contact {name} has no {', '.join(missing)}")
        times = results._get(f"contact/{name}/time")[:]
        self.times = times[: min([len(times)] + [len(self._slave[a]) for a in self.ARRAYS])]

    def nearest(self, time):
        """Number of the output time nearest to `time` (None: the last)."""
        return len(self.times) - 1 if time is None else int(np.argmin(np.abs(self.times - time)))

    def patch(self, index):
        return Patch(self, {a: self._slave[a][index] for a in self.ARRAYS})


class Patch:
    """The contact at one instant, in the plane of the patch: x along the rail, y across, both mm; stresses MPa; forces kN."""

    THRESHOLD = 1e-3  # N: below it a node is not in contact (thesis 3.4.1)

    def __init__(self, contact, state):
        force, normal, area = state["normal_force"], state["normal"], state["area"]
        pressing = -np.einsum("ij,ij->i", force, normal)
        self.touching = pressing > self.THRESHOLD
        self.facets = contact.facets
        self.friction = contact.friction
        self.pressure = np.where(self.touching, pressing / np.maximum(area, 1e-30), 0) * 1e-6
        total = force[self.touching].sum(axis=0)
        self.normal_force = np.linalg.norm(total) * 1e-3
        direction = total / np.linalg.norm(total) if self.touching.any() else np.array([0.0, 0.0, 1.0])
        along, across = self._in_plane(0, direction), self._in_plane(1, direction)

        centre = np.average(state["position"], axis=0, weights=np.where(self.touching, pressing, 0)) if self.touching.any() else np.zeros(3)
        offset = state["position"] - centre
        self.centre = 1e3 * centre[:2]
        self.x, self.y = 1e3 * (centre[0] + offset @ along), 1e3 * (centre[1] + offset @ across)

        tangential = np.where(self.touching[:, None], state["tangential_force"], 0)
        stress = 1e-6 * tangential / np.maximum(area, 1e-30)[:, None]
        self.shear_x, self.shear_y = stress @ along, stress @ across
        self.creep_force, self.lateral_force = 1e-3 * tangential.sum(axis=0) @ along, 1e-3 * tangential.sum(axis=0) @ across
        slip = np.where(self.touching[:, None], state["slip_velocity"], 0)
        self.slip_x, self.slip_y = slip @ along, slip @ across
        self.slipping = state["slipping"] == 2

    @staticmethod
    def _in_plane(axis, normal):
        direction = np.eye(3)[axis] - normal[axis] * normal
        length = np.linalg.norm(direction)
        return direction / length if length > 1e-6 else np.zeros(3)

    @property
    def traction_coefficient(self):
        return np.hypot(self.creep_force, self.lateral_force) / self.normal_force if self.normal_force > 0 else 0.0

    def half_size(self):
        """Half length and half width of the window that shows the patch, mm."""
        if not self.touching.any():
            return 5.0, 5.0
        margin = 1.2 * self.cell_size()
        return (
            np.abs(self.x[self.touching] - self.centre[0]).max() + margin,
            np.abs(self.y[self.touching] - self.centre[1]).max() + margin,
        )

    def cell_size(self):
        """Size of the facets that touch, mm."""
        near = self.facets[self.touching[self.facets].any(axis=1)]
        if len(near) == 0:
            return 1.0
        edge = np.hypot(self.x[near[:, 1]] - self.x[near[:, 0]], self.y[near[:, 1]] - self.y[near[:, 0]])
        other = np.hypot(self.x[near[:, 2]] - self.x[near[:, 1]], self.y[near[:, 2]] - self.y[near[:, 1]])
        return float(max(np.median(edge), np.median(other)))

    def square_of_pressure(self):
        """Pressure squared by node, MPa2, and below zero outside: continued there from the nearest touching nodes by a plane.

        Near the edge of a smooth contact the pressure goes as the root of the distance, so that its square crosses zero
        like a plane, and shows the edge finer than the mesh.
        """
        square = self.pressure**2
        inside = np.flatnonzero(self.touching)
        ring = np.setdiff1d(self.facets[self.touching[self.facets].any(axis=1)], inside)
        scale = self.cell_size()
        for node in ring:
            distance = np.hypot(self.x[inside] - self.x[node], self.y[inside] - self.y[node])
            near = inside[np.argsort(distance)[:8]]
            offset = np.column_stack([np.ones(len(near)), (self.x[near] - self.x[node]) / scale, (self.y[near] - self.y[node]) / scale])
            value = np.linalg.lstsq(offset, square[near], rcond=None)[0][0] if len(near) >= 4 else -square[near].mean()
            square[node] = min(value, -1e-3 * square[near].max())
        return square

    def triangles(self):
        """The facets around the patch, each as two triangles (node numbers); empty without contact."""
        near = self.facets[self.touching[self.facets].any(axis=1)]
        return np.concatenate([near[:, [0, 1, 2]], near[:, [0, 2, 3]]]) if len(near) else np.zeros((0, 3), int)
