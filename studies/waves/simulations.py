"""The runs of the waves' study (thesis chapter 7): case 1 of the squeal study under traction and under braking, its
case 4 while friction is used up, and a wheel over a crack. All have the contact's or the surface's motion in short
steps."""

import pathlib

import cases

HERE = pathlib.Path(__file__).resolve().parent
CRACK = HERE / "crack.toml"
# Of the contact only the nodes near the patch are written, with what they move by.
NEAR = [
    "output.contact_margin=0.0011", 'output.contact_sides=["slave"]', "output.significant_digits=3",
    'output.contact_fields=["displacement", "normal_force", "tangential_force", "slip_velocity"]',
    "output.history_sets=[\"wheelset.bore\"]",
]
PERTURBED = [*NEAR, "output_windows.solutions.interval=1e-6", "output_windows.solutions.end=18.7e-3",
             "output_windows.waves.start=18.69e-3", "output_windows.waves.end=18.69e-3", "time.end=18.75e-3"]
SLIDING = [*NEAR, "output_windows.solutions.start=18.18e-3", "output_windows.solutions.end=18.27e-3",
           "output_windows.solutions.interval=0.3e-6", "time.end=18.3e-3"]
RUNS = {
    "traction": (cases.CASE, [*PERTURBED, *cases.settings(1)]),
    "braking": (cases.CASE, [*PERTURBED, *cases.settings(1), "loads.drive.moment=-17500"]),
    "creepage": (cases.CASE, None),  # by the motion of case 4, which may be another
    "crack": (CRACK, []),
}


def run(steps, name):
    """The results file of one of RUNS."""
    case, overrides = RUNS[name]
    return steps.run(name, case, [*SLIDING, *cases.settings(4)] if overrides is None else overrides)
