"""Decks of two elastic parts that meet in OpenRadioss's own format, whose open reader of keyword decks loses the
surfaces of contacts."""

from typing import NamedTuple


class Model(NamedTuple):
    """What such a deck has beside its mesh: units of mass, length and time; material; velocities along z of both
    parts; when it ends, and how often it writes."""

    units: tuple
    density: float
    youngs: float
    poisson: float
    velocities: tuple
    end: float
    interval: float


DIRECTIONS = {1: "100", 2: "010", 4: "110"}  # what TC of a node holds


def line(*fields):
    """Fields of (value, width)."""
    return "".join(f"{value:>{width}.10g}" if value != "" else " " * width for value, width in fields)


def numbers(values):
    return [line(*((value, 10) for value in values[first : first + 10])) for first in range(0, len(values), 10)]


def starter(name, deck, model):
    """The text of DECK_0000.rad."""
    units = "".join(f"{unit:>20}" for unit in model.units)
    lines = ["#RADIOSS STARTER", "/BEGIN", name, line((2022, 10), (0, 10)), units, units]
    lines += ["/MAT/ELAST/1", "elastic"]
    lines += [line((model.density, 20), (0, 20)), line((model.youngs, 20), (model.poisson, 20))]
    lines += ["/NODE", *(line((node[0], 10), *((place, 20) for place in node[1:4])) for node in deck.nodes)]
    lines += ["/PROP/SOLID/1", "solid"]
    lines += [line((24, 10), (0, 10), ("", 10), (0, 10), ("", 10), (0, 10), (0, 10), (0, 10), (0, 20))]
    lines += [line(*[(0, 20)] * 5), line((0, 20), (0, 10), (0, 10))]
    for part in (1, 2):
        lines += [f"/PART/{part}", f"part {part}", line((1, 10), (1, 10), (0, 10)), f"/BRICK/{part}"]
        lines += [line(*((n, 10) for n in (solid[0], *solid[2:]))) for solid in deck.solids if solid[1] == part]
        lines += [f"/SURF/PART/EXT/{part}", f"part {part}", line((part, 10))]
        lines += [f"/GRNOD/PART/{part}", f"part {part}", line((part, 10))]
        lines += [f"/INIVEL/TRA/{part}", f"part {part}"]
        lines += [line((0, 20), (0, 20), (model.velocities[part - 1], 20), (part, 10), (0, 10))]
    for code, held in DIRECTIONS.items():
        nodes = [node[0] for node in deck.nodes if node[4] == code]
        if nodes:
            lines += [f"/BCS/{code}", "held", f"   {held} 000" + line((0, 10), (100 + code, 10))]
            lines += [f"/GRNOD/NODE/{100 + code}", "held", *numbers(nodes)]
    lines += ["/INTER/TYPE25/1", "contact"]
    lines += [line((1, 10), (2, 10), (0, 10), (0, 10), (0, 10), (0, 10), ("", 10), (0, 10), (1000, 10))]
    lines += [line((0, 10), ("", 10), *[(0, 20)] * 4), line((0, 20), (0, 20), (0, 10), (0, 10), (0, 20))]
    lines += [line(*[(0, 20)] * 5)]
    lines += ["       000" + line(("", 10), (0, 10), (0, 10), (0, 20), (0, 10), ("", 10), (0, 20))]
    lines += [line((0, 10), (0, 10), (0, 20), (0, 10), ("", 30), (0, 10))]
    lines += ["/TH/PART/1", "parts", "DEF", line((1, 10), (2, 10)), "/END"]
    return "\n".join(lines) + "\n"


def engine(name, model):
    """The text of DECK_0001.rad."""
    return f"/RUN/{name}/1/\n{model.end:g}\n/TFILE/4\n{model.interval:g}\n/PRINT/-1000\n/VERS/2022\n"
