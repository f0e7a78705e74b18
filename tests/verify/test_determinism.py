#!/usr/bin/env python3
"""The same case run twice, on one, two and three threads, interrupted and taken up again, with other output intervals,
with and without monitor and checkpoints, gives the same results to the last bit; in double, mixed and single precision,
with subcycling, and with contact by multipliers. `--program FILE` takes another build, such as one for a GPU, and
compares two of its runs instead of numbers of threads."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

try:
    import h5py
    import numpy
except ImportError:
    sys.exit(77)

HERE = pathlib.Path(__file__).parent
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"


def run(case, folder, threads, overrides):
    """Results of the case as {dataset: bytes}, and the histories as arrays."""
    folder.mkdir()
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads))
    subprocess.run([PROGRAM, "run", HERE / case, *overrides], cwd=folder, env=environment, check=True,
                   stdout=subprocess.DEVNULL)
    return results_in(folder)


def results_in(folder):
    found = {}
    with h5py.File(folder / "results.h5", "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def differences(first, second):
    """Names of datasets that are not the same bit for bit; how long a run took is not a result."""
    if first.keys() != second.keys():
        return sorted(first.keys() ^ second.keys())
    return [name for name in first
            if "wall" not in name and numpy.asarray(first[name]).tobytes() != numpy.asarray(second[name]).tobytes()]


def numbers(results):
    return sum(numpy.asarray(values).size for values in results.values()
               if numpy.issubdtype(numpy.asarray(values).dtype, numpy.floating))


def repeats(case, *overrides):
    """Whether the case repeats itself."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        once = run(case, folder / "once", 1, overrides)
        failed = False
        for name, threads in (("again", 1), ("two_threads", 2), ("three_threads", 3)):
            different = differences(once, run(case, folder / name, threads, overrides))
            print(
                f"{' '.join([case, *overrides])}, {name}: {len(different)} of {len(once)} datasets differ"
                f" {different[:5]}"
            )
            failed = failed or bool(different)
        print(f"{numbers(once)} numbers compared")
        if numbers(once) < 10000:
            print("the results hold too little to tell")
            failed = True
    return not failed


def at_common_times(first, second):
    """Names of arrays that differ at times that both have, and the number of those times. Every array that grows lies
    beside its `time`, or below it in the history and in contacts."""
    different, common = [], 0
    for name in first:
        parts = name.split("/")
        folder = next(
            (
                folder
                for folder in ("/".join(parts[:n]) for n in range(len(parts) - 1, 0, -1))
                if folder + "/time" in first
            ),
            None,
        )
        if folder is None or name not in second:
            continue
        times = numpy.intersect1d(first[folder + "/time"], second[folder + "/time"])
        rows = [numpy.isin(one[folder + "/time"], times) for one in (first, second)]
        if len(first[name]) != len(rows[0]):
            continue  # of the mesh
        common = max(common, len(times))
        if first[name][rows[0]].tobytes() != second[name][rows[1]].tobytes():
            different.append(name)
    return different, common


def interrupted(case, folder, threads, overrides, settled):
    """Results of a run that was interrupted as often as its wall time asks, and taken up again. It begins with the
    settled state of the folder `settled`: settling that is interrupted ends elsewhere within its tolerance
    (docs/restart.md)."""
    folder.mkdir()
    for state in settled.glob("settled-*.h5"):
        shutil.copy(state, folder)
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads))
    parts = 0
    for attempt in range(200):
        restart = ["--restart"] if any(folder.glob("results.checkpoint.h5*")) else []
        wall = ["--wall-time", f"{0.05 + 0.1 * attempt:g}"]
        code = subprocess.run(
            [PROGRAM, "run", HERE / case, *overrides, *wall, *restart],
            cwd=folder, env=environment, stdout=subprocess.DEVNULL,
        ).returncode
        parts += 1
        if code == 0:
            return results_in(folder), parts
        if code != 4:
            raise RuntimeError(f"exit code {code}")
    raise RuntimeError("it does not come to its end")


def same_whatever_is_set(case, *overrides):
    """Whether outputs, monitor, checkpoints and interruptions leave the solution as it is."""
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        once = run(case, folder / "once", 1, overrides)
        kinds = {
            "no_monitor": ("--set", "monitor.active=false"),
            "checkpoints": ("--set", "checkpoint.interval=0.02"),
            "no_checkpoints": ("--set", "checkpoint.interval=0"),
            "three_threads": (),
        }
        for name, more in kinds.items():
            other = run(case, folder / name, 3 if name == "three_threads" else 1, [*overrides, *more])
            different, common = at_common_times(once, other)
            print(
                f"{' '.join([case, *overrides])}, {name}: {len(different)} of {len(once)} arrays differ at"
                f" {common} common times {different[:5]}"
            )
            failed = failed or bool(different) or common < 4
        # Outputs' intervals choose the step, unless it is given.
        with h5py.File(folder / "once" / "results.h5", "r") as results:
            given = [*overrides, "--set", f"time.step={float(results.attrs['step_size'])!r}"]
        once_given = run(case, folder / "given", 1, given)
        other = run(
            case, folder / "other_outputs", 1,
            [*given, "--set", "output.history_interval=1.2e-6", "--set", "output.field_interval=1.5e-5"],
        )
        different, common = at_common_times(once_given, other)
        print(
            f"{' '.join([case, *overrides])}, other outputs: {len(different)} of {len(once)} arrays differ at"
            f" {common} common times {different[:5]}"
        )
        failed = failed or bool(different) or common < 4
        other, parts = interrupted(case, folder / "interrupted", 2, overrides, folder / "once")
        different = differences(once, other)
        print(
            f"{' '.join([case, *overrides])}, in {parts} parts on two threads: {len(different)} of {len(once)} datasets"
            f" differ {different[:5]}"
        )
        failed = failed or bool(different)
    return not failed


def twice(program, case, overrides):
    """For a GPU: two runs of one build."""
    global PROGRAM
    PROGRAM = pathlib.Path(program).resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        once, again = run(case, folder / "once", 1, overrides), run(case, folder / "again", 1, overrides)
        different = differences(once, again)
        print(f"{case}: {len(different)} of {len(once)} datasets differ, {numbers(once)} numbers {different[:5]}")
    return not different and numbers(once) > 10000


DAMPED = (
    "--set",
    "parts.upper.stiffness_damping=2e-9",
    "--set",
    "parts.upper.mass_damping=20",
    "--set",
    "contacts.touch.damping=0.05",
)

# For the whole scene's step to pay, so that the default takes it.
LONG_ENOUGH = ("--set", "time.end=1e-3", "--set", "output.history_interval=1e-5")


def main():
    if len(sys.argv) > 2 and sys.argv[1] == "--program":
        return (
            0
            if all([twice(sys.argv[2], case, sys.argv[3:]) for case in ("two_blocks.toml", "graded_rail.toml")])
            else 1
        )
    checks = [
        repeats("two_blocks.toml"),
        repeats("graded_rail.toml"),
        repeats("two_blocks.toml", "--set", "solver.precision=float"),
        repeats("two_blocks.toml", "--set", "contacts.touch.algorithm=multiplier"),
        repeats("two_blocks.toml", *LONG_ENOUGH),
        same_whatever_is_set("two_blocks.toml", *LONG_ENOUGH),
    ]
    for precision in ("double", "mixed"):
        of_precision = ("--set", f"solver.precision={precision}")
        checks.append(same_whatever_is_set("two_blocks.toml", *of_precision, *DAMPED))
        checks.append(same_whatever_is_set("graded_rail.toml", *of_precision))
    return 0 if all(checks) else 1


if __name__ == "__main__":
    sys.exit(main())
