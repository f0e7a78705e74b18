#!/usr/bin/env python3
"""The same case run twice, and on one and two threads, gives the same results to the last bit; one with subcycling, in single precision
and with contact by multipliers too."""

import os
import pathlib
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
        for name, threads in (("again", 1), ("two_threads", 2)):
            different = differences(once, run(case, folder / name, threads, overrides))
            print(f"{' '.join([case, *overrides])}, {name}: {len(different)} of {len(once)} datasets differ {different[:5]}")
            failed = failed or bool(different)
        print(f"{numbers(once)} numbers compared")
        if numbers(once) < 10000:
            print("the results hold too little to tell")
            failed = True
    return not failed


def main():
    checks = [repeats("two_blocks.toml"), repeats("graded_rail.toml"), repeats("two_blocks.toml", "--set", "solver.precision=float"),
              repeats("two_blocks.toml", "--set", "contacts.touch.algorithm=multiplier")]
    return 0 if all(checks) else 1


if __name__ == "__main__":
    sys.exit(main())
