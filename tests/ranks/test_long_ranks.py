#!/usr/bin/env python3
"""Every kind of scene on more ranks than tests/ranks/test_ranks.py takes, and stopped on four ranks and taken up on one
and on three: bit for bit the results of one process."""

import signal
import unittest

from test_ranks import KINDS, PATIENCE, Ranks, add_kinds, need_ranks, scene


class OnManyRanks(Ranks):
    """Made below: one test for each kind of scene."""


class TakenUp(Ranks):
    """The same."""


add_kinds(OnManyRanks, (4, 7))


def add_restart(name):
    def test(self):
        self.write(scene(name, 0.4))
        self.run_to_end(1)
        alone = self.kept("alone.h5")
        for ranks in (1, 3):
            run = self.start(4, "--set", "checkpoint.interval=0.02", "--overwrite")
            self.when_it_runs(run)
            run.send_signal(signal.SIGUSR1)
            said, _ = run.communicate(timeout=PATIENCE)
            self.assertIn("interrupted at step", said)
            self.assertIn("restart: goes on from", self.run_to_end(ranks, "--restart"))
            self.assert_same(alone, self.kept(f"from-4-on-{ranks}.h5"))
    setattr(TakenUp, "test_" + name, test)


for name_ in KINDS:
    add_restart(name_)

if __name__ == "__main__":
    need_ranks()
    unittest.main()
