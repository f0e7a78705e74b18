"""Makes wavelet_reference.csv with PyWavelets (Debian's python3-pywt 1.1.1), an implementation that convolves in time
with the integral of the wavelet and takes differences, where Railwave multiplies spectra:

    /usr/bin/python3 -B make_wavelet_reference.py > wavelet_reference.csv

PyWavelets' cmorB-C is exp(-t^2/B) exp(2 pi i C t) / sqrt(pi B), so that B = 2 and C = w0 / (2 pi) is Morlet's wavelet
of Torrence and Compo but for its factor. Its integral is tabulated at 2^16 points here instead of 2^10: with these, the
modulus is off by some per cent. Differences belong half-way between samples, which turns the phase, so that the modulus
is what is compared.
"""

import numpy as np
import pywt

INTERVAL, COUNT, W0 = 1e-3, 1024, 6.0


def signal():
    """A sweep from 5 to 45 Hz, and a burst of 60 Hz; test_wavelet.cpp has the same formula."""
    t = INTERVAL * np.arange(COUNT)
    return np.cos(2 * np.pi * (5 + 20 * t) * t) + 0.8 * np.exp(-(((t - 0.3) / 0.03) ** 2)) * np.sin(2 * np.pi * 60 * t)


def main():
    integrate = pywt._cwt.integrate_wavelet
    pywt._cwt.integrate_wavelet = lambda wavelet, precision: integrate(wavelet, precision=16)
    print(
        f"# PyWavelets {pywt.__version__}: modulus of the wavelet transform of the signal in make_wavelet_reference.py"
    )
    print("scale_s,sample,modulus")
    wavelet = pywt.ContinuousWavelet(f"cmor2.0-{W0 / (2 * np.pi):.15f}")
    factor = np.pi**-0.25 * np.sqrt(2 * np.pi)
    for scale in 24e-3 * 2 ** (0.5 * np.arange(7)):
        (row,), _ = pywt.cwt(signal(), [scale / INTERVAL], wavelet)
        for n in range(12, COUNT, 25):
            print(f"{scale:.12g},{n},{factor * abs(row[n]):.6g}")


if __name__ == "__main__":
    main()
