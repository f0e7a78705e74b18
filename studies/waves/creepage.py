"""Waves of large creepage (thesis 7.1.2, 7.2): case 4, in which the whole patch slides. Which waves the surface has, by
frequency and wave number, within the patch and around it; particles at three places as the thesis has them."""

import matplotlib.pyplot as plt
import numpy as np

from particles import Particle
from pictures import style
from scenes import SPEED
from spectrum import BANDS, Field, Ridge, Spectrum, rayleigh_speed

BAND = (0.48e6, 0.51e6)  # Hz, the thesis's
WINDOW = (18.18e-3, 18.27e-3)  # s
NODES_X, NODES_Y = 0.510, {"N1": 0.0, "N2": -0.004, "N3": -0.010}  # m; from the middle of the patch
MARGIN = 0.002  # m about the patch that belongs to neither region
WITHIN = "within the patch"
AROUND = "around the patch"


class Region:
    """Waves in one part of the surface."""

    def __init__(self, field, mask, sources):
        self.spectrum = Spectrum(field, mask)
        self.ridge = Ridge(self.spectrum)
        self.ridge.calibrate(field, sources)
        self.limit = self.ridge.limit(field, mask)
        self.clear = self.ridge.clear(self.limit)

    def in_band(self, band):
        frequency = self.ridge.frequency[self.clear]
        return self.clear[(frequency >= band[0]) & (frequency < band[1])]

    def nearest(self, frequency):
        return int(np.abs(self.ridge.frequency - frequency).argmin())


class Waves:
    """The surface's waves while the patch slides."""

    def __init__(self, one):
        self.one = one
        self.velocity = one["velocity"].astype(np.float32) + one["swaying"][:, None]
        time = one["time"] + one.earlier
        self.field = Field(time, one["place"], one["velocity"])
        begin, end = one.patch_at(time[0]), one.patch_at(time[-1])
        self.patch = 0.5 * (begin + end)
        self.slip = self.patch[4:6]
        travel = 0.5 * (end[0] - begin[0])
        x, y = np.meshgrid(self.field.x - self.patch[0], self.field.y_of_s - self.patch[1], indexing="ij")
        half = self.patch[2:4]
        swept = np.hypot(x / (half[0] + travel), y / half[1])
        outside = np.clip((np.hypot(x / (half[0] + travel + MARGIN), y / (half[1] + MARGIN)) - 1) / 0.3, 0, 1)
        inside = np.where(swept < 1, np.cos(0.5 * np.pi * np.minimum(swept, 1)) ** 2, 0)
        sources = self._sources(half)
        self.regions = {AROUND: Region(self.field, outside, sources)}
        if (swept < 1).sum() > 50:
            self.regions[WITHIN] = Region(self.field, inside, sources)

    def _sources(self, half):
        """Nine places in the patch, x and s."""
        across = np.interp(self.patch[1], self.field.y_of_s, self.field.s)
        return [(self.patch[0] + a * half[0], across + b * half[1]) for a in (-0.6, 0, 0.6) for b in (-0.6, 0, 0.6)]

    def shares(self):
        """Of the surface's mean power: from 1 MHz on, and in the thesis's band."""
        step = self.field.time[1] - self.field.time[0]
        velocity = self.field.velocity - self.field.velocity.mean(axis=1, keepdims=True)
        window = np.hanning(len(self.field.time))[None, :, None, None]
        frequency = np.fft.rfftfreq(len(self.field.time), step)
        power = sum((np.abs(np.fft.rfft(part, axis=0)) ** 2).sum(axis=(1, 2)) for part in velocity * window)
        known = frequency > 2e4
        total = power[known].sum()
        in_band = (frequency > BAND[0]) & (frequency < BAND[1])
        return power[frequency > 1e6].sum() / total, power[in_band].sum() / total

    def way(self):
        """Unit vector along which the wave within the patch goes: the slip's, or against it."""
        slip = self.slip / np.linalg.norm(self.slip)
        region = self.regions.get(WITHIN) or self.regions[AROUND]
        chosen = region.clear if len(region.clear) else np.arange(len(region.ridge.frequency))
        angles, power = region.ridge.heading(chosen)
        along = np.cos(np.radians(angles) - np.arctan2(slip[1], slip[0]))
        return slip if power[along > 0.7].sum() >= power[along < -0.7].sum() else -slip

    def particles(self, way):
        """At the thesis's three places, by name."""
        time, place = self.one["time"] + self.one.earlier, self.one["place"]
        chosen = (time >= WINDOW[0]) & (time <= WINDOW[1])
        found = {}
        for name, aside in NODES_Y.items():
            at = np.array([NODES_X - SPEED * self.one.earlier, self.patch[1] + aside])
            node = int(np.hypot(*(place[:, :2] - at).T).argmin())
            found[name] = Particle(time[chosen], self.velocity[chosen][:, node], way)
        return found


def listed(ridge, chosen):
    speed, error = ridge.fitted(chosen)
    phase, coherence, ratio = ridge.motion(chosen)
    sense = "retrograde" if phase < 0 else "forward"
    return speed, error, f"{phase:.0f} deg ({sense}); {coherence:.2f}; {ratio:.2f}"


def rows_of(name, region, mesh):
    ridge, rows = region.ridge, []
    if not len(region.clear):
        inside = ridge.reachable & ~ridge.at_edge()
        most = np.max(ridge.contrast[inside] / np.maximum(region.limit[inside], 1), initial=0)
        return [(f"{name}: waves that stand out", "6 mm, 0.495 MHz, 3 km/s",
                 f"none (contrast at most {most:.2f} of the limit between the slowest and the fastest speed)")]
    frequency = ridge.frequency[region.clear]
    speed, error, motion = listed(ridge, region.clear)
    strongest = max(region.clear, key=lambda k: np.nanmax(ridge.power[k]))
    slowest, fastest = speed - 2 * error, speed + 2 * error
    rows += [
        (f"{name}: frequencies at which one wave number stands out", "0.48 to 0.51 MHz",
         f"{len(frequency)} between {1e-6 * frequency[0]:.2f} and {1e-6 * frequency[-1]:.2f} MHz"),
        (f"{name}: speed of that wave, all these frequencies", "2.98 km/s, within 3 %",
         f"{1e-3 * speed:.2f} km/s ({1e-3 * slowest:.2f} to {1e-3 * fastest:.2f}: two standard errors)",
         f"{100 * (speed / rayleigh_speed() - 1):+.1f} %"),
        (f"{name}: normal before tangential motion; coherence; amplitude ratio",
         "-90 deg, retrograde; above 0.8; 1.52", motion),
        (f"{name}: the strongest of them", "0.495 MHz, 6 mm",
         f"{1e-6 * ridge.frequency[strongest]:.3f} MHz, {1e3 * ridge.speed[strongest] / ridge.frequency[strongest]:.1f}"
         f" mm, {1e-3 * ridge.speed[strongest]:.2f} km/s"),
    ]
    for band in BANDS:
        chosen = region.in_band(band)
        if len(chosen):
            speed, error, motion = listed(ridge, chosen)
            length = speed / ridge.frequency[chosen].mean()
            own = mesh.speed(ridge.frequency[chosen]).mean() if mesh else np.nan
            beside = "" if np.isnan(own) else f", {100 * (speed / own - 1):+.1f} % of the mesh's"
            rows.append((f"{name}, {1e-6 * band[0]:.1f} to {1e-6 * band[1]:.1f} MHz: speed; length; phase; coherence;"
                         " ratio", "",
                         f"{1e-3 * speed:.2f} +- {1e-3 * error:.2f} km/s; {1e3 * length:.1f} mm; {motion}",
                         f"{100 * (speed / rayleigh_speed() - 1):+.1f} %{beside}"))
    angles, power = ridge.heading(region.clear)
    top = int(power.argmax())
    rows.append((f"{name}: where most of it goes to, from the rolling direction", "against the slip",
                 f"{angles[top]:.0f} deg, {power[top]:.1f} times the mean of all directions"))
    return rows


def study(found, mesh=None):
    """Rows of the study's table, and (name, figure); mesh: MeshWaves, beside which speeds are put."""
    waves = Waves(found["creepage"])
    high, in_band = waves.shares()
    slip, way = waves.slip, waves.way()
    rows = [
        ("creepage: slip of the wheel on the rail, mean; its direction from the rolling direction", "",
         f"{np.hypot(*slip):.2f} m/s; {np.degrees(np.arctan2(slip[1], slip[0])):.0f} deg"),
        ("creepage: share of the surface's power from 1 MHz on; in the thesis's band", "narrow about 0.495 MHz",
         f"{high:.2f}; {in_band:.3f}"),
    ]
    for name, region in waves.regions.items():
        rows += rows_of(f"creepage, {name}", region, mesh)
    for name, region in waves.regions.items():
        k = region.nearest(np.mean(BAND))
        phase, coherence, ratio = region.ridge.motion([k])
        rows.append((f"creepage, {name}: in the thesis's band, whether it stands out or not", "6 mm, 3 km/s",
                     f"{1e3 * region.ridge.speed[k] / region.ridge.frequency[k]:.1f} mm,"
                     f" {1e-3 * region.ridge.speed[k]:.2f} km/s, contrast {region.ridge.contrast[k]:.1f} (limit"
                     f" {region.limit[k]:.1f}), phase {phase:.0f} deg, coherence {coherence:.2f}"))
    particles = waves.particles(way)
    for name, one in particles.items():
        phase, coherence, chance = one.relation(BAND)
        ratio, _, polarised = one.ellipse(BAND)
        rows += [
            (f"creepage, {name}: largest of the spectrum, normal and tangential", "0.495 MHz",
             ", ".join(f"{1e-6 * one.dominant(which):.2f}" for which in ("normal", "tangential")) + " MHz"),
            (f"creepage, {name}: phase of normal before tangential motion, {1e-6 * BAND[0]:.2f} to"
             f" {1e-6 * BAND[1]:.2f} MHz", "0.5 pi apart" if name != "N3" else "0.65 pi apart",
             f"{phase / 180:.2f} pi ({'retrograde' if phase < 0 else 'forward'})"),
            (f"creepage, {name}: coherence there (chance reaches {chance:.2f} in one of twenty)", "above 0.8",
             f"{coherence:.2f}"),
            (f"creepage, {name}: ellipse there, normal over tangential; share that is polarised", "ellipse",
             f"{ratio:.2f}; {polarised:.2f}"),
        ]
    return rows, [("creepage_waves", draw_waves(waves, mesh)), ("creepage_surface", draw_surface(waves)),
                  ("creepage_nodes", draw_nodes(particles))]


def draw_waves(waves, mesh):
    """Power by wave number and frequency over its median at that frequency; below, speed by frequency."""
    figure, grid = plt.subplots(2, len(waves.regions), figsize=(5.5 * len(waves.regions), 8), squeeze=False,
                                constrained_layout=True)
    for (plane, line), (name, region) in zip(grid.T, waves.regions.items()):
        ridge, rings = region.ridge, region.spectrum.rings
        level = np.log10(ridge.power / np.median(ridge.power, axis=1, keepdims=True))
        drawn = plane.pcolormesh(rings, 1e-6 * ridge.frequency, level, cmap=style.POWER_MAP, shading="nearest",
                                 vmin=0, vmax=max(np.percentile(level, 99), 0.1))
        figure.colorbar(drawn, ax=plane, label="power over its median at that frequency, log10")
        plane.plot(rings, 1e-6 * rings * rayleigh_speed(), "w--", linewidth=0.8)
        plane.plot(ridge.wavenumber[region.clear], 1e-6 * ridge.frequency[region.clear], "c.", markersize=4)
        plane.set(title=f"{name}; dashed: Rayleigh's speed", xlabel="wave number, 1/m", ylabel="frequency, MHz",
                  ylim=(1e-6 * ridge.frequency[0], 1e-6 * ridge.frequency[-1]), xlim=(0, rings[-1]))
        line.plot(1e-6 * ridge.frequency, 1e-3 * ridge.speed, ".", color="0.7", label="largest at each frequency")
        line.plot(1e-6 * ridge.frequency[region.clear], 1e-3 * ridge.speed[region.clear], ".", color=style.CURVE,
                  label="stands out")
        line.axhline(1e-3 * rayleigh_speed(), color=style.MARKED, linestyle="--", label="Rayleigh's")
        if mesh:
            line.plot(1e-6 * ridge.frequency, 1e-3 * mesh.speed(ridge.frequency), color=style.STICK,
                      label="Rayleigh's in a mesh of 1 mm")
        line.axvspan(*(1e-6 * f for f in BAND), color="0.9", zorder=0, label="thesis's band")
        line.set(xlabel="frequency, MHz", ylabel="speed, km/s", ylim=(1.5, 5))
        line.legend(fontsize=style.TINY)
    return figure


def draw_surface(waves):
    """Four outputs 0.3 us apart at the middle of the thesis's window (fig. 7.5), in the band from 0.3 to 0.7 MHz."""
    surface = waves.one.surface
    step = np.median(np.diff(surface.time))
    spectrum = np.fft.rfft(surface.velocity, axis=0)
    frequency = np.fft.rfftfreq(len(surface.time), step)
    spectrum[(frequency < 0.3e6) | (frequency > 0.7e6)] = 0
    raw, surface.velocity = surface.velocity, np.fft.irfft(spectrum, len(surface.time), axis=0)
    middle = surface.nearest(np.mean(WINDOW))
    figure, grid = plt.subplots(2, 2, figsize=(11, 6.5), constrained_layout=True)
    largest = surface.largest(range(middle, middle + 4))
    for k, axes in enumerate(grid.flat):
        drawn = surface.draw(axes, middle + k, largest)
        patch_edge(axes, waves.one.patch_at(surface.time[middle + k]))
        axes.set_title(f"{1e3 * surface.time[middle + k]:.4f} ms, 0.3 to 0.7 MHz", fontsize=style.SMALL, loc="left")
    figure.colorbar(drawn, ax=grid, label="normal velocity, m/s", shrink=0.7)
    surface.velocity = raw
    return figure


def patch_edge(axes, patch):
    angle = np.linspace(0, 2 * np.pi, 90)
    axes.plot(1e3 * (patch[0] + patch[2] * np.cos(angle)), 1e3 * (patch[1] + patch[3] * np.sin(angle)), "k--",
              linewidth=0.9)


def draw_nodes(particles):
    """Velocities, their spectra, the band by itself, particles' ways in it (fig. 7.7)."""
    figure, grid = plt.subplots(4, len(particles), figsize=(3.8 * len(particles), 11), constrained_layout=True)
    for (history, power, band, way), (name, one) in zip(grid.T, particles.items()):
        for which, colour in (("normal", style.SHEAR), ("tangential", style.SLIP)):
            history.plot(1e3 * one.time, getattr(one, which), color=colour, linewidth=0.7, label=which)
            power.semilogy(1e-6 * one.frequency, one.density(which), color=colour, linewidth=0.8)
            band.plot(1e3 * one.time, one.within(which, BAND), color=colour, linewidth=0.8)
        power.axvspan(*(1e-6 * f for f in BAND), color="0.9")
        tangential, normal = (one.displacement(which, BAND) for which in ("tangential", "normal"))
        way.plot(1e9 * tangential, 1e9 * normal, linewidth=0.7)
        way.set(xlabel="along the wave's way, nm", ylabel="normal, nm", aspect="equal")
        history.set(title=name, xlabel="time, ms")
        power.set(xlabel="frequency, MHz")
        band.set(xlabel="time, ms")
    for axes, label in zip(grid[:, 0], ("velocity, m/s", "density, (m/s)2/Hz", "velocity in the band, m/s")):
        axes.set_ylabel(label)
    grid[0, 0].legend(fontsize=style.TINY)
    return figure
