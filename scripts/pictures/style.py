"""The look of all pictures: sizes of text, colours, colour maps; quantities with names, units and prefixes."""

import matplotlib
import numpy as np

TITLE, TEXT, SMALL, TINY = 10, 9, 8, 7  # points
RESOLUTION = 300  # points an inch of a picture
MOVIE_RESOLUTION = 110  # of a movie

SHEAR, SLIP, BOUND, STICK = "#10407f", "#c2185b", "#b3261e", "#0a7a4a"
CURVE, MARKED = "#10407f", "#b3261e"
LIST = "tab10"  # colours of things without an order
PRESSURE_MAP, PARTING_MAP = "YlOrRd", "PuOr"
SCALOGRAM_MAP, POWER_MAP = "YlGnBu", "magma"
SIZE_MAP, SIGNED_MAP = "viridis", "RdBu_r"  # of a quantity from zero on; of one with a sign

SETTINGS = {
    "font.size": TEXT,
    "axes.titlesize": TEXT,
    "axes.labelsize": TEXT,
    "xtick.labelsize": SMALL,
    "ytick.labelsize": SMALL,
    "legend.fontsize": SMALL,
    "figure.titlesize": TITLE,
    "grid.alpha": 0.3,
    "lines.linewidth": 1.2,
    "image.cmap": SIZE_MAP,
    "figure.facecolor": "white",
    "text.parse_math": False,  # a title may say what something costs in $
    "pdf.fonttype": 42,  # text stays text
    "svg.fonttype": "none",
    "svg.hashsalt": "railwave",  # the same picture, the same file
}


def apply():
    """Makes this look matplotlib's; needs no display."""
    matplotlib.use("Agg")
    matplotlib.rcParams.update(SETTINGS)


PREFIXES = (
    (1e12, "T"),
    (1e9, "G"),
    (1e6, "M"),
    (1e3, "k"),
    (1, ""),
    (1e-3, "m"),
    (1e-6, "\N{MICRO SIGN}"),
    (1e-9, "n"),
    (1e-12, "p"),
)


def scale_of(largest, prefixes=PREFIXES):
    """Factor and prefix in which a number of this size reads well."""
    for unit, prefix in prefixes:
        if np.isfinite(largest) and largest >= unit * (1 - 1e-9):
            return 1 / unit, prefix
    return 1.0, ""


def unit_of(largest, unit):
    """Factor and unit with a prefix for a quantity of this size: 3e8 of "Pa" gives 1e-6 and "MPa"; m/s2 and no unit
    stay."""
    if unit in ("", "m/s2", "m/s\N{SUPERSCRIPT TWO}", "1", "-"):
        return 1.0, "" if unit in ("1", "-") else unit
    factor, prefix = scale_of(largest)
    return factor, prefix + unit


def label_of(name, unit):
    """"stress, MPa": what stands at an axis or a colour bar."""
    return f"{name}, {unit}" if unit else name
