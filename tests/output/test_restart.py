#!/usr/bin/env python3
"""A run that is stopped and taken up again ends with the results of the unbroken one, bit for bit; what can't be taken
up is refused."""

import hashlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import h5py
    import numpy
except ImportError:
    sys.exit(77)

from blocks_case import KINDS, arrays, case, different_arrays

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"


def monitored(said):
    """What the summary says of the monitor, without times by the clock."""
    return re.findall(r"^  (?:warning: )?monitor[:,] .*", said, re.MULTILINE)


class Folder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.results, self.checkpoint = self.folder / "results.h5", self.folder / "results.checkpoint.h5"

    def write(self, text):
        (self.folder / "case.toml").write_text(text)

    def start(self, *options):
        return subprocess.Popen(
            [PROGRAM, "run", "case.toml", *options],
            cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )

    def run_to_end(self, *options, code=0):
        run = self.start(*options)
        said, complaint = run.communicate(timeout=120)
        self.assertEqual(run.returncode, code, said + complaint)
        return said + complaint

    def stop(self, number=signal.SIGTERM):
        """Runs until a checkpoint is there, then sends the signal. False: the run ended before."""
        run = self.start("--set", "checkpoint.interval=0.02")
        while not self.checkpoint.exists() and run.poll() is None:
            time.sleep(0.002)
        run.send_signal(number)
        said, complaint = run.communicate(timeout=120)
        self.assertEqual(complaint, "")
        self.assertIn(run.returncode, (130, -number), said)
        return said

    def assert_same(self, one, other):
        self.assertEqual(different_arrays(one, other), [])
        self.assertEqual(one.with_suffix(".xdmf").read_text(), other.with_suffix(".xdmf").read_text())


class RestartedRuns(Folder):
    """Made below: one test for each kind of scene."""


def add_kind(name, options):
    def test(self):
        self.write(case(**options))
        said = of_whole = self.run_to_end()
        if name.startswith("subcycling"):
            self.assertIn("times fewer element updates", said)
        if name == "global_step":
            self.assertRegex(said, "steps between .* renewed [1-9]")
        if name == "automatic_step":
            self.assertRegex(said, "steps between .* renewed [1-9]")
            chosen = re.search(r"step automatic: the whole scene's step, .* evaluations of forces spent on it", said)[0]
        whole = self.folder / "whole.h5"
        shutil.move(self.results, whole)
        shutil.move(self.results.with_suffix(".xdmf"), whole.with_suffix(".xdmf"))
        said = self.stop()
        self.assertIn("interrupted at step", said)
        said = self.run_to_end("--restart")
        self.assertIn("restart: goes on from results.checkpoint.h5: step ", said)
        self.assertNotIn(".h5: step 0,", said)
        if name == "automatic_step":
            self.assertIn(chosen, said)
        self.assert_same(whole, self.results)
        self.assertEqual(monitored(said), monitored(of_whole))
        self.assertGreater(len(monitored(said)), 5 if name == "monitored" else 0)
        self.assertFalse(self.checkpoint.exists())
        with h5py.File(self.results, "r") as file:
            self.assertEqual(file.attrs["completed"], 1)
            self.assertEqual(file.attrs["restarts"], 1)
            if name == "penalty":
                self.assertGreater(file["history/contact/between/nodes_in_contact"][-1], 5)
            if name == "much_else":
                for term in ("friction", "plastic", "damping", "connector"):
                    self.assertGreater(abs(file["history/energy/" + term][-1]), 0, term)
    setattr(RestartedRuns, "test_" + name, test)


for name_, options_ in KINDS.items():
    add_kind(name_, options_)


class EndsThatMove(Folder):
    """A run may go on to a later end: what was computed stays as it is, and the steps stay as they were."""

    def stays(self, before):
        """Whether the results begin with all that was computed before, bit for bit; but for the output at the end,
        which is off the intervals."""
        now = arrays(self.results)
        self.assertEqual(sorted(before), sorted(now))
        for name, value in before.items():
            if now[name].shape != value.shape:
                self.assertGreater(len(now[name]), len(value) - 1, name)
                value = value[:-1]
            self.assertEqual(now[name][:len(value)].tobytes(), value.tobytes(), name)
        return now

    def test_complete_run_that_kept_its_state(self):
        for options in ({}, KINDS["subcycling"], KINDS["global_step"]):
            with self.subTest(options=options):
                self.write(case(**dict(options, end=4e-4)))
                self.run_to_end("--keep-state")
                self.assertTrue(self.checkpoint.exists())
                before = arrays(self.results)
                self.assertIn("nothing to do", self.run_to_end("--restart"))
                self.write(case(**dict(options, end=6e-4)))
                said = self.run_to_end("--restart")
                after = self.stays(before)
                times = after["history/time"]
                self.assertGreater(len(times), len(before["history/time"]))
                self.assertTrue(6e-4 - 1e-9 <= times[-1] < 6e-4 + 2e-6, times[-1])
                with h5py.File(self.results, "r") as file:
                    self.assertEqual((file.attrs["completed"], file.attrs["end_time"]), (1, 6e-4))
                self.assertIn("completed\n", said)
                self.assertFalse(self.checkpoint.exists())

    def test_interrupted_run_with_another_end(self):
        """The same whether it is reported before or after another interruption."""
        self.write(case())
        self.stop()
        kept = {path: path.read_bytes() for path in self.folder.iterdir()}
        later = (
            "--set",
            "time.end=1.5e-3",
            "--set",
            "monitor.active=false",
            "--set",
            "output.progress_interval=9",
            "--set",
            "title=longer",
        )
        self.run_to_end("--restart", *later)
        at_once = arrays(self.results)
        for path, content in kept.items():
            path.write_bytes(content)
        self.run_to_end("--restart", "--keep-state")
        self.run_to_end("--restart", *later)
        again = arrays(self.results)
        self.assertEqual(at_once["history/time"].tobytes(), again["history/time"].tobytes())
        self.assertEqual([name for name in at_once if at_once[name].tobytes() != again[name].tobytes()], [])

    def test_ends_that_cannot_be(self):
        self.write(case())
        self.stop()
        before = self.results.read_bytes()
        said = self.run_to_end("--restart", "--set", "time.end=1e-6", code=2)
        self.assertIn("time.end: the checkpoint's t = ", said)
        self.assertIn("name a later end", said)
        self.run_to_end("--restart")
        said = self.run_to_end("--restart", "--set", "time.end=2e-3", code=2)
        self.assertIn("--keep-state", said)


class WhatCannotBeTakenUp(Folder):
    def setUp(self):
        super().setUp()
        self.write(case())

    def test_nothing_is_there(self):
        self.assertIn("there are no results results.h5 to add to", self.run_to_end("--restart", code=2))
        self.assertFalse(self.results.exists())

    def test_complete_run(self):
        self.run_to_end()
        self.assertIn("nothing to do: results.h5 holds the whole run", self.run_to_end("--restart"))

    def test_another_case(self):
        self.stop()
        before = self.results.read_bytes()
        self.write(case(of_contact="damping = 0.1"))
        self.assertIn("of this case before it was changed", self.run_to_end("--restart", code=2))
        self.assertEqual(before, self.results.read_bytes())

    def test_damaged_checkpoints(self):
        self.stop()
        previous = self.checkpoint.with_name("results.checkpoint.h5.previous")
        self.assertTrue(previous.exists())
        for damaged in (self.checkpoint, previous):
            content = bytearray(damaged.read_bytes())
            content[len(content) // 2] ^= 1
            damaged.write_bytes(content)
            if damaged is self.checkpoint:
                kept = {path: path.read_bytes() for path in self.folder.iterdir()}
                said = self.run_to_end("--restart")
                self.assertIn("results.checkpoint.h5 cannot be used: its checksum is not that of what it holds", said)
                self.assertIn("goes on from results.checkpoint.h5.previous", said)
                for path, bytes_ in kept.items():
                    path.write_bytes(bytes_)
        said = self.run_to_end("--restart", code=2)
        self.assertEqual(said.count("its checksum is not that"), 2)

    def test_results_of_another_run(self):
        self.stop()
        kept = self.checkpoint.read_bytes()
        for path in self.folder.glob("results.checkpoint.h5*"):
            path.unlink()
        self.stop(signal.SIGKILL)
        for path in self.folder.glob("results.checkpoint.h5*"):
            path.unlink()
        self.checkpoint.write_bytes(kept)
        self.assertIn("it is of another run than the one whose results are there", self.run_to_end("--restart", code=2))

    def test_wall_time(self):
        self.write(case(end=1))
        for seconds in ("1", "5", "25"):  # a busy machine may need more for what comes before the first step
            said = self.run_to_end("--wall-time", seconds, "--overwrite", code=4)
            if self.checkpoint.exists():
                break
        self.assertIn("NOT completed: the wall time is spent at step", said)
        with h5py.File(self.checkpoint, "r") as file:
            step = int(file.attrs["step"])
        self.assertIn(f"spent at step {step} of", said)
        said = self.run_to_end("--restart", "--wall-time", "1", code=4)
        self.assertIn(f"step {step}, t =", said)

    def test_no_place_for_checkpoints(self):
        self.assertIn(
            "checkpoint.file: nowhere/a.h5 goes to", self.run_to_end("--set", "checkpoint.file=nowhere/a.h5", code=2)
        )
        self.assertIn("is the results file", self.run_to_end("--set", "checkpoint.file=results.h5", code=2))

    def test_checkpoint_that_cannot_be_written(self):
        """The run goes on and says so."""
        run = self.start("--set", "checkpoint.interval=0.02", "--set", "time.end=3e-3")
        while not self.results.exists():
            self.assertIsNone(run.poll())
            time.sleep(0.002)
        notes = self.folder / "results.checkpoint.h5.previous"
        notes.write_text("notes that came while the run began")
        said, complaint = run.communicate(timeout=120)
        self.assertIn("warning: a checkpoint could not be written", complaint)
        self.assertIn("is there already and is text that begins with 'notes that came", complaint)
        self.assertIn("completed\n", said)
        self.assertEqual(notes.read_text(), "notes that came while the run began")

    def test_a_name_in_the_way(self):
        """A checkpoint is written first under a name that nobody has."""
        (self.folder / "results.checkpoint.h5.new").mkdir()
        (self.folder / "results.checkpoint.h5.new" / "in the way").touch()
        said = self.run_to_end("--set", "checkpoint.interval=0.02", "--keep-state")
        self.assertNotIn("a checkpoint could not be written", said)
        self.assertTrue(self.checkpoint.exists())
        self.assertTrue((self.folder / "results.checkpoint.h5.new" / "in the way").exists())


class WhatIsNotReplaced(Folder):
    def setUp(self):
        super().setUp()
        self.write(case())

    def everything(self):
        return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in self.folder.iterdir()}

    def test_the_case_again(self):
        """An interrupted run is gone on with, or given up: not by chance."""
        for number in (signal.SIGTERM, signal.SIGKILL):
            with self.subTest(signal=number):
                self.stop(number)
                before = self.everything()
                said = self.run_to_end(code=2)
                self.assertIn("results.h5 holds a run that has not ended", said)
                self.assertIn("--restart", said)
                self.assertIn("--overwrite", said)
                before.pop("results.h5.lock", None)  # of the killed run
                before.pop("results.checkpoint.h5.lock", None)
                after = self.everything()
                self.assertEqual(
                    {name: after[name] for name in before if ".new" not in name},
                    {name: before[name] for name in before if ".new" not in name},
                )
                said = self.run_to_end("--overwrite")
                self.assertNotIn("restart:", said)
                self.assertFalse(self.checkpoint.exists())
                with h5py.File(self.results, "r") as file:
                    self.assertEqual(file.attrs["completed"], 1)
                    self.assertNotIn("restarts", file.attrs)
        self.run_to_end()  # a complete run is replaced as ever

    def test_only_the_previous_checkpoint_is_left(self):
        self.stop()
        self.checkpoint.rename(self.checkpoint.with_name("results.checkpoint.h5.previous"))
        self.assertIn("holds a run that has not ended", self.run_to_end(code=2))

    def test_checkpoint_of_another_run(self):
        self.stop()
        self.results.rename(self.folder / "kept.h5")
        before = self.everything()
        said = self.run_to_end(code=2)
        self.assertIn("results.checkpoint.h5 is the checkpoint of another run", said)
        self.assertIn("--overwrite", said)
        said = self.run_to_end(
            "--set", "output.file=other.h5", "--set", "checkpoint.file=results.checkpoint.h5", code=2
        )
        self.assertIn("is the checkpoint of another run", said)
        self.assertEqual(self.everything(), before)
        self.run_to_end("--overwrite")

    def test_two_cases_with_one_checkpoint(self):
        """They lock each other out, whatever names the file goes by."""
        self.write(case(end=1))
        first = self.start("--set", "checkpoint.file=state.h5")
        self.addCleanup(first.communicate)
        self.addCleanup(first.kill)
        while not (self.folder / "state.h5.lock").exists():
            self.assertIsNone(first.poll())
            time.sleep(0.002)
        (self.folder / "link.h5").symlink_to("state.h5")
        for name in ("state.h5", "./state.h5", "link.h5", str(self.folder / "state.h5")):
            said = self.run_to_end(
                "--set", "output.file=other.h5", "--set", f"checkpoint.file={name}", "--overwrite", code=2
            )
            self.assertIn(f"checkpoint.file: another run is writing {name} now", said)
        said = self.run_to_end("--set", "checkpoint.file=another.h5", code=2)
        self.assertIn("output.file: another run is writing results.h5 now", said)
        first.terminate()
        first.communicate(timeout=60)
        self.assertEqual(list(self.folder.glob("*.lock")), [])
        self.assertFalse((self.folder / "other.h5").exists())

    def test_lock_of_a_killed_run(self):
        self.stop(signal.SIGKILL)
        self.assertEqual(len(list(self.folder.glob("*.lock"))), 2)
        self.run_to_end("--restart")
        self.assertEqual(list(self.folder.glob("*.lock")) + list(self.folder.glob("*.new*")), [])


if __name__ == "__main__":
    unittest.main()
