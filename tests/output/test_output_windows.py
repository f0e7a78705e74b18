#!/usr/bin/env python3
"""Windows of output: fields come at their intervals from their start to their end, besides those of the whole run."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy
except ImportError:
    sys.exit(77)

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import two_blocks  # noqa: E402

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"

SCENE = two_blocks.two_blocks(
    ([0.06, 0.05, 0.03], [6, 5, 3]), ([0.04, 0.04, 0.03], [4, 4, 3]), [0.005, 0.005, 0.03001]
) + """
[initial_motion.fall]
parts = ["upper"]
velocity = [0, 0, -2]
[time]
end = 2e-4
[output]
file = "results.h5"
history_interval = 1e-5
field_interval = 5e-5
field_sets = ["lower.z_max"]
fields = ["velocity"]
"""


def window(name, start, end, interval):
    ends = "" if end is None else f"end = {end}\n"
    return f"[output_windows.{name}]\nstart = {start}\n{ends}interval = {interval}\n"


class OutputWindows(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def command(self, name, text, code=0):
        (self.folder / "case.toml").write_text(text)
        done = subprocess.run([PROGRAM, name, "case.toml"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def outputs(self, text):
        """Times of the fields' outputs and of those of the contact, which are the same; the size of a step."""
        self.command("run", text)
        with h5py.File(self.folder / "results.h5", "r") as file:
            times, steps = file["fields/lower.z_max/time"][()], file["fields/lower.z_max/step"][()]
            numpy.testing.assert_array_equal(times, file["contact/between/time"][()])
        (self.folder / "results.h5").unlink()
        self.assertTrue((numpy.diff(steps) > 0).all(), "an output twice, or out of order")
        return times, steps, times[-1] / steps[-1]

    def test_come_at_their_interval_besides_the_others(self):
        plain, _, _ = self.outputs(SCENE)
        numpy.testing.assert_allclose(plain, [0, 5e-5, 1e-4, 1.5e-4, 2e-4], rtol=1e-9)
        times, steps, step = self.outputs(SCENE + window("landing", 6.1e-5, 9.2e-5, 3e-6))
        every = round(3e-6 / step)
        inside = steps[(times >= 6.1e-5) & (times <= 9.2e-5)]
        first = inside[0] * step
        self.assertTrue(6.1e-5 <= first < 6.1e-5 + step)
        numpy.testing.assert_array_equal(numpy.diff(inside), every)
        self.assertLess(9.2e-5 - inside[-1] * step, every * step)
        numpy.testing.assert_allclose(times[(times < 6.1e-5) | (times > 9.2e-5)], plain, rtol=1e-9)

    def test_overlap_and_last_to_the_end(self):
        times, _, step = self.outputs(
            SCENE + window("one", 2.2e-5, 1.3e-4, 1.1e-5) + window("two", 1.2e-4, None, 7e-6)
        )
        one, two = [round(interval / step) for interval in (1.1e-5, 7e-6)]
        begins = [int(numpy.ceil(start / step * (1 - 1e-9))) for start in (2.2e-5, 1.2e-4)]
        last = round(2e-4 / step)
        expected = set(range(begins[0], int(1.3e-4 / step * (1 + 1e-9)) + 1, one))
        expected |= set(range(begins[1], last + 1, two)) | {round(k * 5e-5 / step) for k in range(5)}
        numpy.testing.assert_allclose(times, [step * number for number in sorted(expected)], rtol=1e-9)

    def test_every_step(self):
        _, steps, step = self.outputs(SCENE + window("all", 1e-4, 1.01e-4, 0))
        inside = steps[(steps * step >= 1e-4 - 1e-12) & (steps * step <= 1.01e-4)]
        self.assertGreater(len(inside), 1)
        numpy.testing.assert_array_equal(numpy.diff(inside), 1)

    def test_whole_cycles_where_levels_take_steps_of_their_own(self):
        text = two_blocks.two_blocks(
            ([0.06, 0.05, 0.08], [6, 5, 8]), ([0.04, 0.04, 0.03], [14, 14, 4]), [0.005, 0.005, 0.08001]
        ) + SCENE[SCENE.index("[initial_motion") :] + "[solver]\nsubcycling = true\n"
        text += window("landing", 6.1e-5, 9.2e-5, 3e-6)
        cycle = int(re.search(r"outputs every whole (\d+) steps", self.command("check", text)).group(1))
        _, steps, step = self.outputs(text)
        self.assertGreater(len(steps), 10)
        self.assertTrue((steps % cycle == 0).all())
        inside = steps[(steps * step >= 6.1e-5) & (steps * step <= 9.2e-5)]
        self.assertEqual(len(set(numpy.diff(inside))), 1)

    def test_check_says_what_will_be_written(self):
        said = self.command("check", SCENE + window("landing", 6.1e-5, None, 3e-6))
        self.assertRegex(said, r"outputs of fields from 6\.1e-05 to 0\.0002 s \(landing\) besides every")
        plain = self.command("check", SCENE)

        def outputs_of(text):
            return int(re.search(r"^Results: (\d+) outputs of fields", text, re.MULTILINE).group(1))

        self.assertLessEqual(abs(outputs_of(said) - outputs_of(plain) - 1.39e-4 / 3e-6), 5)

    def test_have_sets_and_contacts_of_their_own(self):
        more = window("touch", 6e-5, 9e-5, 1e-6) + "field_sets = []\n"
        more += window("surface", 7e-5, 1.1e-4, 2e-6) + "contacts = []\n"
        self.command("run", SCENE + more)
        with h5py.File(self.folder / "results.h5", "r") as file:
            step = file.attrs["step_size"]
            steps = {
                name: set(file[group + "/step"][()].tolist())
                for name, group in (("surface", "fields/lower.z_max"), ("touch", "contact/between"))
            }
            for group in ("fields/lower.z_max", "contact/between/slave"):
                of_velocity = file[group + "/velocity"].shape[0]
                self.assertEqual(of_velocity, len(steps["surface" if "fields" in group else "touch"]))
        plain = {round(k * 5e-5 / step) for k in range(5)}
        for name, start, end, interval in (("touch", 6e-5, 9e-5, 1e-6), ("surface", 7e-5, 1.1e-4, 2e-6)):
            begin, last = int(numpy.ceil(start / step * (1 - 1e-9))), int(end / step * (1 + 1e-9))
            self.assertEqual(steps[name], plain | set(range(begin, last + 1, round(interval / step))))
        grids = (self.folder / "results.xdmf").read_text().split('CollectionType="Spatial"')[1:]
        self.assertEqual(len(grids), len(steps["surface"] | steps["touch"]))
        self.assertEqual(sum('Name="lower.z_max"' in grid for grid in grids), len(steps["surface"]))
        self.assertEqual(sum('Name="contact between slave"' in grid for grid in grids), len(steps["touch"]))

    def test_mistakes(self):
        for text, expected in [
            (window("late", 3e-4, None, 1e-6), "[output_windows.late]: starts at 0.0003 s, after the run's end"),
            (window("turned", 1e-4, 5e-5, 1e-6), "start: is 0.0001, must be at most end"),
            ("[output_windows.no]\nstart = 0\n", "interval"),
            (window("odd", 0, None, -1), "interval"),
            (window("a", 0, None, 1) + 'field_sets = ["lower"]', "field_sets: there is no 'lower'; "),
            (window("a", 0, None, 1) + 'contacts = ["betwen"]', "contacts: there is no 'betwen'; did you mean"),
            (window("a", 0, None, 1) + "contacts = []\nfield_sets = []", "nothing would be written"),
        ]:
            with self.subTest(expected):
                self.assertIn(expected, self.command("check", SCENE + text, code=2))
        nothing = SCENE[: SCENE.index("[contacts.between]")] + SCENE[SCENE.index("[initial_motion") :]
        nothing = nothing.replace('field_sets = ["lower.z_max"]\nfields = ["velocity"]\n', "")
        self.assertIn("nothing would be written", self.command("check", nothing + window("w", 0, None, 1e-6), code=2))


if __name__ == "__main__":
    unittest.main()
