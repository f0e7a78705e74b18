"""Reads what the pictures need from a results file (docs/results-file.md)."""

import os

import h5py
import numpy as np


class BadFile(Exception):
    """The file cannot be used; the text says why, and what to do."""


class NearNodes:
    """A field of a contact surface of which only nodes near the contact are written (output.contact_margin), as if it
    were written whole: zero of forces and stresses elsewhere, not-a-number of the rest."""

    ZERO = ("normal_force", "tangential_force", "pressure", "shear", "slipping")

    def __init__(self, side, name):
        self._rows, self._node, self._values = side["rows"][:], side["near/node"], side[f"near/{name}"]
        self._elsewhere = 0.0 if name in self.ZERO else np.nan
        self.shape = (len(self._rows), len(side["nodes"]), *self._values.shape[1:])
        self.ndim, self.dtype = len(self.shape), self._values.dtype
        self.name, self.attrs = self._values.name, self._values.attrs

    def __len__(self):
        return len(self._rows)

    def __getitem__(self, output):
        output = range(len(self))[output]
        first, last = (self._rows[output - 1] if output else 0), self._rows[output]
        whole = np.full(self.shape[1:], self._elsewhere)
        whole[self._node[first:last]] = self._values[first:last]
        return whole


class ContactSide:
    """One side of a contact as if it were a group of /fields."""

    ELSEWHERE = {"connectivity": "facets", "elements": "facets"}

    def __init__(self, group, side):
        self._side, self._time, self.name = group[side], group["time"], group[side].name
        self._near = set(self._side["near"]) - {"node"} if "near" in self._side else set()

    def __getitem__(self, name):
        if name in self._near:
            return NearNodes(self._side, name)
        return self._time if name == "time" else self._side[self.ELSEWHERE.get(name, name)]

    def __contains__(self, name):
        return name in self._near or name == "time" or self.ELSEWHERE.get(name, name) in self._side

    def items(self):
        own = [(name, data) for name, data in self._side.items() if name not in ("near", "rows")]
        return own + [(name, self[name]) for name in sorted(self._near)]


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
            name: (
                self._get(f"history/contact/{name}/normal_force")[:],
                self._get(f"history/contact/{name}/tangential_force")[:],
            )
            for name in self._get("history/contact")
        }
        time = group["time"][:]
        # A kill in the middle of a write may leave the arrays with different lengths.
        n = min(
            [len(time)] + [len(e) for e in energies.values()] + [len(f) for pair in contacts.values() for f in pair]
        )
        return time[:n], {k: e[:n] for k, e in energies.items()}, {k: (a[:n], b[:n]) for k, (a, b) in contacts.items()}

    def fields(self):
        """Groups of /fields by name: parts, element sets and surfaces that the run wrote."""
        return dict(self._file["fields"].items()) if "fields" in self._file else {}

    def contact_sides(self):
        """Both sides of each contact, as "contact NAME slave" and "contact NAME master", with the names of /fields."""
        return {
            f"contact {name} {side}": ContactSide(group, side)
            for name, group in self._get("contact").items()
            for side in ("slave", "master")
            if side in group
        }

    def friction(self, name):
        """Coefficient of friction of a contact."""
        return float(self._get(f"contact/{name}").attrs.get("friction", 0))
