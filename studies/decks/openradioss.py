"""The decks beside OpenRadioss: the same nodes, elements, materials and velocities in another explicit program.

The figures kept here are OpenRadioss's own: its sources of 21 August 2026 (commit bd4557ba), built with gfortran 12 in
double precision, with its open reader, which takes formats up to 2026 and lacks rigid parts and structured ALE meshes
(none here has these). That build gives the energies that OpenRadioss publishes with its test SOLIDES/nv_elts/
poutre_flex/flexion/HEPH at cycle 800 in all their digits (internal 2.529e5, kinetic 6.969e4). All is by its defaults:
one-point hexahedra with physical stabilisation (Isolid 24), contact by penalty springs (TYPE25), bulk viscosity 1.1 and
0.05."""

import csv
from typing import NamedTuple

import numpy as np
from comparison import contact_times

UNITS = {  # kg, m, s
    "rod_on_wall": (175.126835, 0.0254, 1.0),
    "plastic_bar": (1.0, 1e-3, 1e-3),
    "taylor_bar": (1e-3, 1e-3, 1e-3),
    "two_bars": (1.0, 1e-3, 1e-3),
    "balls": (1e3, 1e-3, 1.0),
}
QUARTERS = ("balls",)


class History(NamedTuple):
    """A run by time: s, N, J. `taken` is what bodies and contacts have stored and dissipated."""

    time: np.ndarray
    force: np.ndarray
    kinetic: np.ndarray
    taken: np.ndarray
    plastic: np.ndarray


def of_railwave(name, results):
    whole = 4 if name in QUARTERS else 1
    energy = {key: whole * values[:] for key, values in results["history/energy"].items()}
    (contact,) = results["history/contact"].values()
    taken = ("internal", "hourglass", "contact", "friction", "plastic", "damping")
    return History(
        results["history/time"][:],
        whole * np.abs(contact["normal_force"][:, 2]),
        energy["kinetic"],
        sum(energy[key] for key in taken),
        energy["plastic"],
    )


def of_openradioss(name, path):
    """Of a time history T01 as OpenRadioss's th_to_csv writes it; the force is by the last part's momentum."""
    with open(path, newline="", encoding="utf-8") as file:
        heading, *rows = csv.reader(file)
    heading = [" ".join(title.split()) for title in heading]
    table = np.array([[float(field) for field in row if field.strip()] for row in rows if len(row) > 5])
    mass, length, second = UNITS[name]
    whole = 4 if name in QUARTERS else 1
    time = second * table[:, 0]
    momentum = table[:, max(place for place, title in enumerate(heading) if title.endswith("ZMOM"))]

    def energy(title):
        return whole * mass * (length / second) ** 2 * table[:, heading.index(title)]

    return History(
        time,
        np.abs(np.gradient(whole * mass * length / second * momentum, time)),
        energy("KINETIC ENERGY"),
        energy("INTERNAL ENERGY") + energy("CONTACT ENERGY"),
        energy("PLASTIC WORK"),
    )


def mean_force(run):
    """kN, in the middle half of the contact; what a body's first layer gives a wall within one step is left out."""
    begin, end = contact_times(run.time, np.where(run.time > run.time[1], run.force, 0.0), 0.05)
    middle = np.abs(run.time - (begin + end) / 2) < (end - begin) / 4
    return run.force[middle].mean() / 1e3


def lasting(run):
    begin, end = contact_times(run.time, run.force, 0.01)
    return 1e6 * (end - begin)


MEASURES = {
    "contact force": (mean_force, "kN"),
    "largest contact force": (lambda run: run.force.max() / 1e3, "kN"),
    "contact lasts, by a hundredth of the largest force": (lasting, "us"),
    "kinetic energy at least": (lambda run: run.kinetic.min(), "J"),
    "kinetic energy at the end": (lambda run: run.kinetic[-1], "J"),
    "energy stored and dissipated at most": (lambda run: run.taken.max(), "J"),
    "plastic work at the end": (lambda run: run.plastic[-1], "J"),
}

# OpenRadioss's reader leaves out the rod's CONTROL_BULK_VISCOSITY: what that takes is not compared.
KEPT = {
    "rod_on_wall": {"contact force": 133.22, "energy stored and dissipated at most": 16.76},
    "plastic_bar": {
        "contact force": 52.921,
        "kinetic energy at the end": 6.8421,
        "energy stored and dissipated at most": 71.47,
        "plastic work at the end": 51.41,
    },
    "taylor_bar": {
        "contact force": 28.359,
        "energy stored and dissipated at most": 234.46,
        "plastic work at the end": 232.08,
    },
    "two_bars": {
        "largest contact force": 21.082,
        "kinetic energy at least": 10.224,
        "kinetic energy at the end": 18.757,
        "energy stored and dissipated at most": 9.3639,
    },
    "balls": {
        "largest contact force": 6.8178,
        "contact lasts, by a hundredth of the largest force": 42.6,
        "kinetic energy at the end": 0.20273,
        "energy stored and dissipated at most": 0.20519,
    },
}


def compare(name, results, history):
    """(what, found, OpenRadioss's figure, unit) of a deck; history: a time history to take in place of what is kept."""
    run = of_railwave(name, results)
    other = of_openradioss(name, history) if history else None
    for what, kept in KEPT[name].items():
        measure, unit = MEASURES[what]
        yield what, measure(run), measure(other) if other else kept, unit
