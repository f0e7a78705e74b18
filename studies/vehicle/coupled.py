"""Coupled runs of a wheelset in Railwave and a bogie in Simbody, by the program railwave_vehicle."""

import pathlib

import numpy as np

import two_masses as masses
from steps import Failed

HERE = pathlib.Path(__file__).resolve().parent
CASE, BOGIE = HERE / "dipped_weld.toml", HERE / "bogie.toml"
WINDOW = 2e-6  # s, between samples of the interface; ten of them are a window
HISTORIES = ("contact.tread.normal_force", "contact.tread.tangential_force")
REWIND = 5  # windows


def until(end):
    return [] if end is None else ["--set", f"time.end={end}"]


def run(steps, name, case, bogie, *words, threads=None):
    """The table of a coupled run. @param threads of a model so small that a second one only waits"""
    program = pathlib.Path(steps.program).parent / "railwave_vehicle"
    if not program.exists():
        raise Failed(f"{program} is not there: scripts/setup --simbody installs Simbody, the next build makes it")
    table = steps.path(f"{name}.csv")
    environment = [] if threads is None else ["env", f"OMP_NUM_THREADS={threads}"]
    # The settled state lies beside what would be the results.
    words = [*environment, program, case, bogie, "--out", table, "--rewind", REWIND, "--set",
             f"output.file={steps.path(name)}.h5", *words]
    inputs = [case, bogie, HERE / "dipped_weld.csv"]
    steps.once(name, inputs, words, lambda: steps.command(*words))
    return np.genfromtxt(table, delimiter=",", names=True, deletechars="")


def closure(table):
    """What both sides' accounts of the energy over the interface differ by, over the largest that has passed; and that,
    J."""
    given, got = table["wheelset_work_J"], table["bogie_work_J"]
    largest = max(np.abs(given).max(), np.abs(got).max())
    return np.abs(given + got).max() / largest, largest


def two_masses(steps):
    table = run(steps, "two_masses", masses.CASE, masses.BOGIE, "--window", "4e-5", "--samples", 5, threads=1)
    return [masses.Compared(table, axis) for axis in range(3)], closure(table)


def two_masses_rows(found):
    compared, (difference, largest) = found
    rows = []
    for axis, (name, one) in enumerate(zip(masses.AXES, compared)):
        exact = one.exact
        rows.append((f"two masses, {name}: frequency beside {exact.frequency:.4f} Hz, off by",
                     f"{one.frequency / exact.frequency - 1:+.1e} (elasticity {-masses.elastic_share(axis):+.1e})",
                     "1 %"))
        rows.append((f"two masses, {name}: logarithmic decrement, exact {exact.decrement:.5f}",
                     f"{one.decrement:.5f}", "1 %"))
        rows.append((f"two masses, {name}: largest difference of the distance, of its largest",
                     f"{one.difference:.1e}", "1 %"))
    rows.append((f"two masses: energy over the interface, {largest:.2f} J at most, closes within", f"{difference:.1e}",
                 "1e-6"))
    return [*rows, rewound("two masses")]


def weld(steps, end):
    curves = steps.path("curves")
    curves.mkdir(exist_ok=True)
    histories = [word for name in HISTORIES for word in ("--history", name)]
    return run(steps, "weld", CASE, BOGIE, "--window", WINDOW, "--samples", 10, "--tolerance", "1e-9",
               "--curves", curves, *histories, *until(end))


def weld_rows(table):
    difference, largest = closure(table)
    normal, box = table["contact.tread.normal_force.z"] / 1e3, table["force_z_N"] / 1e3
    return [
        ("weld: contact force, static, smallest, largest",
         f"{normal[0]:.1f}, {normal.min():.1f}, {normal.max():.1f} kN", ""),
        ("weld: primary suspension, vertical, least and most pressed",
         f"{-box.max():.2f}, {-box.min():.2f} kN", ""),
        (f"weld: energy over the interface, {largest:.1f} J at most, closes within", f"{difference:.1e}", "1e-6"),
        rewound("weld"),
    ]


def rewound(what):
    """The program fails where a bit differs."""
    return (f"{what}: {REWIND} windows taken back and computed again", "the same bit for bit", "the same bit for bit")
