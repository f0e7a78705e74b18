"""A wave that goes out from a place of a running surface: its normal velocity by the distance from there, how fast and
how long it is."""

import numpy as np

NEAR, FAR = 0.006, 0.036  # m from the place between which it is followed
EARLIER, LATER = 6e-6, 25e-6  # s about the instant at which it begins
SPEEDS = np.arange(1500.0, 7000.0, 25.0)  # m/s, among which it is looked for
LEAST_RINGS = 5


class RadialWave:
    """Means of the normal velocity over rings about a place, less the whole surface's and each ring's parabola in
    time."""

    def __init__(self, surface, origin, touch):
        """origin: x and y, m; touch: s"""
        chosen = surface.between(touch - EARLIER, touch + LATER)
        normal = surface.velocity[chosen][:, :, 2]
        normal = normal - np.median(normal, axis=1, keepdims=True)
        distance = np.hypot(*(surface.place[:, :2] - origin).T)
        count = round((FAR - NEAR) / surface.size)
        edges = np.linspace(NEAR, FAR, count + 1)
        rings = [np.flatnonzero((distance >= a) & (distance < b)) for a, b in zip(edges, edges[1:])]
        full = [k for k, ring in enumerate(rings) if len(ring)]
        self.time = surface.time[chosen] - touch
        self.radius = (edges[:-1] + 0.5 * np.diff(edges))[full]
        self.velocity = np.array([normal[:, rings[k]].mean(axis=1) for k in full]).T

    def is_seen(self):
        return len(self.time) >= 12 and len(self.radius) >= LEAST_RINGS

    def _without_trend(self):
        """Of each ring, over its deviation."""
        trend = np.polyfit(self.time, self.velocity, 2)
        own = self.velocity - np.array([np.polyval(one, self.time) for one in trend.T]).T
        return own / np.maximum(own.std(axis=0), 1e-300)

    def speed_and_length(self):
        """m/s, at which the rings add up to the strongest wave; m, twice the way between the zeros about its crest."""
        delays = np.arange(-3e-6, 10e-6, 0.1e-6)
        rings = self._without_trend().T
        # Means of the rings, each as it is when a wave of that speed has come to it.
        stacks = [np.mean([np.interp(delays + radius / speed, self.time, ring)
                           for radius, ring in zip(self.radius, rings)], axis=0) for speed in SPEEDS]
        best = int(np.argmax([np.abs(stack).max() for stack in stacks]))
        stack, speed = stacks[best], SPEEDS[best]
        crest = int(np.abs(stack).argmax())
        other = np.flatnonzero(stack * np.sign(stack[crest]) <= 0)
        begin = max((k for k in other if k < crest), default=0)
        end = min((k for k in other if k > crest), default=len(stack) - 1)
        return float(speed), float(2 * speed * (delays[end] - delays[begin]))
