#!/usr/bin/python3
"""Holds the sources to scripts/dev/check_layout, and that script to finding each fault that it names: a made-up folder
without a fault passes, and with one fault does not."""
import importlib.machinery
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(os.environ.get("RAILWAVE_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
SCRIPT = ROOT / "scripts" / "dev" / "check_layout"


def loaded():
    loader = importlib.machinery.SourceFileLoader("check_layout", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_layout", loader))
    loader.exec_module(module)
    return module


RULES = loaded()


def check(folder):
    return subprocess.run([sys.executable, "-B", SCRIPT, folder], capture_output=True, text=True, check=False)


class Sources(unittest.TestCase):
    def test_layout(self):
        done = check(ROOT)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


class MadeUp(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        shutil.copy(ROOT / ".clang-format", self.folder)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def assert_faults(self, *wanted):
        """Each fault begins with its place and says what it is."""
        done = check(self.folder)
        said = done.stdout.splitlines()
        self.assertEqual(len(said), len(wanted), done.stdout + done.stderr)
        for line, (place, what) in zip(said, wanted):
            self.assertTrue(line.startswith(place + ": "), line)
            self.assertIn(what, line)
        self.assertEqual(done.returncode, 1 if wanted else 0, done.stderr)

    def test_a_sound_folder_passes(self):
        self.write("src/mesh/tread.cpp", '#include "case/rail.hpp"\n')
        self.write("src/case/rail.hpp", "#include <vector>\n")
        self.write("kernels/support/lanes.hpp", "#include <Kokkos_Core.hpp>\n#include \"kernels/support/team.hpp\"\n")
        self.write("scripts/run", "#!/usr/bin/env bash\n" + "#" * 120 + "\n")
        self.write("README.md", "long " * 100)
        self.write("build/generated.cpp", "//" + "-" * 200)
        self.write(".unpacked/library/header.hpp", "//" + "-" * 200)
        self.assert_faults()
        self.write(".ci/run", "#!/usr/bin/env bash\n" + "#" * 121 + "\n")
        self.assert_faults((".ci/run:2", "121 columns"))

    def test_long_lines(self):
        # As characters, not as bytes.
        self.write("tests/case/test_rail.py", "#" + "\N{GREEK SMALL LETTER MU}" * 119 + "\n")
        self.assert_faults()
        for name in ("src/rail.cpp", "src/rail.hpp", "tests/case/test_rail.py", "scripts/lib/rail.sh"):
            with self.subTest(name):
                start = "// " if name.startswith("src") else "# "
                self.write(name, "\n" + start + "-" * 121 + "\n")
                done = check(self.folder)
                self.assertEqual(done.returncode, 1)
                self.assertIn(f"{name}:2: the line has {121 + len(start)} columns", done.stdout)
                (self.folder / name).unlink()
        for shell in ("/usr/bin/env bash", "/bin/sh", "/usr/bin/python3"):
            with self.subTest(shell):
                self.write("scripts/rail", f"#!{shell}\n" + "#" * 121 + "\n")
                self.assert_faults(("scripts/rail:2", "121 columns"))

    def test_includes_against_the_order(self):
        self.write("src/mesh/tread.cpp", '#include "case/rail.hpp"\n#include "model/wheel.hpp"\n')
        self.assert_faults(("src/mesh/tread.cpp:2", "mesh includes model/wheel.hpp"))
        self.write("src/mesh/tread.cpp", "")
        self.write("kernels/support/lanes.hpp", '#include "model/wheel.hpp"\n')
        self.assert_faults(("kernels/support/lanes.hpp:1", "kernels includes model/wheel.hpp"))
        self.write("kernels/support/lanes.hpp", "")
        self.write("src/case/rail.hpp", "#include <Kokkos_Core.hpp>\n")
        self.assert_faults(("src/case/rail.hpp:1", "case knows nothing of Kokkos"))
        self.write("src/case/rail.hpp", "")
        self.write("src/sleeper/pad.hpp", "")
        self.assert_faults(("src/sleeper/pad.hpp", "no row in MAY_INCLUDE"))

    def test_names_twice(self):
        self.write("src/model/rail.hpp", "")
        self.write("kernels/rail.hpp", "")
        self.assert_faults(("kernels/rail.hpp and src/model/rail.hpp", "files of one name"))

    def test_too_many_short_files(self):
        for number in range(RULES.MOST_SHORT_FILES):
            self.write(f"src/model/part_{number}.hpp", "#pragma once\n")
        self.write("src/model/long.hpp", "#pragma once\n" * RULES.SHORT)
        self.assert_faults()
        self.write("src/model/long.hpp", "#pragma once\n" * (RULES.SHORT - 1))
        self.assert_faults(("src and kernels", f"{RULES.MOST_SHORT_FILES + 1} files have less than"))

    @unittest.skipUnless(RULES.clang_format(), f"clang-format {RULES.CLANG_FORMAT_VERSION} is not here")
    def test_format(self):
        self.write("src/rail.cpp", "int  rail;\n")
        self.assert_faults(("src/rail.cpp", "is not as .clang-format has it"))


class Order(unittest.TestCase):
    def test_the_table_goes_one_way(self):
        self.addCleanup(RULES.MAY_INCLUDE.update, case=RULES.MAY_INCLUDE["case"])
        RULES.MAY_INCLUDE["case"] = ("solve",)
        (fault,) = RULES.includes_against_the_order(ROOT, [])
        self.assertIn("'case' may include 'solve'", fault)


if __name__ == "__main__":
    sys.exit(unittest.main())
