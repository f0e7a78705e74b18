#!/usr/bin/env python3
"""What an ensemble writes: one member's file that cannot be written ends no other, and nobody's files are lost."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from faults import Folder, limited  # noqa: E402

import h5py  # noqa: E402

SHORT = 1e-5  # s


class Ensemble(Folder):
    def setUp(self):
        super().setUp()
        self.case(end=SHORT)

    def ensemble(self, *members, code=0, more=(), **how):
        words = [word for member in members for word in ("--member", *member)]
        return self.ends(self.start("ensemble", "case.toml", *words, *more, **how), code)

    def completed(self, name):
        with h5py.File(self.folder / name, "r") as file:
            return bool(file.attrs["completed"])

    def test_one_that_cannot_write_ends_no_other(self):
        # Both run for a second, in which the first one's file becomes too large.
        many = ("output.file=a.h5", "time.end=2e-3", "output.field_interval=1e-6")
        few = ("output.file=b.h5", "time.end=2e-3", "output.field_interval=2e-3", "output.history_interval=1e-4")
        _, said = self.ensemble(many, few, code=1, before=limited("fsize", 800_000))
        self.assertIn("member 1, a.h5: failed", said)
        self.assertIn("member 2, b.h5: completed", said)
        self.assertTrue(self.completed("b.h5"))

    def test_logs_replace_nobodys_files(self):
        (self.folder / "a.log").write_text("somebody's")
        complaint, _ = self.ensemble(("output.file=a.h5",), code=2)
        self.assertIn("a.log", complaint)
        self.assertEqual((self.folder / "a.log").read_text(), "somebody's")
        self.ensemble(("output.file=a.h5",), more=("--overwrite",))
        self.assertIn("whose results are a.h5", (self.folder / "a.log").read_text())
        self.ensemble(("output.file=a.h5",))  # its own it replaces

    def test_a_log_is_neither_the_case_nor_the_results(self):
        case = (self.folder / "case.toml").read_text()
        (self.folder / "c.log").write_text(case)
        run = self.start("ensemble", "c.log", "--member", "output.file=c.h5", "--overwrite")
        complaint, _ = self.ends(run, 2)
        self.assertIn("the case file", complaint)
        self.assertEqual((self.folder / "c.log").read_text(), case)
        self.ensemble(("output.file=d.log",), code=2)
        self.assertFalse((self.folder / "d.log").exists())
        complaint, _ = self.ensemble(("output.file=a.h5",), ("output.file=a.hdf5",), code=2)
        self.assertIn("member 2 of the ensemble", complaint)

    def test_a_mistake_that_models_reveal(self):
        self.ensemble(("output.file=a.h5",))
        before = self.everything()
        for wrong in ('output.history_sets=["upper.z_nax"]', "time.step=1"):
            complaint, _ = self.ensemble(("output.file=a.h5",), ("output.file=b.h5", wrong), code=2)
            self.assertIn("member 2 of the ensemble: ", complaint)
            self.assertEqual(self.everything(), before)

    def test_no_checkpoints_are_written_or_wanted(self):
        self.case(end=SHORT, more='[checkpoint]\nfile = "state.h5"\n')
        self.ensemble(("output.file=a.h5",), ("output.file=b.h5",))
        self.assertTrue(self.completed("a.h5") and self.completed("b.h5"))
        self.assertFalse((self.folder / "state.h5").exists())
        complaint, _ = self.ends(self.start("run", "case.toml", "--restart", "--set", "output.file=a.h5"), 2)
        self.assertIn("those of an ensemble's member, whose state is not kept", complaint)

    def test_blanks_around_a_key(self):
        self.ensemble(("output.file = a.h5",))
        self.assertTrue(self.completed("a.h5"))
        self.assertFalse((self.folder / "results").exists())


if __name__ == "__main__":
    unittest.main()
