"""Outer faces of hexahedra."""

import numpy as np

FACES = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
MOST_NODES = 1 << 21  # three numbers of nodes then fit into one of 63 bits


def exterior(elements):
    """Corners of the faces that belong to one element only (faces, 4), turned outwards, and their elements (faces)."""
    faces = elements[:, FACES].reshape(-1, 4)
    corners = np.sort(faces, axis=1).astype(np.int64)
    if corners.size and corners.max() < MOST_NODES:
        # Two faces of hexahedra that share three corners share the fourth.
        keys = (corners[:, 0] * MOST_NODES + corners[:, 1]) * MOST_NODES + corners[:, 2]
        _, first, count = np.unique(keys, return_index=True, return_counts=True)
    else:
        _, first, count = np.unique(corners, axis=0, return_index=True, return_counts=True)
    outside = np.sort(first[count == 1])
    return faces[outside], outside // 6
