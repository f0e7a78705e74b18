"""Two blocks of which one falls onto the other, with all that a case may have: kinds of scenes whose runs are to be the
same to the last bit however they are interrupted or dealt out; and the comparison of their results."""

import h5py

BLOCKS = """
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
yield_stress = 2e8
tangent_modulus = 21e9
hardening_beta = 0.5
[materials.elastic]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.lower]
type = "box"
size = [0.06, 0.05, 0.03]
divisions = [6, 5, 3]
[meshes.upper]
type = "box"
size = [0.04, 0.04, 0.03]
divisions = [5, 5, 4]
[parts.lower]
mesh = "lower"
material = "steel"
[parts.upper]
mesh = "upper"
material = "{upper}"
position = [0.005, 0.005, 0.03001]
{of_upper}
[constraints.floor]
target = "lower.z_min"
fixed = ["x", "y", "z"]
[contacts.between]
slave = "upper.z_min"
master = "lower.z_max"
friction = 0.3
{of_contact}
[initial_motion.fall]
parts = ["upper"]
velocity = [2, 1, -2]
angular_velocity = [0, 30, 10]
[gravity]
acceleration = [0, 0, -1e5]
[time]
end = {end}
[probes.inside]
part = "lower"
position = [0.022, 0.022, 0.02]
quantities = ["acceleration", "stress", "strain", "plastic_strain"]
[element_sets.core]
part = "lower"
box = [[0.01, 0.01, 0], [0.05, 0.04, 0.02]]
[output]
file = "results.h5"
history_interval = 1e-5
field_interval = {field_interval}
field_sets = ["upper", "lower.z_max"]
fields = ["displacement", "velocity", "stress", "plastic_strain"]
history_sets = ["upper.z_max", "lower.core"]
progress_interval = 0.5
"""

WEIGHT = """
[points.weight]
mass = 0.3
position = [0.03, 0.03, 0.2]
[connectors.spring]
from = "{hub}"
to = "weight"
stiffness = [1e6, 1e6, 4e7]
damping = [100, 100, 3000]
preload = [0, 0, -3e3]
[curves.rise]
type = "cosine_ramp"
duration = 3e-4
[loads.turn]
type = "torque"
target = "upper.z_max"
axis = [0, 0, 1]
moment = 200
curve = "rise"
[loads.press]
type = "pressure"
target = "upper.x_min"
pressure = 2e7
curve = "rise"
"""

RIB = """
[meshes.rib]
type = "box"
size = [0.02, 0.02, 0.02]
divisions = [2, 2, 2]
[parts.rib]
mesh = "rib"
material = "elastic"
position = [0.06, 0.012, 0.002]
[ties.rib]
slave = "rib.x_min"
master = "lower.x_max"
"""

BEAMS = WEIGHT.format(hub="hub") + RIB + """
[points.hub]
mass = 0.5
position = [0.025, 0.025, 0.075]
[beams.spokes]
from = "hub"
to = "upper.z_max"
material = "elastic"
radius = 0.004
count = 4
orientation = [0, 0, 1]
divisions = 2
"""

ENDS = """
[non_reflecting.side]
target = "lower.y_max"
"""

# Several motions drive the same nodes: each its own way.
PUSHED = """
[prescribed_motion.push]
target = "rib.x_max"
velocity = [-1.5, 0, 0]
directions = ["x"]
[prescribed_motion.lift]
target = "rib.x_max"
displacement = [0, 0, 1e-5]
displacement_curve = "rise"
directions = ["z"]
[node_sets.edge]
part = "rib"
box = [[0.079, 0, 0.021], [0.081, 1, 1]]
[prescribed_motion.aside]
target = "rib.edge"
velocity = [0, 0.2, 0]
curve = "rise"
directions = ["y"]
[probes.driven]
part = "rib"
position = [0.08, 0.022, 0.022]
"""

def long_lower(layers):
    """A fine upper block on a lower one of so many layers of 10 mm."""
    return {
        "divisions = [5, 5, 4]": "divisions = [14, 14, 4]",
        "size = [0.06, 0.05, 0.03]": f"size = [0.06, 0.05, 0.{layers:02}]",
        "divisions = [6, 5, 3]": f"divisions = [6, 5, {layers}]",
        "0.03001]": f"0.{layers:02}001]",
    }


KINDS = {
    "penalty": dict(
        of_contact="damping = 0.1\nfriction_decay = 0.5\ndynamic_friction = 0.1",
        of_upper="stiffness_damping = 2e-8\nmass_damping = 20",
    ),
    "multiplier": dict(of_contact='algorithm = "multiplier"'),
    "much_else": dict(more=BEAMS + ENDS + PUSHED, end=6e-4),
    "symmetric_and_settled": dict(
        of_contact="symmetric = true", more="[settle]\ncache = false\n", of_upper='hourglass = "stiffness"'
    ),
    "subcycling": dict(
        of_contact='algorithm = "penalty"',
        more="[solver]\nsubcycling = true\n" + WEIGHT.format(hub="upper.z_max") + ENDS,
        of_upper="stiffness_damping = 2e-9",
        end=4e-4,
        instead=long_lower(8),
    ),
    "subcycling_much_else": dict(
        of_contact='algorithm = "multiplier"',
        more="[solver]\nsubcycling = true\n" + BEAMS + PUSHED,
        end=4e-4,
        instead={
            **long_lower(24),
            "[0.025, 0.025, 0.075]": "[0.025, 0.025, 0.285]",
            "[0.03, 0.03, 0.2]": "[0.03, 0.03, 0.41]",
        },
    ),
    "mixed": dict(
        more='[solver]\nprecision = "mixed"\n' + BEAMS + ENDS + PUSHED, of_upper="stiffness_damping = 2e-8", end=6e-4
    ),
    "float": dict(more='[solver]\nprecision = "float"\n' + BEAMS, of_upper="linear_bulk_viscosity = 0.1", end=6e-4),
    "float_multiplier": dict(
        more='[solver]\nprecision = "float"\n', of_contact='algorithm = "multiplier"\nnormals = "smooth"'
    ),
    "monitored": dict(
        more=(
            "[monitor]\nspeed = 1\npenetration = 1e-4\nchatter = 1\nhourglass_share = 1e-3\n"
            "hourglass_distortion = 1e-5\nvolume_ratio = 0.999\nenergy_error = 1e-4\nkinetic_growth = 1e-6\n"
        )
    ),
    "windows": dict(
        instead={
            "progress_interval = 0.5": (
                "progress_interval = 0.5\ncontact_margin = 0.012\nprecision = \"single\"\n"
                'contact_fields = ["displacement", "normal_force", "tangential_force", "slipping"]'
            )
        },
        more=(
            "[output_windows.landing]\nstart = 2.03e-4\nend = 4.1e-4\ninterval = 6e-6\nfield_sets = []\n"
            "[output_windows.late]\nstart = 3.9e-4\ninterval = 7e-5\ncontacts = []\n"
        )
    ),
    "global_step": dict(
        of_contact='algorithm = "penalty"',  # whose springs come and go
        more=(
            '[solver]\nstep_estimate = "global"\nrenew_steps = 97\n'
            "[output_windows.landing]\nstart = 2.03e-4\nend = 4.1e-4\ninterval = 6e-6\n"
        ),
        instead={"[0, 0, -1e5]": "[0, 0, -9.81]", "velocity = [2, 1, -2]": "velocity = [2, 1, -12]"},
    ),
}


# The default takes the whole scene's step while the upper block flies, and a shorter one as it comes down.
KINDS["automatic_step"] = dict(
    of_contact="damping = 0.05\npenalty_scale = 3",
    instead={"velocity = [2, 1, -2]": "velocity = [0.001, 0, 0]", "[0, 30, 10]": "[0, 0, 0.1]",
             "[0.005, 0.005, 0.03001]": "[0.005, 0.005, 0.042]", "[0, 0, -1e5]": "[0, 0, -5e3]"},
    end=4e-3,
)
# A blow that squeezes the upper block, so that the step follows its elements.
KINDS["deforming"] = dict(
    of_contact='algorithm = "penalty"\ndamping = 0.05',
    instead={"velocity = [2, 1, -2]": "velocity = [5, 1, -150]", "[0, 30, 10]": "[0, 0, 0]",
             "yield_stress = 2e8": "yield_stress = 5e7", "tangent_modulus = 21e9": "tangent_modulus = 5e8",
             "[0, 0, -1e5]": "[0, 0, -9.81]", "[0.005, 0.005, 0.03001]": "[0.005, 0.005, 0.034]"},
    end=3e-4,
)


def case(of_contact="", of_upper="", more="", upper="steel", end=1.2e-3, field_interval=5e-5, instead=()):
    text = (
        BLOCKS.format(of_contact=of_contact, of_upper=of_upper, upper=upper, end=end, field_interval=field_interval)
        + more
    )
    for old in instead:
        assert old in text
        text = text.replace(old, instead[old])
    return text


def arrays(path):
    """Of a results file, by name."""
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def different_arrays(one, other):
    """Names of arrays of two results files that differ in any bit, or that one of them lacks."""
    first, second = arrays(one), arrays(other)
    return sorted(
        name
        for name in first.keys() | second.keys()
        if name not in first
        or name not in second
        or first[name].shape != second[name].shape
        or first[name].tobytes() != second[name].tobytes()
    )
