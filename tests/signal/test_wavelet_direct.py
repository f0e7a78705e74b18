"""railwave signal wavelet against the definition itself: sums over time of the signal times Morlet's wavelet (eq. 2 of
Torrence and Compo, 1998), which has nothing in common with the transforms that Railwave multiplies."""

import os
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from made_up_results import INTERVAL, signal, write_results

W0 = 6.0


def test_signal():
    """A sweep, a burst and a step, without mean."""
    t = INTERVAL * np.arange(700)
    values = (
        np.cos(2 * np.pi * (5e3 + 6e7 * t) * t)
        + (t > 4e-4) * 0.5
        + 2 * np.exp(-(((t - 2e-4) / 1e-5) ** 2)) * np.sin(2 * np.pi * 1.2e5 * t)
    )
    return values - values.mean()


def direct_power(values, scale):
    n = np.arange(len(values))
    eta = (n[None, :] - n[:, None]) * INTERVAL / scale
    wavelet = np.pi**-0.25 * np.exp(1j * W0 * eta) * np.exp(-(eta**2) / 2)
    return abs((np.conj(wavelet) * values).sum(axis=1) * np.sqrt(INTERVAL / scale)) ** 2


class Wavelet(unittest.TestCase):
    def test_power_at_every_time_and_scale(self):
        values = test_signal()
        with tempfile.TemporaryDirectory() as folder:
            results, out = os.path.join(folder, "run.h5"), os.path.join(folder, "wavelet.h5")
            write_results(results, {"body.node": values})
            signal(
                "wavelet", results, "--channel", "body.node.velocity.z", "--low", "5e3", "--scale-spacing", "0.25",
                "--hdf5", out,
            )
            with h5py.File(out, "r") as file:
                power, scales, frequency = (
                    file["power"][:],
                    file["by_frequency/scale"][:],
                    file["by_frequency/frequency"][:],
                )
                self.assertAlmostEqual(file.attrs["variance"] / np.mean(values**2), 1, delta=1e-9)
        np.testing.assert_allclose(1 / frequency, 4 * np.pi * scales / (W0 + np.sqrt(2 + W0**2)), rtol=1e-12)
        self.assertGreater(len(scales), 20)
        for scale, row in zip(scales, power):
            expected = direct_power(values, scale)
            self.assertLess(abs(row - expected).max(), 0.01 * expected.max(), f"scale {scale}")


if __name__ == "__main__":
    unittest.main()
