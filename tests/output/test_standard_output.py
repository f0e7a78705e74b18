#!/usr/bin/env python3
"""What goes to standard output gets there or is missed: a full disk, a reader that has gone, a descriptor that was
closed at the start."""

import errno
import os
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from faults import PROGRAM, SOURCE, Folder, between  # noqa: E402

LOST = "railwave: not all that was to go to standard output got there: "
CHANNEL = ["--channel", "contact.between.normal_force.z"]
COMMANDS = [
    ["--help"],
    ["--version"],
    ["run", "--help"],
    ["help"],
    ["help", "parts"],
    ["reference", "--schema"],
    ["reference", "--markdown"],
    ["check", "case.toml"],
    ["mesh", "case.toml", "--out", "mesh.h5"],
    ["modes", "case.toml", "--up-to", "100000"],
    ["contact", "results.h5"],
    ["signal", "psd", "results.h5", *CHANNEL],
    ["run", "case.toml", "--set", "output.file=again.h5"],
]


class StandardOutput(Folder):
    def setUp(self):
        super().setUp()
        self.run_case()
        for made in ("again", "mesh"):  # so that no command is the first to make its file
            self.addCleanup((self.folder / f"{made}.h5").unlink, missing_ok=True)

    def remove_made(self):
        for made in ("again", "mesh"):
            for path in self.folder.glob(f"{made}.*"):
                path.unlink()

    def test_disk_full(self):
        for why, reason in (
            (errno.ENOSPC, "No space left on device; free some space there"),
            (errno.EIO, "Input/output error"),
        ):
            for command in COMMANDS:
                with self.subTest(command=command, why=why):
                    self.remove_made()
                    with open(self.folder / "said.txt", "wb") as said:
                        run = self.start(*command, stdout=said, faults=dict(fail=1, only="said.txt", errno=why))
                        complaint = run.communicate(timeout=120)[1]
                    self.assertEqual(run.returncode, 1, complaint)
                    self.assertIn(LOST + reason, complaint)
                    self.assertEqual((self.folder / "said.txt").read_bytes(), b"")
                    if why == errno.ENOSPC and command[0] == "contact":
                        self.reported("disk full: standard output of any command", 1, complaint)
        self.assertTrue((self.folder / "again.h5").exists(), "a run goes on to its end")

    def test_nobody_reads(self):
        """As `| head`: silence, and the exit code of the work."""
        for command in COMMANDS:
            with self.subTest(command=command):
                self.remove_made()
                reads, writes = os.pipe()
                os.close(reads)
                run = self.start(*command, stdout=writes)
                os.close(writes)
                complaint = run.communicate(timeout=120)[1]
                self.assertEqual((run.returncode, complaint), (0, ""))
        self.assertTrue((self.folder / "again.h5").exists())

    def test_first_lines_only(self):
        text = subprocess.run(
            f"'{PROGRAM}' reference --markdown | head -n 1; exit ${{PIPESTATUS[0]}}", shell=True,
            executable="/bin/bash", cwd=self.folder, capture_output=True, text=True, check=False,
        )
        self.assertEqual((text.returncode, text.stderr, text.stdout.count("\n")), (0, "", 1))

    def test_closed_at_the_start(self):
        """No file takes the number of a standard descriptor, so nothing is written into it."""
        wanted = self.arrays()
        for closed in ((1,), (1, 2), (0, 1, 2), (0,), (2,)):
            with self.subTest(closed=closed):
                for path in self.folder.glob("results*"):
                    path.unlink()
                run = self.start("run", "case.toml", preexec_fn=lambda: [os.close(number) for number in closed])
                said, complaint = run.communicate(timeout=120)
                # What was to be said on standard output is lost, as on a full disk.
                self.assertEqual(run.returncode, 1 if 1 in closed else 0, complaint)
                self.assertEqual(LOST + "Bad file descriptor" in complaint, 1 in closed and 2 not in closed)
                self.assertEqual(self.arrays(), wanted)

    def test_scripts(self):
        """Python's own ways are a traceback, and status 120."""
        def close(command, **options):
            reads, writes = os.pipe()
            os.close(reads)
            run = subprocess.Popen(
                command, stdout=writes, stderr=subprocess.PIPE, text=True, cwd=self.folder, **options
            )
            os.close(writes)
            complaint = run.communicate(timeout=300)[1]
            return run.returncode, complaint
        self.ends(self.start("mesh", "case.toml", "--out", "mesh.h5"), 0)
        self.assertEqual(close([sys.executable, "-B", SOURCE / "scripts" / "picture", "--mesh", "mesh.h5"]), (0, ""))
        self.assertTrue(list(self.folder.glob("*.png")))
        scripts = [
            path
            for path in sorted((SOURCE / "scripts").iterdir())
            if path.is_file() and path.read_bytes().startswith(b"#!/usr/bin/python3")
        ]
        self.assertGreater(len(scripts), 10)
        for script in scripts:
            with self.subTest(script=script.name):
                self.assertEqual(close([sys.executable, "-B", script, "--help"]), (0, ""))
        environment = dict(
            os.environ, FAULTY_FOLDER=str(self.folder), FAULTY_FAIL="1", FAULTY_ONLY="said.txt",
            LD_PRELOAD=str(between("faulty_disk")),
        )
        with open(self.folder / "said.txt", "wb") as said:
            run = subprocess.run(
                [sys.executable, "-B", SOURCE / "scripts" / "picture", "--help"],
                stdout=said, stderr=subprocess.PIPE, text=True, env=environment, cwd=self.folder, check=False,
            )
        self.assertEqual(
            (run.returncode, run.stderr),
            (1, "picture: not all that was to go to standard output got there: No space left on device\n"),
        )


if __name__ == "__main__":
    unittest.main()
