"""Motion of a particle of the surface: spectra, phase and coherence of its normal and tangential velocity, its ellipse
in a band."""

import numpy as np

PIECE = 20e-6  # s, of the record that is transformed at once for phase and coherence


class Particle:
    """Velocity of a node at even times less its trend: `normal` and, along the unit vector `way`, `tangential`, m/s."""

    def __init__(self, time, velocity, way):
        self.step = (time[-1] - time[0]) / (len(time) - 1)
        self.time = time[0] + self.step * np.arange(len(time))
        raw = {"normal": velocity[:, 2], "tangential": velocity[:, :2] @ np.asarray(way)}
        clock = np.linspace(-1, 1, len(time))
        for which, values in raw.items():
            values = np.interp(self.time, time, values)
            setattr(self, which, values - np.polyval(np.polyfit(clock, values, 3), clock))
        self.frequency = np.fft.rfftfreq(len(time), self.step)

    def density(self, which):
        """Power spectral density under Hann's window, (m/s)2/Hz."""
        window = np.hanning(len(self.time))
        return 2 * self.step * np.abs(np.fft.rfft(getattr(self, which) * window)) ** 2 / np.sum(window**2)

    def dominant(self, which):
        """Frequency of the largest density above two periods of the record, Hz."""
        known = self.frequency > 2.5 / (len(self.time) * self.step)
        return float(self.frequency[known][self.density(which)[known].argmax()])

    def relation(self, band):
        """Phase of the normal before the tangential motion in a band, deg; their coherence; what chance reaches in one
        of twenty."""
        count = min(round(PIECE / self.step), len(self.time))
        frequency = np.fft.rfftfreq(count, self.step)
        half = 0.5 / (count * self.step)
        chosen = (frequency > band[0] - half) & (frequency < band[1] + half)
        window, sums, pieces = np.hanning(count), np.zeros(3, complex), 0
        for first in range(0, len(self.time) - count + 1, max(count // 2, 1)):
            normal, tangential = (np.fft.rfft(getattr(self, which)[first:first + count] * window)[chosen]
                                  for which in ("normal", "tangential"))
            sums += [np.sum(np.abs(normal) ** 2), np.sum(np.abs(tangential) ** 2), np.sum(normal * tangential.conj())]
            pieces += 1
        # Pieces of which a half is common count as three quarters of as many.
        chance = 1 - 0.05 ** (1 / max(0.75 * pieces - 1, 0.5))
        return float(np.degrees(np.angle(sums[2]))), float(np.abs(sums[2]) ** 2 / (sums[0] * sums[1]).real), chance

    def _analytic(self, which, band):
        """Of the velocity in a band."""
        spectrum = np.fft.fft(getattr(self, which))
        frequency = np.fft.fftfreq(len(self.time), self.step)
        edge = 0.1 * (band[1] - band[0]) + 1e-9
        gain = np.clip((frequency - band[0]) / edge + 0.5, 0, 1) * np.clip((band[1] - frequency) / edge + 0.5, 0, 1)
        return frequency, 2 * spectrum * gain

    def within(self, which, band):
        return np.fft.ifft(self._analytic(which, band)[1]).real

    def displacement(self, which, band):
        """m"""
        frequency, spectrum = self._analytic(which, band)
        return np.fft.ifft(spectrum / np.where(frequency > 0, 2j * np.pi * frequency, np.inf)).real

    def ellipse(self, band):
        """Normal over tangential amplitude; phase of the normal before the tangential motion, deg; share of the motion
        that is one ellipse, by Stokes's parameters."""
        normal, tangential = (np.fft.ifft(self._analytic(which, band)[1]) for which in ("normal", "tangential"))
        n, t, both = np.mean(np.abs(normal) ** 2), np.mean(np.abs(tangential) ** 2), np.mean(normal * tangential.conj())
        share = np.sqrt((n - t) ** 2 + 4 * np.abs(both) ** 2) / (n + t)
        return float(np.sqrt(n / t)), float(np.degrees(np.angle(both))), float(share)
