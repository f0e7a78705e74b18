#!/usr/bin/env python3
"""Three metres of track: what one place answers to a blow at another is what that answers to a blow at the first
(thesis 4.3.4), vertical, and vertical to lateral."""
import math
import tempfile

import hammers

TRACK = """
[tracks.track]
hourglass = "stiffness"
start = -1.5
end = 1.5
first_sleeper = -1.2
zone_size = 0.006
zone_start = -0.32
zone_end = -0.3
zone_layers = 1
coarse_size = 0.05
core_size = 0.05
section_size = 0.012
[hammers.{hammer}]
part = "track_rail"
position = {struck}
radius = 0.02
direction = {direction}
peak = 1000
duration = 1.5e-4
[probes.{probe}]
part = "track_rail"
position = {heard}
radius = 0.02
[solver]
step_estimate = "global"
renew_steps = 0
[time]
end = 0.02
[output]
history_interval = 1e-5
"""
HERE, THERE = [-0.3, -0.004, 0.159], [0.6, 0.0325, 0.145]


def answer(folder, name, struck, direction, heard, along):
    text = TRACK.format(hammer="blow", probe="ear", struck=struck, heard=heard, direction=direction)
    found, _ = hammers.responses(
        [hammers.run(folder, name, text)], "--response", f"ear:{along}", "--from", "100", "--to", "5000"
    )
    return [value for _, value in next(iter(found.values()))]


def compare(what, one, other):
    off = [abs(20 * math.log10(abs(a) / abs(b))) for a, b in zip(one, other)]
    hammers.show(f"{what}, 100 to 5000 Hz: largest difference, dB", max(off), 1)
    print(f"  in the mean {sum(off) / len(off):.2e} dB")


with tempfile.TemporaryDirectory(prefix="railwave-") as place:
    down, aside = [0, 0, -1], [0, -1, 0]
    compare("vertical at mid-span, vertical at the head's side on a support",
            answer(place, "a", HERE, down, THERE, "vertical"), answer(place, "b", THERE, down, HERE, "vertical"))
    compare("vertical at mid-span, lateral at the head's side on a support",
            answer(place, "c", HERE, down, THERE, "lateral"), answer(place, "d", THERE, aside, HERE, "vertical"))
hammers.conclude()
