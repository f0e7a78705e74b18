"""Bodies and surfaces of a results file as their outer faces, moved and deformed, at each output."""

import numpy as np

from .faces import exterior
from .results import BadFile

TURNS, TRAVELS = 0.01, 0.1  # rad, and of its size: beyond these a body's rigid motion is not magnified
FITTED = 4000  # nodes at most from which the rigid motion is found


def rigid_motion(start, now):
    """Rotation R (3, 3) and translation t with least squares of R x + t - y (Kabsch), x and y (n, 3)."""
    a, b = start.mean(axis=0), now.mean(axis=0)
    u, _, v = np.linalg.svd((start - a).T @ (now - b))
    turn = v.T @ np.diag([1, 1, np.sign(np.linalg.det(v.T @ u.T)) or 1]) @ u.T
    return turn, b - turn @ a


class Body:
    """The outside of a volume, or a surface; with `box` (centre, half size) only the elements in there, undeformed."""

    def __init__(self, name, group, box=None):
        self.name, self.group = name, group
        self.nodes = group["coordinates"][:]
        cells = group["connectivity"][:]
        chosen = np.arange(len(cells))
        if box is not None:
            chosen = np.flatnonzero(np.all(np.abs(self.nodes[cells].mean(axis=1) - box[0]) <= box[1], axis=1))
        if cells.shape[1] == 8:
            self.faces, owner = exterior(cells[chosen])
            self.owner = chosen[owner]
        else:
            self.faces, self.owner = cells[chosen], chosen
        self.is_surface = cells.shape[1] != 8
        self.moves = "displacement" in group
        self.travels = False
        self._every = np.arange(0, len(self.nodes), max(1, len(self.nodes) // FITTED))

    def check_whether_it_travels(self, outputs):
        """Whether between these outputs its rigid motion is more than a small part of its size or of a turn."""
        if not self.moves or len(self._every) < 3:
            return
        size = np.linalg.norm(np.ptp(self.nodes, axis=0))
        for output in outputs:
            start, moved = self._known(output)
            if len(start) < 3:
                continue
            turn, _ = rigid_motion(start, moved)
            middle = (moved - start).mean(axis=0)
            angle = np.arccos(np.clip((np.trace(turn) - 1) / 2, -1, 1))
            if angle > TURNS or np.linalg.norm(middle) > TRAVELS * size:
                self.travels = True

    def _known(self, output):
        """Where nodes began and where they are: of a contact surface only those that were written then."""
        start, displacement = self.nodes[self._every], self.group["displacement"][output][self._every]
        known = np.isfinite(displacement).all(axis=1)
        return start[known], start[known] + displacement[known]

    def corners(self, output, scale=1.0):
        """Of each face (n, 4, 3), the deformation magnified: all motion, or of a body that travels what is not
        rigid."""
        if not self.moves:
            return self.nodes[self.faces]
        displacement = self.group["displacement"][output]
        place = self.nodes + displacement
        if scale != 1 and self.travels:
            turn, shift = rigid_motion(*self._known(output))
            rigid = self.nodes @ turn.T + shift
            place = rigid + scale * (place - rigid)
        elif scale != 1:
            place = self.nodes + scale * displacement
        return place[self.faces]

    def values(self, quantity, output):
        """Of each face: the mean of its corners, or its element's."""
        values = quantity.of(self.group, output)
        return values[self.faces].mean(axis=1) if quantity.by_node else values[self.owner]


def chosen_names(fields, names, sides=()):
    """Of the groups of /fields and sides of contacts those named; of "scene" all volumes that are not part of another,
    or all surfaces."""
    if names == ["scene"] and not fields:
        raise BadFile("the run wrote no fields of bodies: name some in output.field_sets and run again")
    if names != ["scene"]:
        for name in names:
            if name not in fields and name not in sides:
                raise BadFile(
                    f"--show {name}: the run wrote no such part or set; there are"
                    f" {', '.join(['scene', *fields, *sides])}"
                )
        return names
    volumes = {
        name: set(group["elements"][:].tolist())
        for name, group in fields.items()
        if group["connectivity"].shape[1] == 8
    }
    by_size = sorted(volumes, key=lambda name: -len(volumes[name]))
    shown = []
    for name in by_size:
        if not any(volumes[name] <= volumes[other] for other in shown):
            shown.append(name)
    return [name for name in fields if name in shown] or list(fields)


def read_bodies(results, names, box=None):
    """The bodies named, and how many outputs they all have. Throws BadFile."""
    fields, sides = results.fields(), results.contact_sides()
    shown = chosen_names(fields, names, sides)
    groups = {**fields, **sides}
    bodies = [Body(name, groups[name], box) for name in shown]
    if box is not None:
        bodies = [body for body in bodies if len(body.faces)]
        if not bodies:
            raise BadFile(f"there is no element within {box[1]:g} m of ({', '.join(f'{x:g}' for x in box[0])})")
    count = min(len(body.group["time"]) for body in bodies)
    if count == 0:
        raise BadFile("the run ended before its first output of fields")
    return bodies, count
