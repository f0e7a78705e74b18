"""Finds the lateral motions of cases 2 to 4, which cannot be read in the thesis, from its table 5.2: of cases 3 and 4
displacement and duration, of case 2 the displacement; by Broyden's rule in few runs."""

import json

import numpy as np

from cases import CASE, EXTENTS, MOTIONS, SOLUTIONS, Motion, Rolling, earlier, settings

ROUNDS, NEAR = 6, 0.035  # runs for a case; misfit that will do
LARGEST_MOVE = 0.3  # of the logarithm of a displacement or duration from run to run
FIT = ["output_windows.solutions.end=16.6e-3", "time.end=18.6e-3"]
FIT_SHORT = ["time.end=6.1e-3"]
# What is fitted: of these solutions the lateral force; of the last one, where friction is used up, the direction.
FITTED = {2: ("b",), 3: ("c", "e"), 4: ("d", "f")}
DIRECTED, TURN = "f", 90.0  # degrees that count as much as the whole of a force
# How misfits follow the logarithms of displacement and duration, as coarse runs had it.
SLOPES = {2: [[1.0]], 3: [[0.95, -1.7], [0.7, -0.84]], 4: [[0.9, -1.8], [0.17, -0.18]]}


def misfit(one, number):
    """Of a run from the table: an entry for each of FITTED, and a text."""
    entries, texts = [], []
    for name in FITTED[number]:
        want = SOLUTIONS[name]
        own = one.at(want.time)
        entries.append((own.direction - want.direction) / TURN if name == DIRECTED else own.lateral / want.lateral - 1)
        texts.append(f"{name}: {own.lateral:.2f} kN of {want.lateral:.2f}, {own.direction:.0f} deg of"
                     f" {want.direction:.0f}")
    return np.array(entries), "; ".join(texts)


def fit(steps, extent, numbers):
    """Rows of a table: case, run, motion, forces. Writes the best motions to fit.json."""
    rows = [["case", "run", "displacement, mm", "duration, ms", "lateral forces and directions, and the thesis's"]]
    best = {}
    for number in sorted(set(FITTED) & set(numbers)):
        motion, slope, last, least = MOTIONS[number], np.array(SLOPES[number]), None, np.inf
        for turn in range(1, ROUNDS + 1):
            results = steps.run(f"fit_{number}_{turn}", CASE, [
                *EXTENTS[extent], *(FIT if extent == "full" else FIT_SHORT), *settings(number, motion)])
            off, text = misfit(Rolling(number, results, earlier(extent)), number)
            rows.append([str(number), str(turn), f"{1e3 * motion.displacement:.3f}", f"{1e3 * motion.duration:.3f}",
                         text])
            if np.abs(off).max() < least:
                best[number], least = motion, np.abs(off).max()
            if least < NEAR:
                break
            if last is not None:
                move, change = last[0], off - last[1]
                slope = slope + np.outer(change - slope @ move, move) / (move @ move)
            move = np.linalg.solve(slope, -off)
            move *= min(1, LARGEST_MOVE / np.abs(move).max())
            last = move, off
            motion = Motion(motion.displacement * np.exp(move[0]),
                            motion.duration * (np.exp(move[1]) if len(move) > 1 else 1))
    steps.path("fit.json").write_text(json.dumps({str(n): [m.displacement, m.duration] for n, m in best.items()}))
    return rows
