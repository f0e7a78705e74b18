#!/usr/bin/env python3
"""Numbers of threads, devices and sizes of stacks that users set in their environment: what cannot be is refused with a
message, and nothing ends by a signal."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    from faults import CASE, PROGRAM, limited, sanitized, thread_sanitized
except SystemExit:
    sys.exit(77)

REFUSED = {
    "OMP_NUM_THREADS": [
        "700", "513", "0", "-1", "abc", "1000000", "99999999999999999999", "2.5", "4,", "4,0", "4,x", "0x10", "1e3",
    ],
    "KOKKOS_NUM_THREADS": ["700", "1000000", "0", "-1", "abc", "4,2", "2.5"],
    "OMP_STACKSIZE": ["1", "16", "16k", "100B", "0", "-1", "abc", "M", "8X", "1000000G"],
    "GOMP_STACKSIZE": ["16"],
    "KOKKOS_DEVICE_ID": ["-1", "abc", "1.5", "99999999999"],
    "KOKKOS_NUM_DEVICES": ["0", "abc"],
    "KOKKOS_RAND_DEVICES": ["0", "x"],
    "KOKKOS_SKIP_DEVICE": ["x"],
}
TAKEN = [
    {"OMP_NUM_THREADS": "3"},
    {"OMP_NUM_THREADS": "2,4"},
    {"OMP_NUM_THREADS": " 2 "},
    {"OMP_NUM_THREADS": ""},
    {"KOKKOS_NUM_THREADS": "3"},
    {"KOKKOS_NUM_THREADS": ""},
    {"KOKKOS_DEVICE_ID": ""},
    {"OMP_STACKSIZE": "512"},
    {"OMP_STACKSIZE": "2 M"},
    {"OMP_THREAD_LIMIT": "1"},
    {"OMP_DYNAMIC": "true"},
    {"OMP_MAX_ACTIVE_LEVELS": "0"},
]


@unittest.skipIf(thread_sanitized(), "ThreadSanitizer takes the barriers of GNU's OpenMP for races")
class Environment(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        (self.folder / "case.toml").write_text(CASE.format(end=2e-5))

    def run_case(self, *words, stack=None, **variables):
        environment = {
            name: value for name, value in os.environ.items() if not name.startswith(("OMP_", "KOKKOS_", "GOMP_"))
        }
        environment.update({"OMP_NUM_THREADS": "2", "OMP_WAIT_POLICY": "passive"}, **variables)
        before = limited("stack", stack) if stack else []
        return subprocess.run(
            [*before, PROGRAM, *words], cwd=self.folder, env=environment, capture_output=True, text=True, timeout=120
        )

    def numbers(self):
        done = self.run_case("contact", "results.h5", "--csv", "t.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.folder / "t.csv").read_text()

    def test_what_cannot_be_is_refused(self):
        for name, values in REFUSED.items():
            for value in values:
                with self.subTest(**{name: value}):
                    done = self.run_case("run", "case.toml", **{name: value})
                    self.assertEqual(done.returncode, 2, done.stderr)
                    self.assertIn(f"environment variable {name} is '{value}'", done.stderr)
                    self.assertIn("unset it", done.stderr)
                    self.assertFalse((self.folder / "results.h5").exists())

    def test_what_can_be_is_taken_and_computes_the_same(self):
        wanted = None
        for variables in TAKEN:
            with self.subTest(**variables):
                done = self.run_case("run", "case.toml", **variables)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertNotIn("Kokkos", done.stdout + done.stderr)
                wanted = wanted or self.numbers()
                self.assertEqual(self.numbers(), wanted)
        self.assertIn("OMP_THREAD_LIMIT allows 1", self.run_case("check", "case.toml", OMP_THREAD_LIMIT="1").stderr)

    def test_as_many_threads_as_there_can_be(self):
        done = self.run_case("check", "case.toml", OMP_NUM_THREADS="512")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("512 threads are asked for, but this process may use", done.stderr)

    @unittest.skipIf(sanitized(), "a sanitizer wants more stack before the program begins")
    def test_small_stacks(self):
        for kilobytes in (32, 64, 128, 256, 512, 1024):
            for words in (
                ("check", "case.toml"),
                ("run", "case.toml"),
                ("contact", "results.h5"),
                ("reference",),
                ("modes", "case.toml", "--up-to", "1e5"),
            ):
                with self.subTest(stack=kilobytes, command=words[0]):
                    done = self.run_case(*words, stack=kilobytes << 10)
                    self.assertIn(done.returncode, (0, 2) if words[0] == "modes" else (0,), done.stderr)

    @unittest.skipIf(sanitized(), "a sanitizer wants more stack before the program begins")
    def test_an_error_with_a_small_stack_has_its_exit_code(self):
        done = self.run_case("contact", "none.h5", stack=64 << 10)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("cannot open results file none.h5", done.stderr)


if __name__ == "__main__":
    unittest.main()
