#!/usr/bin/env python3
"""Too little memory, a damaged checkpoint, a clock that jumps, a kill: each is reported, with the exit code, and
nothing that was there is lost."""

import concurrent.futures
import pathlib
import signal
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from faults import LONG, Folder, arrays_of, limited, sanitized  # noqa: E402


@unittest.skipIf(sanitized(), "the address space can't be limited under a sanitizer")
class Memory(Folder):
    def test_too_large(self):
        """Whatever it is that finds no memory before a run begins: a message, no abort, and older results stay. With
        less the mesh is refused by its size, with more the run begins."""
        self.run_case()
        before = self.everything()
        text = (self.folder / "case.toml").read_text()
        (self.folder / "large.toml").write_text(text.replace("divisions = [3, 3, 2]", "divisions = [60, 60, 60]"))
        reported = 0
        for megabytes in range(100, 3200, 25):
            with self.subTest(megabytes=megabytes):
                run = self.start("run", "large.toml", before=limited("as", megabytes << 20))
                begun = run.stdout.readline()  # a line of the settings comes when all is built
                if "step" in begun:
                    run.kill()
                    break
                said, complaint = run.communicate(timeout=60)
                if run.returncode == 2:
                    self.assertIn("need about", complaint)
                elif run.returncode != 127:
                    self.assertEqual(run.returncode, 1, complaint)
                    self.assertRegex(
                        complaint,
                        r"(?m)^railwave: out of memory: .*; this machine has .*, this process may take .*; take a"
                        r" coarser mesh",
                    )
                    self.reported("out of memory", 1, complaint)
                    reported += 1
                self.assertEqual({**self.everything(), "large.toml": ""}, {**before, "large.toml": ""})
        self.assertGreater(reported, 0, "memory was never short")

    hangs = False

    def test_at_any_moment(self):
        """Every limit in steps of 1 MB, from the smallest in which the program starts to where the run comes to its
        end: it neither hangs nor aborts nor crashes, leaves no half-written file, and what it leaves can be read; at
        its end all is there."""
        wanted = self.whole_run()
        with concurrent.futures.ThreadPoolExecutor(4) as several:
            ends = list(several.map(self.run_within, range(34, 121)))
        for megabytes, code, complaint, arrays, half_written in ends:
            with self.subTest(megabytes=megabytes):
                if code == 127 or "error while loading shared libraries" in complaint:
                    continue  # the system's loader had too little
                self.assertIn(code, (0, 1), complaint)
                self.assertEqual(half_written, [])
                if code == 0:
                    self.assertEqual(arrays, wanted)
                else:
                    self.assertRegex(complaint, r"(?m)^railwave: ")
        larger = iter((200, 400, 800, 1600, 3200))  # libraries of other systems and of GPUs take more
        while ends[-1][1] not in (0, "it hangs"):
            ends.append(self.run_within(next(larger)))
        self.assertEqual(ends[-1][1], 0, ends[-1][2])
        self.assertEqual(ends[-1][3], wanted)

    def run_within(self, megabytes):
        """(megabytes, exit code, what it said on stderr, the arrays of its results, files without names) in a folder of
        its own."""
        if self.hangs:
            return megabytes, 1, "railwave: not run, after one that hangs", {}, []
        folder = self.folder / str(megabytes)
        folder.mkdir()
        (folder / "case.toml").write_text((self.folder / "case.toml").read_text())
        run = self.start("run", "case.toml", cwd=folder, before=limited("as", megabytes << 20))
        try:
            said, complaint = run.communicate(timeout=60)
        except subprocess.TimeoutExpired:
            run.kill()
            self.hangs = True
            return megabytes, "it hangs", run.communicate()[1], {}, []
        found = arrays_of(folder / "results.h5") if (folder / "results.h5").exists() else {}
        return (
            megabytes,
            run.returncode,
            complaint,
            found,
            [path.name for path in folder.iterdir() if ".new" in path.name],
        )


class DamagedCheckpoint(Folder):
    def test_each_kind(self):
        """No checkpoint of use: refused, and nothing is touched. test_checkpoint_file.cpp has thousands of damages."""
        self.run_case("--keep-state")
        sound = self.checkpoint.read_bytes()
        middle = len(sound) // 2
        kinds = {
            "a flipped bit": (
                sound[:middle] + bytes([sound[middle] ^ 8]) + sound[middle + 1 :],
                "its checksum is not that of what it holds",
            ),
            "cut off": (sound[:middle], "it is not whole"),
            "empty": (b"", "it is not whole"),
            "zeros": (bytes(len(sound)), "it is not whole"),
            "another program's file": (b"\x7fELF" + bytes(5000), "it is not whole, or no file of this version"),
        }
        for kind, (content, why) in kinds.items():
            with self.subTest(kind=kind):
                self.checkpoint.write_bytes(content)
                before = self.everything()
                complaint, _ = self.run_case("--restart", "--set", "time.end=1e-4", code=2)
                self.assertIn(why, complaint)
                self.assertEqual(self.everything(), before)
                self.reported("checkpoint damaged, no previous one: " + kind, 2, complaint)
        self.checkpoint.write_bytes(sound)
        self.run_case("--restart", "--set", "time.end=1e-4")

    def test_results_damaged(self):
        self.run_case("--keep-state")
        self.results.write_bytes(self.results.read_bytes()[:1000])
        before = self.everything()
        complaint, _ = self.run_case("--restart", "--set", "time.end=1e-4", code=2)
        self.assertIn("the results results.h5 cannot be added to", complaint)
        self.assertEqual(self.everything(), before)
        self.reported("results damaged: --restart", 2, complaint)


class Clock(Folder):
    def test_jumps(self):
        """The clock on the wall jumps a year at every other look: intervals, wall time and results are as without."""
        wanted = self.whole_run()
        for jump in (31536000, -31536000):
            self.run_case("--wall-time", "100", "--set", "checkpoint.interval=50", faults=dict(clock=jump))
            self.assertEqual(self.arrays(), wanted)
        self.case(end=LONG)
        complaint, said = self.run_case("--wall-time", "1", code=4, faults=dict(clock=31536000))
        self.assertIn("the wall time is spent", said)
        self.reported(
            "clock jumps by a year", 0, "nothing: intervals and wall time are measured by a clock that does not jump"
        )


class Kill(Folder):
    def settling_for_long(self):
        self.case(more='[settle]\nmethod = "relaxation"\ntolerance = 1e-14\nmax_steps = 100000000\n')
        text = (self.folder / "case.toml").read_text().replace("0.02001]", "0.02]")
        text = text.replace("divisions = [3, 3, 2]", "divisions = [40, 40, 24]")
        (self.folder / "case.toml").write_text(text + "[gravity]\nacceleration = [0, 0, -9.81]\n")

    def test_wall_time_spent_while_settling(self):
        self.settling_for_long()
        complaint, said = self.run_case("--wall-time", "2", code=4)
        self.assertIn("the wall time was spent while the scene settled; how far it came is kept", said)
        self.assertEqual(len(list(self.folder.glob("settled-*.h5"))), 1)
        self.nothing_half_written()
        self.reported("wall time spent while the scene settles", 4, said)

    def test_interrupted_while_settling(self):
        self.settling_for_long()
        run = self.start("run", "case.toml")
        import time
        time.sleep(3)
        run.send_signal(signal.SIGTERM)
        complaint, said = self.ends(run, 130)
        self.assertIn("interrupted while the scene settled; how far it came is kept", said)
        self.assertEqual(len(list(self.folder.glob("settled-*.h5"))), 1)
        self.nothing_half_written()
        complaint, _ = self.run_case("--restart", code=2)
        self.assertIn("run the case without --restart", complaint)
        self.reported("--restart of a run that was interrupted while it settled", 2, complaint)


if __name__ == "__main__":
    unittest.main()
