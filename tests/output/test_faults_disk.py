#!/usr/bin/env python3
"""A full disk, missing rights, files that vanish or are open elsewhere: each is reported, with the exit code, and
nothing that was there is lost."""

import contextlib
import os
import pathlib
import shutil
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from faults import LONG, PROGRAM, Folder  # noqa: E402

import h5py  # noqa: E402

EVERY_STEP = ("--set", "checkpoint.interval=1e-9")
SOMETIMES = ("--set", "checkpoint.interval=0.05")


class FullDisk(Folder):
    def goes_on(self, wanted):
        """With disk space again the run comes to its end, bit for bit."""
        self.run_case("--restart")
        self.assertEqual(self.arrays(), wanted)

    def times_count(self, file):
        """A program that goes by the times finds all else at each of them; a flush that ended halfway may have left an
        entry more."""
        groups = [file["history"], *(group for kind in ("fields", "contact") for group in file[kind].values())]
        for group in groups:
            grown = []

            def take(name, item, grown=grown):
                if getattr(item, "maxshape", [1])[0] is None:
                    grown.append((name, item.shape[0]))

            group.visititems(take)
            self.assertGreater(len(grown), 2)
            for name, entries in grown:
                self.assertGreaterEqual(entries, len(group["time"]), f"{group.name}/{name}")

    def test_results(self):
        """At whatever call the disk is full: the results are readable, and the run can be taken up where a checkpoint
        was."""
        self.run_case()
        older = self.results.read_bytes()
        with h5py.File(self.results, "r") as file:
            all_times = file["history/time"][()].tobytes()
        wanted = self.whole_run()
        resumed = 0
        for call in range(1, 2000, 97):
            for path in self.folder.glob("results*"):
                path.unlink()
            self.results.write_bytes(older)
            run = self.start("run", "case.toml", *EVERY_STEP, faults=dict(fail=call, only="results.h5"))
            said, complaint = run.communicate(timeout=120)
            if run.returncode == 0:
                break
            self.assertEqual(run.returncode, 1, complaint)
            self.assertIn("No space left on device", complaint)
            self.assertIn("free some space there", complaint)
            self.nothing_half_written()
            if self.results.read_bytes() == older:
                continue
            with h5py.File(self.results, "r") as file:
                self.times_count(file)
                times = file["history/time"][()].tobytes()
            self.assertTrue(all_times.startswith(times), "other times than those of the whole run")
            if self.checkpoint.exists():
                self.assertIn("--restart goes on from the last checkpoint", complaint)
                self.goes_on(wanted)
                resumed += 1
                self.reported("disk full: results", 1, complaint)
        self.assertGreater(resumed, 3)

    def test_small_disk(self):
        """A real one, where the system lets us have it: too small from the beginning, and filled by somebody else
        later."""
        disk = self.folder / "disk"
        disk.mkdir()
        if (
            shutil.which("mount") is None
            or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=700m", "none", disk], capture_output=True).returncode
            != 0
        ):
            self.skipTest("no right to mount a small disk")
        self.addCleanup(subprocess.run, ["umount", disk])
        self.case(end=LONG)
        results = ("--set", "output.file=disk/results.h5")
        complaint, _ = self.run_case(*results, "--set", "time.end=1e3", code=2)
        self.assertRegex(complaint, "histories of .*, but disk/results.h5 has .* free")
        self.assertEqual(list(disk.iterdir()), [])
        self.reported("disk too small for what the run will write", 2, complaint)
        run = self.start("run", "case.toml", *results, *SOMETIMES)
        while not (disk / "results.h5").exists():
            self.assertIsNone(run.poll())
            time.sleep(0.01)
        time.sleep(0.2)
        with contextlib.suppress(OSError), open(disk / "filler", "wb", buffering=0) as filler:
            while True:
                filler.write(bytes(1 << 20))
        complaint, _ = self.ends(run, 1)
        self.assertIn("No space left on device", complaint)
        self.assertEqual([path.name for path in disk.iterdir() if ".new" in path.name], [])
        with h5py.File(disk / "results.h5", "r") as file:
            self.assertGreater(len(file["history/time"]), 1)

    def test_checkpoint(self):
        """The run goes on; the state before stays."""
        complaint, said = self.run_case(*EVERY_STEP, faults=dict(fail=60, only="checkpoint"))
        self.assertIn("a checkpoint could not be written, the one before it is the last: ", complaint)
        self.assertIn("No space left on device", complaint)
        self.assertEqual(complaint.count("railwave:"), 1, "reported once")
        self.assertIn("completed\n", said)
        self.nothing_half_written()
        self.reported("disk full: checkpoint", 0, complaint)

    def test_settled_state(self):
        self.case(more="[settle]\nmethod = \"newton\"\n[gravity]\nacceleration = [0, 0, -9.81]\n")
        text = (
            (self.folder / "case.toml")
            .read_text()
            .replace("0.02001]", "0.02]")
            .replace("velocity = [2, 1, -12]", "velocity = [2, 1, 0]")
        )
        (self.folder / "case.toml").write_text(text)
        complaint, said = self.run_case(faults=dict(fail=3, only="settled-"))
        line = next(line for line in said.splitlines() if "could not be kept" in line)
        self.assertIn("No space left on device", line)
        self.nothing_half_written()
        self.reported("disk full: settled state", 0, line)

    def test_what_other_commands_write(self):
        self.run_case()
        commands = {
            "mesh": (["mesh", "case.toml", "--out", "made.h5"], 1),
            "contact --csv": (["contact", "results.h5", "--csv", "made.csv"], 2),
            "contact --hdf5": (["contact", "results.h5", "--hdf5", "made.h5"], 2),
            "modes --csv": (["modes", "case.toml", "--up-to", "50000", "--csv", "made.csv"], 2),
            "modes --out": (["modes", "case.toml", "--up-to", "50000", "--out", "made.h5"], 1),
        }
        for name, (command, code) in commands.items():
            with self.subTest(command=name):
                made = self.folder / command[-1]
                self.ends(self.start(*command), 0)
                before = self.everything()
                for call in (1, 2, 5):
                    complaint, _ = self.ends(self.start(*command, faults=dict(fail=call, only="made.")), code)
                    self.assertIn("No space left on device", complaint)
                    self.assertEqual(complaint.count("railwave:"), 1)
                    self.nothing_half_written()
                    after = self.everything()
                    self.assertEqual(after[made.name], before[made.name], "what was there is there")
                    if made.suffix == ".csv":
                        break
                self.reported("disk full: railwave " + name, code, complaint)
                for path in self.folder.glob("made*"):
                    path.unlink()


@unittest.skipUnless(os.geteuid() != 0 or shutil.which("setpriv"), "root may write everywhere, and there is no setpriv")
class NoPermission(Folder):
    def setUp(self):
        super().setUp()
        self.user = []
        if os.geteuid() == 0:  # the program is to run as somebody whom modes bind
            self.user = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"]
            self.folder.chmod(0o777)
            seen = subprocess.run([*self.user, PROGRAM, "--version"], capture_output=True)
            if seen.returncode != 0:
                self.skipTest("another user may not start the program where it lies")

    def run_as_user(self, *options, code):
        return self.run_case(*options, code=code, before=self.user)

    def test_folder_that_can_only_be_read(self):
        self.folder.chmod(0o555)
        self.addCleanup(self.folder.chmod, 0o755)
        before = self.everything()
        complaint, _ = self.run_as_user(code=2)
        self.assertIn("may not be written: Permission denied", complaint)
        self.assertEqual(self.everything(), before)
        self.reported("read-only folder: results", 2, complaint)

    def test_checkpoint_folder_that_can_only_be_read(self):
        there = self.folder / "there"
        there.mkdir(mode=0o555)
        complaint, _ = self.run_as_user("--set", "checkpoint.file=there/a.h5", code=2)
        self.assertIn("checkpoint.file: there/a.h5 goes to", complaint)
        self.reported("read-only folder: checkpoint", 2, complaint)

    def test_results_that_can_only_be_read(self):
        """Protected by their mode they are neither replaced nor added to."""
        self.run_as_user("--keep-state", code=0)
        self.results.chmod(0o444)
        before = self.everything()
        complaint, _ = self.run_as_user(code=2)
        self.assertIn("may not be written (its mode protects it)", complaint)
        self.assertEqual(self.everything(), before)
        self.reported("read-only results: a new run", 2, complaint)
        complaint, _ = self.run_as_user("--restart", "--set", "time.end=1e-4", code=1)
        self.assertIn("Permission denied", complaint)
        self.assertIn("you may not write there", complaint)
        self.assertEqual(self.everything(), before)
        self.reported("read-only results: --restart", 1, complaint)

    def test_case_that_may_not_be_read(self):
        (self.folder / "case.toml").chmod(0)
        complaint, _ = self.run_as_user(code=2)
        self.assertIn("case.toml", complaint)
        self.reported("case file that may not be read", 2, complaint)

    def test_rights_taken_away_while_running(self):
        """The results are open, so they go on; the checkpoint can't be made."""
        self.case(end=LONG)
        run = self.start("run", "case.toml", *SOMETIMES, before=self.user)
        while not self.checkpoint.exists():
            self.assertIsNone(run.poll())
            time.sleep(0.01)
        self.folder.chmod(0o555)
        self.addCleanup(self.folder.chmod, 0o755)
        time.sleep(0.5)
        run.terminate()
        complaint, said = self.ends(run, 130)
        self.assertIn("a checkpoint could not be written", complaint)
        self.assertIn("Permission denied", complaint)
        with h5py.File(self.results, "r") as file:
            self.assertIn("interrupted", file.attrs["reason"])
        self.reported("rights taken away while running: checkpoint", 130, complaint)


class Vanished(Folder):
    def running(self, *options, **how):
        self.case(end=LONG)
        run = self.start("run", "case.toml", *options, **how)
        described = self.folder / "results.xdmf"  # comes after the first output
        while not described.exists() or len(self.results.read_bytes()) < 30000:
            self.assertIsNone(run.poll())
            time.sleep(0.01)
        return run

    def whole(self, run):
        time.sleep(1)
        run.terminate()
        complaint, said = self.ends(run, 130)
        with h5py.File(self.results, "r") as file:
            self.assertEqual(file["history/step"][0], 0)
            self.assertEqual(file["history/step"][-1], file.attrs["steps"])
            self.assertEqual(file["fields/upper/step"][-1], file.attrs["steps"])
            self.assertFalse((file["fields/upper/stress"][()] != file["fields/upper/stress"][()]).any())
        return complaint

    def test_results_removed(self):
        run = self.running()
        self.results.unlink()
        (self.folder / "results.xdmf").unlink()
        complaint = self.whole(run)
        self.assertIn("was removed while the run wrote it; it was written anew", complaint)
        self.assertIn("</Xdmf>", (self.folder / "results.xdmf").read_text())
        self.reported("results removed while running", 130, complaint)
        self.ends(self.start("run", "case.toml", "--restart", "--wall-time", "1"), 4)

    def test_results_moved(self):
        run = self.running()
        self.results.rename(self.folder / "moved.h5")
        complaint = self.whole(run)
        self.assertIn("was moved while the run wrote it; the file now has both names", complaint)
        self.reported("results moved while running", 130, complaint)

    def others(self, name):
        """A file of somebody else's appears under this name at once, so that the run has no moment to write its own."""
        other = self.folder / "other"
        other.write_bytes(b"somebody else's")
        other.rename(self.folder / name)

    def rescued(self, run, beside):
        complaint, _ = self.ends(run, 1)
        self.assertIn("another file has taken the name results.h5", complaint)
        self.assertIn(f"is in {beside}; the file results.h5 is not this run's", complaint)
        self.assertEqual(self.results.read_bytes(), b"somebody else's")
        with h5py.File(self.folder / beside, "r") as file:
            self.assertGreaterEqual(len(file["history/time"]), 1)
        return complaint

    def test_name_taken(self):
        run = self.running()
        self.others("results.h5")
        complaint = self.rescued(run, "results.h5.rescued")
        self.reported("results replaced by another file while running", 1, complaint)

    def test_name_taken_and_restart(self):
        """What was rescued is gone on from once it has its name again."""
        run = self.running(*SOMETIMES)
        while not self.checkpoint.exists():
            self.assertIsNone(run.poll())
            time.sleep(0.01)
        self.others("results.h5")
        complaint = self.rescued(run, "results.h5.rescued")
        self.assertIn("--restart goes on from the last checkpoint when what was written has the name", complaint)
        self.reported("results with a checkpoint replaced by another file while running", 1, complaint)
        (self.folder / "results.h5.rescued").rename(self.results)
        self.ends(self.start("run", "case.toml", "--restart", "--wall-time", "1"), 4)

    def test_name_taken_between_two_looks(self):
        """When the run has just seen that its file has a name."""
        run = self.running(faults=dict(only="/results.h5", taken=self.folder / "taken"))
        self.others("taken")
        self.rescued(run, "results.h5.rescued")

    def test_moved_and_name_taken(self):
        run = self.running()
        self.results.rename(self.folder / "moved.h5")
        self.others("results.h5")
        self.rescued(run, "results.h5.rescued")
        with h5py.File(self.folder / "moved.h5", "r") as file:
            self.assertGreaterEqual(len(file["history/time"]), 1)

    def test_rescued_twice(self):
        """What was rescued before stays."""
        (self.folder / "results.h5.rescued").write_bytes(b"rescued before")
        run = self.running()
        self.others("results.h5")
        self.rescued(run, "results.h5.rescued-2")
        self.assertEqual((self.folder / "results.h5.rescued").read_bytes(), b"rescued before")

    def test_folder_removed(self):
        self.case(end=LONG)
        (self.folder / "there").mkdir()
        results = self.folder / "there" / "results.h5"
        run = self.start("run", "case.toml", "--set", "output.file=there/results.h5")
        while not results.exists():
            self.assertIsNone(run.poll())
            time.sleep(0.01)
        while results.parent.exists():  # the run makes files there meanwhile
            shutil.rmtree(results.parent, ignore_errors=True)
        complaint, _ = self.ends(run, 1)
        self.assertIn("No such file or directory", complaint)
        self.reported("results' folder removed while running", 1, complaint)

    def test_inputs(self):
        text = (self.folder / "case.toml").read_text()
        (self.folder / "case.toml").write_text(
            text.replace(
                '[parts.upper]\nmesh = "upper"',
                '[meshes.gone]\ntype = "file"\npath = "gone.inp"\n[parts.upper]\nmesh = "gone"',
            )
        )
        complaint, _ = self.run_case(code=2)
        self.assertIn("gone.inp", complaint)
        self.reported("mesh file vanished", 2, complaint)
        complaint, _ = self.ends(self.start("run", "none.toml"), 2)
        self.assertIn("none.toml", complaint)
        self.reported("case file vanished", 2, complaint)


class OpenElsewhere(Folder):
    def test_two_runs(self):
        self.case(end=LONG)
        first = self.start("run", "case.toml", *SOMETIMES)
        while not self.checkpoint.exists():
            self.assertIsNone(first.poll())
            time.sleep(0.01)
        for options in ((), ("--restart",)):
            complaint, _ = self.run_case(*options, code=2)
            self.assertIn("another run is writing results.h5 now", complaint)
        self.reported("two runs with one results file: the second", 2, complaint)
        first.terminate()
        self.ends(first, 130)
        self.ends(self.start("run", "case.toml", "--restart", "--wall-time", "1"), 4)

    def test_read_by_another(self):
        """One that reads has the file open: a restart is refused, a new run goes its way."""
        wanted = self.whole_run()
        self.run_case("--keep-state")
        before = self.results.read_bytes()
        with h5py.File(self.results, "r") as file:
            complaint, _ = self.run_case("--restart", "--set", "time.end=1e-4", code=1)
            self.assertIn("another program has it open", complaint)
            self.reported("results open in another program: --restart", 1, complaint)
            self.assertEqual(self.results.read_bytes(), before)
            self.run_case()
            self.assertEqual(file["history/step"][0], 0)  # its own, though they have lost their name
        self.assertEqual(self.arrays(), wanted)

    def test_read_while_running(self):
        """HDF5's readers find the file locked while the run has it open, and can be made to read nevertheless."""
        self.case(end=LONG)
        run = self.start("run", "case.toml")
        while not self.results.exists():
            self.assertIsNone(run.poll())
            time.sleep(0.01)
        script = (
            "import h5py, sys; f = h5py.File('results.h5', 'r'); t = f['history/time'][()]; assert len(t) >= 1 and t[0]"
            " == 0"
        )
        for _ in range(20):  # who looks just while the file grows finds it too short, and looks again
            looked = subprocess.run(
                [sys.executable, "-c", script],
                cwd=self.folder, env=dict(os.environ, HDF5_USE_FILE_LOCKING="FALSE"), capture_output=True, text=True,
            )
            if looked.returncode == 0:
                break
        self.assertEqual(looked.returncode, 0, looked.stderr)
        self.assertIsNone(run.poll())
        run.terminate()
        self.assertEqual(self.ends(run, 130)[0], "")


if __name__ == "__main__":
    unittest.main()
