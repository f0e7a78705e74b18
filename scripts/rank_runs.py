"""Runs over several ranks, and their results compared bit for bit: for same_on_ranks and rank_scaling."""

import os

# Attributes of the results that say how the run went; others say when, and how long it took.
OF_THE_RUN = ("steps", "completed", "reason", "settling_evaluations", "smallest_step", "largest_step")


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
