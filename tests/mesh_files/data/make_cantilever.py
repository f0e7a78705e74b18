#!/usr/bin/env python3
"""Writes cantilever.inp: a bar of 100 x 10 x 10 mm along z in the form of CalculiX's example decks (mm, N, s)."""

import pathlib

DIVISIONS = (4, 4, 40)
SIZE = (10.0, 10.0, 100.0)


def node(i, j, k):
    return 1 + i + (DIVISIONS[0] + 1) * (j + (DIVISIONS[1] + 1) * k)


def lines_of(numbers, per_line=8):
    for start in range(0, len(numbers), per_line):
        yield "".join(f"{number:6d}," for number in numbers[start:start + per_line])


def deck():
    nx, ny, nz = DIVISIONS
    yield "** A cantilever of 8-node hexahedra, held at z = 0, in mm, N, s and t. Written by make_cantilever.py."
    yield "*HEADING"
    yield "Cantilever"
    yield "*NODE, NSET=Nall"
    for k in range(nz + 1):
        for j in range(ny + 1):
            for i in range(nx + 1):
                x, y, z = (SIZE[0] * i / nx, SIZE[1] * j / ny, SIZE[2] * k / nz)
                yield f"{node(i, j, k):6d}, {x:9.4f}, {y:9.4f}, {z:9.4f}"
    element = 0
    yield "*ELEMENT, TYPE=C3D8, ELSET=Eall"
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                element += 1
                corners = [node(i + a, j + b, k + c)
                           for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                yield f"{element:6d}," + "".join(f"{corner:6d}," for corner in corners[:4])
                yield "       " + ",".join(f"{corner:6d}" for corner in corners[4:])
    yield "*NSET, NSET=FIX"
    yield from lines_of([node(i, j, 0) for j in range(ny + 1) for i in range(nx + 1)])
    yield "*NSET, NSET=LAST, GENERATE"
    yield f"{node(0, 0, nz)}, {node(nx, ny, nz)}"
    yield "*ELSET, ELSET=ELAST, GENERATE"
    yield f"{element - nx * ny + 1}, {element}, 1"
    yield "*SURFACE, NAME=SLAST, TYPE=ELEMENT"
    yield "ELAST, S2"
    yield "*BOUNDARY"
    yield "FIX, 1, 3"
    yield "*MATERIAL, NAME=EL"
    yield "*ELASTIC"
    yield "210000.0, .3"
    yield "*DENSITY"
    yield "7.8E-9"
    yield "*SOLID SECTION, ELSET=Eall, MATERIAL=EL"
    yield "*STEP"
    yield "*STATIC"
    yield "*CLOAD"
    yield "LAST, 1, 1."
    yield "*NODE PRINT, NSET=LAST"
    yield "U"
    yield "*END STEP"


if __name__ == "__main__":
    path = pathlib.Path(__file__).with_name("cantilever.inp")
    path.write_text("\n".join(deck()) + "\n")
