"""Mode shapes that `railwave modes --out` wrote: bodies of revolution seen along their axis, others from above and
aside."""

import h5py
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

from . import style
from .faces import exterior
from .model import AZIMUTH, ELEVATION
from .results import BadFile

KINDS = ("axial", "radial", "circumferential")
DEFORMED = 0.08  # largest displacement drawn, of the body's size


class Shapes:
    def __init__(self, path):
        try:
            file = h5py.File(path, "r")
        except OSError as error:
            raise BadFile(f"{path} cannot be read as an HDF5 file: {error}") from None
        with file:
            if "modes" not in file:
                raise BadFile(f"{path} is no file that 'railwave modes --out' wrote")
            self.title = str(file.attrs["title"])
            names = [str(name) for name in file.attrs["part_names"]]
            modes = {name: dataset[:] for name, dataset in file["modes"].items()}
            self.modes = [{name: values[k] for name, values in modes.items()} for k in range(len(modes["frequency"]))]
            for number, mode in enumerate(self.modes):
                mode["number"] = number + 1
                mode["part_name"] = names[mode["part"]] if mode["part"] >= 0 else ""
            self.parts = {}
            for name in names:
                group = file["fields"][name]
                faces, _ = exterior(group["connectivity"][:])
                axis = np.array([group.attrs[f"axis_{c}"] for c in "xyz"]) if "axis_x" in group.attrs else None
                self.parts[name] = (group["coordinates"][:], faces, axis, group["displacement"][:])

    def chosen(self, numbers, most):
        """Those numbers; or the first ones that strain, one of each pair."""
        if numbers:
            wrong = [n for n in numbers if not 1 <= n <= len(self.modes)]
            if wrong:
                raise BadFile(f"there is no mode {wrong[0]}: the file holds modes 1 to {len(self.modes)}")
            return [self.modes[n - 1] for n in numbers]
        result = []
        for mode in self.modes:
            last = result[-1] if result else None
            pair = (
                last is not None
                and mode["kind"] >= 0
                and all(mode[key] == last[key] for key in ("kind", "nodal_diameters", "nodal_circles"))
            )
            if not mode["rigid"] and not pair:
                result.append(mode)
        return result[:most]


def name_of(mode):
    if mode["kind"] < 0:
        return "rigid" if mode["rigid"] else ""
    return f"{KINDS[mode['kind']]} ({mode['nodal_circles']},{mode['nodal_diameters']})"


def draw_faces(axes, corners, towards, up, values, limit):
    """Faces turned towards the eye, the farthest first, coloured by the mean of their corners."""
    right = np.cross(up, towards)
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    order = np.argsort(corners.mean(axis=1) @ towards)
    order = order[normal[order] @ towards > 0]
    colours = plt.get_cmap(style.SIGNED_MAP)(0.5 + 0.5 * values[order] / limit) if limit > 0 else None
    polygons = corners[order] @ np.stack([right, up], axis=1)
    axes.add_collection(PolyCollection(polygons, facecolors=colours, edgecolors=colours, linewidths=0.3))
    low, high = polygons.reshape(-1, 2).min(axis=0), polygons.reshape(-1, 2).max(axis=0)
    axes.update_datalim([low, high])


def draw_mode(axes, shapes, mode):
    body = shapes.parts.get(mode["part_name"])
    round_body = mode["kind"] >= 0 and body is not None
    for nodes, faces, axis, displacement in [body] if round_body else shapes.parts.values():
        u = displacement[mode["number"] - 1]
        if round_body:
            axis = axis / np.linalg.norm(axis)
            up = np.array([0.0, 0, 1]) if abs(axis[2]) < 0.9 else np.array([0.0, 1, 0])
            up = up - (up @ axis) * axis
            out = nodes - nodes.mean(axis=0)
            out = out - np.outer(out @ axis, axis)
            out /= np.maximum(np.linalg.norm(out, axis=1), 1e-12)[:, None]
            along = (np.broadcast_to(axis, u.shape), out, np.cross(axis, out))[mode["kind"]]
            value = np.einsum("ij,ij->i", u, along)
            place = nodes if mode["kind"] == 0 else nodes + DEFORMED * np.ptp(nodes, axis=0).max() * u
            draw_faces(
                axes, place[faces], axis, up / np.linalg.norm(up), value[faces].mean(axis=1), np.abs(value).max()
            )
        else:
            towards = np.array(
                [np.cos(ELEVATION) * np.cos(AZIMUTH), np.cos(ELEVATION) * np.sin(AZIMUTH), np.sin(ELEVATION)]
            )
            size = max(np.ptp(part[0], axis=0).max() for part in shapes.parts.values())
            up = np.cross(towards, np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0]))
            value = np.linalg.norm(u, axis=1)
            draw_faces(axes, (nodes + DEFORMED * size * u)[faces], towards, up, value[faces].mean(axis=1), 1.0)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_title(f"{mode['number']}: {mode['frequency']:.0f} Hz\n{name_of(mode)}", fontsize=style.TEXT)


def draw_modes(path, numbers=None, most=12, columns=4):
    """One small picture for each mode; red and blue: the displacement's direction, of the kind that names the mode."""
    shapes = Shapes(path)
    modes = shapes.chosen(numbers, most)
    if not modes:
        raise BadFile(f"{path} holds no mode that strains anything")
    columns = min(columns, len(modes))
    rows = -(-len(modes) // columns)
    figure, grid = plt.subplots(
        rows, columns, figsize=(2.3 * columns, 2.5 * rows + 0.3), layout="constrained", squeeze=False
    )
    for axes in grid.flat[len(modes):]:
        axes.axis("off")
    for axes, mode in zip(grid.flat, modes):
        draw_mode(axes, shapes, mode)
    named = any(mode["kind"] >= 0 for mode in modes)
    colours = (
        "displacement along what names the mode (nodal circles, nodal diameters): red and blue are opposite"
        if named
        else "red: largest displacement"
    )
    figure.suptitle(f"{shapes.title}\n{colours}" if shapes.title else colours, fontsize=style.TEXT)
    return figure
