"""Waves on the running surface: its normal velocity by the distance from where they begin, how fast and how long they
are. The impact's begin where the wheel first touches the second rail, a perturbation's where the velocity changes most
when the slip in the patch's leading half jumps (thesis 4.6)."""

import copy

import numpy as np

from radial_wave import EARLIER, LEAST_RINGS, RadialWave
from surface import AHEAD, BEFORE, BEHIND, surface_of

FROM, REACH = 0.003, 0.025  # m ahead of the patch from which on, and over which, waves are looked for
PIECE = 64e-6  # s, of the record that is transformed at once
COHERENT_SPEEDS = np.arange(2000.0, 6500.0, 50.0)  # m/s
SURFACE_SPEEDS = (2500.0, 3500.0)  # m/s, of waves along a surface, about Rayleigh's 2980
# Share of the power that moves as one wave from which on that stands out, and by how much it exceeds what noise of as
# many outputs at as many places reaches in one of a hundred frequencies: less than 0.38 at a dozen places, 0.65 at
# five.
COHERENT, BEYOND_NOISE = 0.45, 1.2
NOISE_DRAWS = 40
LANDED = 60e-6  # s after the touch in which the impact's waves are looked for
# A disturbance stands out that is so many times the median of all outputs': nodes that come in and go out, each 36 us,
# make twice the median.
STANDS_OUT = 3


class WavesAhead:
    """Waves that run along the rail ahead of the patch: by frequency, how much of the normal velocity on the patch's
    centre line moves as one wave, and how fast that is."""

    def __init__(self, surface, begin, end, front, middle):
        """begin, end: s; front: x, m, ahead of which they are looked for; middle: y of the centre line, m"""
        chosen = surface.between(begin, end)
        self.time, velocity = surface.time[chosen], surface.velocity[chosen][:, :, 2].astype(float)
        x = surface.place[:, 0].round(5)
        line = (np.abs(surface.place[:, 1] - middle) < 0.75 * surface.size) & (x > front) & (x < front + REACH)
        self.x = np.unique(x[line])
        self.velocity = np.array([velocity[:, line & (x == place)].mean(axis=1) for place in self.x]).T

    def is_seen(self):
        return len(self.time) >= 32 and len(self.x) >= LEAST_RINGS

    def limit(self):
        """The share from which on a wave stands out."""
        noise = copy.copy(self)
        random = np.random.default_rng(0)
        shares = []
        for _ in range(NOISE_DRAWS):
            noise.velocity = random.normal(size=self.velocity.shape)
            shares.append(noise.coherence()[1][2:-1])
        return max(COHERENT, BEYOND_NOISE * float(np.quantile(shares, 0.99)))

    def coherence(self):
        """Hz; the largest share of the power that any speed of COHERENT_SPEEDS adds up, by frequency; m/s, that one."""
        step = (self.time[-1] - self.time[0]) / (len(self.time) - 1)
        even = self.time[0] + step * np.arange(len(self.time))
        moved = np.array([np.interp(even, self.time, one) for one in self.velocity.T]).T
        count = min(round(PIECE / step), len(even))
        frequency = np.fft.rfftfreq(count, step)
        way = np.outer(frequency, self.x - self.x[0])
        together_at = np.exp(2j * np.pi * np.multiply.outer(1 / COHERENT_SPEEDS, way))  # by speed, frequency, place
        together, apart = 0, 0
        for first in range(0, len(even) - count + 1, max(count // 2, 1)):
            piece = moved[first:first + count]
            spectrum = np.fft.rfft((piece - piece.mean(axis=0)) * np.hanning(count)[:, None], axis=0)
            together = together + np.abs((spectrum * together_at).sum(axis=2)) ** 2
            apart = apart + len(self.x) * (np.abs(spectrum) ** 2).sum(axis=1)
        share = together / np.maximum(apart, 1e-300)
        return frequency, share.max(axis=0), COHERENT_SPEEDS[share.argmax(axis=0)]

    def listed(self):
        """(frequency, Hz; speed, m/s; share) of those that stand out, the longest first: no sound waves, which are
        faster."""
        frequency, share, speed = self.coherence()
        limit = self.limit()
        return [(float(frequency[k]), float(speed[k]), float(share[k])) for k in range(2, len(frequency) - 1)
                if share[k - 1] <= share[k] > share[k + 1] and share[k] > limit
                and SURFACE_SPEEDS[0] < speed[k] < SURFACE_SPEEDS[1]]


def waves_ahead(passing, name, begin, end):
    """What the table says of the waves ahead of the patch on a surface behind the gap between two times, s."""
    patch = passing.at(end)
    if patch is None:
        return "no contact then"
    waves = WavesAhead(surface_of(passing.results, name), begin, end, passing.front(end) + FROM, patch.centre_y)
    if not waves.is_seen():
        return "too few outputs of the surface then"
    listed = [f"{1e3 * speed / frequency:.1f} mm {1e-3 * speed:.2f} km/s {1e-3 * frequency:.0f} kHz ({share:.2f})"
              for frequency, speed, share in waves.listed()]
    return ", ".join(listed) or "none stands out"


def measured(wave):
    """What the table says of it."""
    if not wave.is_seen():
        return "too few outputs of the surface then"
    speed, length = wave.speed_and_length()
    return f"{1e3 * length:.1f} mm (crest {500 * length:.1f} mm), {1e-3 * speed:.2f} km/s"


def perturbation(passing):
    """What the table says of disturbances of the slip in the leading half of the patch while the wheel nears the gap,
    and of the wave of the one that stands out most."""
    time, change = passing.disturbances()
    if len(time) < 100:
        return "too few outputs of the contact then"
    largest, ratio = change.argmax(), change.max() / np.median(change)
    said = (f"{1e3 * time[0]:.1f} to {1e3 * time[-1]:.1f} ms: slip changes by at most {change.max():.3f} m/s in"
            f" {1e6 * np.median(np.diff(time)):.1f} \N{MICRO SIGN}s, {ratio:.1f} times the median")
    if ratio < STANDS_OUT:
        return f"none stands out; {said}"
    before = surface_of(passing.results, BEFORE)
    disturbed = before.disturbed(time[largest] - 5e-6, time[largest] + 5e-6)
    if disturbed is None:
        return f"at {1e3 * time[largest]:.3f} ms, outside the surface's window; {said}"
    output, node = disturbed
    wave = RadialWave(before, before.place[node, :2], before.time[output])
    return f"{measured(wave)}, {1e3 * before.time[output]:.3f} ms, {before.x[node]:.0f} mm; {said}"


def findings(found):
    """Rows of the study's table, and by simulation the wave that was looked at."""
    rows, seen = [], {}
    for number, passing in sorted(found.items()):
        touch = passing.touch
        name = f"simulation {number}: first touch of the second rail"
        if touch is None:
            rows.append((name, "46.39 ms by its clock", "none"))
            continue
        rows.append((name, "46.39 ms by its clock",
                     f"{1e3 * touch:.3f} ms, wheel {1e3 * passing.place(touch):.1f} mm from the gap"))
        surface = surface_of(passing.results, BEHIND)
        wave = RadialWave(surface, passing.touched, touch)
        if wave.is_seen():
            seen[number] = wave
        begin, end = surface_of(passing.results, AHEAD).last_window()
        rows += [
            (f"simulation {number}: first crest of the impact's wave, as half of one", "10 mm, 3 km/s", measured(wave)),
            (f"simulation {number}: perturbation wave before the gap", "6 mm, 3 km/s, 43.603 ms, 1244 mm",
             perturbation(passing)),
            (f"simulation {number}: waves ahead of the landing patch, within {1e6 * LANDED:.0f} us (share that moves as"
             " one wave)",
             "10 mm (3), 20 and 40 mm (2), 3 km/s", waves_ahead(passing, BEHIND, touch - EARLIER, touch + LANDED)),
            (f"simulation {number}: waves of large creepage, {1e3 * begin:.2f} to {1e3 * end:.2f} ms",
             "495 kHz, 6 mm, 3 km/s (7.2)", waves_ahead(passing, AHEAD, begin, end)),
        ]
    return rows, seen
