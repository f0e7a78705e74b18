"""Nodes of a contact's slave near the patch, of a results file with `output.contact_margin` (docs/results-file.md)."""

import h5py
import numpy as np


def near_nodes(results, contact, *more):
    """Of each output at which there are any: time, s; their places, m; normal force, N; and the named fields beside
    these."""
    with h5py.File(results, "r") as file:
        pair = file[f"contact/{contact}"]
        near, coordinates = pair["slave/near"], pair["slave/coordinates"][:]
        columns = [near[name] for name in ("node", "displacement", "normal_force", *more)]
        first = 0
        for time, last in zip(pair["time"][:], pair["slave/rows"][:]):
            if last > first:
                node, displacement, force, *rest = (column[first:last] for column in columns)
                if "node" in more:
                    rest[more.index("node")] = node
                yield (float(time), coordinates[node] + displacement, np.linalg.norm(force, axis=1), *rest)
            first = last
