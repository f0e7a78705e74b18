"""Makes the results file of the made-up run (tests/output/made_up_run.hpp) for the Python tests."""

import os
import subprocess
import sys
import tempfile
import unittest

SOURCE_DIR = os.environ.get("RAILWAVE_SOURCE_DIR", os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..")))


def writer():
    folder = os.environ.get("RAILWAVE_BIN_DIR")
    if not folder:
        sys.exit("RAILWAVE_BIN_DIR must name the folder of the built test programs (ctest sets it)")
    return os.path.join(folder, "test_output")


def write_sample(path, kill_after=None):
    """Runs the writer. With kill_after, a step, it is killed by a signal after that; returns the exit status."""
    environment = dict(os.environ, RAILWAVE_SAMPLE=path)
    if kill_after is not None:
        environment["RAILWAVE_SAMPLE_KILL_AFTER"] = str(kill_after)
    return subprocess.run([writer(), "[.write-sample]"], env=environment, stdout=subprocess.DEVNULL).returncode


class Sample:
    """A temporary folder with the made-up run in run.h5 and run.xdmf."""

    def __init__(self, name="run.h5", kill_after=None):
        self._folder = tempfile.TemporaryDirectory(prefix="railwave-")
        self.folder = self._folder.name
        self.path = os.path.join(self.folder, name)
        self.status = write_sample(self.path, kill_after)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._folder.cleanup()


class SampleTest(unittest.TestCase):
    """Tests that read the made-up run, which is written once for all tests of a class."""

    name = "run.h5"

    @classmethod
    def setUpClass(cls):
        cls.sample = Sample(cls.name)
        cls.addClassCleanup(cls.sample.__exit__)
        assert cls.sample.status == 0, "the writer failed"
