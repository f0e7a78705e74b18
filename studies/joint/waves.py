"""Waves on the running surface behind the gap: space-time diagram of the surface's velocity along the middle of the
running band, speed of the front and wavelength (thesis 4.6)."""

import h5py
import numpy as np

FIRST, LAST = 0.002, 0.045  # m from the gap between which a front is followed


class SurfaceLine:
    """Normal velocity along a line of nodes at an output set's outputs of one window."""

    def __init__(self, results, name, begin, end):
        with h5py.File(results, "r") as file:
            group = file[f"fields/{name}"]
            time = group["time"][:]
            chosen = np.flatnonzero((time >= begin) & (time <= end))
            nodes = group["coordinates"][:]
            # The line of nodes whose heights change least: the middle of the band, by the most nodes of one y.
            across = np.round(nodes[:, 1], 5)
            values, counts = np.unique(across, return_counts=True)
            full = values[counts >= 0.9 * counts.max()]
            line = full[np.abs(full - np.median(full)).argmin()]
            on_line = np.flatnonzero(across == line)
            on_line = on_line[np.argsort(nodes[on_line, 0])]
            self.time, self.x, self.y = time[chosen], nodes[on_line, 0], line
            self.velocity = np.array([group["velocity"][k][on_line, 2] for k in chosen]).reshape(len(chosen), -1)

    def front_speed(self, share=0.1):
        """Speed of the first arrival, m/s, by a straight line through the times at which the velocity first passes a
        share of its largest; NaN where fewer than five places see it."""
        size = np.abs(self.velocity - self.velocity[:1])
        threshold = share * size.max(initial=0)
        inside = (np.abs(self.x) >= FIRST) & (np.abs(self.x) <= LAST)
        seen = [(self.x[i], self.time[size[:, i] > threshold][0]) for i in np.flatnonzero(inside)
                if threshold > 0 and (size[:, i] > threshold).any()]
        if len(seen) < 5:
            return float("nan")
        place, arrival = np.array(seen).T
        slope = np.polyfit(place, arrival, 1)[0]
        return 1 / slope if slope != 0 else float("nan")

    def wavelength(self, output):
        """Of the strongest wave in space at one output, m: the highest line of the spectrum of the velocity less its
        parabola, between twice the nodes' distance and the line's length."""
        x = np.linspace(self.x[0], self.x[-1], 512)
        values = np.interp(x, self.x, self.velocity[output])
        values = (values - np.polyval(np.polyfit(x, values, 2), x)) * np.hanning(len(x))
        power = np.abs(np.fft.rfft(values, 4096)) ** 2
        frequency = np.fft.rfftfreq(4096, x[1] - x[0])
        shortest = 2 * np.diff(self.x).max()
        inside = (frequency > 1 / (x[-1] - x[0])) & (frequency < 1 / shortest)
        return 1 / frequency[inside][power[inside].argmax()]


def first_touch(passing):
    """When the wheel first touches the rail behind the gap, s; None: never."""
    with h5py.File(passing.results, "r") as file:
        contact = file["contact/tread"]
        side, near = contact["slave"], contact["slave/near"]
        rows, coordinates = side["rows"][:], side["coordinates"][:]
        for output, time in enumerate(contact["time"][:]):
            first, last = (rows[output - 1] if output else 0), rows[output]
            if passing.place(time) < -0.05 or last == first:
                continue
            x = coordinates[near["node"][first:last], 0] + near["displacement"][first:last, 0]
            touching = np.linalg.norm(near["normal_force"][first:last], axis=1) > 1e-3
            if (x[touching] > 0).any():
                return float(time)
    return None


def findings(found):
    """Rows of the study's table, and by simulation the line that was looked at."""
    rows, lines = [], {}
    for number, passing in sorted(found.items()):
        touch = first_touch(passing)
        if touch is None:
            rows.append((f"simulation {number}: first touch of the second rail", "46.39 ms by its clock", "none"))
            continue
        line = SurfaceLine(passing.results, "track_rail_2.behind_gap", touch - 5e-6, touch + 40e-6)
        rows.append((f"simulation {number}: first touch of the second rail", "46.39 ms by its clock",
                     f"{1e3 * touch:.3f} ms, wheel {1e3 * passing.place(touch):.1f} mm from the gap"))
        if len(line.time) < 8:
            rows.append((f"simulation {number}: impact wave", "10 mm, 3 km/s", "no outputs of the surface then"))
            continue
        lines[number] = line
        after = np.flatnonzero(line.time >= touch + 8e-6)
        rows.append((
            f"simulation {number}: impact wave on the second rail", "10 mm, 3 km/s",
            f"{1e3 * line.wavelength(after[0] if len(after) else -1):.1f} mm, {1e-3 * line.front_speed():.2f} km/s",
        ))
    return rows, lines
