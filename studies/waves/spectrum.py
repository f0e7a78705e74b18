"""Waves of a surface by frequency and wave vector: which of a surface's motion is one wave, how fast and where to it
goes, and whether its particles move as those of a Rayleigh wave: normal and tangential motion a quarter of a period
apart, backwards at the top."""

import numpy as np

YOUNG, POISSON, DENSITY = 210e9, 0.3, 7800.0  # of the cases' steel
PIECE = 64e-6  # s, of the record that is transformed at once, half of it common with the next
LARGEST_WAVENUMBER, STEP = 480.0, 6.0  # 1/m; less on coarse meshes, whose nodes tell no more
HIGHEST = 0.9e6  # Hz
BANDS = [(1e5 * low, 1e5 * (low + 1)) for low in range(1, 9)]  # Hz, of tables
# A ridge is looked for at speeds from SLOWEST to FASTEST times Rayleigh's, and in the mean over as much on both sides.
SLOWEST, FASTEST = 0.6, 1.7
NOISE_DRAWS, BEYOND_NOISE, NEIGHBOURS = 6, 1.3, 4


def rayleigh_speed(young=YOUNG, poisson=POISSON, density=DENSITY):
    """m/s: the root of (2 - q)^2 = 4 sqrt(1 - q) sqrt(1 - r q) below 1, q = (c / c_S)^2, r = (c_S / c_P)^2."""
    shear = young / (2 * (1 + poisson) * density)
    ratio = (1 - 2 * poisson) / (2 * (1 - poisson))
    low, high = 0.5, 1 - 1e-9
    for _ in range(60):
        q = 0.5 * (low + high)
        below = (2 - q) ** 2 - 4 * np.sqrt((1 - q) * (1 - ratio * q)) < 0
        low, high = (q, high) if below else (low, q)
    return float(np.sqrt(low * shear))


def normal_over_tangential(poisson=POISSON):
    """Of a Rayleigh wave's motion at the surface: 2 sqrt(1 - r q) / (2 - q)."""
    q = (rayleigh_speed(1.0, poisson, 1.0) ** 2) * 2 * (1 + poisson)
    ratio = (1 - 2 * poisson) / (2 * (1 - poisson))
    return float(2 * np.sqrt(1 - ratio * q) / (2 - q))


class Field:
    """Velocity of a surface that is a prism along x, on a grid of x and of the way s across it, at even times.
    `velocity`: outwards along the surface's normal, along x, across; each by time, x and s."""

    def __init__(self, time, place, velocity):
        """place: of its nodes, m, a grid of x and y; velocity: by time, node and axis, m/s"""
        x, y = (np.unique(place[:, axis].round(5)) for axis in (0, 1))
        if len(place) != len(x) * len(y):
            raise ValueError(f"{len(place)} places are no grid of {len(x)} times {len(y)}")
        order = np.lexsort((place[:, 1], place[:, 0]))
        place = place[order].reshape(len(x), len(y), 3)
        velocity = np.asarray(velocity, np.float32)[:, order].reshape(len(time), len(x), len(y), 3)
        self.time, self.x, self.y = even(time), x, y
        velocity = at_even_times(time, self.time, velocity)
        height = place[:, :, 2].mean(axis=0)
        slope = np.gradient(height, y) if len(y) > 2 else np.zeros(len(y))
        way = np.concatenate([[0], np.cumsum(np.hypot(np.diff(y), np.diff(height)))])
        length = np.sqrt(1 + slope**2)
        parts = [(velocity[..., 2] - slope * velocity[..., 1]) / length, velocity[..., 0],
                 (velocity[..., 1] + slope * velocity[..., 2]) / length]
        # The way across in even steps: weights of the nodes at both sides of each place.
        count = max(1, round(way[-1] / np.median(np.diff(way)))) + 1 if len(y) > 1 else 1
        self.s = np.linspace(0, way[-1], count)
        weights = np.array([np.interp(self.s, way, row) for row in np.eye(len(y))])
        self.velocity = np.stack([part @ weights for part in parts])
        self.y_of_s = np.interp(self.s, way, y)

    def tapered(self, mask=None):
        """Weights by x and s: a Hann window over both, times a mask of the same shape."""
        across = np.hanning(len(self.s) + 2)[1:-1] if len(self.s) > 2 else np.ones(len(self.s))
        weights = np.outer(np.hanning(len(self.x) + 2)[1:-1], across)
        return weights if mask is None else weights * mask


def even(time):
    return time[0] + (time[-1] - time[0]) / (len(time) - 1) * np.arange(len(time))


def at_even_times(time, wanted, values):
    """Values by time first, interpolated."""
    after = np.clip(np.searchsorted(time, wanted), 1, len(time) - 1)
    share = ((wanted - time[after - 1]) / (time[after] - time[after - 1])).reshape(-1, *[1] * (values.ndim - 1))
    return (1 - share) * values[after - 1] + share * values[after]


class Spectrum:
    """Power of the normal (n), tangential along the wave vector (t) and tangential across it (h) velocity by frequency
    and wave vector, and the cross-spectrum of n and t; means over pieces of the record. The wave vector points where
    the wave goes to."""

    def __init__(self, field, mask=None, piece=PIECE):
        step = field.time[1] - field.time[0]
        count = min(round(piece / step), len(field.time))
        frequency = np.fft.rfftfreq(count, step)
        kept = (frequency > 1.5 / (count * step)) & (frequency < min(HIGHEST, 0.45 / step))
        self.frequency = frequency[kept]
        spacing = max(np.median(np.diff(way)) for way in (field.x, field.s) if len(way) > 1)
        steps = np.arange(int(min(LARGEST_WAVENUMBER, 0.48 / spacing) / STEP) + 1)
        self.rings = STEP * steps
        one = STEP * np.concatenate([-steps[:0:-1], steps])
        self.kx = one
        self.ky = one if len(field.s) > 1 else np.zeros(1)
        self.size = np.hypot(self.kx[:, None], self.ky[None, :])
        self.direction = np.arctan2(self.ky[None, :], self.kx[:, None])
        cos, sin = np.cos(self.direction), np.sin(self.direction)
        # A wave that goes along k has the phase 2 pi (f t - k x): the sum over places takes that back.
        self._to_x = np.exp(2j * np.pi * np.outer(self.kx, field.x))
        self._to_s = np.exp(2j * np.pi * np.outer(field.s, self.ky))
        self._cos, self._sin = cos, sin
        self._weights, window = field.tapered(mask), np.hanning(count)[:, None, None]
        clock = np.linspace(-1, 1, count)
        pieces = []
        for first in range(0, len(field.time) - count + 1, max(count // 2, 1)):
            turned = []
            for part in field.velocity:
                part = part[first:first + count]
                line = np.tensordot(clock, part, 1) / np.sum(clock**2)
                part = part - part.mean(axis=0) - clock[:, None, None] * line
                by_frequency = np.fft.rfft(part * window, axis=0)[kept]
                turned.append(self._by_wave(by_frequency))
            normal, along, across = turned
            tangential, horizontal = cos * along + sin * across, cos * across - sin * along
            pieces.append([np.abs(normal) ** 2, np.abs(tangential) ** 2, np.abs(horizontal) ** 2,
                           normal * tangential.conj()])
        self.pieces = [[sums.astype(np.complex64 if k == 3 else np.float32) for k, sums in enumerate(piece)]
                       for piece in pieces]
        self._ring = np.rint(self.size / STEP).astype(int)
        self._members = np.bincount(self._ring.ravel(), minlength=len(self.rings))[:len(self.rings)]

    def _by_wave(self, values):
        """Of values by frequency, x and s those by frequency and wave vector."""
        return self._to_x @ (values * self._weights) @ self._to_s

    def of_rayleigh_wave(self, field, speed, sources):
        """Power by frequency and wave number that this spectrum would have of Rayleigh waves of that speed which go out
        from places x and s of the surface, as strong as one another and not in step."""
        power = 0.0
        x, s = np.meshgrid(field.x, field.s, indexing="ij")
        for at_x, at_s in sources:
            away = np.hypot(x - at_x, s - at_s)
            wave = np.exp(-2j * np.pi * self.frequency[:, None, None] * away / speed) / np.sqrt(np.maximum(away, 1e-3))
            radial = 1j / normal_over_tangential() * wave / np.maximum(away, 1e-9)
            normal, along, across = (self._by_wave(part) for part in (wave, radial * (x - at_x), radial * (s - at_s)))
            power = power + np.abs(normal) ** 2 + np.abs(self._cos * along + self._sin * across) ** 2
        return self.by_ring(power)

    def over_pieces(self, which, without=None):
        """Mean over the pieces, but one, of n (0), t (1), h (2) or the cross-spectrum (3)."""
        return np.mean([piece[which] for k, piece in enumerate(self.pieces) if k != without], axis=0)

    def by_ring(self, values):
        """Means over the wave vectors of a length, by frequency and length."""
        flat, ring = values.reshape(len(values), -1), self._ring.ravel()
        within = ring < len(self.rings)
        sums = np.zeros((len(values), len(self.rings)), values.dtype)
        for k, row in enumerate(flat):
            real = np.bincount(ring[within], row.real[within], len(self.rings))
            sums[k] = real + (1j * np.bincount(ring[within], row.imag[within], len(self.rings))
                              if np.iscomplexobj(values) else 0)
        return sums / self._members

    def power(self, without=None):
        """Of normal and tangential motion, by frequency and wave number."""
        return self.by_ring(self.over_pieces(0, without) + self.over_pieces(1, without))


class Ridge:
    """Where the power of a Spectrum is largest at each frequency, among speeds about Rayleigh's: wave number, contrast
    to the median of those wave numbers, phase, coherence and amplitude ratio of normal and tangential motion there."""

    def __init__(self, spectrum, expected=None):
        self.spectrum, self.expected = spectrum, expected or rayleigh_speed()
        self.frequency = spectrum.frequency
        self.power = spectrum.power()
        self.wavenumber, self.contrast = self._largest(self.power)
        self.bias = np.ones(len(self.frequency))
        self.reachable = self._range(self.frequency)[1] < spectrum.rings[-1]
        n, t, c = (spectrum.by_ring(spectrum.over_pieces(which)) for which in (0, 1, 3))
        at = np.rint(np.nan_to_num(self.wavenumber) / STEP).astype(int)
        near = np.clip(at[:, None] + np.array([-1, 0, 1]), 0, len(spectrum.rings) - 1)
        weight = spectrum._members[near]
        row = np.arange(len(at))[:, None]
        self.sums = [(values[row, near] * weight).sum(axis=1) for values in (n, t, c)]

    @property
    def speed(self):
        """By frequency, m/s."""
        return self.frequency / (self.wavenumber * self.bias)

    def calibrate(self, field, sources):
        """What a short surface does to the wave number, frequency by frequency, as it does to Rayleigh waves of known
        speed from the sources (places x and s, m), is taken out of the speeds from now on."""
        found, _ = self._largest(self.spectrum.of_rayleigh_wave(field, self.expected, sources))
        self.bias = self.frequency / self.expected / found

    def _range(self, frequency):
        return np.asarray(frequency) / (FASTEST * self.expected), np.asarray(frequency) / (SLOWEST * self.expected)

    def _largest(self, power):
        rings = self.spectrum.rings
        found, contrast = np.full(len(power), np.nan), np.zeros(len(power))
        for k, row in enumerate(power):
            low, high = self._range(self.frequency[k])
            within = np.flatnonzero((rings >= max(low, STEP)) & (rings <= high))
            if len(within) < 3:
                continue
            top = within[row[within].argmax()]
            contrast[k] = row[top] / np.median(row[within])
            found[k] = rings[top]
            if 0 < top < len(rings) - 1:
                left, middle, right = np.log(np.maximum(row[top - 1:top + 2], 1e-300))
                bend = left - 2 * middle + right
                found[k] += STEP * (0.5 * (left - right) / bend if bend < 0 else 0.0)
        return found, contrast

    def at_edge(self):
        """Whether the maximum is at the end of the speeds that are looked at: no ridge."""
        low, high = self._range(self.frequency)
        return (self.wavenumber < low + STEP) | (self.wavenumber > high - STEP)

    def limit(self, field, mask=None):
        """By frequency the contrast from which on a ridge stands out: beyond what the same motion with its places
        shuffled reaches at that frequency and the next ones."""
        random, reached = np.random.default_rng(0), []
        flat = field.velocity.reshape(*field.velocity.shape[:2], -1)
        shuffled = Field.__new__(Field)
        vars(shuffled).update(vars(field))
        for _ in range(NOISE_DRAWS):
            shuffled.velocity = flat[:, :, random.permutation(flat.shape[2])].reshape(field.velocity.shape)
            reached.append(self._largest(Spectrum(shuffled, mask).power())[1])
        most = np.pad(np.max(reached, axis=0), NEIGHBOURS, mode="edge")
        return BEYOND_NOISE * np.lib.stride_tricks.sliding_window_view(most, 2 * NEIGHBOURS + 1).max(axis=1)

    def clear(self, limit):
        """Frequencies at which the ridge stands out."""
        return np.flatnonzero((self.contrast > limit) & ~self.at_edge() & self.reachable)

    def fitted(self, chosen):
        """Speed over the chosen frequencies, and its standard error by leaving out one piece of the record after the
        other, m/s."""
        def speed(wavenumber):
            weight = np.log(np.maximum(self.contrast[chosen], 1.001))
            own = self.frequency[chosen] / (wavenumber[chosen] * self.bias[chosen])
            return float(np.sum(weight * own) / np.sum(weight))

        count = len(self.spectrum.pieces)
        if not len(chosen):
            return np.nan, np.nan
        if count < 2:
            return speed(self.wavenumber), np.nan
        left = [speed(self._largest(self.spectrum.power(without=k))[0]) for k in range(count)]
        return speed(self.wavenumber), float(np.sqrt((count - 1) / count * np.sum((left - np.mean(left)) ** 2)))

    def motion(self, chosen):
        """Of the chosen frequencies together: phase of the normal before the tangential motion, deg, -90 where it is
        retrograde as a Rayleigh wave's; coherence; normal over tangential amplitude."""
        n, t, c = (sums[chosen].sum() for sums in self.sums)
        return float(np.degrees(np.angle(c))), float(np.abs(c) ** 2 / (n * t)), float(np.sqrt(n / t))

    def heading(self, chosen):
        """Power on the ridge by direction, the mean of the chosen frequencies: deg from x to s, -180 to 180; over the
        mean of all directions."""
        angles = np.arange(-180.0, 180.0, 15.0)
        found, spectrum = np.zeros(len(angles)), self.spectrum
        power = spectrum.over_pieces(0) + spectrum.over_pieces(1)
        sector = np.rint((np.degrees(spectrum.direction) + 180) / 15).astype(int) % len(angles)
        for k in chosen:
            on = np.abs(spectrum.size - self.wavenumber[k]) < 1.5 * STEP
            count = np.bincount(sector[on], minlength=len(angles))
            found += np.bincount(sector[on], power[k][on], len(angles)) / np.maximum(count, 1)
        return angles, found / max(found.mean(), 1e-300)
