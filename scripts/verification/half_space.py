"""Steady rolling contact with friction of two half-spaces of one material: Kalker's exact three-dimensional theory on a
grid of rectangles of constant traction. SI units.

The patch rolls along +x. Tractions are those on the upper body, u its surface displacement less the lower one's: the
integral of Boussinesq's and Cerruti's solutions over rectangles (Johnson 1985, section 3.6; Kalker 1990, appendix C).
Material passes towards -x, so that over a cell of length h the upper body slips over the lower one by
    S = h w + u(x) - u(x + h),    w = -creepage + spin (-y, x).
Coulomb: |q| <= mu p; S = 0 below, S against q at the bound. Creepages are positive where the creep force on the upper
body is (a driven wheel's longitudinal one), spin is the upper body's about +z less the lower one's, over the velocity,
1/m. The upwind difference makes forces and stick area right to the first order in the cell: `converged` takes that away
with two grids."""

import numpy as np
from scipy.sparse.linalg import LinearOperator, gmres


def influence(x, y, h, k):
    """Integrals over the rectangle h by k round (x, y) of x^2/r^3, y^2/r^3, xy/r^3, r the distance from (0, 0)."""
    total = np.zeros((3, *np.shape(x)))
    for side_x, side_y in ((-1, -1), (-1, 1), (1, -1), (1, 1)):
        px, py = x + 0.5 * side_x * h, y + 0.5 * side_y * k
        r = np.hypot(px, py)
        total += side_x * side_y * np.array([py * np.log(px + r), px * np.log(py + r), -r])
    return total


def solve_linear(apply, right, tolerance, most=500):
    """x with apply(x) = right by GMRES. The problem here is of order zero, a difference of an integral, and needs no
    preconditioner."""
    operator = LinearOperator((len(right), len(right)), matvec=apply, dtype=float)
    # The bound is given as atol: its relative one, 1e-5 by itself, has had two names.
    x, left = gmres(operator, right, atol=max(tolerance, 1e-5) * np.linalg.norm(right), restart=most, maxiter=1)
    if left < 0:
        raise RuntimeError(f"GMRES broke down ({left}) on {len(right)} unknowns")
    return x


class FallingFriction:
    """Friction that falls with the speed of slip from `static` to `dynamic` (thesis eq. 2.29): dynamic + (static -
    dynamic) exp(-decay v). v is the size of the slip velocity as a passing particle remembers it: its mean over the
    past, weighted by exp(-t / memory); without memory the present one. @param decay s/m; speed of rolling, m/s; memory,
    s"""

    def __init__(self, static, dynamic, decay, speed, memory=0.0):
        self.static, self.dynamic, self.decay, self.speed, self.memory = static, dynamic, decay, speed, memory

    def along(self, slip, h):
        """Coefficients from the slip over the way, (cells of length h from the leading edge on, rows, 2)."""
        velocity = self.speed * slip
        if self.memory > 0:
            kept, now = np.exp(-h / self.speed / self.memory), np.zeros(velocity.shape[1:])
            for k in range(len(velocity)):
                now = velocity[k] = kept * now + (1 - kept) * velocity[k]
        return self.dynamic + (self.static - self.dynamic) * np.exp(-self.decay * np.linalg.norm(velocity, axis=-1))


class RollingContact:
    """Steady rolling of a patch of any pressure. @param pressure (rows, columns), Pa, 0 outside the patch; x, y of the
    middles of its columns and rows, m, equally spaced; material as verification.exact.Steel; friction a coefficient or
    FallingFriction; creepages longitudinal, lateral, spin (1/m), the latter about (0, 0). Arrays over the cells of the
    patch: x, y, pressure, coefficient of friction, shear (n, 2), slips, slip (n, 2) over the way."""

    def __init__(self, pressure, x, y, material, friction, creepages):
        self.material, self.friction, self.creepages = material, friction, tuple(creepages)
        self.columns, self.rows, self.h, self.k = len(x), len(y), x[1] - x[0], y[1] - y[0]
        self.grid_x, self.grid_y = x, y
        self.row, self.column = np.nonzero(pressure > 0)
        self.x, self.y, self.pressure = x[self.column], y[self.row], pressure[self.row, self.column]
        self._prepare()
        if not isinstance(friction, FallingFriction):
            self._solve(friction * np.ones_like(self.x), np.zeros(2 * len(self.x)))
        else:
            self._solve_falling()

    def _prepare(self):
        """Transform of what a cell's traction does to the slip of the others; both bodies' displacement: 1 / pi G."""
        dx, dy = np.meshgrid(*(np.fft.fftfreq(2 * n, 1 / (2 * n)) * size
                               for n, size in ((self.columns, self.h), (self.rows, self.k))))
        xx, yy, xy = influence(dx, dy, self.h, self.k) - influence(dx + self.h, dy, self.h, self.k)
        nu = self.material.poissons_ratio
        kernel = np.array([xx + (1 - nu) * yy, yy + (1 - nu) * xx, nu * xy]) / (
            np.pi * self.material.shear_modulus()
        )
        self.own, self.kernel = kernel[0, 0, 0], np.fft.rfft2(kernel)

    def _elastic_slip(self, q):
        """u(x) - u(x + h) of the tractions q: all along x, then all along y."""
        grid = np.zeros((2, 2 * self.rows, 2 * self.columns))
        grid[:, self.row, self.column] = q.reshape(2, -1)
        along, across = np.fft.rfft2(grid)
        k = self.kernel
        slip = np.fft.irfft2(np.stack([k[0] * along + k[2] * across, k[2] * along + k[1] * across]), s=grid.shape[1:])
        return slip[:, self.row, self.column].ravel()

    def _solve_falling(self):
        """Solutions of given coefficients, which are then made those of its slip, until they are. They contract: faster
        slip by a share of less friction takes away 2 V p |mu'| / G of that share."""
        coefficient, shear = self.friction.static * np.ones_like(self.x), np.zeros(2 * len(self.x))
        for _ in range(200):
            self._solve(coefficient, shear)
            wished = self._coefficients()
            if np.abs(wished - coefficient).max() < 1e-5 * self.friction.static:
                return
            coefficient, shear = coefficient + 0.6 * (wished - coefficient), self.shear.T.ravel()
        raise RuntimeError(f"steady rolling: falling friction finds no end at creepages {self.creepages}, "
                           f"{self.columns} by {self.rows} cells")

    def _coefficients(self):
        """By cell, of the slip there is. Each row is passed from its leading edge on."""
        slip = np.zeros((self.columns, self.rows, 2))
        slip[self.column, self.row] = np.where(self.slips[:, None], self.slip, 0)
        return self.friction.along(slip[::-1], self.h)[::-1][self.column, self.row]

    def _solve(self, coefficient, q):
        """Newton's iteration, from the tractions q, on q = projection of (q - rate S) onto the friction circle, which
        is the whole of Coulomb's law."""
        n, bound, rate = len(self.x), coefficient * self.pressure, 1 / self.own
        longitudinal, lateral, spin = self.creepages
        rigid = self.h * np.concatenate([-longitudinal - spin * self.y, -lateral + spin * self.x])

        def state(q):
            slip = rigid + self._elastic_slip(q)
            trial = q - rate * slip
            size = np.maximum(np.hypot(trial[:n], trial[n:]), 1e-300)
            share = np.minimum(1, bound / size)
            return q - trial * np.tile(share, 2), slip, trial[:n] / size, trial[n:] / size, share

        now = state(q)
        for _ in range(100):
            error, slip, tx, ty, share = now
            slips = share < 1
            if np.abs(error).max() < 1e-9 * bound.max():
                break
            # The projection's derivative: nothing changes where it sticks; bound / size (1 - t t^T) where it slips.
            pxx, pyy, pxy = (
                np.where(slips, share * ty * ty, 1),
                np.where(slips, share * tx * tx, 1),
                np.where(slips, -share * tx * ty, 0),
            )

            def derivative(change):
                along, across = np.split(change - rate * self._elastic_slip(change), 2)
                return change - np.concatenate([pxx * along + pxy * across, pxy * along + pyy * across])

            step = solve_linear(derivative, -error, 1e-4)
            length, before = 1.0, np.linalg.norm(error)
            now = state(q + step)
            while np.linalg.norm(now[0]) > (1 - 1e-4 * length) * before and length > 1e-3:
                length *= 0.5
                now = state(q + length * step)
            q = q + length * step
        else:
            raise RuntimeError(
                f"steady rolling: no solution found for creepages {self.creepages}, {self.columns} by {self.rows} cells"
            )
        self.coefficient = coefficient
        self.shear, self.slip, self.slips = q.reshape(2, n).T, slip.reshape(2, n).T / self.h, slips
        self.force = self.shear.sum(axis=0) * self.h * self.k
        self.moment = np.sum(self.x * self.shear[:, 1] - self.y * self.shear[:, 0]) * self.h * self.k
        self.stick_share = 1 - slips.mean()

    def nearest(self, values, x, y):
        """Of values over the cells, those of the cell at each place; 0 outside."""
        column, row = (
            np.floor((place - first) / size + 0.5).astype(int)
            for place, first, size in ((x, self.grid_x[0], self.h), (y, self.grid_y[0], self.k))
        )
        inside = (column >= 0) & (column < self.columns) & (row >= 0) & (row < self.rows)
        grid = np.zeros((self.rows, self.columns, *values.shape[1:]), dtype=values.dtype)
        grid[self.row, self.column] = values
        found = grid[np.clip(row, 0, self.rows - 1), np.clip(column, 0, self.columns - 1)]
        found[~inside] = 0
        return found

    def grid(self):
        """x, y and shear (rows, columns, 2) for interpolation; nan outside the patch."""
        shear = np.full((self.rows, self.columns, 2), np.nan)
        shear[self.row, self.column] = self.shear
        return self.grid_x, self.grid_y, shear


class SteadyRolling(RollingContact):
    """The same of a Hertzian ellipse. @param hertz the normal contact (verification.exact.Hertz); `cells` over each
    axis of its ellipse"""

    def __init__(self, hertz, friction, creepages, cells=40):
        self.hertz, self.cells = hertz, cells
        place = np.arange(cells) - 0.5 * (cells - 1)
        x, y = place * 2 * hertz.a / cells, place * 2 * hertz.b / cells
        pressure = hertz.pressure(x, y[:, None])
        pressure *= hertz.force / (pressure.sum() * (x[1] - x[0]) * (y[1] - y[0]))
        super().__init__(pressure, x, y, hertz.material, friction, creepages)

    def creepages_round(self, inner, outer, points=60):
        """Longitudinal, lateral creepage and spin of the rigid motion that fits best, by least squares, the surfaces'
        velocities between two distances from the centre, in larger semi-axes: those prescribed and what the strained
        surfaces add as they pass. Signs are the creepages'; tractions count as forces at the cells' middles."""
        nu, reach = self.hertz.material.poissons_ratio, outer * max(self.hertz.a, self.hertz.b)
        place = np.linspace(-reach, reach, points)
        x, y = (values.ravel() for values in np.meshgrid(place, place))
        there = (np.hypot(x, y) >= inner / outer * reach) & (np.hypot(x, y) <= reach)
        x, y = x[there], y[there]
        dx, dy = x[:, None] - self.x, y[:, None] - self.y
        r = np.hypot(dx, dy)
        force = self.shear * self.h * self.k / (np.pi * self.hertz.material.shear_modulus())
        # Derivatives along x of (1 - nu) / r + nu x^2 / r^3, (1 - nu) / r + nu y^2 / r^3 and nu x y / r^3.
        common = -(1 - nu) * dx / r**3
        xx, yy = common + nu * (2 * dx / r**3 - 3 * dx**3 / r**5), common - 3 * nu * dx * dy**2 / r**5
        xy = nu * (dy / r**3 - 3 * dx**2 * dy / r**5)
        strain = np.concatenate([xx @ force[:, 0] + xy @ force[:, 1], xy @ force[:, 0] + yy @ force[:, 1]])
        one, none = np.ones_like(x), np.zeros_like(x)
        longitudinal, lateral, spin = np.linalg.lstsq(np.column_stack([np.concatenate(column) for column in (
            (-one, none), (none, -one), (-y, x))]), -strain, rcond=None)[0]
        return self.creepages[0] + longitudinal, self.creepages[1] + lateral, self.creepages[2] + spin


def converged(hertz, friction, creepages, cells=40):
    """Forces along and across and the share of stick, extrapolated from half as many cells."""
    coarse, fine = (SteadyRolling(hertz, friction, creepages, n) for n in (cells // 2, cells))
    return 2 * fine.force - coarse.force, 2 * fine.stick_share - coarse.stick_share


def creepage_for_force(hertz, friction, creepages, which, force, cells=40):
    """The creepage `which` (0, 1, 2: along, across, spin) in place of that in `creepages` for which the force along (0)
    or across (1, 2) comes out, by the secant rule from there."""
    component = 0 if which == 0 else 1
    scale = creepages[which]
    tried = []
    guess = scale
    for _ in range(8):
        now = list(creepages)
        now[which] = guess
        tried.append((guess, converged(hertz, friction, now, cells)[0][component] - force))
        if abs(tried[-1][1]) < 1e-4 * abs(force):
            return guess
        if len(tried) == 1:
            guess *= 1.02 if abs(tried[0][1] + force) < abs(force) else 0.98
        else:
            (c0, e0), (c1, e1) = tried[-2:]
            guess = c1 - e1 * (c1 - c0) / (e1 - e0)
    raise RuntimeError(f"no creepage found for a force of {force:.6g} N: {tried}")
