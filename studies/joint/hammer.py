"""Hammer tests at the joint: three sections, two directions, eight sensors; decay rate along five metres (thesis
4.3)."""

from steps import rows_of

# Name: sensor beside which is struck, x of the place, direction.
PLACES = {
    "rail_end_vertical": (1, 0.02, "vertical"),
    "rail_end_lateral": (2, 0.02, "lateral"),
    "support_vertical": (3, 0.12, "vertical"),
    "support_lateral": (4, 0.12, "lateral"),
    "mid_span_vertical": (5, 0.42, "vertical"),
    "mid_span_lateral": (6, 0.42, "lateral"),
}
STRUCK = {"vertical": ((-0.004, 0.159), (0, 0, -1)), "lateral": ((0.0325, 0.145), (0, -1, 0))}
VERTICAL, LATERAL = (1, 3, 5, 7, 8), (2, 4, 6)
COARSE = [
    "tracks.track.zone_size=0.006", "tracks.track.coarse_size=0.04", "tracks.track.core_size=0.04",
    "tracks.track.section_size=0.012", "tracks.track.web_columns=2", "tracks.track.zone_start=-0.03", "time.end=0.02",
]


def strike(steps, case, overrides=(), places=tuple(PLACES), prefix=""):
    """Runs blows at places; tables of the accelerances at all sensors, and of the decay rate where the rail's end is
    struck from above. Returns the tables' paths."""
    tables = {}
    for name in places:
        _, x, along = PLACES[name]
        (y, z), direction = STRUCK[along]
        blow = [f"hammers.blow.position=[{x}, {y}, {z}]", f"hammers.blow.direction={list(direction)}"]
        results = steps.run(f"{prefix}hammer_{name}", case, [*blow, *overrides])
        table = tables[name] = steps.path(f"{prefix}accelerance_{name}.csv")
        responses = ["--response", "blow"]
        for sensor in VERTICAL + LATERAL:
            responses += ["--response", f"sensor_{sensor}:{'vertical' if sensor in VERTICAL else 'lateral'}"]
        words = [steps.program, "frf", results, *responses, "--window", "exponential", "--from", 50, "--to", 6000,
                 "--csv", table, "--overwrite"]
        steps.once(table.stem, [results], words, lambda words=words: steps.command(*words, quiet=bool(prefix)))
        if name == "rail_end_vertical":
            tables["decay"] = steps.path(f"{prefix}decay.csv")
            words = [steps.program, "decay", results, "--at", "beside", "--row", "near", "--row", "far", "--window",
                     "exponential", "--to", 6500, "--csv", tables["decay"], "--overwrite"]
            steps.once(tables["decay"].stem, [results], words,
                       lambda words=words: steps.command(*words, quiet=bool(prefix)))
    return tables


class Accelerance:
    """The direct accelerance of one blow."""

    def __init__(self, path):
        direct = [row for row in rows_of(path) if row["kind"] == "direct"]
        self.frequency = [float(row["frequency"]) for row in direct]
        self.decibels = [float(row["decibels"]) for row in direct]
        self.phase = [float(row["phase"]) for row in direct]

    def extreme(self, low, high, sign):
        """Frequency of the highest peak (sign 1) or lowest trough (-1) between two frequencies, Hz; None: there is only
        a slope."""
        inside = [i for i, f in enumerate(self.frequency) if low <= f <= high]
        level = [sign * one for one in self.decibels]
        turning = [i for i in inside[1:-1] if level[i - 1] <= level[i] > level[i + 1]]
        best = max(turning, key=lambda i: level[i], default=None)
        return None if best is None else self.frequency[best]

    def trough_behind(self, low, high, depth=0.05):
        """The first trough between two frequencies from which the level rises by a depth in dB again, Hz; None: there
        is none."""
        lowest = None
        for frequency, level in zip(self.frequency, self.decibels):
            if not low <= frequency <= high:
                continue
            if lowest is None or level < lowest[1]:
                lowest = (frequency, level)
            elif level > lowest[1] + depth:
                return lowest[0]
        return None


def findings(tables):
    """Rows of the study's table: what, the thesis's simulation, its measurement, what was found; Hz."""
    at = {name: Accelerance(tables[name]) for name in PLACES if name in tables}
    f2 = at["rail_end_vertical"].extreme(200, 450, 1)
    decay = [(float(row["centre"]), float(row["decay_rate"])) for row in rows_of(tables["decay"])]

    def band(low, high, sign):
        inside = [pair for pair in decay if low <= pair[0] <= high]
        return max(inside, key=lambda pair: sign * pair[1])[0] if inside else None

    def trough_behind_peak():
        """The first band that is lower than both beside it."""
        peak = band(1700, 4200, 1) or 1700
        behind = [pair for pair in decay if pair[0] >= peak]
        return next((here[0] for before, here, after in zip(behind, behind[1:], behind[2:])
                     if before[1] > here[1] < after[1]), None)

    def at_mid_span(along, low, high):
        response = at.get(f"mid_span_{along}")
        return response and response.extreme(low, high, 1)

    return [
        ("rail on fastening, f2: peak at the rail end, vertical", 260, 280, f2),
        ("sleepers, f_a: trough behind it", 460, 440, f2 and at["rail_end_vertical"].trough_behind(f2, 800)),
        ("pinned-pinned, vertical, first: mid-span", 1100, 1050, at_mid_span("vertical", 900, 1300)),
        ("pinned-pinned, vertical, second: mid-span", 2550, 2750, at_mid_span("vertical", 2200, 3100)),
        ("pinned-pinned, lateral: mid-span", 600, 550, at_mid_span("lateral", 400, 700)),
        ("decay rate, first trough (third-octave band)", 900, 900, band(700, 1700, -1)),
        ("decay rate, peak", 3000, 3000, band(1700, 4200, 1)),
        ("decay rate, second trough", 4000, 4000, trough_behind_peak()),
    ]
