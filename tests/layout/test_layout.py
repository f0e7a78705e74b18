#!/usr/bin/python3
"""Holds the sources to the layout: folders include one another one way only, and C++ is as .clang-format has it, within
120 columns."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

ROOT = pathlib.Path(os.environ.get("RAILWAVE_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
FOLDERS = ("kernels", "src", "tests", "benchmarks")
# What each folder's files may include besides their own; "" is src itself.
MAY_INCLUDE = {
    "kernels": (),
    "case": (),
    "mesh": ("case",),
    "model": ("case", "mesh", "kernels"),
    "solve": ("case", "mesh", "kernels", "model"),
    "output": ("case", "mesh", "kernels", "model", "solve"),
    "signal": ("case",),
    "post": ("case", "model", "output", "signal"),
    "modes": ("case", "mesh", "model", "solve", "output"),
    "": ("case", "mesh", "kernels", "model", "solve", "output", "signal", "post", "modes"),
}
CLANG_FORMAT_VERSION = 14  # Debian 12's; others break lines elsewhere


def sources(folders=FOLDERS):
    return [
        path
        for folder in folders
        for path in sorted((ROOT / folder).rglob("*"))
        if path.suffix in (".hpp", ".cpp", ".c")
    ]


def folder_of(name):
    """Of a file of kernels or src, or of what an include names."""
    parts = pathlib.PurePath(name).parts
    return parts[0] if len(parts) > 1 else ""


def clang_format():
    for name in (f"clang-format-{CLANG_FORMAT_VERSION}", "clang-format"):
        found = shutil.which(name)
        if (
            found
            and f"version {CLANG_FORMAT_VERSION}."
            in subprocess.run([found, "--version"], capture_output=True, text=True, check=True).stdout
        ):
            return found
    return None


class Layout(unittest.TestCase):
    def test_folders_include_one_way(self):
        for path in sources(("kernels", "src")):
            own = "kernels" if path.is_relative_to(ROOT / "kernels") else folder_of(path.relative_to(ROOT / "src"))
            self.assertIn(own, MAY_INCLUDE, f"{path}: say in this test what this folder may include")
            for number, line in enumerate(path.read_text().splitlines(), 1):
                included = re.match(r'\s*#\s*include\s+"([^"]+)"', line)
                if included and folder_of(included[1]) not in (own, *MAY_INCLUDE[own]):
                    self.fail(f"{path}:{number}: {own or 'src'} must not include {included[1]}")

    def test_no_line_is_longer_than_120_columns(self):
        long = [
            f"{path}:{number}"
            for path in sources()
            for number, line in enumerate(path.read_text().splitlines(), 1)
            if len(line) > 120
        ]
        self.assertEqual(long, [])

    @unittest.skipUnless(clang_format(), f"clang-format {CLANG_FORMAT_VERSION} is not here")
    def test_format(self):
        done = subprocess.run(
            [clang_format(), "--dry-run", *map(str, sources())], capture_output=True, text=True, check=False, cwd=ROOT
        )
        wrong = sorted(set(re.findall(r"^(\S+?):\d+:\d+: warning", done.stderr, re.MULTILINE)))
        self.assertEqual(wrong, [], "to mend: clang-format -i these files")
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    sys.exit(unittest.main())
