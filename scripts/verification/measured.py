"""What a run came out with, from its results file (docs/results-file.md): pressure and shear on the slave's mesh lines,
areas finer than the mesh, forces. SI units."""

import csv
import pathlib
import subprocess
import tempfile

import h5py
import numpy as np


def outlines(x, y, value):
    """Points of the line round `value` > 0 on a structured surface, (points, 2). Where a mesh line leaves the inside,
    the zero of the parabola through the squares at its last three nodes inside, between the last one and the next node
    (as `railwave contact` does, src/post/patch_shape.cpp)."""
    points = []
    place = np.stack([x, y], axis=-1)

    def along(place, value):
        inside = value > 0
        for i in range(len(value)):
            if not inside[i]:
                continue
            for step in (1, -1):
                out, second, third = i + step, i - step, i - 2 * step
                if not 0 <= out < len(value) or inside[out]:
                    continue
                edge = np.linalg.norm(place[out] - place[i])
                distance = 0.5 * edge
                if 0 <= second < len(value) and inside[second]:
                    before = np.linalg.norm(place[second] - place[i])
                    slope, bend = (value[i] ** 2 - value[second] ** 2) / before, 0.0
                    if 0 <= third < len(value) and inside[third]:
                        further = np.linalg.norm(place[third] - place[second])
                        bend = (slope - (value[second] ** 2 - value[third] ** 2) / further) / (before + further)
                    linear = slope + bend * before
                    root = linear**2 - 4 * bend * value[i] ** 2
                    bottom = -linear + np.sqrt(max(root, 0))
                    distance = edge if root < 0 or bottom <= 0 else min(edge, 2 * value[i] ** 2 / bottom)
                points.append(place[i] + distance / edge * (place[out] - place[i]))

    for row in range(value.shape[0]):
        along(place[row], value[row])
    for column in range(value.shape[1]):
        along(place[:, column], value[:, column])
    return np.array(points).reshape(-1, 2)


def enclosed(points, mirrors=""):
    """Area of the polygon through the points, by angle about their middle; mirrored first at x = 0 and y = 0 as
    said."""
    for axis in mirrors:
        turned = points.copy()
        turned[:, "xy".index(axis)] *= -1
        points = np.concatenate([points, turned])
    if len(points) < 3:
        return 0.0
    from_middle = points - 0.5 * (points.min(axis=0) + points.max(axis=0))
    x, y = from_middle[np.argsort(np.arctan2(from_middle[:, 1], from_middle[:, 0]))].T
    return 0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def shares(x, y, exact, samples=12):
    """Means of exact(x, y) over each node's share, weighted by its shape function: what the nodal forces of an exact
    stress would be over the nodes' areas. A node's stress is such a mean, too."""
    total, weight = np.zeros(x.shape), np.zeros(x.shape)
    places = (np.arange(samples) + 0.5) / samples
    for s in places:
        for t in places:
            corner = [
                ((1 - s) * (1 - t), slice(None, -1), slice(None, -1)),
                (s * (1 - t), slice(None, -1), slice(1, None)),
                ((1 - s) * t, slice(1, None), slice(None, -1)),
                (s * t, slice(1, None), slice(1, None)),
            ]
            px, py = (sum(w * values[j, i] for w, j, i in corner) for values in (x, y))
            cell = np.abs((x[:-1, 1:] - x[:-1, :-1]) * (y[1:, :-1] - y[:-1, :-1]))
            value = exact(px, py) * cell
            for w, j, i in corner:
                total[j, i] += w * value
                weight[j, i] += w * cell
    return total / weight


def stick_shares(x, y, pressure, shear, sticks, area, friction):
    """Of the patch's area: inside the zero line of mu p - q of the nodes that stick, and by the nodes' areas."""
    left = friction * pressure - np.linalg.norm(shear, axis=-1)
    inside = enclosed(outlines(x, y, np.where(sticks, np.maximum(left, 0), 0)))
    return inside / enclosed(outlines(x, y, pressure)), area[sticks].sum() / area[pressure > 0].sum()


class State:
    """The slave surface at one output time, its nodes in rows along x: arrays (rows, columns[, 3])."""

    def __init__(self, contact, index):
        slave = contact["slave"]
        place = slave["coordinates"][:]
        side = np.round(place[:, 1], 9)
        order = np.lexsort((place[:, 0], side))
        rows = len(np.unique(side))
        shape = (rows, len(side) // rows)

        def take(name):
            values = slave[name][index][order]
            return values.reshape(shape + values.shape[1:])

        self.time = contact["time"][index]
        self.friction = take("friction") if "friction" in slave else float(contact.attrs["friction"])
        self.x, self.y = take("position")[..., 0], take("position")[..., 1]
        self.pressure, self.area, self.shear = take("pressure"), take("area"), take("shear")
        self.slipping, self.slip_velocity = take("slipping"), take("slip_velocity")
        self.normal_force, self.tangential_force = take("normal_force"), take("tangential_force")

    @property
    def bound_left(self):
        """mu p - q where that is more than a twentieth of its scale, 0 elsewhere. Its zero line, followed outwards from
        there, is the edge of the stick zone; a node that slipped and has been let off by a trace, as by a passing wave,
        is not in it."""
        left = self.friction * self.pressure - np.linalg.norm(self.shear, axis=-1)
        return np.where(left > 0.05 * self.friction * self.pressure.max(), left, 0)

    def centre(self):
        weight = np.linalg.norm(self.normal_force, axis=-1)
        return np.sum(weight * self.x) / np.sum(weight), np.sum(weight * self.y) / np.sum(weight)

    def stick_share(self):
        return stick_shares(self.x, self.y, self.pressure, self.shear, self.slipping == 1, self.area, self.friction)


def largest_patches(program, results, contact, first, last):
    """Of the outputs between two times, the rows of `railwave contact`, as texts, of the patch that presses most."""
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder) / "patches.csv"
        limits = ["--from", f"{first:.9g}", "--to", f"{last:.9g}"]
        subprocess.run(
            [program, "contact", results, "--csv", table, *limits], check=True, stdout=subprocess.DEVNULL
        )
        with open(table, encoding="utf-8") as file:
            largest = {}  # by time: numbers stay with patches, whatever their forces
            for row in csv.DictReader(file):
                if row["contact"] == contact and row["patch"] != "0" and float(row["normal_force"]) > float(
                    largest.get(row["time"], {"normal_force": 0})["normal_force"]
                ):
                    largest[row["time"]] = row
            return list(largest.values())


class Run:
    """@param program the railwave that computed it: for what `railwave contact` finds"""

    def __init__(self, path, program=None):
        self.path, self.program = path, program
        self.file = h5py.File(path, "r")
        self.contact = self.file["contact"][next(iter(self.file["contact"]))]
        self.name = next(iter(self.file["contact"]))
        attributes = self.file.attrs
        self.step_size, self.elements = float(attributes["step_size"]), int(attributes["element_count"])
        self.seconds, self.steps = float(attributes.get("wall_seconds", np.nan)), int(attributes.get("steps", 0))

    def state(self, index=-1):
        return State(self.contact, index if index >= 0 else len(self.contact["time"]) + index)

    def times(self):
        return self.contact["time"][:]

    def creepages(self, start, end):
        """Longitudinal, lateral, spin of the largest patch at each output between these shares of the run, by `railwave
        contact`; None without the program."""
        if self.program is None:
            return None
        end_of_run = self.times()[-1]
        rows = largest_patches(self.program, self.path, self.name, start * end_of_run, end * end_of_run + 1e-6)
        return np.array(
            [[float(row[f"{which}_creepage"]) for which in ("longitudinal", "lateral", "spin")] for row in rows]
        )

    def history(self):
        """Time, normal and tangential force on the slave, (n, 3)."""
        group = self.file["history"]
        force = group["contact"][self.name]
        return group["time"][:], force["normal_force"][:], force["tangential_force"][:]

    def energy(self):
        """Largest imbalance and largest energy of the run, J."""
        energy = {name: data[:] for name, data in self.file["history/energy"].items()}
        balance = np.abs(energy.pop("balance_error")).max()
        return balance, max(np.abs(values).max() for values in energy.values())

    def on_axis(self, part):
        """Undeformed z and displacement u_z at the first output along the vertical through (0, 0) of a part whose
        columns of nodes are upright there, between the four nearest columns; by z."""
        fields = self.file["fields"][part]
        place, moved = np.round(fields["coordinates"][:], 9), fields["displacement"][0][:, 2]
        top = place[np.isclose(place[:, 2], place[np.argmin(np.hypot(place[:, 0], place[:, 1])), 2], atol=1e-4)]

        def around(values):
            below, above = values[values <= 0].max(), values[values >= 0].min()
            return (
                [(below, 1.0)]
                if below == above
                else [(below, above / (above - below)), (above, -below / (above - below))]
            )

        total = None
        for x, wx in around(top[:, 0]):
            for y, wy in around(top[:, 1]):
                column = np.flatnonzero((np.abs(place[:, 0] - x) < 1e-8) & (np.abs(place[:, 1] - y) < 1e-8))
                column = column[np.argsort(place[column, 2])]
                add = wx * wy * np.stack([place[column, 2], moved[column]])
                total = add if total is None else total + add
        return total
