#!/usr/bin/python3
"""The study of 200 members through a Slurm array of four jobs, with controller and node on this machine, and through
Snakemake: the same table as railwave sweep alone makes. Needs scripts/setup --schedulers."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from slurm_here import Slurm, installed
from studies import PROGRAM, ROOT

STUDY = ROOT / "studies" / "rolling_grid" / "rolling_grid.toml"
MEMBERS = 200
PATIENCE = 3600  # s


class Schedulers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        cls.addClassCleanup(temporary.cleanup)
        cls.top = pathlib.Path(os.path.realpath(temporary.name))
        done = cls.sweep("alone")
        assert done.returncode == 0, done.stdout + done.stderr
        cls.alone = cls.table("alone")
        assert cls.alone.count(",completed,") == MEMBERS

    @classmethod
    def sweep(cls, folder, *options, **more):
        (cls.top / folder).mkdir(exist_ok=True)
        return subprocess.run(
            [PROGRAM, "sweep", STUDY, *options], cwd=cls.top / folder, capture_output=True, text=True, check=False,
            **more,
        )

    @classmethod
    def table(cls, folder):
        return (cls.top / folder / "results" / "rolling_grid" / "sweep.csv").read_text()

    def expect_each_run_once(self, folder):
        logs = list((self.top / folder).rglob("log.txt"))
        self.assertEqual(len(logs), MEMBERS)
        self.assertEqual({log.read_text().count("\nresults: ") for log in logs}, {1})

    @unittest.skipUnless(installed(), "slurm-wlm is not installed: scripts/setup --schedulers installs it")
    def test_slurm(self):
        slurm = Slurm(self.top / "slurm-daemons")
        self.addCleanup(slurm.stop)
        done = self.sweep("slurm", "--slurm", "4", env=slurm.environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("an array of 4 jobs for 200 members", done.stdout)
        slurm.wait_for_jobs(PATIENCE)
        said = "\n".join(path.read_text() for path in (self.top / "slurm").rglob("slurm-*.txt"))
        self.assertEqual(said.count("50 completed, 0 broke down, 0 refused, 0 unfinished"), 4, said)
        self.assertEqual(self.table("slurm"), self.alone)
        self.expect_each_run_once("slurm")
        # A processor of a job is a thread, whatever the machine has.
        for attempts in (self.top / "slurm").rglob("attempts.txt"):
            self.assertIn("began with 1 thread\n", attempts.read_text())

    @unittest.skipUnless(shutil.which("snakemake"), "snakemake is not installed: scripts/setup --schedulers does that")
    def test_snakemake(self):
        done = self.sweep("snakemake", "--snakemake")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        snakefile = self.top / "snakemake" / "results" / "rolling_grid" / "Snakefile"
        self.assertIn(str(snakefile), done.stdout)
        environment = dict(os.environ, XDG_CACHE_HOME=str(self.top / "cache"))
        run = subprocess.run(
            ["snakemake", "--snakefile", snakefile, "--cores", "2"], cwd=self.top, capture_output=True, text=True,
            check=False, env=environment, timeout=PATIENCE,
        )
        self.assertEqual(run.returncode, 0, run.stderr[-3000:])
        self.assertEqual(self.table("snakemake"), self.alone)
        self.expect_each_run_once("snakemake")


if __name__ == "__main__":
    if not installed() and not shutil.which("snakemake"):
        sys.exit(77)
    unittest.main()
