"""Types what a page of docs says, docs/first-steps.md unless a test names another, in a folder of its own: blocks
marked sh are commands, blocks marked python or toml are files whose name is their first line."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ.get("RAILWAVE_SOURCE_DIR", os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..")))
BIN = os.environ.get("RAILWAVE_BIN_DIR") or os.path.join(SOURCE, "build", "release", "bin")
PAGE = os.path.join(SOURCE, "docs", "first-steps.md")


def sections(path=PAGE):
    """Blocks of each section by its heading: (language, text) in their order."""
    with open(path, encoding="utf-8") as file:
        parts = re.split(r"^## (.+)$", file.read(), flags=re.MULTILINE)
    return {
        title.strip(): re.findall(r"^```(\w+)\n(.*?)^```$", text, flags=re.MULTILINE | re.DOTALL)
        for title, text in zip(parts[1::2], parts[2::2])
    }


class Desk:
    """A copy of what a user needs of the repository, with the built programs in build/release/bin."""

    def __init__(self, page=PAGE):
        self.page = page
        self._folder = tempfile.TemporaryDirectory(prefix="railwave-first-steps-")
        self.folder = os.path.join(self._folder.name, "railwave")
        shutil.copytree(
            os.path.join(SOURCE, "scripts"),
            os.path.join(self.folder, "scripts"),
            ignore=shutil.ignore_patterns("__pycache__"),
        )
        os.makedirs(os.path.join(self.folder, "cases"))
        shutil.copy(os.path.join(SOURCE, "cases", "first_steps.toml"), os.path.join(self.folder, "cases"))
        shutil.copytree(os.path.join(SOURCE, "cases", "own_mesh"), os.path.join(self.folder, "cases", "own_mesh"))
        os.makedirs(os.path.join(self.folder, "build", "release"))
        os.symlink(BIN, os.path.join(self.folder, "build", "release", "bin"))
        self._nothing_to_install()
        self._with_this_python()
        tools = os.path.join(self._folder.name, "tools")
        os.makedirs(tools)
        # No link: a virtual environment's Python knows its modules by the folder that it is called from.
        with open(os.path.join(tools, "python3"), "w", encoding="utf-8") as file:
            file.write(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
        os.chmod(os.path.join(tools, "python3"), 0o755)
        # One thread: models of some hundred elements gain nothing from a second, and wait for it where the machine is
        # busy.
        self.environment = dict(
            os.environ, OMP_NUM_THREADS="1",
            PATH=os.pathsep.join([tools, BIN, os.environ.get("PATH", "/usr/bin:/bin")]), MPLCONFIGDIR=self._folder.name,
        )

    def _nothing_to_install(self):
        """scripts/run as it is, but for setting the machine up and building: both are done where tests run."""
        with open(os.path.join(self.folder, "scripts", "setup"), "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\n")
        with open(os.path.join(self.folder, "scripts", "lib", "common.sh"), "a", encoding="utf-8") as file:
            file.write("\nbuild_preset() { :; }\n")

    def _with_this_python(self):
        """Scripts begin with Debian's own Python; on another system that need not have the modules."""
        for folder, _, names in os.walk(os.path.join(self.folder, "scripts")):
            for name in names:
                path = os.path.join(folder, name)
                with open(path, encoding="utf-8") as file:
                    text = file.read()
                if text.startswith("#!/usr/bin/python3\n"):
                    with open(path, "w", encoding="utf-8") as file:
                        file.write(text.replace("/usr/bin/python3", sys.executable, 1))

    def type(self, section, ends=(0,)):
        """All blocks of a section. Returns what they print; throws AssertionError when a command ends with another code
        than `ends`."""
        said = ""
        for language, text in sections(self.page)[section]:
            named = re.match(r"# (\S+\.(py|toml))\n", text)
            if language == "python" or (language == "toml" and named):
                with open(self.path(named.group(1)), "w", encoding="utf-8") as file:
                    file.write(text)
            elif language == "sh":
                said += self.command(text, ends)
        return said

    def command(self, text, ends=(0,)):
        allowed = " ".join(f'[ "$code" -eq {code} ] ||' for code in ends)
        script = f"set -u; trap 'code=$?; {allowed} exit $code' ERR\n{text}\n"
        done = subprocess.run(
            ["bash", "-c", script], cwd=self.folder, env=self.environment, capture_output=True, text=True, check=False
        )
        assert (
            done.returncode in ends
        ), f"{text}\nended with {done.returncode}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}"
        return done.stdout + done.stderr

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def close(self):
        self._folder.cleanup()


class DeskTest(unittest.TestCase):
    """Tests that type at one desk, beside whose results/ nothing is left but `made`."""

    made = set()
    page = PAGE

    @classmethod
    def setUpClass(cls):
        cls.desk = Desk(cls.page)
        cls.addClassCleanup(cls.desk.close)
        cls.before = set(os.listdir(cls.desk.folder))

    @classmethod
    def tearDownClass(cls):
        more = set(os.listdir(cls.desk.folder)) - cls.before - {"results"} - cls.made
        assert not more, f"beside results/ lie {more}"
