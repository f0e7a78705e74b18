"""Perturbations of steady rolling (thesis 7.1.3): case 1 under traction and under braking. Where within the patch, when
and how often nodes that friction holds begin to slip for some microseconds."""

import functools

import matplotlib.pyplot as plt
import numpy as np

from pictures import style

SMOOTH = 10e-6  # s, over which the slip of a node, less what is usual at its place of the patch, is averaged: what it
# has beside that mean is its disturbance
HELD = 0.97  # of friction's bound, below which a node sticks, by forces averaged over SMOOTH
STANDS_OUT = 3.0  # times the median of the patch's disturbance, from which on it counts as a perturbation
APART = 15e-6  # s, between two perturbations
NEAR = 1.6  # elements: near the leading edge, near the border of slip
PERIODS = (0.05e-3, 1.2e-3)  # s, after which the disturbance may come again
PLACES = ("leading edge", "border of slip", "elsewhere")


def running_mean(values, count):
    """Of a table by time first, over `count` times, of what is known."""
    known = ~np.isnan(values)
    sums, counts = (np.cumsum(np.concatenate([np.zeros_like(table[:1], float), table]), axis=0)
                    for table in (np.where(known, values, 0.0), known.astype(float)))
    last = np.minimum(np.arange(len(values)) + count // 2 + 1, len(values))
    first = np.maximum(np.arange(len(values)) - count // 2, 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(known, (sums[last] - sums[first]) / (counts[last] - counts[first]), np.nan)


class Disturbed:
    """The disturbance of the slip by output and node: nan where a node does not touch."""

    def __init__(self, one):
        self.one, self.patches = one, one.patches
        nodes = np.unique(one["contact_node"])
        count = len(self.patches)
        self.time = self.patches[:, 0]
        slip, place = (np.full((count, len(nodes), 2), np.nan, np.float32) for _ in range(2))
        share = np.full((count, len(nodes)), np.nan, np.float32)
        for k, (_, node, at, normal, tangential, sliding) in enumerate(one.contacts()):
            column = np.searchsorted(nodes, node)
            slip[k, column], place[k, column] = sliding, at
            share[k, column] = np.hypot(*tangential.T) / (one.friction * normal)
        self.step = float(np.median(np.diff(self.time)))
        smooth = max(3, round(SMOOTH / self.step)) | 1
        self.half = np.median(self.patches[:, 3:5], axis=0)
        centre = np.array([np.polyval(np.polyfit(self.time - self.time[0], column, 1), self.time - self.time[0])
                           for column in self.patches[:, 1:3].T]).T
        self.place = place - centre[:, None]
        self.touching = ~np.isnan(share)
        self.size = self._size()
        slip -= self._steady(slip)
        self.disturbance = np.hypot(*(slip - running_mean(slip, smooth)).transpose(2, 0, 1))
        self.share = running_mean(share, smooth)
        # Nodes that have just come, or go at once, have no mean yet.
        early, late = self.touching.copy(), self.touching.copy()
        early[smooth // 2:], early[:smooth // 2] = self.touching[:len(early) - smooth // 2], False
        late[:len(late) - smooth // 2], late[len(late) - smooth // 2:] = self.touching[smooth // 2:], False
        self.known = self.touching & early & late
        with np.errstate(invalid="ignore"):
            self.held = (self.share < HELD) & self.known

    def _steady(self, slip):
        """The mean slip at a place of the patch: a node that comes from where friction holds it to where it slips is
        not disturbed."""
        at = self.place[self.touching]
        along, across = (np.rint(at[:, axis] / (share * self.size)).astype(int) for axis, share in ((0, 0.5), (1, 1)))
        along, across = along - along.min() + 1, across - across.min() + 1
        shape = along.max() + 2, across.max() + 2
        counts = np.zeros(shape)
        np.add.at(counts, (along, across), 1)
        steady = np.full(slip.shape, np.nan, np.float32)
        for axis in range(2):
            sums = np.zeros(shape)
            np.add.at(sums, (along, across), slip[self.touching][:, axis])
            mean = sums / np.maximum(counts, 1)
            # Between the middles of two cells along, as far as both have nodes.
            exact = at[:, 0] / (0.5 * self.size)
            exact = exact - np.rint(exact)
            beside = along + np.sign(exact).astype(int)
            share = np.where(counts[beside, across] > 0, np.abs(exact), 0)
            steady[self.touching, axis] = (1 - share) * mean[along, across] + share * mean[beside, across]
        return steady

    def _size(self):
        """Of the elements, m."""
        middle = len(self.time) // 2
        at = self.place[middle][self.touching[middle]]
        apart = np.linalg.norm(at[:, None] - at[None], axis=2)
        return float(np.median(np.partition(apart, 1, axis=1)[:, 1])) if len(at) > 1 else 1e-3

    def deviation(self, which):
        """Of the disturbance of nodes for which `which` holds, m/s."""
        return float(np.sqrt(np.mean(self.disturbance[which & self.touching] ** 2)))

    @functools.cached_property
    def level(self):
        """Mean square of the disturbance of nodes that stick by output, over its median."""
        square = np.where(self.held, self.disturbance**2, 0).sum(axis=1) / np.maximum(self.held.sum(axis=1), 1)
        square = np.convolve(square, np.ones(3) / 3, mode="same")
        return square / np.median(square)

    def events(self):
        """Outputs at which a perturbation begins."""
        above = np.flatnonzero(self.level > STANDS_OUT**2)
        if not len(above):
            return above
        return above[np.diff(above, prepend=-len(self.time)) > APART / self.step]

    def classes(self, output):
        """Of each node that sticks at an output: its number, and which of PLACES it is at."""
        held = np.flatnonzero(self.held[output] & self.touching[output])
        at, touching = self.place[output], np.flatnonzero(self.touching[output])
        slipping = np.flatnonzero(self.known[output] & ~self.held[output])
        listed = []
        for n in held:
            line = touching[np.abs(at[touching, 1] - at[n, 1]) < 0.6 * self.size]
            if at[line, 0].max() - at[n, 0] < NEAR * self.size:
                listed.append(0)
            elif len(slipping) and np.hypot(*(at[slipping] - at[n]).T).min() < NEAR * self.size:
                listed.append(1)
            else:
                listed.append(2)
        return held, np.array(listed, int)

    def where(self, events):
        """Count of perturbations that begin at each of PLACES, and the share of the nodes that stick which are
        there."""
        counts = np.zeros(len(PLACES), int)
        for output in events:
            held, listed = self.classes(output)
            if len(held):
                counts[listed[np.nanargmax(self.disturbance[output, held])]] += 1
        share = np.zeros(len(PLACES))
        for output in np.linspace(0, len(self.time) - 1, 60).astype(int):
            share += np.bincount(self.classes(output)[1], minlength=len(PLACES))
        return counts, share / max(share.sum(), 1)

    def by_place(self):
        """Mean square of the disturbance of nodes that stick at each of PLACES, over that of all that stick."""
        sums, numbers = np.zeros(len(PLACES)), np.zeros(len(PLACES))
        for output in range(0, len(self.time), max(1, len(self.time) // 300)):
            held, listed = self.classes(output)
            square = self.disturbance[output, held] ** 2
            sums += np.bincount(listed, square, len(PLACES))
            numbers += np.bincount(listed, minlength=len(PLACES))
        return (sums / np.maximum(numbers, 1)) / (sums.sum() / max(numbers.sum(), 1))

    def period(self):
        """After how long the patch's disturbance is most like itself again, s, and the correlation then; of white noise
        it is below 0.1 with a thousand outputs."""
        value = np.log(np.maximum(self.level, 1e-6))
        clock = np.linspace(-1, 1, len(value))
        value = value - np.polyval(np.polyfit(clock, value, 2), clock)
        power = np.abs(np.fft.rfft(value, 2 * len(value))) ** 2
        alike = np.fft.irfft(power)[:len(value)]
        lag = self.step * np.arange(len(value))
        chosen = np.flatnonzero((lag > PERIODS[0]) & (lag < PERIODS[1]))
        if not len(chosen):
            return np.nan, np.nan
        top = chosen[alike[chosen].argmax()]
        return float(lag[top]), float(alike[top] / alike[0])

    def map(self, reach=1.15):
        """Edges of cells along and across, half lengths and half widths; deviation of the disturbance and mean share of
        friction's bound in each."""
        counts = (2 * reach * self.half / (1.2 * self.size)).astype(int)
        edges = [np.linspace(-reach, reach, max(4, count) + 1) for count in counts]
        at = self.place[self.known] / self.half
        cells = [np.histogram2d(*at.T, bins=edges, weights=weights)[0]
                 for weights in (np.ones(len(at)), self.disturbance[self.known] ** 2, self.share[self.known])]
        with np.errstate(invalid="ignore", divide="ignore"):
            return edges, np.sqrt(cells[1] / cells[0]), cells[2] / cells[0]


EXPECTED = {"traction": "more often at the border of slip", "braking": "generally at the leading edge"}


def study(found):
    """Rows of the study's table, and (name, figure)."""
    disturbed = {name: Disturbed(one) for name, one in found.items()}
    rows = []
    for name, one in disturbed.items():
        events = one.events()
        counts, share = one.where(events)
        period, strength = one.period()
        rolled = found[name]
        within = (rolled.time > one.time[0]) & (rolled.time < one.time[-1])
        used = np.hypot(rolled.longitudinal, rolled.lateral)[within] / (rolled.friction * rolled.normal[within])
        rows += [
            (f"{name}: share of friction used; longitudinal force on the wheel", "0.6 to 0.7",
             f"{used.mean():.2f} ({used.min():.2f} to {used.max():.2f}); {rolled.longitudinal[within].mean():+.1f} kN"),
            (f"{name}: disturbance of the slip of nodes that stick, that slip; deviation", "",
             f"{one.deviation(one.held):.3f}, {one.deviation(one.known & ~one.held):.3f} m/s"),
            (f"{name}: {', '.join(PLACES)}: mean square of it there over that of all that stick", "",
             ", ".join(f"{value:.2f}" for value in one.by_place())),
            (f"{name}: perturbations (over {STANDS_OUT:g} times the median) in"
             f" {1e3 * (one.time[-1] - one.time[0]):.2f} ms; largest", "one each 0.6 ms",
             f"{len(events)}; {np.sqrt(one.level.max()):.1f} times"),
            (f"{name}: where they begin: {', '.join(PLACES)} (share of the nodes that stick)", EXPECTED[name],
             ", ".join(f"{count} ({part:.2f})" for count, part in zip(counts, share))),
            (f"{name}: the disturbance is most like itself after; correlation", "0.6 ms",
             f"{1e3 * period:.2f} ms; {strength:.2f}"),
        ]
    return rows, [("perturbation_places", draw_places(disturbed)), ("perturbation_times", draw_times(disturbed)),
                  ("perturbation_spread", draw_spread(disturbed))]


def draw_places(disturbed):
    """Where in the patch the slip is disturbed, and the border of what friction holds."""
    figure, panels = plt.subplots(1, len(disturbed), figsize=(5.2 * len(disturbed), 4.2), squeeze=False,
                                  constrained_layout=True)
    for axes, (name, one) in zip(panels[0], disturbed.items()):
        edges, deviation, share = one.map()
        drawn = axes.pcolormesh(*edges, np.ma.masked_invalid(deviation.T), cmap=style.SIZE_MAP)
        middles = [0.5 * (one_way[1:] + one_way[:-1]) for one_way in edges]
        if np.nanmin(share) < HELD < np.nanmax(share):
            axes.contour(*middles, np.nan_to_num(share.T, nan=1.0), levels=[HELD], colors="w")
        axes.set(title=f"{name}; white: border of slip", xlabel="along, half lengths; it rolls to the right",
                 ylabel="across, half widths")
        figure.colorbar(drawn, ax=axes, label="disturbance of the slip, deviation, m/s")
    return figure


def draw_times(disturbed):
    figure, panels = plt.subplots(len(disturbed), 1, figsize=(9, 2.6 * len(disturbed)), squeeze=False, sharex=True,
                                  constrained_layout=True)
    for axes, (name, one) in zip(panels[:, 0], disturbed.items()):
        axes.semilogy(1e3 * one.time, np.sqrt(one.level), linewidth=0.7, color=style.CURVE)
        events = one.events()
        axes.plot(1e3 * one.time[events], np.sqrt(one.level[events]), "v", color=style.MARKED, markersize=4)
        axes.set(title=f"{name}; triangles: perturbations begin", ylabel="disturbance over its median")
        axes.grid()
    panels[-1, 0].set_xlabel("time, ms")
    return figure


def draw_spread(disturbed, before=2, count=6):
    """The largest perturbation of each run, an output apart: slip at each node less its mean over SMOOTH (fig. 7.3,
    7.4)."""
    figure, grid = plt.subplots(len(disturbed), count, figsize=(2.6 * count, 2.7 * len(disturbed)), squeeze=False,
                                sharex=True, sharey=True, constrained_layout=True)
    for row, (name, one) in zip(grid, disturbed.items()):
        first = int(np.clip(one.level.argmax() - before, 0, len(one.time) - count))
        largest = np.nanmax(one.disturbance[first:first + count])
        for axes, output in zip(row, range(first, first + count)):
            touching = one.touching[output]
            at = 1e3 * one.place[output][touching]
            drawn = axes.scatter(*at.T, c=one.disturbance[output][touching], s=14, cmap=style.SIZE_MAP, vmin=0,
                                 vmax=largest)
            slips = ~one.held[output][touching]
            axes.plot(*at[slips].T, "r.", markersize=2)
            axes.set_aspect("equal")
            axes.set_title(f"{name}: {1e3 * one.time[output]:.3f} ms", fontsize=style.SMALL)
        figure.colorbar(drawn, ax=row, label="disturbance, m/s")
    figure.supxlabel("along the rail, mm; red: slips by force", fontsize=style.TEXT)
    return figure
