"""What `railwave signal --hdf5` found (docs/signals.md): spectra, scalograms, phase and coherence, ellipses, wave
speeds."""

import h5py
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter

from . import style
from .results import BadFile
from .style import label_of, scale_of

MOST_ELLIPSES = 4
STRONG = 0.01  # of the largest power: what the speed was found from


class Signals:
    def __init__(self, path):
        self.path = path
        try:
            self._file = h5py.File(path, "r")
        except OSError as error:
            raise BadFile(f"{path} cannot be read as an HDF5 file: {error}") from None
        if self._file.attrs.get("format") != "Railwave signals":
            raise BadFile(f"{path} is no file that 'railwave signal --hdf5' wrote")
        self.attributes = dict(self._file.attrs)
        self.kind = self.attributes["kind"]
        self.channels = [str(name) for name in self.attributes["channels"]]
        self.units = [str(unit) for unit in self.attributes["units"]]
        self.title = self.attributes["title"]
        self.quantity = {
            "m": "displacement",
            "m/s": "velocity",
            "m/s2": "acceleration",
            "m/s\N{SUPERSCRIPT TWO}": "acceleration",
            "N": "force",
            "J": "energy",
        }.get(self.units[0], "value")

    def __getitem__(self, name):
        try:
            return self._file[name][:]
        except KeyError:
            raise BadFile(f"{self.path} is damaged: it has no {name}") from None


def draw_psd(signals):
    figure, axes = plt.subplots(figsize=(8, 4.5), constrained_layout=True)
    frequency = signals["psd/frequency"]
    factor, prefix = scale_of(frequency[-1])
    for name in signals.channels:
        axes.semilogy(factor * frequency[1:], signals[f"psd/{name}"][1:], linewidth=1, label=name)
    axes.set(
        xlabel=f"frequency, {prefix}Hz", ylabel=f"power spectral density, ({signals.units[0]})\N{SUPERSCRIPT TWO}/Hz"
    )
    axes.set_xlim(
        factor * frequency[1],
        factor * (signals.attributes["high"] * 1.5 if signals.attributes["high"] > 0 else frequency[-1]),
    )
    shown = (factor * frequency >= axes.get_xlim()[0]) & (factor * frequency <= axes.get_xlim()[1]) & (frequency > 0)
    values = np.concatenate([signals[f"psd/{name}"][shown] for name in signals.channels])
    if (values > 0).any():
        axes.set_ylim(max(values[values > 0].min(), 1e-12 * values.max()) / 2, 2 * values.max())
    axes.grid(alpha=0.3)
    axes.legend(fontsize=style.SMALL)
    return figure


def draw_wavelet(signals):
    time, value = signals["by_time/time"], signals["by_time/value"]
    frequency, power = signals["by_frequency/frequency"], signals["power"]
    variance = signals.attributes["variance"]
    to_time, time_prefix = scale_of(abs(time).max())
    to_frequency, frequency_prefix = scale_of(frequency.max())
    figure, ((above, corner), (main, side)) = plt.subplots(
        2, 2, figsize=(9.5, 6), constrained_layout=True, gridspec_kw={"height_ratios": [1, 3], "width_ratios": [4, 1]},
        sharex="col"
    )
    corner.axis("off")
    above.plot(to_time * time, value, linewidth=0.8, color="black")
    above.set_ylabel(label_of(signals.quantity, signals.units[0]))
    above.set_title(signals.channels[0], fontsize=style.TEXT)
    log_power = np.log2(np.maximum(power / variance, 1e-30))
    top = np.ceil(log_power.max())
    image = main.contourf(
        to_time * time, to_frequency * frequency, np.clip(log_power, top - 10, top),
        levels=np.arange(top - 10, top + 1), cmap=style.SCALOGRAM_MAP,
    )
    noise = signals["by_frequency/red_noise_95"]
    main.contour(
        to_time * time, to_frequency * frequency, power / noise[:, None], levels=[1], colors="black", linewidths=0.8
    )
    # Beyond the cone the record's ends reach.
    cone = signals["by_time/cone_period"]
    with np.errstate(divide="ignore"):
        edge = np.where(cone > 0, 1 / np.maximum(cone, 1e-300), np.inf)
    edge = np.clip(to_frequency * edge, to_frequency * frequency.min(), to_frequency * frequency.max())
    main.fill_between(
        to_time * time, to_frequency * frequency.min(), edge, facecolor="white", alpha=0.55, hatch="xx",
        edgecolor="grey", linewidth=0,
    )
    main.set_yscale("log")
    main.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    main.yaxis.set_major_formatter("{x:g}")
    main.yaxis.set_minor_formatter(NullFormatter())
    main.set(
        xlabel=f"time, {time_prefix}s",
        ylabel=f"frequency, {frequency_prefix}Hz",
        ylim=(to_frequency * frequency.min(), to_frequency * frequency.max()),
    )
    main.set_xlim(to_time * time[0], to_time * time[-1])
    figure.colorbar(image, ax=side, label="log2 of power over variance", shrink=0.8)
    side.plot(signals["by_frequency/global_power"] / variance, to_frequency * frequency, color="black", label="mean")
    side.plot(noise / variance, to_frequency * frequency, color="grey", linestyle="--", label="red noise, 95 %")
    side.set_yscale("log")
    side.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    side.yaxis.set_major_formatter(NullFormatter())
    side.yaxis.set_minor_formatter(NullFormatter())
    side.set(xlabel="power over variance", ylim=main.get_ylim())
    side.legend(fontsize=style.TINY)
    return figure


def draw_bandpass(signals):
    figure, axes = plt.subplots(figsize=(8, 4), constrained_layout=True)
    time = signals["bandpass/time"]
    factor, prefix = scale_of(abs(time).max())
    for name in signals.channels:
        axes.plot(factor * time, signals[f"bandpass/{name}"], linewidth=0.9, label=name)
    axes.set(xlabel=f"time, {prefix}s", ylabel=label_of(signals.quantity, signals.units[0]), title=band_text(signals))
    axes.grid(alpha=0.3)
    axes.legend(fontsize=style.SMALL)
    return figure


def band_text(signals):
    low, high = signals.attributes["low"], signals.attributes["high"]
    factor, prefix = scale_of(max(low, high))
    if low > 0 and high > 0:
        return f"{factor * low:g} to {factor * high:g} {prefix}Hz"
    return (
        f"above {factor * low:g} {prefix}Hz"
        if low > 0
        else f"below {factor * high:g} {prefix}Hz"
        if high > 0
        else "all frequencies"
    )


def draw_cross(signals):
    figure, (density, coherence, phase) = plt.subplots(3, 1, figsize=(8, 7.5), sharex=True, constrained_layout=True)
    frequency = signals["cross/frequency"]
    factor, prefix = scale_of(frequency[-1])
    pairs = len(signals.channels) // 2
    first, second = signals.channels[0], signals.channels[pairs]
    more = f" and {pairs - 1} more pairs" if pairs > 1 else ""
    figure.suptitle(f"{first}, {second}{more}", fontsize=style.TEXT)
    density.semilogy(factor * frequency, signals["cross/density_first"], label="first")
    density.semilogy(factor * frequency, signals["cross/density_second"], label="second")
    density.set_ylabel(
        "power spectral\ndensity, "
        + (f"({signals.units[0]})\N{SUPERSCRIPT TWO}/Hz" if len(set(signals.units)) == 1 else "squared units/Hz")
    )
    density.legend(fontsize=style.SMALL)
    coherence.plot(factor * frequency, signals["cross/coherence"], marker=".", color="black")
    coherence.set(ylabel="coherence", ylim=(0, 1.05))
    phase.plot(factor * frequency, signals["cross/phase"], marker=".", color="black")
    phase.set(
        ylabel="phase of the second\nbefore the first, deg", xlabel=f"frequency, {prefix}Hz", ylim=(-180, 180),
        yticks=range(-180, 181, 45),
    )
    low, high = signals.attributes["low"], signals.attributes["high"]
    for axes in (density, coherence, phase):
        axes.grid(alpha=0.3)
        if low > 0 or high > 0:
            axes.axvspan(factor * low, factor * (high or frequency[-1]), color="#f2c14e", alpha=0.2, linewidth=0)
    if high > 0:
        phase.set_xlim(0, min(3 * high, frequency[-1]) * factor)
    return figure


def draw_ellipse(signals):
    first, second = signals["first"], signals["second"]
    count = len(first)
    chosen = np.unique(np.linspace(0, count - 1, min(count, MOST_ELLIPSES)).round().astype(int))
    figure, all_axes = plt.subplots(
        1, len(chosen), figsize=(3.2 * len(chosen) + 0.6, 3.9), constrained_layout=True, squeeze=False, sharex=True,
        sharey=True,
    )
    figure.suptitle(band_text(signals), fontsize=style.TEXT)
    factor, prefix = scale_of(max(abs(first).max(), abs(second).max()))
    # A motion along a line would leave axes of one scale without width.
    width, height = (factor * max(abs(motion).max() for motion in both) for both in (first, second))
    half = [1.05 * max(size, 0.25 * max(width, height)) for size in (width, height)]
    interval, start = signals.attributes["interval"], signals.attributes["start"]
    for axes, i in zip(all_axes[0], chosen):
        x, z = factor * first[i], factor * second[i]
        axes.plot(x, z, color=style.CURVE, linewidth=0.8)
        middle = int(round((signals["ellipse/strongest_time"][i] - start) / interval))
        # Arrows where it moves fastest, along the way.
        for at in range(max(1, middle - 40), min(len(x) - 1, middle + 40), 10):
            axes.annotate(
                "", xy=(x[at + 1], z[at + 1]), xytext=(x[at - 1], z[at - 1]),
                arrowprops={"arrowstyle": "->", "color": style.MARKED},
            )
        sense = "retrograde" if signals["ellipse/retrograde"][i] else "prograde"
        axes.set_title(
            f"{signals.channels[i]}\n{sense}, phase {signals['ellipse/phase'][i]:.1f} deg", fontsize=style.SMALL
        )
        axes.set(xlim=(-half[0], half[0]), ylim=(-half[1], half[1]))
        axes.set_aspect("equal", adjustable="box")
        axes.locator_params(axis="x", nbins=4 if half[0] > 0.5 * half[1] else 2)
        axes.set_xlabel(f"first channel, {prefix}{signals.units[0]}")
        axes.grid(alpha=0.3)
    all_axes[0][0].set_ylabel(f"second channel, {prefix}{signals.units[0]}")
    return figure


def draw_speed(signals):
    figure, (map_axes, lag_axes) = plt.subplots(1, 2, figsize=(10, 4.5), constrained_layout=True)
    figure.suptitle(
        f"{len(signals.channels)} channels: {signals.channels[0]} to {signals.channels[-1]}", fontsize=style.TEXT
    )
    frequency, wavenumber, power = signals["ridge/frequency"], signals["wavenumber"], signals["power"]
    factor, prefix = scale_of(frequency[-1])
    image = map_axes.pcolormesh(
        wavenumber, factor * frequency, 10 * np.log10(np.maximum(power, 1e-6)), vmin=-40, cmap=style.POWER_MAP,
        shading="nearest", rasterized=True,
    )
    figure.colorbar(image, ax=map_axes, label="power, dB")
    strong = signals["ridge/power"] >= STRONG
    map_axes.plot(
        signals["ridge/wavenumber"][strong], factor * frequency[strong], ".", color="#45e0ff", markersize=4,
        label="ridge",
    )
    speed = signals.attributes["wavenumber_speed"]
    map_axes.plot(frequency / speed, factor * frequency, color="white", linewidth=0.8, label=f"{speed:.0f} m/s")
    map_axes.set(xlabel="wave number, 1/m", ylabel=f"frequency, {prefix}Hz", xlim=(wavenumber[0], wavenumber[-1]))
    map_axes.legend(fontsize=style.SMALL, loc="lower left")
    distance, lag = signals["probes/distance"], signals["probes/lag"]
    to_time, time_prefix = scale_of(abs(lag).max())
    to_metre, metre_prefix = scale_of(distance.max())
    flight = signals.attributes["time_of_flight_speed"]
    lag_axes.plot(
        to_metre * distance, to_time * lag, "o", color=style.CURVE, markersize=4, label="lag behind the first"
    )
    offset = np.mean(lag) - np.mean(distance) / flight
    lag_axes.plot(
        to_metre * distance, to_time * (offset + distance / flight), color="black", linewidth=0.8,
        label=f"{flight:.0f} m/s",
    )
    lag_axes.set(xlabel=f"distance, {metre_prefix}m", ylabel=f"time, {time_prefix}s")
    lag_axes.grid(alpha=0.3)
    lag_axes.legend(fontsize=style.SMALL)
    return figure


DRAWINGS = {
    "psd": draw_psd,
    "wavelet": draw_wavelet,
    "bandpass": draw_bandpass,
    "cross": draw_cross,
    "ellipse": draw_ellipse,
    "speed": draw_speed,
}


def draw_signal(path):
    """(kind, figure) of a file of `railwave signal --hdf5`."""
    signals = Signals(path)
    if signals.kind not in DRAWINGS:
        raise BadFile(f"{path} holds a '{signals.kind}', which this script does not know")
    return signals.kind, DRAWINGS[signals.kind](signals)
