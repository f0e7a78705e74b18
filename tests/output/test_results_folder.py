#!/usr/bin/env python3
"""Where a case names no file its run writes into results/NAME/, a folder of its own, and tells at its end where that is
and what to type next."""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from faults import PROGRAM, SOURCE, Folder  # noqa: E402

import h5py  # noqa: E402


class ResultsFolder(Folder):
    def case(self, end=6e-6, more=""):
        super().case(end, more)
        path = self.folder / "case.toml"
        path.write_text(
            path.read_text()
            .replace('file = "results.h5"\n', "field_interval = 0\n", 1)
            .replace("field_interval = 4e-6\n", "", 1)
        )

    def run_it(self, *words, code=0):
        return self.ends(self.start(*words), code)

    def names(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*"))

    def test_a_folder_of_its_own(self):
        _, said = self.run_it("run", "case.toml", "--keep-state")
        self.assertEqual(
            self.names(),
            [
                "case.toml", "results", "results/case", "results/case/case.checkpoint.h5", "results/case/case.h5",
                "results/case/case.xdmf",
            ],
        )
        self.assertIn("results: results/case/case.h5\n", said)
        with h5py.File(self.folder / "results/case/case.h5", "r") as file:
            self.assertEqual(file.attrs["completed"], 1)
        _, said = self.run_it("mesh", "case.toml")
        self.assertTrue(said.startswith("results/case/mesh.h5 and results/case/mesh.xdmf: "), said)
        self.run_it("run", "case.toml")
        self.run_it("mesh", "case.toml")

    def test_next_commands_work(self):
        """Every command that the end of a run names, typed as it stands."""
        _, said = self.run_it("run", "case.toml")
        commands = re.findall(r"^  (\S.*?)  # ", said[said.index("\nnext:\n"):], re.MULTILINE)
        can_report = (SOURCE / "build/report/report.html").exists()
        first = ["railwave"] if can_report else []
        self.assertEqual(
            [shlex.split(command)[0] for command in commands], [*first, "scripts/picture", "railwave", "paraview"]
        )
        for command in commands:
            words = shlex.split(command)
            self.assertTrue((self.folder / words[-1]).exists(), command)
            if words[0] == "paraview":
                continue
            words = (
                [PROGRAM, *words[1:]]
                if words[0] == "railwave"
                else [sys.executable, SOURCE / words[0], *words[1:], "--program", PROGRAM]
            )
            done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue((self.folder / "results/case/case-energies.png").exists())
        self.assertEqual([name for name in self.names() if "/" not in name], ["case.toml", "results"])

    def test_a_run_that_is_to_go_on(self):
        self.case(end=0.3)
        _, said = self.run_it("run", "case.toml", "--wall-time", "0.3", code=4)
        self.assertIn("railwave run case.toml --restart", said)
        complaint, _ = self.run_it("run", "case.toml", code=2)
        self.assertIn("results/case/case.h5 holds a run that has not ended", complaint)
        _, said = self.run_it("check", "case.toml")
        self.assertIn(
            "note: 'railwave run' would refuse: output.file: results/case/case.h5 holds a run that has not ended", said
        )
        _, said = self.run_it("run", "case.toml", "--restart", "--wall-time", "0.5", code=4)
        self.assertIn("restart: goes on from results/case/case.checkpoint.h5", said)

    def test_from_another_folder(self):
        (self.folder / "cases").mkdir()
        (self.folder / "case.toml").rename(self.folder / "cases" / "two words.toml")
        _, said = self.run_it("run", "cases/two words.toml")
        self.assertIn("results: results/two words/two words.h5\n", said)
        self.assertIn("railwave contact 'results/two words/two words.h5'", said)
        self.assertTrue((self.folder / "results/two words/two words.h5").exists())

    def test_nothing_is_made_where_nothing_is_run(self):
        self.run_it("check", "case.toml")
        self.assertEqual(self.names(), ["case.toml"])
        self.run_it("run", "case.toml", "--restart", code=2)
        self.assertEqual(self.names(), ["case.toml"])
        (self.folder / "results").write_text("a file of that name")
        for words in (["run", "case.toml"], ["check", "case.toml"], ["mesh", "case.toml"]):
            complaint, _ = self.run_it(*words, code=2)
            self.assertIn("goes to results, which is text that begins with 'a file of that name'", complaint)
        self.assertEqual(self.names(), ["case.toml", "results"])

    def test_two_cases_of_one_name(self):
        (self.folder / "other").mkdir()
        (self.folder / "other" / "case.toml").write_text((self.folder / "case.toml").read_text())
        self.run_it("run", "case.toml")
        before = (self.folder / "results/case/case.h5").read_bytes()
        complaint, _ = self.run_it("run", "other/case.toml", code=2)
        self.assertIn("results/case/case.h5 holds the results of another case, case.toml", complaint)
        self.assertEqual((self.folder / "results/case/case.h5").read_bytes(), before)
        self.run_it("run", "other/case.toml", "--set", "output.file=other/case.h5")
        self.run_it("run", str(self.folder / "case.toml"))  # the same by another path
        self.run_it("run", "other/case.toml", "--overwrite")

    def test_a_named_file_is_where_it_says(self):
        complaint, _ = self.run_it("run", "case.toml", "--set", "output.file=nowhere/a.h5", code=2)
        self.assertIn("nowhere/a.h5 goes to nowhere, but there is no folder of that name", complaint)
        self.run_it("run", "case.toml", "--set", "output.file=a.h5")
        self.assertEqual(self.names(), ["a.h5", "a.xdmf", "case.toml"])
        complaint, _ = self.run_it("run", "case.toml", "--set", 'output.file=""', code=2)
        self.assertIn("[output] file: is empty", complaint)
        complaint, _ = self.run_it("mesh", "case.toml", "--out", "", code=2)
        self.assertIn("--out: is empty, must be the name of a file", complaint)

    def test_the_projects_cases_use_it(self):
        for path in [*SOURCE.glob("cases/*.toml"), *SOURCE.glob("cases/verify/*.toml")]:
            self.assertNotRegex(path.read_text(), r"(?m)^\s*file\s*=.*\.h5", path.name)


if __name__ == "__main__":
    unittest.main()
