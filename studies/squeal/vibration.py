"""Vibration of the rolling wheel (thesis 5.3.3): the rim's velocity along the axle, along the radius and round the
wheel, its spectra, and which of the wheel's modes these show."""

import h5py
import matplotlib.pyplot as plt
import numpy as np

import wheel_modes
from cases import NAMES, SIDEWAYS
from pictures import style
from pictures.signals import Signals, draw_wavelet

NAMED = {0: 163.0, 3: 1172.0, 4: 1921.0}  # Hz, of the thesis's lateral vibration, by nodal diameters (table 5.3)
# Of the wheel's own mode, within which a maximum is looked for; and how many times the median from a third of the
# frequency to three times it that is.
WITHIN, STANDS_OUT = 0.05, 50
PLACE = "wheelset.rim_above"
BAND = (100.0, 5000.0)  # Hz
PADDED = 8  # times the record's length, to read frequencies finer than one over it


class Rim:
    """Velocity of one place of the rim against the bore's, in the wheel's own directions, m/s: lateral, radial,
    circumferential."""

    def __init__(self, one):
        self.number = one.number
        with h5py.File(one.results, "r") as file:
            history = file["history"]
            self.time = history["time"][:] + one.earlier
            rim, bore = (history[f"set/{name}"] for name in (PLACE, "wheelset.bore"))
            # The bore's mean place is the axle's: the set goes once around.
            arm = np.subtract(*(side["position"][:] + side["displacement"][:] for side in (rim, bore)))[:, [0, 2]]
            velocity = rim["velocity"][:] - bore["velocity"][:]
            self.lateral = rim["velocity"][:, 1]
        outwards = arm / np.linalg.norm(arm, axis=1, keepdims=True)
        self.radial = np.einsum("nc,nc->n", velocity[:, [0, 2]], outwards)
        turning = velocity[:, 0] * outwards[:, 1] - velocity[:, 2] * outwards[:, 0]
        self.circumferential = turning - turning.mean()

    def later(self, name):
        """A velocity from when the lateral motion begins on; times, s."""
        chosen = self.time >= SIDEWAYS
        return self.time[chosen], getattr(self, name)[chosen]


def spectrum(time, value):
    """Frequency, Hz, and power spectral density, (m/s)2/Hz, of a record without its line, under Hann's window."""
    step = time[1] - time[0]
    value = value - np.polyval(np.polyfit(time, value, 1), time)
    window = np.hanning(len(value))
    density = 2 * step * np.abs(np.fft.rfft(value * window, PADDED * len(value))) ** 2 / np.sum(window**2)
    return np.fft.rfftfreq(PADDED * len(value), step), density


def maxima(density):
    """Where a spectrum has its local maxima."""
    return np.flatnonzero((density[1:-1] > density[:-2]) & (density[1:-1] >= density[2:])) + 1


def peaks(frequency, density, least=1e-4):
    """Frequencies of the local maxima within BAND, the strongest first: those above `least` times the strongest."""
    within = (frequency >= BAND[0]) & (frequency <= BAND[1])
    top = maxima(density)
    top = top[within[top] & (density[top] > least * density[within].max())]
    return frequency[top[np.argsort(-density[top])]]


def near(frequency, density, mode):
    """Frequency of the highest local maximum within WITHIN of a mode's, Hz; None: there is none that stands out."""
    around = (frequency > mode / 3) & (frequency < 3 * mode)
    top = maxima(density)
    top = top[(np.abs(frequency[top] / mode - 1) < WITHIN) & (density[top] > STANDS_OUT * np.median(density[around]))]
    return float(frequency[top[density[top].argmax()]]) if len(top) else None


def findings(rims, modes):
    """Rows of the study's table."""
    rows = []
    for number, rim in sorted(rims.items()):
        if number == 1:
            continue
        density = spectrum(*rim.later("lateral"))
        found = peaks(*density)
        for diameters, thesis in NAMED.items():
            mode = wheel_modes.axial(modes, diameters)
            own = mode and near(*density, mode)
            rows.append((
                f"case {number}: lateral vibration at the wheel's axial mode (0,{diameters})", f"{thesis:.0f} Hz",
                *((f"{own:.0f} Hz, mode {mode:.0f} Hz", f"{100 * (own / mode - 1):+.1f} % of the mode") if own else
                  ("none", "")),
            ))
        strongest = ", ".join(f"{f:.0f}" for f in found[:6])
        rows.append((f"case {number}: strongest lateral vibration", "", f"{strongest} Hz"))
        for which in ("radial", "circumferential"):
            found = peaks(*spectrum(*rim.later(which)))[:4]
            strongest = ", ".join(f"{f:.0f}" for f in found)
            rows.append((f"case {number}: strongest {which} vibration", "", f"{strongest} Hz"))
    sizes = ", ".join(f"{rim.later('lateral')[1].std():.3f} (case {number})" for number, rim in sorted(rims.items()))
    rows.append(("lateral velocity of the rim, deviation, m/s", "grows with the displacement", sizes))
    return rows


def draw(rims):
    """The rim's lateral velocity over time, its orbit (limit cycle), its spectrum (fig. 5.9)."""
    figure, grid = plt.subplots(3, len(rims), figsize=(3.6 * len(rims) + 1, 9), squeeze=False, constrained_layout=True)
    for (line, cycle, power), (number, rim) in zip(grid.T, sorted(rims.items())):
        time, velocity = rim.later("lateral")
        line.plot(1e3 * rim.time, rim.lateral, linewidth=0.8)
        line.set_title(f"case {number}: {NAMES[number]}", fontsize=style.TEXT)
        line.set_xlabel("time, ms")
        place = np.concatenate([[0], np.cumsum(0.5 * (velocity[1:] + velocity[:-1]) * np.diff(time))])
        place = place - np.polyval(np.polyfit(time, place, 3), time)
        cycle.plot(1e3 * place, velocity, linewidth=0.6)
        cycle.set_xlabel("lateral displacement less its trend, mm")
        frequency, density = spectrum(time, velocity)
        shown = (frequency > 50) & (frequency < BAND[1])
        power.semilogy(frequency[shown], density[shown], linewidth=0.8)
        for wanted in NAMED.values():
            power.axvline(wanted, color="0.6", linestyle=":")
        power.set_xlabel("frequency, Hz")
        for axes in (line, cycle, power):
            axes.grid(alpha=0.3)
    for axes, label in zip(grid[:, 0], ("lateral velocity, m/s", "lateral velocity, m/s", "density, (m/s)2/Hz")):
        axes.set_ylabel(label)
    return figure


def wavelets(steps, found):
    """Wavelet power of the vibration of cases 1 and 4 along three directions (fig. 5.10): (name, figure)."""
    for number in (1, 4):
        if number not in found:
            continue
        one = found[number]
        low = max(BAND[0], 2 / (one.time[-1] - one.earlier))
        for name, axis in (("lateral", "y"), ("vertical", "z"), ("longitudinal", "x")):
            path = steps.path(f"wavelet_{number}_{name}.h5")
            place = PLACE if name == "lateral" else "wheelset.bore"
            steps.derive(path, one.results, "signal", "wavelet", one.results, "--channel", f"{place}.velocity.{axis}",
                         "--trend", "line", "--low", f"{low:.0f}", "--high", f"{BAND[1]:.0f}", "--hdf5")
            yield path.stem, draw_wavelet(Signals(path))
