"""Options and words of the command line that nobody means: each gets an answer that says what is wrong, what is allowed
and how to mend it."""

import os
import re
import subprocess
import tempfile
import unittest

import extreme_values
from test_docs_and_program import commands

NUMBERS = ["nan", "-inf", "1e300", "10min", "0x10", "9" * 400]
POSITIVE = {
    "--wall-time",
    "--up-to",
    "--resolution",
    "--segment",
    "--scale-spacing",
    "--window-end",
    "--prominence",
    "--order",
    "--rolling-velocity",
    "--jobs",
    "--threads",
    "--slurm",
    "--ranks",
    "--instants",
    "--size",
}
NUMERIC = POSITIVE | {
    "--retries",
    "--from",
    "--to",
    "--interval",
    "--low",
    "--high",
    "--overlap",
    "--w0",
    "--ring",
    "--rolling-direction",
}
FILES = {"--csv", "--out", "--hdf5", "--nodes", "--cuts"}
WORDS = {
    "--set",
    "--part",
    "--axle",
    "--together",
    "--input",
    "--response",
    "--quantity",
    "--window",
    "--row",
    "--at",
    "--direction",
    "--channel",
    "--trend",
    "--member",
    "--members",
    "--job",
    "--units",
    "--drop",
    "--show",
}
FLAGS = {"--restart", "--keep-state", "--overwrite", "--average", "--markdown", "--schema", "--help", "--version"}
FLAGS |= {"--collect", "--dry-run", "--no-pictures", "--snakemake", "--vtkhdf"}


def answer(*words, folder=None):
    done = subprocess.run(
        [extreme_values.PROGRAM, *words],
        capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL, cwd=folder,
    )
    return done.returncode, done.stderr if done.returncode else done.stdout


class OptionMessages(unittest.TestCase):
    def refused(self, words, *expected, folder=None):
        code, said = answer(*words, folder=folder)
        with self.subTest(words=words):
            self.assertEqual(code, 2, said)
            self.assertLess(max(map(len, said.splitlines())), 600)
            self.assertNotRegex(re.sub(r"'[^']*'", "", said), r"\d{20}")
            for one in expected:
                self.assertIn(one, said)

    def test_numbers(self):
        for command, options in commands().items():
            first = ["cases/x.toml"] if command in ("run", "check", "mesh", "modes") else ["x.h5"]
            for option in options & NUMERIC:
                for value in NUMBERS + (["0", "-1", "1e-320"] if option in POSITIVE else []):
                    count = {"--ring": 2, "--rolling-direction": 3}.get(option, 1)
                    self.refused([*command.split(), *first, option, ",".join([value] * count)], option, "must be ")
                self.refused([*command.split(), *first, option + "="], option, "its value is missing")
                if count == 1:
                    self.refused([*command.split(), *first, option, ""], option, "is empty, must be ")

    def test_examples_of_the_messages_are_taken(self):
        for command, options in commands().items():
            for option in options & NUMERIC:
                count = {"--ring": 2, "--rolling-direction": 3}.get(option, 1)
                _, said = answer(*command.split(), "x.h5", option + "=" + ",".join(["x"] * count))
                example = re.search(r"such as (\S+)", said)[1]
                code, said = answer(*command.split(), "no_such_file", f"{option}={example}")
                with self.subTest(command=command, option=option, example=example):
                    self.assertEqual(code, 2)
                    self.assertIn("no_such_file", said)

    def test_every_option_is_of_a_known_kind(self):
        for command, options in commands().items():
            with self.subTest(command=command):
                self.assertEqual(
                    options - NUMERIC - FILES - WORDS - FLAGS,
                    set(),
                    "an option of numbers or files needs an entry in option_checks.cpp, and one here",
                )

    def test_files(self):
        for command, options in commands().items():
            first = ["cases/x.toml"] if command in ("run", "check", "mesh", "modes") else ["x.h5"]
            for option in options & FILES:
                self.refused([*command.split(), *first, option, ""], option, "is empty, must be the name of a file")
                self.refused([*command.split(), *first, option, "-"], option, "stands for no file")
                self.refused([*command.split(), *first, option + "="], option, "its value is missing")
            if command not in ("", "help", "reference", "signal"):
                self.refused([*command.split(), ""], "is empty")
                self.refused([*command.split(), "-"], "stands for no file", "give the name of a ")
                self.refused([*command.split()], "is missing")

    def test_commands(self):
        self.refused(["chekc", "box.toml"], "there is no command 'chekc'; did you mean 'check'?")
        self.refused(["signal", "foo"], "there is no analysis 'foo'; there are: psd, ")
        self.refused(["signal", "psdd", "x.h5"], "did you mean 'psd'?")
        self.refused(["signal"], "a kind of analysis is missing; there are: psd")
        self.refused([], "a command is missing; there are: run, ensemble, check")
        self.refused(["--vresion"], "there is no option '--vresion'; did you mean '--version'?")
        self.refused(
            ["check", "x.toml", "--sett", "time.end=1"], "check: there is no option '--sett'; did you mean '--set'?"
        )
        self.refused(["run", "x.toml", "--walltime=3"], "did you mean '--wall-time'?")
        self.refused(["check", "x.toml", "y.toml"], "'y.toml' is one word too many")
        self.refused(["run", "x.toml", "--wall-time"], "--wall-time")
        self.refused(["\x1b[31m" + "x" * 5000], "there is no command '?[31mxxx")

    def test_help(self):
        for command in commands():
            if command:
                code, said = answer("help", *command.split())
                self.assertEqual(code, 0)
                self.assertIn("Usage: railwave " + command, said)
        self.assertIn("[parts.NAME]", answer("help", "parts.mesh")[1])
        code, said = answer("help", "mesh")  # a command and a key
        self.assertIn("--out", said)
        self.assertIn("[parts.NAME]", said)
        self.refused(["help", "chekc"], "did you mean the command 'check'?")
        self.refused(["help", "hourglas"], "did you mean 'hourglass'?")
        self.refused(["help", "signal", "foo"], "there is no analysis 'foo'")

    def test_infinite_times_are_those_of_no_option(self):
        """Without --from and --to all is taken; that infinity cannot be typed is no loss."""
        with tempfile.TemporaryDirectory() as folder:
            self.refused(["contact", os.path.join(folder, "none.h5")], "none.h5")


if __name__ == "__main__":
    unittest.main()
