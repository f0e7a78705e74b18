#!/usr/bin/env python3
"""The study of the insulated joint (studies/joint) in its parts: its cases are sound, its steps are done once and go on
where they ended, and what it measures in results it finds in results made up to have it. Its whole is in
test_long_joint_study.py."""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy
except ImportError:
    sys.exit(77)

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
STUDY = ROOT / "studies" / "joint"
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
sys.path[:0] = [str(STUDY), str(STUDY.parent / "common"), str(ROOT / "scripts")]
import hammer  # noqa: E402
import passing  # noqa: E402
import scan  # noqa: E402
import steps  # noqa: E402
import surface  # noqa: E402
import waves  # noqa: E402
import worn_joint  # noqa: E402

# Stands for the program: writes results that are complete at its second call, and counts its calls.
FAKE = f"""#!{sys.executable}
import pathlib, sys, h5py
results = next(word for word in sys.argv if word.startswith("output.file="))[len("output.file="):]
calls = pathlib.Path(results).with_suffix(".calls")
with calls.open("a") as file:
    print(*sys.argv[1:], file=file)
count = len(calls.read_text().splitlines())
with h5py.File(results, "w") as file:
    file.attrs["completed"] = int(count > 1)
pathlib.Path(results).with_suffix(".checkpoint.h5").touch()
sys.exit(4 if count == 1 else 0)
"""


class Folder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)


class Cases(Folder):
    def check(self, case, overrides):
        words = [PROGRAM, "check", case]
        for override in overrides:
            words += ["--set", override]
        done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_the_passing_wheel(self):
        said = self.check(STUDY / "passing.toml", passing.COARSE)
        self.assertRegex(said, r"wheelset: .* of bilinear")
        self.assertRegex(said, r"outputs of fields from 0\.001 to 0\.002 s \(landing\)")
        said = self.check(STUDY / "passing.toml", [*passing.COARSE, *passing.ELASTIC])
        self.assertRegex(said, r"wheelset: .* of elastic")
        self.assertRegex(said, r"track_rail_2: .* of elastic")

    def test_the_worn_surface(self):
        path = self.folder / "worn.csv"
        subprocess.run([sys.executable, STUDY / "worn_joint.py", path], check=True)
        nominal = self.check(STUDY / "passing.toml", passing.COARSE)
        worn = self.check(STUDY / "passing.toml", [*passing.COARSE, f"tracks.track.height_map={path}"])
        self.assertNotEqual(nominal, worn)
        x, y, dz = numpy.loadtxt(path, delimiter=",", skiprows=1).T
        middle = numpy.abs(y - y.mean()) < 1e-6
        deepest = numpy.flatnonzero(middle)[dz[middle].argmin()]
        self.assertLess(abs(x[deepest]), 2e-3)
        behind, before = dz[middle & (x > 0)].min(), dz[middle & (x < 0)].min()
        self.assertLess(behind, before)
        self.assertAlmostEqual(-0.5 * (behind + before), 0.15e-3, delta=2e-5)
        self.assertGreater(dz[numpy.abs(x) > 0.1].min(), -1e-6)
        self.assertGreater(dz[numpy.abs(y - y.mean()) > 0.035].min(), -1e-6)

    def test_the_hammer(self):
        said = self.check(STUDY / "hammer.toml", hammer.COARSE)
        for sensor in range(1, 9):
            self.assertIn(f"sensor_{sensor}", said)
        self.assertNotIn("farther", said)


    def test_the_settings_of_the_scan(self):
        coarser = ["tracks.track.coarse_size=0.1", "tracks.track.core_size=0.1"]
        made = steps.Steps(self.folder, PROGRAM)
        seen = set()
        for name, setting in scan.SETTINGS.items():
            with self.subTest(name):
                case = setting.case(made, STUDY / "hammer.toml", "scan")
                seen.add(self.check(case, [*setting.overrides, *scan.MESH, *coarser]))
        self.assertEqual(len(seen), len(scan.SETTINGS), "each changes something")


class Once(Folder):
    def test_done_once_and_again_for_other_arguments(self):
        done, source = [], self.folder / "input"
        source.touch()
        for arguments in (["a"], ["a"], ["b"]):
            steps.Steps(self.folder / "study", "railwave").once("x", [source], arguments, lambda: done.append(1))
        self.assertEqual(len(done), 2)
        os.utime(source, (1, 1))
        steps.Steps(self.folder / "study", "railwave").once("x", [source], ["b"], lambda: done.append(1))
        self.assertEqual(len(done), 3)

    def test_what_was_interrupted_goes_on(self):
        program = self.folder / "fake"
        program.write_text(FAKE)
        program.chmod(0o755)
        case = self.folder / "case.toml"
        case.touch()
        study = self.folder / "study"
        with self.assertRaises(steps.Failed):
            steps.Steps(study, program).run("one", case, ["time.end=1"])
        for _ in range(2):
            results = steps.Steps(study, program).run("one", case, ["time.end=1"])
        calls = results.with_suffix(".calls").read_text().splitlines()
        self.assertEqual(len(calls), 2, "the third is not called")
        self.assertNotIn("--restart", calls[0])
        self.assertTrue(calls[1].endswith("--restart"))
        steps.Steps(study, program).run("one", case, ["time.end=2"])
        calls = results.with_suffix(".calls").read_text().splitlines()
        self.assertIn("time.end=2", calls[2])


class Measures(Folder):
    def test_waves_ahead_of_a_patch(self):
        """A wave of 0.49 MHz and 6.1 mm that dies away ahead of a patch, among noise, on a surface that sways."""
        frequency, length = 0.49e6, 6.1e-3
        x, y = numpy.arange(0.003, 0.0501, 0.001), numpy.arange(0.750, 0.7601, 0.001)
        grid = numpy.array([(a, b, 0.17) for b in y for a in x])
        time = 48.45e-3 + 0.28e-6 * numpy.arange(350)
        phase = 2 * numpy.pi * (frequency * time[:, None] - grid[None, :, 0] / length)
        noise = numpy.random.default_rng(1).normal(size=phase.shape)
        swaying = 0.2 * numpy.sin(2 * numpy.pi * 2e4 * time)[:, None]
        made = argparse.Namespace(size=1e-3, place=grid, time=time, between=lambda begin, end: numpy.arange(len(time)))
        made.velocity = numpy.zeros((*phase.shape, 3))
        made.velocity[..., 2] = numpy.exp(-(grid[None, :, 0] - 0.03) / 0.02) * numpy.sin(phase) + noise + swaying
        wave = waves.WavesAhead(made, time[0], time[-1], 0.028, 0.755)
        self.assertTrue(wave.is_seen())
        (found, speed, share), = wave.listed()
        self.assertAlmostEqual(found / frequency, 1, delta=0.03)
        self.assertAlmostEqual(speed / found / length, 1, delta=0.05)
        self.assertGreater(share, 0.45)
        made.velocity[..., 2] = noise + swaying
        self.assertEqual(waves.WavesAhead(made, time[0], time[-1], 0.028, 0.755).listed(), [])

    def test_speed_and_length_of_a_wave(self):
        """A burst of three waves that goes out from a place beside the surface's middle."""
        speed, length, origin, touch = 2980.0, 0.010, numpy.array([0.004, 0.744]), 1e-3
        x, y = numpy.arange(0.003, 0.0501, 0.001), numpy.arange(0.735, 0.7701, 0.001)
        grid = numpy.array([(a, b, 0.17) for b in y for a in x])
        corner = [b * len(x) + a for b in range(len(y) - 1) for a in range(len(x) - 1)]
        facets = numpy.array([(k, k + 1, k + 1 + len(x), k + len(x)) for k in corner])
        time = touch + 1e-6 * numpy.arange(-6, 40)
        radius = numpy.hypot(*(grid[:, :2] - origin).T)
        behind = speed * (time[:, None] - touch) - radius[None, :]
        burst = numpy.where((behind > 0) & (behind < 1.5 * length), numpy.sin(2 * numpy.pi * behind / length), 0)
        height = 0.3 + burst / numpy.sqrt(numpy.maximum(radius, 1e-3))
        with h5py.File(self.folder / "r.h5", "w") as file:
            group = file.create_group(f"fields/{surface.BEHIND}")
            group["time"], group["coordinates"], group["connectivity"] = time, grid, facets
            group["velocity"] = numpy.stack([0 * height, 0 * height, height], axis=2)
        wave = waves.RadialWave(surface.Surface(self.folder / "r.h5", surface.BEHIND), origin, touch)
        self.assertTrue(wave.is_seen())
        found = wave.speed_and_length()
        self.assertAlmostEqual(found[0], speed, delta=0.05 * speed)
        self.assertAlmostEqual(found[1], length, delta=0.2 * length)

    def test_peaks_and_troughs_of_an_accelerance(self):
        frequency = numpy.arange(100.0, 1000.0)
        decibels = 10 * numpy.exp(-(((frequency - 280) / 20) ** 2)) - 15 * numpy.exp(-(((frequency - 450) / 30) ** 2))
        decibels += 0.001 * frequency
        with open(self.folder / "a.csv", "w") as file:
            file.write("kind,frequency,decibels,phase\n")
            file.writelines(f"direct,{f},{level},0\n" for f, level in zip(frequency, decibels))
        found = hammer.Accelerance(self.folder / "a.csv")
        self.assertAlmostEqual(found.extreme(200, 400, 1), 280, delta=2)
        self.assertAlmostEqual(found.extreme(300, 800, -1), 450, delta=2)
        self.assertAlmostEqual(found.trough_behind(280, 800), 450, delta=2)
        self.assertIsNone(found.trough_behind(600, 605), "a slope has no trough")
        self.assertIsNone(found.extreme(600, 900, 1), "a slope has no peak")

    def test_a_worn_joint_keeps_its_parameters(self):
        parser = argparse.ArgumentParser()
        worn_joint.add_options(parser)
        shape = parser.parse_args(["--depth", "2e-4", "--asymmetry", "0", "--second-depth", "0"])
        self.assertAlmostEqual(worn_joint.height(0, 0, shape), -2e-4)
        self.assertAlmostEqual(worn_joint.height(shape.length, 0, shape), -2e-5)
        self.assertAlmostEqual(worn_joint.height(-shape.length, 0, shape), -2e-5)


if __name__ == "__main__":
    unittest.main()
