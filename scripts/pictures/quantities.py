"""What bodies can be coloured by: fields of a results file and what follows from them, each with a name, a unit, a
sign."""

import numpy as np

from .results import BadFile

TENSOR = ("xx", "yy", "zz", "xy", "yz", "zx")
UNITS = {
    "displacement": "m",
    "velocity": "m/s",
    "acceleration": "m/s\N{SUPERSCRIPT TWO}",
    "stress": "Pa",
    "plastic_strain": "",
    "pressure": "Pa",
    "shear": "Pa",
    "normal_force": "N",
    "tangential_force": "N",
    "slip_velocity": "m/s",
    "gap": "m",
    "area": "m\N{SUPERSCRIPT TWO}",
}
SIGNED = ("gap",)
FROM_STRESS = {"von_mises": "mises", "pressure": "pressure"}  # by names of their own


def von_mises(s):
    """Of stresses (n, 6) xx, yy, zz, xy, yz, zx: sqrt(3 J2) (n)."""
    xx, yy, zz, xy, yz, zx = np.moveaxis(s, -1, 0)
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy**2 + yz**2 + zx**2))


class Quantity:
    """One number for each node or cell, of "stress", "stress:xx", "velocity:z", "pressure", "plastic_strain" and so
    on."""

    def __init__(self, text, groups):
        """`groups`: those of /fields that are shown; each has to hold the field. Throws BadFile."""
        name, _, part = text.partition(":")
        if name in FROM_STRESS and not part and not all(name in group for group in groups):
            name, part = "stress", FROM_STRESS[name]
        self.field, self.part = name, part
        held = sorted({field for group in groups for field, data in group.items() if self._is_field(group, data)})
        for group in groups:
            if name not in group:
                choice = (
                    ", ".join(held + (["von_mises", "pressure"] if "stress" in held else []))
                    or "none: give output.fields some"
                )
                raise BadFile(f"--by {text}: {group.name} holds no '{name}'; this file has {choice}")
        data = groups[0][name]
        vector, tensor = (data.ndim == 3 and data.shape[2] == size for size in (3, 6))
        self.by_node = vector or (not tensor and data.shape[1] == len(groups[0]["nodes"]))
        parts = (
            ("x", "y", "z")
            if vector
            else (*TENSOR, *(("mises", "pressure") if name == "stress" else ()))
            if tensor
            else ()
        )
        if tensor and not part:
            if name != "stress":
                raise BadFile(f"--by {text}: a component is needed, such as {name}:xx, of {', '.join(parts)}")
            self.part = "mises"
        if self.part and self.part not in parts:
            raise BadFile(
                f"--by {text}: there is no '{self.part}'; "
                + (
                    f"give {name} alone, or one of {', '.join(f'{name}:{p}' for p in parts)}"
                    if parts
                    else f"{name} has no components"
                )
            )
        self._vector = vector
        self.signed = (bool(self.part) and self.part != "mises") or self.field in SIGNED
        unit = data.attrs.get("unit", data.attrs.get("units", UNITS.get(name, "")))
        unit = unit.decode() if isinstance(unit, bytes) else str(unit)
        self.unit = "" if unit in ("1", "-") else unit
        self.name = self._title()

    @staticmethod
    def _is_field(group, data):
        """Whether a dataset has a number, vector or tensor for each output and node or cell."""
        of_all = (
            data.ndim >= 2
            and data.shape[0] >= len(group["time"])
            and data.shape[1] in (len(group["nodes"]), len(group["elements"]))
        )
        return (
            of_all
            and data.dtype.kind == "f"
            and data.name.rsplit("/", 1)[-1] not in ("coordinates", "position", "normal")
        )

    def _title(self):
        plain = self.field.replace("_", " ")
        if self.part == "mises":
            return "von Mises stress"
        if self.part == "pressure":
            return "pressure (mean compressive stress)"
        if self.field == "plastic_strain":
            return "equivalent plastic strain"
        if self._vector and not self.part:
            return f"{plain}, size"
        return f"{plain} {self.part}" if self.part else plain

    def of(self, group, output):
        """Its values at an output: by node or by cell, in SI units."""
        values = group[self.field][output]
        if self._vector:
            return values[:, "xyz".index(self.part)] if self.part else np.linalg.norm(values, axis=1)
        if self.part == "mises":
            return von_mises(values)
        if self.part == "pressure":
            return -values[:, :3].mean(axis=1)
        return values[:, TENSOR.index(self.part)] if self.part else values
