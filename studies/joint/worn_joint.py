"""A made-up worn joint as a height map for `height_map` of a track: what hammering wheels leave of two rail ends.

The thesis's measured surface (fig. 4.4) is not printed. Both ends are battered down towards the gap, the one behind it,
on which wheels land, deeper and longer; a shallow second dip lies where they land again. Depths and lengths are
parameters.
"""

import argparse
import csv
import math


def height(x, y, shape):
    """Change of height at a place of the running surface, m: zero or less.

    x: along the track from the gap's middle, m; y: across, from the middle of the running band, m.
    """
    before, behind = shape.depth * (1 - shape.asymmetry), shape.depth * (1 + shape.asymmetry)
    depth, length = (before, shape.length * (1 - shape.asymmetry)) if x < 0 else (
        behind, shape.length * (1 + shape.asymmetry))
    along = depth * math.exp(-((abs(x) / length) ** 2) * math.log(10))  # a tenth is left at `length`
    second = shape.second_depth * math.exp(-(((x - shape.second_place) / shape.second_length) ** 2))
    across = math.exp(-((y / shape.width) ** 4))
    return -(along + second) * across


def add_options(parser):
    parser.add_argument("--depth", type=float, default=0.15e-3, metavar="M",
                        help="at the gap, mean of both ends; default: 0.15e-3")
    parser.add_argument("--length", type=float, default=0.03, metavar="M",
                        help="from the gap to where a tenth of the depth is left, mean of both; default: 0.03")
    parser.add_argument("--asymmetry", type=float, default=0.25, metavar="SHARE",
                        help="by so much the end behind the gap is deeper and longer, the other less; default: 0.25")
    parser.add_argument("--second-depth", type=float, default=0.02e-3, metavar="M",
                        help="of the dip where wheels land again; default: 0.02e-3")
    parser.add_argument("--second-place", type=float, default=0.062, metavar="M", help="default: 0.062")
    parser.add_argument("--second-length", type=float, default=0.012, metavar="M", help="default: 0.012")
    parser.add_argument("--width", type=float, default=0.02, metavar="M",
                        help="half of the band that is worn; default: 0.02")
    parser.add_argument("--centre", type=float, default=-0.003, metavar="M",
                        help="y of its middle, in the track's own axes; default: -0.003")


def default_shape():
    """The shape by the options' defaults."""
    parser = argparse.ArgumentParser()
    add_options(parser)
    return parser.parse_args([])


def write(path, shape):
    """The height map of a shape (the options above, as attributes) as a CSV file with the columns x, y, dz."""
    steps = [k * 0.5e-3 for k in range(-240, 241)]
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["x", "y", "dz"])
        for x in steps:
            for k in range(-20, 21):
                y = 2e-3 * k
                table.writerow([f"{x:.6g}", f"{y + shape.centre:.6g}", f"{height(x, y, shape):.6g}"])


def main():
    parser = argparse.ArgumentParser(prog="worn_joint.py", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser)
    parser.add_argument("file", help="the height map that is written")
    shape = parser.parse_args()
    write(shape.file, shape)


if __name__ == "__main__":
    main()
