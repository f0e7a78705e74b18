"""Exact contact solutions of elastic half-spaces of one material: Hertz, Cattaneo and Mindlin, Carter. SI units."""

import numpy as np
from scipy.special import ellipe, ellipk


class Steel:
    youngs_modulus = 210e9
    poissons_ratio = 0.3

    @classmethod
    def shear_modulus(cls):
        return cls.youngs_modulus / (2 * (1 + cls.poissons_ratio))

    @classmethod
    def contact_modulus(cls):
        """E* of two bodies of it."""
        return cls.youngs_modulus / (2 * (1 - cls.poissons_ratio**2))


class Hertz:
    """Contact of curvatures 1/radius_along (x) <= 1/radius_across (y) under a force (Johnson 1985, section 4.2)."""

    def __init__(self, force, radius_along, radius_across, material=Steel):
        self.force, self.material = force, material
        modulus = material.contact_modulus()
        ratio = radius_along / radius_across
        low, high = 0.0, 1 - 1e-12  # of e^2
        for _ in range(200 if ratio > 1 + 1e-12 else 0):
            e2 = (low + high) / 2
            k, e = ellipk(e2), ellipe(e2)
            low, high = (e2, high) if (e / (1 - e2) - k) / (k - e) < ratio else (low, e2)
        e2 = low if ratio > 1 + 1e-12 else 0.0
        k, e = ellipk(e2), ellipe(e2)
        curvature = 0.5 / radius_along + 0.5 / radius_across
        self.b = (3 * force * e * np.sqrt(1 - e2) / (2 * np.pi * modulus * curvature)) ** (1 / 3)
        self.a = self.b / np.sqrt(1 - e2)
        self.peak = 3 * force / (2 * np.pi * self.a * self.b)
        self.approach = self.peak * self.b * k / modulus
        self.area = np.pi * self.a * self.b

    def pressure(self, x, y):
        return self.peak * np.sqrt(np.maximum(0, 1 - (x / self.a) ** 2 - (y / self.b) ** 2))

    def displacement(self, depth):
        """Of one half-space into its depth, on the axis at a depth of about half the contact or more: the integral of
        Boussinesq's solution over the pressure."""
        t, weight = np.polynomial.legendre.leggauss(40)
        t, weight = (t + 1) * np.pi / 4, weight * np.pi / 4
        angle = (np.arange(64) + 0.5) * 2 * np.pi / 64
        r = np.sin(t)[:, None]
        x, y = self.a * r * np.cos(angle), self.b * r * np.sin(angle)
        distance = np.sqrt(x**2 + y**2 + depth**2)
        nu, modulus = self.material.poissons_ratio, self.material.youngs_modulus
        kernel = depth**2 / distance**3 + 2 * (1 - nu) / distance
        share = (np.cos(t) ** 2)[:, None] * r * weight[:, None] * 2 * np.pi / 64
        return (1 + nu) / (2 * np.pi * modulus) * self.peak * self.a * self.b * np.sum(kernel * share)


class Mindlin:
    """A sphere under Hertz's pressure shifted by a tangential force along x below sliding."""

    def __init__(self, hertz, tangential, friction):
        self.hertz, self.friction, self.sign = hertz, friction, np.sign(tangential)
        self.share = abs(tangential) / (friction * hertz.force)
        self.stick_radius = hertz.a * (1 - self.share) ** (1 / 3)

    def shear(self, r):
        h = self.hertz
        inner = np.sqrt(np.maximum(0, 1 - (r / self.stick_radius) ** 2)) * self.stick_radius / h.a
        return self.sign * self.friction * (h.pressure(r, 0) - h.peak * inner)


class HertzLine:
    """A cylinder on a plane under a force a metre."""

    def __init__(self, force, radius, material=Steel):
        self.force, self.radius = force, radius
        self.half_width = np.sqrt(4 * force * radius / (np.pi * material.contact_modulus()))
        self.peak = 2 * force / (np.pi * self.half_width)

    def pressure(self, x):
        return self.peak * np.sqrt(np.maximum(0, 1 - (x / self.half_width) ** 2))


class Carter:
    """The same cylinder driven along +x with a creepage: Q / mu P = 1 - (1 - creepage R / mu a)^2 (Carter 1926)."""

    def __init__(self, line, friction, creepage):
        self.line, self.friction = line, friction
        self.stick = max(0.0, 1 - abs(creepage) * line.radius / (friction * line.half_width))  # of the half width
        self.share = 1 - self.stick**2
        self.force = friction * line.force * self.share * np.sign(creepage)

    @staticmethod
    def creepage(line, friction, share):
        return friction * line.half_width / line.radius * (1 - np.sqrt(1 - share))

    def shear(self, x):
        """The stick zone lies at the leading edge."""
        a = self.line.half_width
        c = max(self.stick * a, 1e-12 * a)
        inner = np.sqrt(np.maximum(0, 1 - ((x - (a - c)) / c) ** 2)) * c / a
        return np.sign(self.force) * self.friction * (self.line.pressure(x) - self.line.peak * inner)
