"""A coarse run of the rolling wheel and its report, for the tests here."""

import os
import pathlib
import subprocess
import tempfile

import browser

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
SOURCE = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
TEMPLATE = SOURCE / "build" / "report" / "report.html"
CASE = SOURCE / "cases" / "rolling.toml"
COARSE = [
    f"--set=meshes.{mesh}.{key}" for mesh in ("wheel", "rail") for key in ("zone_size=0.005", "zone_layers=1")
] + ["--set=time.end=5e-4", "--set=output.field_interval=1e-4"]


def run(*arguments, code=0):
    """Runs the program; returns what it printed."""
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)
    if done.returncode != code:
        raise AssertionError(f"railwave {arguments} ended with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout + done.stderr


class CoarseReport:
    """The results and the report, in a folder that goes with close()."""

    def __init__(self, *overrides):
        browser.expect_browser(TEMPLATE)
        self._folder = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self._folder.name)
        self.results = self.compute("rolling", *overrides)
        self.said = run("report", self.results)
        self.page = self.results.with_suffix(".html")

    def compute(self, name, *overrides):
        results = self.folder / f"{name}.h5"
        run("run", CASE, *COARSE, *(f"--set={one}" for one in overrides), f"--set=output.file={results}")
        return results

    def close(self):
        self._folder.cleanup()
