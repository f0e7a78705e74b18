"""What the tests of faults share: a folder with a case, runs of the program under a failing disk, without rights or
memory, and the table of what was reported, which docs/faults.md holds."""

import atexit
import functools
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
except ImportError:
    sys.exit(77)

SOURCE = pathlib.Path(os.environ.get("RAILWAVE_SOURCE_DIR", pathlib.Path(__file__).resolve().parent.parent.parent))
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from two_blocks import two_blocks  # noqa: E402

CASE = two_blocks(([0.03, 0.03, 0.02], [3, 3, 2]), ([0.02, 0.02, 0.02], [2, 2, 2]), [0.005, 0.005, 0.02001]) + """\
[initial_motion.fall]
parts = ["upper"]
velocity = [2, 1, -12]
[time]
end = {end}
[output]
file = "results.h5"
history_interval = 1e-6
field_interval = 4e-6
field_sets = ["upper", "lower"]
fields = ["displacement", "velocity", "stress"]
"""
LONG = 0.3  # s: some minutes, so that no test sees its end; its results fit onto a small disk


@functools.lru_cache(maxsize=None)
def between(name):
    """The library tests/output/NAME.c, to stand between the program and the system (LD_PRELOAD), built in a folder of
    this process's own; without a C compiler these tests are skipped."""
    compiler = os.environ.get("CC") or shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if not compiler:
        raise unittest.SkipTest("no C compiler")
    folder = tempfile.TemporaryDirectory(prefix="railwave-")
    atexit.register(folder.cleanup)
    os.chmod(folder.name, 0o755)  # the program may run as somebody else
    library = pathlib.Path(folder.name) / f"{name}.so"
    subprocess.run(
        [
            *compiler.split(), "-O1", "-shared", "-fPIC", "-o", library, SOURCE / "tests" / "output" / f"{name}.c",
            "-ldl",
        ],
        check=True,
    )
    return library


def sanitized():
    """Whether the program is built with AddressSanitizer or ThreadSanitizer, which take address space without end for
    themselves."""
    return thread_sanitized() or b"__asan_init" in pathlib.Path(PROGRAM).read_bytes()


def thread_sanitized():
    return b"__tsan_init" in pathlib.Path(PROGRAM).read_bytes()


def limited(what, soft, hard=None):
    """The command that runs what stands behind it within a limit: "as" and "stack" in bytes, "fsize" in bytes, "cpu" in
    s. Not `preexec_fn`: it runs Python between fork and exec, which can hang for ever where the test has threads."""
    return ["prlimit", f"--{what}={soft}:{hard or soft}"]


def digest(content):
    return f"{len(content)} bytes, {hashlib.sha256(content).hexdigest()}"


def arrays_of(results):
    """A digest of every dataset's bytes, by its name: unittest takes hours to tell how millions of bytes differ."""
    found = {}
    with h5py.File(results, "r") as file:
        file.visititems(
            lambda name, item: found.update({name: digest(item[()].tobytes())})
            if isinstance(item, h5py.Dataset)
            else None
        )
    return found


class Folder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name).resolve()
        self.results, self.checkpoint = self.folder / "results.h5", self.folder / "results.checkpoint.h5"
        self.case()

    def case(self, end=6e-5, more=""):
        (self.folder / "case.toml").write_text(CASE.format(end=end) + more)

    def start(self, *arguments, before=(), faults=None, **options):
        environment = dict(os.environ, OMP_NUM_THREADS="1", OMP_PROC_BIND="false", OMP_WAIT_POLICY="passive")
        if faults:
            environment.update(
                {"FAULTY_" + name.upper(): str(value) for name, value in faults.items()},
                LD_PRELOAD=str(between("faulty_disk")),
            )
            environment.setdefault("FAULTY_FOLDER", str(self.folder))
            # AddressSanitizer would else insist on being loaded first.
            environment["ASAN_OPTIONS"] = ":".join(
                filter(None, [environment.get("ASAN_OPTIONS"), "verify_asan_link_order=0"])
            )
        environment.update(options.pop("environment", {}))
        options = (
            dict(cwd=self.folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) | options
        )
        run = subprocess.Popen([*before, PROGRAM, *arguments], **options)
        self.addCleanup(run.communicate)
        self.addCleanup(run.kill)
        return run

    def ends(self, run, code):
        """What it said on stderr, and on stdout."""
        try:
            said, complaint = run.communicate(timeout=120)
        except subprocess.TimeoutExpired:
            run.kill()
            self.fail("the program hangs")
        self.assertEqual(run.returncode, code, said + complaint)
        self.assertNotIn("HDF5-DIAG", complaint)
        return complaint, said

    def run_case(self, *options, code=0, **how):
        return self.ends(self.start("run", "case.toml", *options, **how), code)

    def everything(self):
        return {path.name: digest(path.read_bytes()) for path in self.folder.iterdir() if path.is_file()}

    def nothing_half_written(self):
        self.assertEqual([path.name for path in self.folder.iterdir() if ".new" in path.name], [])

    def arrays(self):
        return arrays_of(self.results)

    def whole_run(self):
        """The arrays of the run that nothing disturbs; leaves no files."""
        self.run_case()
        wanted = self.arrays()
        for path in self.folder.glob("results*"):
            path.unlink()
        return wanted

    def reported(self, what, code, text):
        """A row of the table: with RAILWAVE_FAULTS=FILE it is added there; see docs/faults.md."""
        text = next(line for line in text.splitlines() if line.strip())
        text = text.replace(str(self.folder) + "/", "").replace(str(self.folder), "FOLDER").replace("railwave: ", "", 1)
        text = re.sub(
            r"\b\d+\.\d+e-\d+ s|\b[0-9]+\.[0-9]+(?= [kMG]B)",
            lambda found: "..." + found.group()[-2:] if found.group().endswith(" s") else "...",
            text,
        )
        if os.environ.get("RAILWAVE_FAULTS"):
            with open(os.environ["RAILWAVE_FAULTS"], "a") as file:
                file.write(json.dumps([what, code, text]) + "\n")
