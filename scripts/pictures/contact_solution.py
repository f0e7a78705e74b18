"""The contact solution that `railwave contact --hdf5` found (docs/results-file.md), as the pictures need it."""

import os
import subprocess

import h5py
import numpy as np

from .results import BadFile


def solve(results, program, folder, arguments=()):
    """Runs `railwave contact` on a results file; returns the name of the file it wrote into `folder`."""
    if not os.access(program, os.X_OK):
        raise BadFile(
            f"there is no program {program}, which finds the contact solution: build it (scripts/run does), or name it"
            " with --program"
        )
    path = os.path.join(folder, "contact.h5")
    done = subprocess.run(
        [program, "contact", results, "--hdf5", path, *arguments],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False,
    )
    if done.returncode != 0:
        raise BadFile(
            done.stderr.strip().removeprefix("railwave: ") or f"{program} contact ended with {done.returncode}"
        )
    return path


class ContactSolution:
    """All contacts of a file that `railwave contact --hdf5` wrote."""

    def __init__(self, path):
        try:
            self._file = h5py.File(path, "r")
        except OSError as error:
            raise BadFile(f"{path} cannot be read as an HDF5 file: {error}") from None
        if self._file.attrs.get("format") != "Railwave contact solution":
            raise BadFile(f"{path} is no file that 'railwave contact --hdf5' wrote")
        self.title = self._file.attrs.get("title", "")

    def contacts(self):
        return [Contact(name, group) for name, group in self._file["contact"].items()]


class Contact:
    """One contact pair at all output times."""

    def __init__(self, name, group):
        self.name = name
        self.surface = group.attrs.get("surface", "the slave surface")
        self._tables = {
            table: {column: data[:] for column, data in group[table].items()}
            for table in ("patches", "nodes", "facets", "cuts")
        }
        rows = self._tables["patches"]
        self.times = rows["time"][rows["patch"] == 0]

    def nearest(self, time):
        """Number of the output time nearest to `time`, s (None: the last)."""
        return len(self.times) - 1 if time is None else int(np.argmin(np.abs(self.times - time)))

    def patches(self, index):
        """The patches at output time number `index`, the one with the largest normal force first."""
        rows = self._tables["patches"]
        found = np.flatnonzero((rows["time"] == self.times[index]) & (rows["patch"] > 0))
        return [Patch(self, row) for row in sorted(found, key=lambda row: -rows["normal_force"][row])]

    def numbers(self):
        """The numbers of all patches that were there at some output time: a patch keeps its own."""
        numbers = np.unique(self._tables["patches"]["patch"])
        return [int(number) for number in numbers if number > 0]

    def small(self, number):
        """By output time: whether that patch has fewer nodes than show its shape. Files of older programs list only one
        such patch, and do not say so."""
        if "small" not in self._tables["patches"]:
            return self.history("nodes_in_contact", number) < 4
        return self.history("small", number) > 0

    def history(self, column, patch=0):
        """A column of the patches' table against time: of one patch, 0: of all together. NaN where there is none."""
        rows = self._tables["patches"]
        mine = rows["patch"] == patch
        values = np.full(len(self.times), np.nan)
        values[np.searchsorted(self.times, rows["time"][mine])] = rows[column][mine]
        return values

    def of_row(self, table, row):
        """First entry and columns of the part of a table that belongs to row `row` of the patches."""
        columns = self._tables[table]
        first, last = np.searchsorted(columns["row"], [row, row + 1])
        return first, {name: values[first:last] for name, values in columns.items()}

    def whole_row(self, row):
        return {name: values[row] for name, values in self._tables["patches"].items()}


class Patch:
    """One patch at one instant, about its centre in its tangent plane: x along the rolling direction, y to its left,
    mm; stresses MPa, forces kN, velocities m/s. Arrays have an entry for each node of the facets that touch."""

    def __init__(self, contact, row):
        self.row = contact.whole_row(row)
        first, nodes = contact.of_row("nodes", row)
        _, facets = contact.of_row("facets", row)
        _, self._cuts = contact.of_row("cuts", row)
        self.time, self.number = self.row["time"], int(self.row["patch"])
        self.nodes = int(self.row["nodes_in_contact"])
        self.small = self.nodes < 4
        self.centre = 1e3 * np.array([self.row[f"centre_{c}"] for c in "xyz"])
        self.normal_force, self.creep_force, self.lateral_force = (
            1e-3 * self.row[f"{f}_force"] for f in ("normal", "creep", "lateral")
        )
        self.traction_coefficient = self.row["traction_coefficient"]

        self.x, self.y = 1e3 * nodes["along"], 1e3 * nodes["across"]
        self.touching = nodes["touching"] > 0
        self.pressure, self.bound = 1e-6 * nodes["pressure"], 1e-6 * nodes["traction_bound"]
        self.shear_x, self.shear_y = 1e-6 * nodes["shear_along"], 1e-6 * nodes["shear_across"]
        self.slip_x, self.slip_y = np.nan_to_num(nodes["micro_slip_along"]), np.nan_to_num(nodes["micro_slip_across"])
        self.parting = np.nan_to_num(nodes["parting_velocity"])
        self.slips = nodes["slips_by_force"] > 0
        self.slips_by_velocity = nodes["slips_by_velocity"] > 0
        self.facets = np.column_stack([facets[f"corner_{k}"] for k in range(4)]).astype(int) - first

    def cut(self, across=False):
        """Columns of the cut along (or across) the centre: distance mm, pressure, traction_bound, shear_* MPa,
        micro_slip_* m/s."""
        mine = self._cuts["cut"] == (1 if across else 0)
        scales = {"distance": 1e3, "pressure": 1e-6, "traction_bound": 1e-6, "shear_along": 1e-6, "shear_across": 1e-6}
        return {name: scales.get(name, 1) * values[mine] for name, values in self._cuts.items()}

    def half_size(self):
        """Half length and half width of the window that shows the patch, mm."""
        margin = 1.2 * self.cell_size()
        return np.abs(self.x[self.touching]).max() + margin, np.abs(self.y[self.touching]).max() + margin

    def cell_size(self):
        """Size of the facets, mm."""
        edges = [
            np.hypot(
                self.x[self.facets[:, a]] - self.x[self.facets[:, b]],
                self.y[self.facets[:, a]] - self.y[self.facets[:, b]],
            )
            for a, b in ((0, 1), (1, 2))
        ]
        return float(max(np.median(edge) for edge in edges))

    def square_of_pressure(self):
        """Pressure squared by node, MPa2, and below zero outside: continued there from the nearest touching nodes by a
        plane.

        Near the edge of a smooth contact the pressure goes as the root of the distance, so that its square crosses zero
        like a plane, and shows the edge finer than the mesh.
        """
        square = self.pressure**2
        inside = np.flatnonzero(self.touching)
        scale = self.cell_size()
        for node in np.flatnonzero(~self.touching):
            distance = np.hypot(self.x[inside] - self.x[node], self.y[inside] - self.y[node])
            near = inside[np.argsort(distance)[:8]]
            offset = np.column_stack(
                [np.ones(len(near)), (self.x[near] - self.x[node]) / scale, (self.y[near] - self.y[node]) / scale]
            )
            value = np.linalg.lstsq(offset, square[near], rcond=None)[0][0] if len(near) >= 4 else -square[near].mean()
            square[node] = min(value, -1e-3 * square[near].max())
        return square

    def triangles(self):
        """The facets, each as two triangles (numbers of the patch's nodes)."""
        return np.concatenate([self.facets[:, [0, 1, 2]], self.facets[:, [0, 2, 3]]])
