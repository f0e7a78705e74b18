"""A run's contact beside half-spaces (scripts/half_space): its pieces against Hertz and the solver for ellipses, and
the whole on a made-up results file, a roller that has turned and moved on a crown, loaded as half-spaces are."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

SOURCE = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
sys.path.insert(0, str(SOURCE / "scripts"))
from verification.exact import Hertz, Steel  # noqa: E402
from verification.half_space import SteadyRolling  # noqa: E402
from verification.of_run import (  # noqa: E402
    Beside, Frame, creepages_for_forces, displacement, normal_contact, rigid_motion,
)

HERTZ = Hertz(110e3, 0.46, 0.30)
SIZE = 1e-3  # m, of the made-up meshes


def turned(angle, axis):
    """Rotation about a unit axis (Rodrigues)."""
    cross = np.cross(np.eye(3), axis)
    return np.eye(3) - np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


class MadeUp:
    """Surfaces of a straight roller and of a crown round (0, 0), their places and the nodal forces of a solution."""

    def __init__(self, solution):
        x, y = np.meshgrid(SIZE * np.arange(-40, 41), SIZE * np.arange(-30, 31))
        number = np.arange(x.size).reshape(x.shape)
        corners = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
        self.facets = np.stack(corners, axis=-1).reshape(-1, 4)
        x, y = x.ravel(), y.ravel()
        roller, crown = (np.column_stack([x, y, z]) for z in (x**2 / 0.92, -(y**2) / 0.60))
        fine = (np.arange(10) - 4.5) / 10 * SIZE
        self.stress = sum(
            solution.nearest(np.column_stack([solution.shear, solution.pressure]), x + dx, y + dy)
            for dx in fine for dy in fine) / 100
        forces = self.stress * SIZE**2
        self.normal, self.tangential = forces * [0, 0, 1], forces * [1, 1, 0]
        loaded = forces[:, 2] > 0
        self.sticks = solution.nearest(~solution.slips, x, y)
        # Off the places that carry them: there a point force would move a node without end.
        away = np.hypot(x, y) > 1.6 * HERTZ.a
        self.sides = {}
        # How the bodies lie: the wheel has turned and moved, the rail leans a little.
        for name, surface, sign, out, motion in (
            ("slave", roller, 1, -1, turned(0.7, np.array([0.1, 0.99, 0.05]) / np.linalg.norm([0.1, 0.99, 0.05]))),
            ("master", crown, -1, 1, turned(2e-3, np.array([1.0, 0, 0]))),
        ):
            moved = np.zeros_like(surface)
            moved[away] = displacement(surface[away], surface[loaded], sign * forces[loaded], out, Steel)
            self.sides[name] = (surface @ motion + [0.3, -0.02, 0.1], surface + moved, sign)

    def write(self, path):
        with h5py.File(path, "w") as file:
            group = file.create_group("contact/tread")
            group["time"], group.attrs["friction"] = [1e-3], 0.45
            for name, (undeformed, present, sign) in self.sides.items():
                side = group.create_group(name)
                side["coordinates"], side["facets"], side["position"] = undeformed, self.facets, present[None]
                side["normal_force"], side["tangential_force"] = sign * self.normal[None], sign * self.tangential[None]
            group["slave/area"] = np.full((1, len(self.stress)), SIZE**2)
            group["slave/shear"], group["slave/pressure"] = (self.stress * [1, 1, 0])[None], self.stress[None, :, 2]
            group["slave/slipping"] = np.where(self.stress[:, 2] > 0, np.where(self.sticks, 1, 2), 0)[None]

    @staticmethod
    def row():
        """As `railwave contact` has it: the frame a little off, as a mesh's normals are."""
        row = {"time": 1e-3, "normal_force": 110e3, "semi_axis_along": HERTZ.a, "semi_axis_across": HERTZ.b,
               "spin_creepage": 0.0, "area": HERTZ.area, "patch": 1}
        for name, values in (("centre", (1e-4, -5e-5, 0)), ("normal", (0, 0, 1)), ("along", (1, 0, 0))):
            row.update(zip((f"{name}_{axis}" for axis in "xyz"), values))
        return {"contact": "tread", **{key: str(value) for key, value in row.items()}}


class HalfSpacesOfARun(unittest.TestCase):
    def test_normal_contact_is_hertz(self):
        x, y = np.linspace(-11e-3, 11e-3, 121), np.linspace(-9e-3, 9e-3, 101)
        pressure = normal_contact(x**2 / 0.92 + y[:, None] ** 2 / 0.6, x, y, 110e3, Steel)
        cell = (x[1] - x[0]) * (y[1] - y[0])
        self.assertLess(abs(pressure.sum() * cell / 110e3 - 1), 1e-9)
        self.assertLess(np.abs(pressure - HERTZ.pressure(x, y[:, None])).max(), 0.12 * HERTZ.peak)
        self.assertLess(abs(pressure.max() / HERTZ.peak - 1), 2e-3)
        self.assertLess(abs((pressure > 0).sum() * cell / HERTZ.area - 1), 0.02)

    def test_rigid_motion(self):
        rng = np.random.default_rng(1)
        places = rng.normal(size=(50, 3))
        turn = turned(2.1, np.array([0.6, 0.0, 0.8]))
        lies = rigid_motion(places, places @ turn + [1, 2, 3])
        other = rng.normal(size=(9, 3))
        np.testing.assert_allclose(lies(other), other @ turn + [1, 2, 3], atol=1e-12)

    def test_creepages_for_forces(self):
        for creepages in ((0.003, 0, 0), (0.002, 0.003, 0.1), (-0.001, 0.0005, 0)):
            known = SteadyRolling(HERTZ, 0.45, creepages, 30)
            pressure = np.zeros((30, 30))
            pressure[known.row, known.column] = known.pressure
            found = creepages_for_forces(pressure, known.grid_x, known.grid_y, Steel, 0.45, creepages[2], known.force)
            self.assertLess(np.linalg.norm(found.force - known.force), 1e-3 * np.linalg.norm(known.force))
            off = np.linalg.norm(np.subtract(found.creepages, creepages))
            self.assertLess(off, 5e-3 * np.linalg.norm(creepages[:2]))

    def test_a_made_up_run(self):
        solution = SteadyRolling(HERTZ, 0.45, (0.0025, 0.0015, 0), 60)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "made_up.h5"
            MadeUp(solution).write(path)
            found = Beside(path, "tread", MadeUp.row(), Steel)
            figures = {what: (run, theory) for what, run, theory in found.figures()}
            self.assertLess(np.linalg.norm(np.subtract(found.solution.creepages[:2], (0.0025, 0.0015))), 3e-5)
            self.assertLess(abs(found.solution.pressure.max() / HERTZ.peak - 1), 5e-3)
            for what in ("force along, N", "force across, N", "patch, m2"):
                self.assertLess(abs(figures[what][1] / figures[what][0] - 1), 0.015, what)
            self.assertLess(figures["shear along the centre line, L2 off"][0], 0.05)
            self.assertLess(figures["shear over the patch, L2 off"][0], 0.07)
            self.assertLess(figures["direction of the shear, mean off, deg"][0], 1)
            self.assertLess(abs(figures["stick share, by nodes"][0] - figures["stick share, by nodes"][1]), 0.03)
            # A file without what is needed is refused, and so by the command.
            with h5py.File(path, "r+") as file:
                del file["contact/tread/master/position"]
            command = [sys.executable, SOURCE / "scripts" / "half_space", path, "--program", "true"]
            said = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertNotEqual(said.returncode, 0)
            self.assertIn("half_space:", said.stderr)
            self.assertNotIn("Traceback", said.stderr)
            before = path.read_bytes()
            for option in ("--csv", "--picture"):  # a slip of the pen costs nobody the results
                refused = subprocess.run([*command, option, path, "--overwrite"], capture_output=True, check=False)
                self.assertEqual(refused.returncode, 2)
            self.assertEqual(path.read_bytes(), before)
            with self.assertRaisesRegex(RuntimeError, "master/position"):
                Beside(path, "tread", MadeUp.row(), Steel)


class AFrame(unittest.TestCase):
    def test_is_right_handed(self):
        frame = Frame((1, 2, 3), (1, 0, 0.2), (0, 0.1, 1))
        np.testing.assert_allclose(frame.axes @ frame.axes.T, np.eye(3), atol=1e-14)
        self.assertGreater(np.linalg.det(frame.axes), 0.99)


if __name__ == "__main__":
    unittest.main()
