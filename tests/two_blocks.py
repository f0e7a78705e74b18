"""The scene that many tests begin with, as text of a case file: a steel block above a held one, in frictional
contact."""

STEEL = """
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
"""


def two_blocks(lower, upper, position, steel=STEEL):
    """From the material to the contact, whose further keys may follow.

    lower, upper: size (m) and divisions of each block, three numbers each; position: of the upper one, m.
    """
    return f"""{steel}[meshes.lower]
type = "box"
size = {lower[0]}
divisions = {lower[1]}
[meshes.upper]
type = "box"
size = {upper[0]}
divisions = {upper[1]}
[parts.lower]
mesh = "lower"
material = "steel"
[parts.upper]
mesh = "upper"
material = "steel"
position = {position}
[constraints.floor]
target = "lower.z_min"
fixed = ["x", "y", "z"]
[contacts.between]
slave = "upper.z_min"
master = "lower.z_max"
friction = 0.3
algorithm = "penalty"
"""
