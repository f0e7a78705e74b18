#!/usr/bin/env python3
"""A rank that is given too little memory, from its beginning or in the middle of its steps, ends all of them soon and
says so; a checkpoint that there was is good."""

import os
import pathlib
import resource
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from test_ranks import Ranks, need_ranks, scene  # noqa: E402
from faults import sanitized  # noqa: E402, of tests/output, where test_ranks looks too

sys.path.insert(0, str(pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"]) / "scripts"))
from rank_runs import bar  # noqa: E402

MOST_SECONDS = 30
# Of address space, in MB: too little for MPI, for the mesh, for the elements, for the step's search, and enough.
LIMITS = (60, 110, 150, 190, 205, 1000)


@unittest.skipIf(sanitized(), "sanitizers take address space of their own")
class OutOfMemory(Ranks):
    def assert_ended_soon(self, run, began, rank):
        said, _ = run.communicate(timeout=4 * MOST_SECONDS)
        self.assertLess(time.monotonic() - began, MOST_SECONDS, said)
        self.assertNotEqual(run.returncode, 0, said)
        self.assertRegex(said, rf"(?m)^railwave: rank {rank}: .*memory")

    def test_little_memory_from_the_beginning(self):
        """Whatever the limit, a run ends well or says which rank had too little."""
        self.write(bar(1.2e5, 15))
        (self.folder / "limited.sh").write_text(
            '#!/bin/sh\n[ "$OMPI_COMM_WORLD_RANK" = "$1" ] && ulimit -v "$2"\nshift 2\nexec "$@"\n')
        self.run_to_end(1, "--set", "output.file=results.h5")
        alone = self.kept("alone.h5")
        for rank in (0, 1):
            ends = []
            for limit in LIMITS:
                with self.subTest(rank=rank, limit=limit):
                    began = time.monotonic()
                    run = self.start(3, "--overwrite", "--set", "output.file=results.h5",
                                     wrapper=["sh", "limited.sh", str(rank), str(1000 * limit)])
                    said, _ = run.communicate(timeout=4 * MOST_SECONDS)
                    self.assertLess(time.monotonic() - began, MOST_SECONDS, said)
                    ends.append(run.returncode)
                    if run.returncode == 0:
                        self.assert_same(alone, self.kept(f"{rank}-{limit}.h5"))
                        continue
                    self.assertRegex(said, rf"(?m)^railwave: rank {rank}: .*memory")
            self.assertNotEqual(ends[0], 0)
            self.assertEqual(ends[-1], 0)

    def give_nothing_more(self, run, rank):
        """@return when"""
        resource.prlimit(self.others(run)[rank], resource.RLIMIT_AS, (1 << 20, resource.RLIM_INFINITY))
        return time.monotonic()

    def test_rank_0_in_the_loop(self):
        """It needs memory again and again, to write."""
        self.write(scene("penalty", field_interval=1e-5))
        run = self.start(3, "--set", "checkpoint.interval=0.02", "--set", "time.end=1")
        self.when_it_runs(run)
        self.assert_ended_soon(run, self.give_nothing_more(run, 0), 0)
        self.assertTrue(self.checkpoint.exists())
        self.assertIn("restart: goes on from", self.run_to_end(2, "--restart", "--set", "time.end=1",
                                                               "--wall-time", "2", code=4))

    def test_another_rank_in_the_loop(self):
        """Its steps need none; the first time that rank 0 wants its state does."""
        self.write(bar(1.2e5, 1e6))
        run = self.start(3, "--set", "output.file=results.h5", "--set", "checkpoint.interval=4")
        while not self.results.exists() and run.poll() is None:
            time.sleep(0.005)
        time.sleep(1)  # the first steps have been taken
        self.assert_ended_soon(run, self.give_nothing_more(run, 1), 1)


if __name__ == "__main__":
    need_ranks()
    unittest.main()
