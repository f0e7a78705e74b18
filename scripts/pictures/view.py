"""A direction from which bodies are looked at, and faces painted from there: back faces left out, the farthest
first."""

import numpy as np

VIEWS = {"iso": (-60, 25), "side": (-90, 0), "front": (0, 0), "top": (-90, 90), "behind": (180, 0), "below": (-90, -90)}
EDGE_ON = 1e-9  # of its size: how little of a face is seen where only its edge is
LIGHT = np.array([-0.35, 0.5, 0.79])  # from the left, above, in front: right, up, towards the eye


def read_view(text):
    """Azimuth and elevation of the eye in degrees: of a name, or of two numbers. Throws ValueError."""
    if text in VIEWS:
        return VIEWS[text]
    azimuth, elevation = (float(part) for part in text.split(","))
    if not (np.isfinite(azimuth) and -90 <= elevation <= 90):
        raise ValueError
    return azimuth, elevation


class View:
    """Seen from an azimuth (degrees, from +x towards +y) and an elevation above the horizontal plane."""

    def __init__(self, azimuth, elevation):
        a, e = np.radians(azimuth), np.radians(elevation)
        self.towards = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
        self.right = np.array([-np.sin(a), np.cos(a), 0])
        self.up = np.cross(self.towards, self.right)
        self._turn = np.stack([self.right, self.up, self.towards], axis=1)

    def flat(self, points):
        """Points (..., 3) on the picture (..., 2)."""
        return points @ self._turn[:, :2]

    def along(self):
        """Names and signs of the global axes that lie across and up the picture, such as ("x", 1); None where it is
        askew."""
        found = []
        for direction in (self.right, self.up):
            axis = int(np.argmax(np.abs(direction)))
            found.append(("xyz"[axis], int(np.sign(direction[axis]))) if abs(direction[axis]) > 1 - 1e-9 else None)
        return found if None not in found else None

    def painted(self, corners, both_sides=False):
        """Of faces (n, 4, 3), turned outwards (`both_sides`, for all or one for each: seen from both): numbers of those
        that are seen, the farthest first; their polygons (m, 4, 2) on the picture; and how light each is, 0 to 1."""
        turned = corners @ self._turn
        first, second = turned[:, 2] - turned[:, 0], turned[:, 3] - turned[:, 1]
        facing = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
        turned_away = np.logical_and(both_sides, facing < 0)
        facing = np.where(turned_away, -facing, facing)
        size = np.einsum("ij,ij->i", first, first) + np.einsum("ij,ij->i", second, second)
        seen = np.flatnonzero(facing > EDGE_ON * size)
        seen = seen[np.argsort(turned[seen, :, 2].mean(axis=1), kind="stable")]
        normal = np.cross(first[seen], second[seen])
        normal[turned_away[seen]] *= -1
        normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
        return seen, turned[seen][:, :, :2], np.clip(normal @ LIGHT, 0, 1)
