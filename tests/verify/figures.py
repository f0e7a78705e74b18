"""What tests of figures share: the rolling case, the program, and figures held against limits."""
import os
import subprocess
import sys

SOURCE = os.environ.get("RAILWAVE_SOURCE_DIR", os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..")))
PROGRAM = os.path.join(os.environ["RAILWAVE_BIN_DIR"], "railwave")
CASE = os.path.join(SOURCE, "cases", "rolling.toml")
failures = []


def program(command, case_options=None, *more, **how):
    """Runs a command of the program on the rolling case, with values in place of the case's own and more arguments."""
    options = [word for key, value in (case_options or {}).items() for word in ("--set", f"{key}={value}")]
    return subprocess.run([PROGRAM, command, CASE, *options, *more], check=True, **how)


def show(what, figure, limit):
    """One line for one figure; figures and limits are shares of one."""
    verdict = "ok" if figure <= limit else "FAILED"
    print(f"{what:80s} {figure:11.3e}  (at most {limit:g})  {verdict}")
    if not figure <= limit:  # also what is no number
        failures.append(what)


def conclude():
    """Fails the test if any figure was beyond its limit."""
    if failures:
        sys.exit("not reached: " + "; ".join(failures))
