#!/usr/bin/env python3
"""Histories of stress and strain at a point and over element sets, evenly spaced to the last sample, from the case file
to the commands that read them."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"

BAR = """
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
{material}
[meshes.bar]
type = "box"
size = [0.02, 0.01, 0.01]
divisions = [4, 2, 2]
[parts.bar]
mesh = "bar"
material = "steel"
[constraints.x]
target = "bar.x_min"
fixed = ["x"]
[constraints.y]
target = "bar.y_min"
fixed = ["y"]
[constraints.z]
target = "bar.z_min"
fixed = ["z"]
[curves.on]
type = "cosine_ramp"
duration = 1e-3
[loads.pull]
type = "traction"
target = "bar.x_max"
traction = [1e8, 0, 0]
curve = "on"
[probes.inside]
part = "bar"
position = [0.0112, 0.0041, 0.0061]
quantities = ["displacement", "stress", "strain"]
[probes.row]
part = "bar"
position = [0.001, 0.005, 0.008]
count = 4
spacing = [0.005, 0, 0]
quantities = ["stress"]
[probes.usual]
part = "bar"
position = [0.02, 0.01, 0.01]
[element_sets.half]
part = "bar"
box = [[0, 0, 0], [0.01, 1, 1]]
[time]
end = {end}
[output]
history_interval = {interval}
field_interval = {fields}
field_sets = ["bar", "bar.half"]
fields = ["stress"]
history_sets = ["bar.half"]
"""


class PointHistories(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def write(self, material="", end="1.2e-3", interval="1e-5", fields="2e-4", instead=()):
        text = BAR.format(material=material, end=end, interval=interval, fields=fields)
        for old, new in instead:
            self.assertIn(old, text)
            text = text.replace(old, new)
        (self.folder / "case.toml").write_text(text)

    def railwave(self, *words, code=0):
        done = subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def run_case(self, *words):
        return self.railwave("run", "case.toml", "--set", "output.file=results.h5", *words)

    def results(self):
        return h5py.File(self.folder / "results.h5", "r")

    def test_bar_in_tension(self):
        self.write()
        self.run_case()
        with self.results() as file:
            sets = file["history/set"]
            samples = len(file["history/time"])
            inside = sets["bar.inside"]
            self.assertEqual(
                set(inside),
                {"displacement", "stress", "strain", "position", "element_centre", "asked_position", "elements"},
            )
            self.assertEqual((inside["stress"].shape, inside["strain"].shape), ((samples, 6), (samples, 6)))
            np.testing.assert_allclose(inside["asked_position"], [0.0112, 0.0041, 0.0061])
            np.testing.assert_allclose(inside["element_centre"], [0.0125, 0.0025, 0.0075])
            np.testing.assert_allclose(inside["position"], [0.01, 0.005, 0.005])  # the nearest node
            self.assertEqual(inside.attrs["asked_by"], "probe inside")
            # At rest at the end: uniaxial stress.
            np.testing.assert_allclose(inside["stress"][-1], [1e8, 0, 0, 0, 0, 0], atol=2e5)
            np.testing.assert_allclose(
                inside["strain"][-1], np.array([1, -0.3, -0.3, 0, 0, 0]) * 1e8 / 210e9, atol=1e-6
            )
            self.assertEqual(
                set(sets["bar.row_3"]), {"stress", "position", "element_centre", "asked_position", "elements"}
            )
            np.testing.assert_array_equal(sets["bar.row_3/position"], sets["bar.row_3/element_centre"])
            self.assertEqual(set(sets["bar.usual"]), {"displacement", "velocity", "acceleration", "position"})
            half = sets["bar.half"]
            self.assertEqual(set(half), {"stress", "strain", "position", "element_centre", "elements"})
            self.assertEqual(len(half["elements"]), 8)
            np.testing.assert_allclose(half["element_centre"], [0.005, 0.005, 0.005], atol=1e-12)
            # The same as the fields say.
            fields = file["fields/bar"]
            times = np.searchsorted(file["history/time"][:], fields["time"][:] - 1e-12)
            self.assertGreater(len(times), 5)
            for name in ("bar.inside", "bar.row_1", "bar.row_4"):
                np.testing.assert_array_equal(
                    sets[name]["stress"][times], fields["stress"][:, sets[name]["elements"][0]]
                )
            np.testing.assert_allclose(
                half["stress"][times], fields["stress"][:, half["elements"][:]].mean(axis=1), rtol=1e-12, atol=1e-3
            )
            self.assertEqual(file["fields/bar.half/stress"].shape, (len(times), 8, 6))

    def test_plastic_strain_comes_by_itself_where_a_material_yields(self):
        self.write(
            material="yield_stress = 60e6\ntangent_modulus = 2e9",
            instead=[('"stress", "strain"]', '"stress", "strain", "plastic_strain"]')],
        )
        self.run_case()
        with self.results() as file:
            inside, half = file["history/set/bar.inside"], file["history/set/bar.half"]
            stress, flow = inside["stress"][:, 0], inside["plastic_strain"][:]
            # the peak lies between two samples
            self.assertAlmostEqual(flow[-1] / ((stress.max() - 60e6) * (1 / 2e9 - 1 / 210e9)), 1, delta=0.01)
            np.testing.assert_allclose(inside["strain"][:, 0], flow + stress / 210e9, atol=2e-5)
            self.assertGreater(flow[-1], 0.015)
            self.assertIn("plastic_strain", half)
            self.assertNotIn("plastic_strain", file["history/set/bar.row_1"])

    def test_check_says_where_probes_lie(self):
        self.write(instead=[("position = [0.0112, 0.0041, 0.0061]", "position = [0.0112, 0.0041, 0.2]")])
        said = self.railwave("check", "case.toml")
        self.assertIn("bar.row_1: 1 element, in one with its centre at [0.0025, 0.0025, 0.0075], 2.96 mm away", said)
        self.assertRegex(
            said,
            r"warning: bar.inside \(line \d+\) is asked for at \[0.0112, 0.0041, 0.2\] m, which lies in no element"
            r" of the part",
        )
        self.assertIn("samples of histories every 1e-05 s", said)

    def test_channels(self):
        self.write()
        self.run_case()
        said = self.railwave(
            "signal", "bandpass", "results.h5", "--channel", "bar.inside.stress.xx", "--csv", "xx.csv", "--low", "100",
            "--high", "20000",
        )
        self.assertIn("bar.inside.stress.xx", said)
        self.assertIn("[Pa]", (self.folder / "xx.csv").read_text().splitlines()[0])
        self.railwave("signal", "psd", "results.h5", "--channel", "bar.row_*.stress.mises")
        self.railwave("signal", "psd", "results.h5", "--channel", "bar.half.strain.yz")
        for channel, complaint in [
            ("bar.inside.stress", "needs a component"),
            ("bar.inside.stress.zzz", "'zzz' is no component; it may be xx, yy"),
            ("bar.inside.velocity.x", "the run did not write the velocity of bar.inside"),
            ("bar.row_1.strain.xx", "the run did not write the strain of bar.row_1"),
            ("bar.usual.stress.xx", "there is no history of a set 'bar.usual' with its stress"),
            ("bar.half.strain.mises", "'mises' is no component"),
        ]:
            self.assertIn(
                complaint, self.railwave("signal", "psd", "results.h5", "--channel", channel, code=2), channel
            )
        with self.results() as file:
            self.assertNotIn("history/set/bar.half/velocity", file)

    def assert_even(self, times, interval=None):
        gaps = np.diff(times)
        np.testing.assert_allclose(gaps, times[-1] / len(gaps), rtol=1e-9)
        if interval is not None:
            np.testing.assert_allclose(times, interval * np.arange(len(times)), rtol=1e-12, atol=1e-18)

    def test_samples_are_evenly_spaced_to_the_last(self):
        for end, interval, fields, exact in (
            ("2e-4", "1e-5", "5e-5", True),
            ("2e-4", "3e-6", "7e-5", False),
            ("1.37e-4", "1e-5", "0", False),
            ("2e-4", "4.4e-7", "1e-4", False),
            ("2e-4", "1.1e-6", "5e-5", False),
            ("2e-4", "0", "4e-5", True),
            ("1e-4", "1", "0", False),
        ):
            self.write(end=end, interval=interval, fields=fields)
            self.run_case()
            with self.results() as file:
                times = file["history/time"][:]
                self.assertAlmostEqual(times[-1] / float(end), 1, 9)
                self.assert_even(times, float(interval) if exact and interval != "0" else None)
                if interval != "0":
                    self.assertLess(times[1], 1.5 * max(float(interval), file.attrs["step_size"]))
                if exact:
                    self.assert_even(file["fields/bar/time"][:], float(fields))
            for name in ("results.h5", "results.xdmf"):
                (self.folder / name).unlink()

    def test_samples_with_subcycling_and_the_global_step_are_even(self):
        for solver in ("subcycling = true", 'step_estimate = "global"'):
            self.write(end="2e-4", interval="1e-5", fields="5e-5", instead=[("[time]", f"[solver]\n{solver}\n[time]")])
            self.run_case()
            with self.results() as file:
                self.assert_even(file["history/time"][:], 1e-5)
            for name in ("results.h5", "results.xdmf"):
                (self.folder / name).unlink()

    def test_a_given_step_stays(self):
        self.write(end="1e-4", interval="2.5e-6")
        self.run_case("--set", "time.step=1e-7")
        with self.results() as file:
            self.assertAlmostEqual(file.attrs["step_size"] / 1e-7, 1, 12)
            self.assert_even(file["history/time"][:], 2.5e-6)

    def test_a_run_taken_further_is_the_one_that_went_there_at_once(self):
        def arrays(path):
            found = {}
            with h5py.File(path, "r") as file:
                file.visititems(
                    lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None
                )
            return found

        self.write(end="1e-4")
        self.railwave("run", "case.toml", "--set", "output.file=results.h5", "--keep-state")
        self.railwave("run", "case.toml", "--set", "output.file=results.h5", "--restart", "--set", "time.end=2e-4")
        self.railwave("run", "case.toml", "--set", "output.file=once.h5", "--set", "time.end=2e-4")
        further, once = arrays(self.folder / "results.h5"), arrays(self.folder / "once.h5")
        self.assertEqual(set(further), set(once))
        for name in once:
            if not name.startswith("fields"):  # the output at the old end is one more
                np.testing.assert_array_equal(further[name], once[name], name)

    def test_mistakes(self):
        for old, new, complaint in [
            ('quantities = ["stress"]', 'quantities = ["stres"]', "did you mean 'stress'"),
            ('quantities = ["stress"]', "quantities = []", "is empty, so nothing would be recorded"),
            (
                "box = [[0, 0, 0], [0.01, 1, 1]]",
                "box = [[0.0101, 0, 0], [0.0102, 1, 1]]",
                "no element of 'bar' has its centre in it; the nearest has it at [0.0125,",
            ),
            ("box = [[0, 0, 0], [0.01, 1, 1]]", "radius = 0.1", "is missing; must be a box"),
            (
                'history_sets = ["bar.half"]',
                'history_sets = ["bar.halv"]',
                "there is no set 'bar.halv'; did you mean 'bar.half'?",
            ),
            (
                "[element_sets.half]",
                "[element_sets.inside]",
                "makes the element set 'bar.inside', which is there already",
            ),
        ]:
            self.write(instead=[(old, new)])
            said = self.railwave("run", "case.toml", code=2)
            self.assertTrue(complaint in said, said)
            self.assertTrue(re.search(r"case\.toml:\d+", said) or "output" in said, said)
            self.assertFalse((self.folder / "results.h5").exists())


if __name__ == "__main__":
    unittest.main()
