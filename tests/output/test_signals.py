#!/usr/bin/env python3
"""What ends a run from outside, at any of its stages: a signal, a limit of processor time or of file size, a closed
terminal."""

import signal
import sys
import time
import unittest
import pathlib

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from faults import LONG, Folder, arrays_of, limited  # noqa: E402

STOPPING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGXCPU, signal.SIGUSR1, signal.SIGUSR2)
FINE = ("divisions = [3, 3, 2]", "divisions = [180, 180, 120]")  # some seconds to mesh and to set up


def ignoring(*signals):
    def ignore():
        for one in signals:
            signal.signal(one, signal.SIG_IGN)
    return ignore


class Signals(Folder):
    def wait_for(self, path, run):
        for _ in range(1200):
            if path.exists() or run.poll() is not None:
                return
            time.sleep(0.05)
        self.fail(f"{path.name} does not come")

    def long_run(self, **options):
        self.case(end=LONG)
        run = self.start("run", "case.toml", **options)
        self.wait_for(self.results, run)
        return run

    def test_each_stops_with_a_checkpoint(self):
        for one in STOPPING:
            with self.subTest(signal=one.name):
                run = self.long_run()
                run.send_signal(one)
                complaint, said = self.ends(run, 130)
                self.assertIn("interrupted at step", said)
                self.assertTrue(self.checkpoint.exists())
                arrays_of(self.results)
                self.nothing_half_written()
                for path in self.folder.glob("results*"):
                    path.unlink()

    def test_goes_on_from_there(self):
        end = 4e-4
        self.case(end=end)
        wanted = self.whole_run()
        run = self.start("run", "case.toml")
        self.wait_for(self.results, run)
        run.send_signal(signal.SIGUSR1)
        run.communicate(timeout=120)
        self.assertIn(run.returncode, (0, 130))  # 0: it was faster
        if run.returncode == 130:
            self.run_case("--restart")
        self.assertEqual(self.arrays(), wanted)

    def test_ignored_stays_ignored(self):
        """nohup, and a shell's background jobs."""
        run = self.long_run(preexec_fn=ignoring(signal.SIGHUP, signal.SIGINT))
        run.send_signal(signal.SIGHUP)
        run.send_signal(signal.SIGINT)
        time.sleep(1)
        self.assertIsNone(run.poll())
        run.send_signal(signal.SIGTERM)
        self.ends(run, 130)

    def test_before_the_run(self):
        """While it reads, meshes and sets up there is nothing to keep: it ends at once, and so do commands that write
        files."""
        text = (self.folder / "case.toml").read_text()
        (self.folder / "case.toml").write_text(text.replace(*FINE).replace("end = 6e-05", f"end = {LONG}"))
        before = self.everything()
        for command in (
            ["run", "case.toml"],
            ["mesh", "case.toml"],
            ["modes", "case.toml", "--out", "modes.h5"],
            ["check", "case.toml"],
        ):
            for one in (signal.SIGTERM, signal.SIGHUP):
                with self.subTest(command=command[0], signal=one.name):
                    run = self.start(*command)
                    time.sleep(0.4)
                    run.send_signal(one)
                    complaint, said = self.ends(run, 130)
                    self.assertIn("interrupted", complaint + said)
                    self.assertEqual(self.everything(), before)

    def test_processor_time(self):
        run = self.long_run(before=limited("cpu", 2, 100))
        self.ends(run, 130)
        self.assertTrue(self.checkpoint.exists())

    def test_file_size(self):
        """`ulimit -f`: reported as a full disk is; what was written before is there, and the checkpoint."""
        self.case(end=LONG, more='[checkpoint]\ninterval = 0.2\n')
        run = self.start("run", "case.toml", before=limited("fsize", 3 << 20))
        complaint, said = self.ends(run, 1)
        self.assertIn("File too large; files there, or of this shell (ulimit -f), may not be so large", complaint)
        self.assertTrue(arrays_of(self.results))
        self.nothing_half_written()
        self.reported("file size limited (ulimit -f)", 1, complaint)


if __name__ == "__main__":
    unittest.main()
