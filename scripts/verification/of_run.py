"""A run's contact beside half-spaces that have its own forces, and its own profiles as they meet. SI units.

The surfaces, undeformed, are brought to where the bodies are: each by the rigid motion that fits its nodes round the
patch best, less what the contact's own forces do to a half-space there. Between them lies the gap of the normal
contact, with the run's normal force; its pressure carries the tangential contact (verification.half_space), whose
creepages are those that have the run's tangential force, with the run's spin."""

from dataclasses import dataclass

import h5py
import matplotlib.tri
import numpy as np

from verification.half_space import RollingContact, influence
from verification.setting import rms

REACH = 4.0  # larger semi-axes round the patch's centre: the nodes that tell how a body lies


def normal_contact(gap, x, y, force, material, tolerance=1e-6):
    """Pressure (rows, columns) of two half-spaces of one material that a force presses together, from the gap between
    them where they just touch, m: conjugate gradients (Polonsky and Keer 1999)."""
    rows, columns = gap.shape
    h, k = x[1] - x[0], y[1] - y[0]
    dx, dy = np.meshgrid(*(np.fft.fftfreq(2 * n, 1 / (2 * n)) * size for n, size in ((columns, h), (rows, k))))
    squares = influence(dx, dy, h, k)
    softness = (1 - material.poissons_ratio) / (np.pi * material.shear_modulus())
    kernel = np.fft.rfft2(softness * (squares[0] + squares[1]))

    def approach(pressure):
        grid = np.zeros((2 * rows, 2 * columns))
        grid[:rows, :columns] = pressure
        return np.fft.irfft2(kernel * np.fft.rfft2(grid), s=grid.shape)[:rows, :columns]

    mean = force / (rows * columns * h * k)
    pressure, direction, before, follows = np.full(gap.shape, mean), np.zeros(gap.shape), 1.0, 0.0
    for _ in range(2000):
        residual = approach(pressure) + gap
        touches = pressure > 0
        residual -= residual[touches].mean()
        size = np.sum(residual[touches] ** 2)
        direction = np.where(touches, residual + follows * size / before * direction, 0)
        before = size
        moved = approach(direction)
        moved -= moved[touches].mean()
        step = np.sum((residual * direction)[touches]) / np.sum((moved * direction)[touches])
        last = pressure.copy()
        pressure = np.maximum(0, np.where(touches, pressure - step * direction, pressure))
        comes_in = (pressure == 0) & (residual < 0)
        pressure[comes_in] = -step * residual[comes_in]
        follows = 0.0 if comes_in.any() else 1.0
        pressure *= force / (pressure.sum() * h * k)
        if np.abs(pressure - last).sum() < tolerance * pressure.sum():
            return pressure
    raise RuntimeError(f"normal contact: not found for {force:.6g} N on {columns} by {rows} cells")


def displacement(places, loaded, forces, out, material):
    """What point forces on a half-space's surface move places on it by, (n, 3), in a frame whose third axis is `out`
    (1 or -1) times the outward normal (Johnson 1985, eqs. 3.18, 3.75)."""
    nu, modulus = material.poissons_ratio, material.shear_modulus()
    dx, dy = (places[:, None, c] - loaded[None, :, c] for c in (0, 1))
    r2 = dx**2 + dy**2
    r = np.sqrt(r2)
    fx, fy, into = forces[:, 0], forces[:, 1], -out * forces[:, 2]
    aside = -(1 - 2 * nu) / (4 * np.pi * modulus) * into / r2
    round_one, pulled = (1 - nu) / r, nu / r**3
    whole = 2 * np.pi * modulus
    ux = np.sum(aside * dx + ((round_one + pulled * dx**2) * fx + pulled * dx * dy * fy) / whole, axis=1)
    uy = np.sum(aside * dy + ((round_one + pulled * dy**2) * fy + pulled * dx * dy * fx) / whole, axis=1)
    in_ = np.sum(
        (1 - nu) * into / (whole * r) + (1 - 2 * nu) * (fx * dx + fy * dy) / (4 * np.pi * modulus * r2),
        axis=1,
    )
    return np.column_stack([ux, uy, -out * in_])


def rigid_motion(before, after):
    """The motion, a function of places, that brings `before` nearest to `after`, by least squares."""
    middle_before, middle_after = before.mean(axis=0), after.mean(axis=0)
    u, _, vt = np.linalg.svd((before - middle_before).T @ (after - middle_after))
    turn = vt.T @ np.diag([1, 1, np.linalg.det(vt.T @ u.T)]) @ u.T
    return lambda places: (places - middle_before) @ turn.T + middle_after


@dataclass
class Side:
    """A contact surface at one output: undeformed places and present ones, forces on it (n, 3), facets."""
    undeformed: np.ndarray
    present: np.ndarray
    normal_force: np.ndarray
    tangential_force: np.ndarray
    facets: np.ndarray

    @classmethod
    def read(cls, group, index):
        return cls(*(group["coordinates"][:], *(group[name][index] for name in (
            "position", "normal_force", "tangential_force")), group["facets"][:]))


class Frame:
    """Along the rolling direction, across, and along the normal force on the slave; from the patch's centre."""

    def __init__(self, centre, along, normal):
        self.centre = np.array(centre)
        z = np.array(normal) / np.linalg.norm(normal)
        x = np.array(along) - np.dot(along, z) * z
        x /= np.linalg.norm(x)
        self.axes = np.array([x, np.cross(z, x), z])

    def places(self, points):
        return (points - self.centre) @ self.axes.T

    def vectors(self, vectors):
        return vectors @ self.axes.T


def height(side, frame, out, semi_axis, material):
    """Of a side's undeformed surface, brought to where its body is, over the frame's plane: a function of x, y (nan
    where there is none)."""
    present, forces = frame.places(side.present), frame.vectors(side.normal_force + side.tangential_force)
    loaded = np.linalg.norm(side.normal_force, axis=1) > 0
    near = (np.hypot(present[:, 0], present[:, 1]) < REACH * semi_axis) & ~loaded
    if near.sum() < 20:
        raise RuntimeError("fewer than 20 nodes of a surface round the patch; write whole surfaces (no "
                           "output.contact_margin), wider than the patch")
    moved = displacement(present[near], present[loaded], forces[loaded], out, material)
    lies = rigid_motion(side.undeformed[near], side.present[near] - moved @ frame.axes)
    x, y, z = frame.places(lies(side.undeformed)).T
    wanted = np.hypot(x, y) < 1.2 * REACH * semi_axis
    facets = side.facets[wanted[side.facets].all(axis=1)]
    used, facets = np.unique(facets, return_inverse=True)
    facets = facets.reshape(-1, 4)
    triangles = np.concatenate([facets[:, [0, 1, 2]], facets[:, [0, 2, 3]]])
    mesh = matplotlib.tri.Triangulation(x[used], y[used], triangles)
    interpolate = matplotlib.tri.CubicTriInterpolator(mesh, z[used], kind="geom")
    return lambda px, py: np.ma.filled(interpolate(px, py), np.nan)


def creepages_for_forces(pressure, x, y, material, friction, spin, wish):
    """The solution with the tangential forces along and across that are wished for: creepages by Broyden's rule. Forces
    of more than 0.995 of what friction can hold are made that."""
    size = np.linalg.norm(wish)
    bound = friction * pressure.sum() * (x[1] - x[0]) * (y[1] - y[0])
    wish = wish * min(1, 0.995 * bound / size)
    # Vermeulen and Johnson's law of a patch as large as this one.
    radius = np.sqrt(np.sum(pressure > 0) * (x[1] - x[0]) * (y[1] - y[0]) / np.pi)
    reach = 3 * bound * (1 - (1 - np.linalg.norm(wish) / bound) ** (1 / 3)) / (4 * material.shear_modulus() * radius**2)
    creepages = reach * wish / np.linalg.norm(wish)
    slope, last = np.eye(2) * np.linalg.norm(wish) / reach * 0.6, None
    for _ in range(25):
        solution = RollingContact(pressure, x, y, material, friction, (*creepages, spin))
        error = solution.force - wish
        if np.linalg.norm(error) < 1e-3 * np.linalg.norm(wish):
            return solution
        if last is not None:
            step, change = creepages - last[0], error - last[1]
            slope = slope + np.outer(change - slope @ step, step) / (step @ step)
        last = creepages, error
        move = np.linalg.solve(slope, -error)
        creepages = creepages + move * min(1, np.linalg.norm(creepages) / np.linalg.norm(move))
    raise RuntimeError(f"no creepages found for forces of {wish[0]:.6g}, {wish[1]:.6g} N")


class Beside:
    """One output of a run beside half-spaces. Forces are those on the slave; x along the rolling direction, y across.
    @param row of `railwave contact`, see measured.largest_patches(); friction the run's where none is given"""

    def __init__(self, results, contact, row, material, cells=60, friction=None):
        number = {key: float(value) for key, value in row.items() if key != "contact" and value != ""}
        frame = self.frame = Frame(
            *([number[f"{name}_{axis}"] for axis in "xyz"] for name in ("centre", "along", "normal"))
        )
        with h5py.File(results) as file:
            group = file[f"contact/{contact}"]
            needed = [f"{side}/{name}" for side in ("slave", "master") for name in (
                "coordinates", "facets", "position", "normal_force", "tangential_force")]
            needed += [f"slave/{name}" for name in ("area", "shear", "pressure", "slipping")]
            if missing := [name for name in needed if name not in group or (
                    name.endswith("position") and group[name].ndim < 3)]:
                raise RuntimeError(f"{results} has no {', '.join(missing)} of whole surfaces; leave out "
                                   "output.contact_margin, contact_fields and contact_sides")
            index = int(np.argmin(np.abs(group["time"][:] - number["time"])))
            self.time = float(group["time"][index])
            self.friction = float(group.attrs["friction"]) if friction is None else friction
            slave, master = (Side.read(group[name], index) for name in ("slave", "master"))
            self.area, self.shear = group["slave/area"][index], frame.vectors(group["slave/shear"][index])[:, :2]
            self.pressure, self.slipping = group["slave/pressure"][index], group["slave/slipping"][index]
        if frame.vectors(slave.normal_force.sum(axis=0))[2] < 0:
            frame = self.frame = Frame(frame.centre, frame.axes[0], -frame.axes[2])
        semi = number["semi_axis_along"], number["semi_axis_across"]
        self.place = frame.places(slave.present)
        own = self.own = (self.pressure > 0) & (np.hypot(self.place[:, 0] / semi[0], self.place[:, 1] / semi[1]) < 1.6)
        self.normal = frame.vectors(slave.normal_force[own].sum(axis=0))[2]
        self.force = frame.vectors(slave.tangential_force[own].sum(axis=0))[:2]
        self.spin, self.outline = number.get("spin_creepage", 0.0), number["area"]
        top, bottom = (height(side, frame, out, max(semi), material) for side, out in ((slave, -1), (master, 1)))
        for reach in (1.3, 1.6, 2.0, 2.5):
            x, y = (reach * size * (2 * np.arange(cells) + 1 - cells) / cells for size in semi)
            cell = np.meshgrid(x, y)
            gap = top(*cell) - bottom(*cell)
            if np.isnan(gap).all():
                raise RuntimeError("the surfaces do not lie over each other at the patch")
            gap = np.where(np.isnan(gap), np.nanmax(gap) + 1e-3, gap)
            pressed = normal_contact(gap - gap.min(), x, y, self.normal, material)
            if not (pressed[[0, -1]].any() or pressed[:, [0, -1]].any()):
                break
        else:
            raise RuntimeError("the patch is more than twice as large as the run's; the surfaces written "
                               "end within it, or are nearly conformal")
        self.solution = creepages_for_forces(pressed, x, y, material, self.friction, self.spin, self.force)

    def sampled(self, values):
        """Of values over the solution's cells, their means over the shares of the slave's nodes that touch: squares as
        large as these."""
        side, total = np.sqrt(self.area[self.own]), 0
        offsets = (np.arange(5) - 2) / 5
        for dx in offsets:
            for dy in offsets:
                total = total + self.solution.nearest(
                    values, self.place[self.own, 0] + dx * side, self.place[self.own, 1] + dy * side)
        return total / len(offsets) ** 2

    def below_bound(self, pressure, shear):
        """Share of the patch in which more than a fiftieth of the peak bound is left: unlike the nodes' own states,
        which vibration changes from instant to instant."""
        left = pressure - np.linalg.norm(shear, axis=1) / self.friction
        area = self.area[self.own]
        return area[left > 0.02 * pressure.max()].sum() / area[pressure > 0].sum()

    def figures(self):
        """(what, of the run, of half-spaces)."""
        solution, own, area = self.solution, self.own, self.area[self.own]
        shear, theory = self.shear[own], self.sampled(solution.shear)
        middle = np.average(self.place[own, 1], weights=self.pressure[own])
        line = np.abs(self.place[own, 1] - middle) < 0.5 * np.sqrt(area)
        bound = self.friction * self.normal
        angle = np.degrees(np.angle((shear @ [1, 1j]) / (theory @ [1, 1j] + 1e-30)))
        weight = area * np.linalg.norm(theory, axis=1)
        cell = solution.h * solution.k
        return [
            ("normal force, N", self.normal, solution.pressure.sum() * cell),
            ("force along, N", self.force[0], solution.force[0]), ("force across, N", self.force[1], solution.force[1]),
            ("share of friction used", np.linalg.norm(self.force) / bound, np.linalg.norm(solution.force) / bound),
            ("creepage along", np.nan, solution.creepages[0]), ("creepage across", np.nan, solution.creepages[1]),
            ("peak pressure, Pa", self.pressure[own].max(), solution.pressure.max()),
            ("peak shear, Pa", np.linalg.norm(shear, axis=1).max(), np.linalg.norm(theory, axis=1).max()),
            ("patch, m2", self.outline, len(solution.x) * cell),
            ("stick share, by nodes", area[self.slipping[own] == 1].sum() / area.sum(),
             area[self.sampled((~solution.slips).astype(float)) > 0.5].sum() / area.sum()),
            ("stick share, by force", self.below_bound(self.pressure[own], shear),
             self.below_bound(self.sampled(solution.pressure), theory)),
            ("shear along the centre line, L2 off",
             rms(shear[line] - theory[line], theory[line], area[line, None]), 0.0),
            ("shear over the patch, L2 off", rms(shear - theory, theory, area[:, None]), 0.0),
            ("direction of the shear, mean off, deg", np.sum(weight * np.abs(angle)) / weight.sum(), 0.0),
        ]
