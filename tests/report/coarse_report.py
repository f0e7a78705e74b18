"""A coarse roller on a block, computed in a second, and its report, for the tests here."""

import os
import pathlib
import subprocess
import tempfile

import browser

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
SOURCE = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
TEMPLATE = SOURCE / "build" / "report" / "report.html"
CASE = SOURCE / "studies" / "rolling_grid" / "rolling.toml"
# Six outputs; at the fifth a part of the patch slips.
CHANGED = (
    "time.end=1.5e-4", "contacts.tread.friction=0.12", "prescribed_motion.axle.angular_velocity=[0, 66, 0]",
    'output.field_sets=["roller", "block", "block.zone"]', 'output.fields=["displacement", "velocity", "stress"]',
)



def run(*arguments, code=0):
    """Runs the program; returns what it printed."""
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)
    if done.returncode != code:
        raise AssertionError(f"railwave {arguments} ended with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout + done.stderr


class CoarseReport:
    """The results and the report, in a folder that goes with close()."""

    def __init__(self):
        browser.expect_browser(TEMPLATE)
        self._folder = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self._folder.name)
        self.results = self.compute("rolling")
        self.said = run("report", self.results)
        self.page = self.results.with_suffix(".html")

    def compute(self, name, *overrides):
        results = self.folder / f"{name}.h5"
        run("run", CASE, *(f"--set={one}" for one in (*CHANGED, *overrides)), f"--set=output.file={results}")
        return results

    def close(self):
        self._folder.cleanup()
