#!/usr/bin/env python3
"""A crack, a slot and a gap in the master are crossed, sliding and rolling: no node is lost, the force stays and the
energy balance holds. The scenes are those of scripts/crossings, whose table has more of them."""

import importlib.machinery
import importlib.util
import os
import pathlib
import sys
import tempfile
import unittest

try:
    import h5py  # noqa: F401
except ImportError:
    sys.exit(77)

SOURCE = pathlib.Path(os.environ.get("RAILWAVE_SOURCE_DIR", pathlib.Path(__file__).resolve().parent.parent.parent))
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("crossings", str(SOURCE / "scripts" / "crossings"))
crossings = importlib.util.module_from_spec(importlib.util.spec_from_loader("crossings", loader))
loader.exec_module(crossings)


class Crossings(unittest.TestCase):
    def crossed(self, scene, text, without, before=0.0):
        """Mean force over that without, fewest nodes over those without, error of the balance over the elastic
        energy."""
        with tempfile.TemporaryDirectory(prefix="railwave-") as name:
            runs = []
            for one, case in (("with", text), ("without", without)):
                found, code, said = crossings.run(PROGRAM, pathlib.Path(name), one, case)
                self.assertEqual(code, 0, said)
                runs.append(found)
        begin, end = crossings.crossing(scene, before)
        within = [(r["time"] >= begin) & (r["time"] <= end) for r in runs]
        force = [r["force"][w].mean() for r, w in zip(runs, within)]
        nodes = [int(r["nodes"][w].min()) for r, w in zip(runs, within)]
        return force[0] / force[1], nodes, runs[0]["error"]

    def test_sliding(self):
        for algorithm, mouth, gap in (
            ("penalty", "crack", 0.0),
            ("penalty", "slot", 1e-3),
            ("multiplier", "crack", 0.0),
            ("multiplier", "gap", 1e-3),
        ):
            with self.subTest(algorithm=algorithm, mouth=mouth, gap=gap):
                force, nodes, error = self.crossed(
                    "slide", crossings.slide(mouth, gap, algorithm, True), crossings.slide("none", 0.0, algorithm, True)
                )
                self.assertEqual(nodes[0], nodes[1])
                self.assertLess(abs(force - 1), 0.05)
                self.assertLess(error, 5e-3)

    def test_rolling(self):
        """The axle is led: by how much less the halved plate presses is seen with the plate as slave, for which no
        mouth is crossed."""
        roll = [crossings.roll("crack", 0.0, "penalty", 0.01, True, swapped) for swapped in (False, True)]
        whole = [crossings.roll("none", 0.0, "penalty", 0.01, True, swapped) for swapped in (False, True)]
        force, nodes, error = self.crossed("roll", roll[0], whole[0], 0.01)
        swapped = self.crossed("roll", roll[1], whole[1], 0.01)[0]
        self.assertGreaterEqual(nodes[0], nodes[1])
        self.assertLess(abs(force / swapped - 1), 0.05)
        self.assertLess(error, 5e-3)

    def test_rolling_of_a_soft_roller(self):
        """All that yields is the roller's: the force is that without a mouth. Its sides hang over the plate's and slide
        there, and its nodes touch and part many times, all of which the account of friction has to tell."""
        for algorithm, strip, mouth, gap in (
            ("penalty", True, "crack", 0.0),
            ("multiplier", True, "gap", 1e-3),
            ("multiplier", False, "crack", 0.0),
        ):
            with self.subTest(algorithm=algorithm, strip=strip, mouth=mouth):
                made = [
                    crossings.roll(*one, algorithm, 0.01, strip, soft=True) for one in ((mouth, gap), ("none", 0.0))
                ]
                force, nodes, error = self.crossed("roll", *made, 0.01)
                self.assertGreaterEqual(nodes[0], nodes[1])
                self.assertLess(abs(force - 1), 0.05)
                self.assertLess(error, 5e-3)

    def test_undamped_springs_that_are_struck(self):
        """They throw light nodes about, which makes energy (docs/monitor.md), but no more than that: what a spring held
        when it parted was booked whole as friction, also what it had given back, 0.5 of the elastic energy."""
        error = self.crossed(
            "roll",
            *2 * [crossings.roll("none", 0.0, "penalty", 0.01, True, soft=True).replace("damping = 0.2", "")],
            0.01
        )[2]
        self.assertLess(error, 0.05)


if __name__ == "__main__":
    unittest.main()
