#!/usr/bin/env python3
"""HDF5 without memory crashes, so it is entered only with a margin: the margin is several times what any call takes,
and where memory ends at any moment, or is little for a command that reads, the program says so and leaves nothing half
written."""

import concurrent.futures
import pathlib
import re
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from faults import SOURCE, Folder, arrays_of, between, limited, sanitized  # noqa: E402

MANY_OUTPUTS = """
history_sets = ["upper.x_min", "upper.x_max", "upper.y_min", "upper.y_max", "lower.x_min", "lower.x_max", \
"lower.y_min", "lower.y_max"]
"""


def margin():
    """Bytes, of src/output/free_memory.hpp."""
    source = (SOURCE / "src/output/free_memory.hpp").read_text()
    shift = re.search(r"memory_margin = std::size_t\{(\d+)\} << 20", source)
    return int(shift.group(1)) << 20


@unittest.skipIf(sanitized(), "sanitizers bring a malloc of their own")
class LittleMemory(Folder):
    def start_with(self, *arguments, folder=None, **memory):
        environment = {"LITTLE_MEMORY" + name: str(value) for name, value in memory.items()}
        environment["LD_PRELOAD"] = str(between("little_memory"))
        return self.start(*arguments, cwd=folder or self.folder, environment=environment)

    def measured(self, *arguments):
        """How often anything but HDF5 asked for memory, the most that was taken, the most that HDF5 took between two
        looks; bytes."""
        self.ends(self.start_with(*arguments, _TELL=self.folder / "report"), 0)
        return [int(word) for word in (self.folder / "report").read_text().split()]

    def test_margin(self):
        """The most that HDF5 takes for one call of our wrapper is below a quarter of the margin, in files small and
        large."""
        text = (self.folder / "case.toml").read_text() + MANY_OUTPUTS
        larger = text.replace("divisions = [3, 3, 2]", "divisions = [40, 40, 16]").replace(
            "field_interval = 4e-6", "field_interval = 2e-6"
        )
        for size, case in (("small", text), ("large", larger.replace("end = 6e-05", "end = 8e-06"))):
            (self.folder / "case.toml").write_text(case)
            for arguments in (
                ["run", "case.toml", "--keep-state"],
                ["contact", "results.h5", "--hdf5", "contact.h5"],
                ["mesh", "case.toml"],
            ):
                with self.subTest(size=size, command=arguments[0]):
                    asked, most, of_hdf5 = self.measured(*arguments)
                    self.assertGreater(of_hdf5, 10000)  # it was seen at all
                    self.assertLess(of_hdf5, margin() / 4)

    def test_ends_at_any_moment(self):
        """At the N-th time that anything asks for memory, but for a quarter of the margin all of it is taken."""
        asked, most, of_hdf5 = self.measured("run", "case.toml")
        wanted = arrays_of(self.results)
        steps = 60
        with concurrent.futures.ThreadPoolExecutor(4) as several:
            ends = list(several.map(self.run_until, [1 + asked * i // steps for i in range(steps)]))
        for at, code, complaint, arrays, half_written in ends:
            with self.subTest(at=at):
                self.assertIn(code, (0, 1), complaint)
                self.assertEqual(half_written, [])
                if code == 0:
                    self.assertEqual(arrays, wanted)
                else:
                    self.assertRegex(complaint, r"(?m)^railwave: ")
        self.assertTrue(any(end[1] == 1 and end[3] for end in ends), "none ended with results begun")

    def run_until(self, at):
        folder = self.folder / str(at)
        folder.mkdir()
        (folder / "case.toml").write_text((self.folder / "case.toml").read_text())
        run = self.start_with("run", "case.toml", folder=folder, _AT=at, _LEFT=margin() // 4)
        try:
            said, complaint = run.communicate(timeout=120)
        except subprocess.TimeoutExpired:
            run.kill()
            return at, "it hangs", "", {}, []
        found = arrays_of(folder / "results.h5") if (folder / "results.h5").exists() else {}
        return at, run.returncode, complaint, found, [path.name for path in folder.iterdir() if ".new" in path.name]

    def test_other_commands(self):
        """What reads or writes other files: within the same limits, and as soon as it ends well its output is the right
        one."""
        self.run_case()
        channel = ["--channel", "contact.between.normal_force.z"]
        commands = {
            "contact": ["contact", "results.h5", "--csv", "a.csv", "--hdf5", "a.h5"],
            "mesh": ["mesh", "case.toml", "--out", "a.h5"],
            "modes": ["modes", "case.toml", "--csv", "a.csv", "--out", "a.h5"],
            "psd": ["signal", "psd", "results.h5", *channel, "--csv", "a.csv"],
            "reference": ["reference"],
            "check": ["check", "case.toml"],
        }
        for name, command in commands.items():
            for made in self.folder.glob("a.*"):
                made.unlink()
            wanted = self.ends(self.start(*command), 0)[1]
            before = self.everything()
            worked = False
            for megabytes in range(40, 200, 8):
                with self.subTest(command=name, megabytes=megabytes):
                    for made in self.folder.glob("a.*"):
                        made.unlink()
                    run = self.start(*command, before=limited("as", megabytes << 20))
                    said, complaint = run.communicate(timeout=120)
                    self.nothing_half_written()
                    if run.returncode != 127:
                        self.assertIn(run.returncode, (0, 1), complaint)
                    if run.returncode == 1:
                        self.assertRegex(complaint, r"(?m)^railwave: out of memory")
                    if run.returncode == 0:
                        self.assertEqual(
                            re.sub(r"\d+\.\d+ GB|[\d.]+ s\b", "", said), re.sub(r"\d+\.\d+ GB|[\d.]+ s\b", "", wanted)
                        )
                        self.assertEqual(set(self.everything()), set(before))
                        worked = True
                        break
            self.assertTrue(worked, name)


if __name__ == "__main__":
    unittest.main()
