#!/usr/bin/env python3
"""What scripts/hip counts: device code is found where it is, and objects that lack it are refused. Without Debian's
hipcc, or without the Kokkos that scripts/setup --hip builds, it is skipped."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
KOKKOS = ROOT / ".deps" / "kokkos-hip"
SOURCE = "src/solve/tasks/load_tasks.cpp"
sys.path.insert(0, str(ROOT / "scripts" / "lib"))
sys.dont_write_bytecode = True
import device_code  # noqa: E402


def check(build, text=None):
    """Makes a build of one source, whose object is compiled of `text` by the host's compiler; None: of the source by
    hipcc. Returns the exit code and what was said."""
    name = "src/one.o"
    (build / "src").mkdir()
    command = f"hipcc -I{ROOT} -I{ROOT}/src -isystem {KOKKOS}/include -isystem /usr/include/eigen3 -DEIGEN_NO_HIP" \
              " -fopenmp -fno-gpu-rdc --amdgpu-target=gfx908 -std=c++17 -O0"
    entry = {"directory": str(build), "file": str(ROOT / SOURCE), "command": f"{command} -o {name} -c {ROOT / SOURCE}"}
    (build / "compile_commands.json").write_text(json.dumps([entry]), encoding="utf-8")
    if text is None:
        subprocess.run(entry["command"].split(), cwd=build, check=True, capture_output=True,
                       env={**os.environ, "HCC_AMDGPU_TARGET": "gfx908"})
    elif text:
        subprocess.run(["g++", "-x", "c++", "-c", "-o", build / name, "-"], input=text, text=True, check=True)
    words = [sys.executable, ROOT / "scripts" / "lib" / "device_code.py", "check", build, "gfx908"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


class DeviceCode(unittest.TestCase):
    def test_functors_are_found(self):
        found = device_code.functors()
        self.assertEqual(found["SharedNodeUpdate"], "kernels/nodes/shared_nodes.hpp")
        self.assertEqual(found["TakeStepValues"], "src/solve/step_recording.cpp")
        self.assertGreater(len(found), 100)

    def test_objects_without_device_code_are_refused(self):
        for text, expected in (("", "not compiled"), ("int one;", "its object has no code for gfx908")):
            with tempfile.TemporaryDirectory() as folder:
                code, said = check(pathlib.Path(folder), text)
                self.assertEqual(code, 1)
                self.assertIn(f"{SOURCE}: {expected}", said)
                self.assertIn("no kernel was found", said)

    def test_kernels_of_one_source_are_counted(self):
        with tempfile.TemporaryDirectory() as folder:
            code, said = check(pathlib.Path(folder))
            self.assertEqual(code, 1)  # for all other functors are missing
            self.assertNotIn(SOURCE, said)
            self.assertNotIn("functor PressureLoad ", said)
            self.assertIn("functor SharedNodeUpdate is in no kernel", said)
            self.assertRegex(said, r"1 sources that include Kokkos, 1 of them with kernels of ours: [1-9]\d* kernels")


if __name__ == "__main__":
    if not shutil.which("hipcc") or not (KOKKOS / "lib" / "cmake").exists():
        print("hipcc or .deps/kokkos-hip is not there: scripts/setup --hip installs both")
        sys.exit(77)
    unittest.main()
