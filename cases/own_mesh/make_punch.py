#!/usr/bin/env python3
"""Writes punch.inp: a block of 24 x 24 x 40 mm whose lower side is rounded, as Abaqus and CalculiX write meshes
(mm)."""

import pathlib

DIVISIONS = (8, 8, 8)
SIZE = (24.0, 24.0, 40.0)
RADIUS = 400.0  # of the rounded side


def node(i, j, k):
    return 1 + i + (DIVISIONS[0] + 1) * (j + (DIVISIONS[1] + 1) * k)


def place(i, j, k):
    x, y = (SIZE[c] * (n / DIVISIONS[c] - 0.5) for c, n in ((0, i), (1, j)))
    low = RADIUS - (RADIUS**2 - x**2 - y**2) ** 0.5  # lowest in the middle, at z = 0
    return x, y, low + (SIZE[2] - low) * k / DIVISIONS[2]


def deck():
    nx, ny, nz = DIVISIONS
    yield "** A punch with a rounded nose, in mm. Written by make_punch.py."
    yield "*HEADING"
    yield "Punch"
    yield "*NODE, NSET=Nall"
    for k in range(nz + 1):
        for j in range(ny + 1):
            for i in range(nx + 1):
                x, y, z = place(i, j, k)
                yield f"{node(i, j, k)}, {x:.6f}, {y:.6f}, {z:.6f}"
    yield "*ELEMENT, TYPE=C3D8R, ELSET=Eall"
    number = 0
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                number += 1
                corners = [node(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                yield ", ".join(str(n) for n in [number, *corners])
    layer = nx * ny
    yield "** The lowest and the highest layer of elements, and their lower and upper faces."
    yield "*ELSET, ELSET=Tip, GENERATE"
    yield f"1, {layer}, 1"
    yield "*ELSET, ELSET=Head, GENERATE"
    yield f"{layer * (nz - 1) + 1}, {layer * nz}, 1"
    yield "*SURFACE, NAME=Nose, TYPE=ELEMENT"
    yield "Tip, S1"
    yield "*SURFACE, NAME=Back, TYPE=ELEMENT"
    yield "Head, S2"
    yield "** A node in the middle of the upper side."
    yield "*NSET, NSET=Eye"
    yield f"{node(nx // 2, ny // 2, nz)}"


if __name__ == "__main__":
    pathlib.Path(__file__).with_name("punch.inp").write_text("\n".join(deck()) + "\n", encoding="ascii")
