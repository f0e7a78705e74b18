"""Runs over several ranks, the bar that they are measured with, and their results compared bit for bit: for
same_on_ranks, rank_scaling and rank_forecast."""

import os

# Attributes of the results that say how the run went; others say when, and how long it took.
OF_THE_RUN = ("steps", "completed", "reason", "settling_evaluations", "smallest_step", "largest_step")

CUBE = 1e-3  # m, of an element
BAR = """title = "a ringing bar"
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.bar]
type = "box"
size = [{length}, {width}, {width}]
divisions = [{along}, {across}, {across}]
[parts.bar]
mesh = "bar"
material = "steel"
[loads.hit]
type = "pressure"
target = "bar.x_min"
pressure = 1e6
[solver]
step_estimate = "element"
[time]
end = {end}
[output]
history_interval = 1
field_interval = 1
field_sets = ["bar.x_min"]
fields = ["displacement"]
"""


def bar(elements, steps):
    """A case of a bar, four times as long as wide."""
    across = max(4, round((elements / 4) ** (1 / 3)))
    along = max(1, round(elements / across ** 2))
    speed = (210e9 * 0.7 / (1.3 * 0.4 * 7800)) ** 0.5  # m/s, of dilatational waves
    return BAR.format(
        length=along * CUBE, width=across * CUBE, along=along, across=across, end=steps * 0.9 * CUBE / speed
    )


def on_ranks(ranks, command):
    """A command, started by mpirun on one machine whatever its number of processors."""
    environment = dict(os.environ, OMP_WAIT_POLICY="passive")
    environment.setdefault("OMP_NUM_THREADS", "1")
    if os.geteuid() == 0:
        environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(ranks), *command]
    return command, environment


def arrays(path):
    """Of a results file, by name."""
    import h5py

    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, one: found.update({name: one[()]}) if isinstance(one, h5py.Dataset) else None)
        found.update({f"attribute {name}": file.attrs[name] for name in OF_THE_RUN if name in file.attrs})
    return found


def differing(one, other):
    """Names of arrays that differ in any bit, or that one alone has."""
    import numpy as np

    def plain(value):
        value = np.asarray(value)
        return value.shape, str(value.dtype), repr(value.tolist()) if value.dtype == object else value.tobytes()

    return sorted(
        name for name in one.keys() | other.keys()
        if name not in one or name not in other or plain(one[name]) != plain(other[name])
    )
