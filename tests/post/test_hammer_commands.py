#!/usr/bin/env python3
"""`railwave frf` and `railwave decay` on made-up results files: a wave that dies away along a rail, blows that
disagree, and what is wrong with a file or a request."""
import csv
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

PROGRAM = os.path.join(os.environ["RAILWAVE_BIN_DIR"], "railwave")
INTERVAL, SAMPLES, SPEED = 1e-5, 8000, 900.0
PLACES = [0.15 * k for k in range(9)] + [1.2 + 0.3 * k for k in range(1, 37)]
failures = 0


def check(holds, what):
    global failures
    if not holds:
        failures += 1
    print(("ok      " if holds else "FAILED  ") + what)


def write(path, rate, factor=1.0, hammers=("blow",)):
    """Force: half a sine wave of 0.2 ms. Motion at x: a smooth pulse that travels and falls by `rate` dB/m."""
    time = INTERVAL * np.arange(SAMPLES)
    force = np.where(time < 2e-4, np.sin(np.pi * time / 2e-4), 0) * 1000
    with h5py.File(path, "w") as file:
        file.attrs.update(
            {
                "format": "Railwave results",
                "format_version": 1,
                "program": "railwave 0",
                "title": "made up",
                "completed": 1,
                "reason": "completed",
            }
        )
        history = file.create_group("history")
        history["time"] = time
        for name in hammers:
            load = history.create_group(f"load/{name}")
            load.attrs.update({"target": "rail.blow", "hammer": 1})
            load["force"] = np.outer(force, [0, 0, -1])
            load["direction"] = [0.0, 0.0, -1.0]
        for k, x in enumerate(PLACES):
            group = history.create_group("set/rail.blow" if k == 0 else f"set/rail.row_{k}")
            group.attrs["asked_by"] = "hammer blow" if k == 0 else "probe row"
            group["position"] = [5 + x, 0.0, 0.16]
            fall = factor * 10 ** (-rate * x / 20)
            since, width = time - 2e-3 - x / SPEED, 6e-5
            pulse = np.exp(-0.5 * (since / width) ** 2)
            up = [0, 0.5, 1]
            group["displacement"] = np.outer(1e-6 * fall * pulse, up)
            group["velocity"] = np.outer(-1e-6 * fall * since / width**2 * pulse, up)
            group["acceleration"] = np.outer(1e-6 * fall * (since**2 / width**4 - 1 / width**2) * pulse, up)


def program(*words):
    return subprocess.run([PROGRAM, *map(str, words)], check=False, capture_output=True, text=True)


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def check_decay(folder):
    for rate in (0.6, 1.5, 3.0):
        results, table = folder / "wave.h5", folder / "decay.csv"
        write(results, rate)
        done = program("decay", results, "--csv", table, "--from", 200, "--to", 4000)
        found = [(float(row["band"]), float(row["decay_rate"])) for row in rows(table)] if done.returncode == 0 else []
        # A row of 12 m leaves out what is beyond it.
        beyond = 1 - 10 ** (-rate * 12.15 / 10)
        check(
            len(found) == 14 and all(abs(value * beyond / rate - 1) < 0.01 for _, value in found),
            f"{rate} dB/m comes out as {found}{done.stderr}",
        )
    done = program("decay", results, "--csv", table, "--at", "row_2", "--from", 200, "--to", 4000)
    found = [float(row["decay_rate"]) for row in rows(table)]
    check(
        done.returncode == 0 and all(abs(value / 3.0 - 1) < 0.01 for value in found),
        f"from a place beside the force it is the same: {found[:3]}{done.stderr}",
    )
    done = program("decay", results, "--hdf5", folder / "decay.h5", "--from", 200, "--to", 4000)
    with h5py.File(folder / "decay.h5", "r") as file:
        check(
            file.attrs["format"] == "Railwave decay rates" and file["level"].shape == (14, len(PLACES)),
            "the HDF5 file has the levels of each band and place",
        )
        check(np.allclose(file["level"][:], -3.0 * file["distance"][:], atol=0.01), "they fall by 3 dB/m")
    check(
        "no third-octave band" in program("decay", results, "--from", 410, "--to", 490).stderr,
        "a range without a band is reported",
    )
    write(results, 0.1)
    check("(row too short)" in program("decay", results).stdout, "rates that a short row cannot tell are marked")


def check_coherence(folder):
    one, three = folder / "one.h5", folder / "three.h5"
    write(one, 1.0)
    write(three, 1.0, factor=3)
    table, lines = folder / "frf.csv", folder / "frf.h5"
    done = program(
        "frf", one, three, "--response", "row_4", "--response", "blow:lateral", "--csv", table, "--hdf5", lines,
        "--from", 200, "--to", 4000,
    )
    check(
        done.returncode == 0
        and "2 blows" in done.stdout
        and "rail.row_4 (transfer)" in done.stdout
        and "rail.blow:lateral (cross)" in done.stdout,
        done.stdout + done.stderr,
    )
    found = rows(table)
    check(
        all(abs(float(row["coherence"]) - 0.8) < 1e-6 for row in found),
        "two blows answered once and threefold have a coherence of 0.8",
    )
    alone = program("frf", one, "--response", "row_4", "--csv", folder / "alone.csv", "--from", 200, "--to", 4000)
    check("coherence is 1 by definition" in alone.stdout, "of one blow the coherence is reported to be 1 by definition")
    single = rows(folder / "alone.csv")
    mean = [row for row in found if row["response"] == "rail.row_4"]
    check(
        len(single) == len(mean)
        and all(abs(float(a["amplitude"]) / float(b["amplitude"]) - 2) < 1e-6 for a, b in zip(mean, single)),
        "their mean is twice the first",
    )
    lateral = [row for row in found if row["response"] == "rail.blow:lateral"]
    direct = (
        rows(folder / "alone.csv")
        if program(
            "frf", one, three, "--response", "blow", "--csv", folder / "alone.csv", "--from", 200, "--to", 4000
        ).returncode
        == 0
        else []
    )
    check(
        all(abs(float(a["amplitude"]) / float(b["amplitude"]) - 0.5) < 1e-6 for a, b in zip(lateral, direct)),
        "the cross response is half of the direct one, as it was made",
    )
    with h5py.File(lines, "r") as file:
        values = file["rail.row_4/real"][:] + 1j * file["rail.row_4/imaginary"][:]
        check(
            np.allclose(np.abs(values), [float(row["amplitude"]) for row in mean], rtol=1e-8),
            "HDF5 and CSV say the same",
        )
    # Velocity over force is the acceleration's over i w.
    program(
        "frf", one, "--response", "row_4", "--quantity", "mobility", "--csv", folder / "mobility.csv", "--from", 200,
        "--to", 4000,
    )
    ratio = [
        float(b["amplitude"]) / float(a["amplitude"]) / (2 * np.pi * float(a["frequency"]))
        for a, b in zip(rows(folder / "mobility.csv"), single)
    ]
    check(
        len(ratio) > 100 and max(abs(r - 1) for r in ratio) < 1e-6,
        "mobility times the angular frequency is the accelerance",
    )


def check_mistakes(folder):
    results = folder / "two.h5"
    write(results, 1.0, hammers=("left", "right"))
    before = results.read_bytes()

    def refused(words, said):
        done = program(*words)
        check(
            done.returncode == 2 and said in done.stderr,
            f"{' '.join(map(str, words[2:])) or words[0]}: {done.stderr.strip()}",
        )

    refused(["frf", results], "several hammers: left, right; name the one")
    refused(["frf", results, "--input", "lift"], "no such load with a force of fixed direction; did you mean 'left'?")
    check(program("frf", results, "--input", "left").returncode == 0, "with --input one of two is taken")
    refused(["frf", results, "--input", "left", "--response", "rwo_3"], "there is no history of a set 'rwo_3'")
    refused(["frf", results, "--input", "left", "--response", "row_3:up"], "'up' is no direction; it may be vertical")
    refused(
        ["frf", results, "--input", "left", "--quantity", "inertance"], "must be accelerance, mobility or receptance"
    )
    refused(["frf", results, "--input", "left", "--window", "hann"], "--window hann: must be none or exponential")
    refused(["frf", results, "--input", "left", "--csv", results], "is the results file, which this command reads")
    refused(["frf", results, "--input", "left", "--from", "9e8", "--to", "9.1e8"], "there are 0 lines")
    refused(
        ["decay", results, "--input", "left", "--row", "row_3"],
        "the force and two places beside it along x at least, but has 1",
    )
    refused(["decay", results, "--input", "left", "--from", "0"], "--from: is '0', must be a number in Hz")
    check(results.read_bytes() == before, "the results file is as it was")
    with h5py.File(results, "a") as file:
        del file["history/load"]
    refused(["frf", results], "has no force of fixed direction that could be the input")


with tempfile.TemporaryDirectory(prefix="railwave-") as place:
    check_decay(pathlib.Path(place))
    check_coherence(pathlib.Path(place))
    check_mistakes(pathlib.Path(place))
sys.exit(1 if failures else 0)
