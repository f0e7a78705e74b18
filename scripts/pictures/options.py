"""The options of scripts/picture."""

import argparse
import math
import pathlib

from .output import FORMATS, MOVIES
from .view import VIEWS, read_view

PICTURES = ("forces", "energies", "patch", "row", "evolution")
FEWEST, MOST_DPI = 20, 2400

DESCRIPTION = """Draws a results file of Railwave. Without more options: forces, energies, and of each contact the \
patch with pressure, shear,
micro-slip, stick and slip, several instants in a row, their evolution. With --show or --by: bodies or the whole \
scene, deformed,
coloured by a field. With --animate: either of them as a movie. Or a model (--mesh), or what `railwave signal --hdf5` \
found
(--signal), or the table of a sweep (--sweep)."""

EXAMPLES = """examples:
  picture drop.h5 --by von_mises --time 5e-4             the whole scene at one instant
  picture drop.h5 --by von_mises --scale 20 --animate    a movie of it, the deformation 20 times
  picture drop.h5 --show plate --by displacement:z --view side --animate --format mp4
  picture rolling.h5 --animate                           the contact patch on its way
  picture rolling.h5 --only patch --format pdf           for a paper"""


def numbers(text, count, option, example, parser):
    try:
        values = [float(x) for x in text.split(",")]
    except ValueError:
        values = []
    if (count and len(values) != count) or not values or not all(map(math.isfinite, values)):
        parser.error(
            f"{option} {text}: {'numbers' if count is None else f'{count} numbers'} with commas between are wanted,"
            f" e.g. {example}"
        )
    return values


def program_of(root):
    """The railwave that belongs to these scripts: PREFIX/bin where they are PREFIX/share/railwave/scripts, else the
    one built in their source tree."""
    installed = root.parent.parent / "bin" / "railwave"
    return installed if installed.is_file() else root / "build" / "release" / "bin" / "railwave"


def make_parser(root):
    parser = argparse.ArgumentParser(
        prog="picture", description=DESCRIPTION, epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("results", nargs="?", help="results file of a run, e.g. rolling.h5")
    parser.add_argument(
        "--mesh",
        metavar="FILE",
        help="draw the model that `railwave mesh` wrote instead: parts, connectors, stable steps, ranks",
    )
    parser.add_argument(
        "--signal",
        metavar="FILE",
        help="draw what `railwave signal --hdf5` wrote instead: spectrum, scalogram, phase, ellipse, wave speed",
    )
    parser.add_argument(
        "--sweep", metavar="FILE", help="draw the table that `railwave sweep` wrote instead: each figure by parameter"
    )

    body = parser.add_argument_group("bodies and the scene")
    body.add_argument(
        "--show",
        metavar="NAME,...",
        help=(
            "parts, element sets or surfaces of output.field_sets; 'scene': all; 'contact NAME slave', 'contact NAME"
            " master': sides of a contact, with pressure, shear, gap, slip_velocity; default with --by: scene"
        ),
    )
    body.add_argument(
        "--by",
        metavar="FIELD",
        help=(
            "colours: displacement, velocity, acceleration (size; with :x, :y, :z along an axis), von_mises, pressure,"
            " stress:xx to stress:zx, plastic_strain, as far as output.fields has them; default with --show:"
            " displacement"
        ),
    )
    body.add_argument(
        "--scale", type=float, metavar="S",
        help="magnifies the deformation; of a body that rolls or travels its rigid motion stays as it is; default: 1",
    )
    body.add_argument(
        "--view",
        metavar="VIEW",
        help=(
            f"{', '.join(VIEWS)}, or azimuth,elevation of the eye in degrees (azimuth from +x towards +y); default: iso"
        ),
    )
    body.add_argument(
        "--range", metavar="LOW,HIGH", help="ends of the colour scale in SI units; default: those of all instants drawn"
    )
    body.add_argument(
        "--around", metavar="X,Y,Z", help="only what is near this place of the undeformed scene, m (with --mesh too)"
    )
    body.add_argument("--reach", type=float, metavar="R", help="how far from it along each axis, m; default: 0.3")

    when = parser.add_argument_group("when")
    when.add_argument(
        "--time", type=float, metavar="T",
        help="time of the picture of the patch or the bodies, s: the nearest output is drawn; default: the last",
    )
    when.add_argument("--times", metavar="T,...", help="times of the row, s; default: spread over the run")
    when.add_argument(
        "--animate", action="store_true", help="a movie: of the contact patches, or with --show or --by of bodies"
    )
    when.add_argument("--from", dest="first", type=float, metavar="T", help="first time of the movie, s")
    when.add_argument("--to", dest="last", type=float, metavar="T", help="last time of the movie, s")
    when.add_argument("--frames", type=int, metavar="N", help="frames of the movie at most; default: 60")
    when.add_argument("--rate", type=float, metavar="N", help="frames a second; default: 10")

    files = parser.add_argument_group("files")
    files.add_argument(
        "--out",
        metavar="DIR",
        help="folder for the pictures (made if it is not there); default: that of the results file",
    )
    files.add_argument("--only", metavar="NAME,...", help=f"which pictures, of {', '.join(PICTURES)}; default: all")
    files.add_argument(
        "--format",
        metavar="KIND",
        help=(
            f"{', '.join(FORMATS)}; of a movie {', '.join(MOVIES)} (png: one that moves; mp4 needs ffmpeg); default:"
            " png, gif"
        ),
    )
    files.add_argument("--resolution", type=int, metavar="DPI", help="points an inch; default: 300, of a movie 110")
    files.add_argument("--overwrite", action="store_true", help="replace files that this script did not write, too")
    files.add_argument(
        "--program",
        default=str(program_of(root)),
        help="the railwave that finds the contact solution",
    )
    files.add_argument(
        "--contact",
        metavar="FILE",
        help="take the contact solution from this file, of `railwave contact --hdf5`, instead",
    )
    return parser


def parse(root=pathlib.Path("."), arguments=None):
    """The arguments, checked: lists and numbers instead of texts, and whether bodies are drawn."""
    parser = make_parser(root)
    a = parser.parse_args(arguments)
    if sum(path is not None for path in (a.results, a.mesh, a.signal, a.sweep)) != 1:
        parser.error(
            "name either a results file or, after --mesh, a model that `railwave mesh` wrote, or, after --signal, what"
            " `railwave signal --hdf5` wrote, or, after --sweep, the table of `railwave sweep`"
        )

    def only_with(allowed, reason, **options):
        for name, value in options.items():
            if value not in (None, False) and not allowed:
                option = {"first": "from", "last": "to"}.get(name, name)
                parser.error(f"--{option}: {reason}")

    of_results = a.results is not None
    only_with(
        of_results, "belongs to a results file", show=a.show, by=a.by, scale=a.scale, view=a.view, range=a.range,
        animate=a.animate, only=a.only, time=a.time, times=a.times, contact=a.contact,
    )
    a.bodies = of_results and any(value is not None for value in (a.show, a.by, a.scale, a.view, a.range, a.around))
    only_with(a.bodies or a.mesh, "belongs to --mesh FILE, or to --show", around=a.around)
    only_with(a.around, "belongs to --around X,Y,Z", reach=a.reach)
    only_with(a.animate, "belongs to --animate", first=a.first, last=a.last, frames=a.frames, rate=a.rate)
    only_with(not a.animate, "is the time of a picture; of a movie give --from and --to", time=a.time, times=a.times)
    only_with(not a.bodies, "is of contacts' pictures, not of bodies", only=a.only, times=a.times, contact=a.contact)
    only_with(not a.animate, "is of pictures; a movie of the patches is --animate alone", only=a.only)

    formats = MOVIES if a.animate else FORMATS
    a.format = (a.format or formats[0]).lower()
    if a.format not in formats:
        parser.error(f"--format {a.format}: {'movies' if a.animate else 'pictures'} are {', '.join(formats)}")
    a.only = [name.strip() for name in a.only.split(",")] if a.only is not None else list(PICTURES)
    for name in a.only:
        if name not in PICTURES:
            parser.error(f"--only {name}: there are {', '.join(PICTURES)}")
    a.show = [name.strip() for name in (a.show or "scene").split(",")]
    a.by = a.by or "displacement"
    a.scale = 1.0 if a.scale is None else a.scale
    if not (math.isfinite(a.scale) and a.scale >= 0):
        parser.error(f"--scale {a.scale:g}: a number from 0 on is wanted")
    a.view = a.view or "iso"
    try:
        read_view(a.view)
    except ValueError:
        parser.error(
            f"--view {a.view}: give {', '.join(VIEWS)}, or two numbers, azimuth and elevation (-90 to 90) in degrees,"
            " e.g. --view=-60,25"
        )
    a.around = numbers(a.around, 3, "--around", "0,0,0.1 in m", parser) if a.around else None
    a.reach = 0.3 if a.reach is None else a.reach
    if not a.reach > 0:
        parser.error(f"--reach {a.reach:g}: a length above 0 is wanted, in m")
    a.range = numbers(a.range, 2, "--range", "0,3e8 in SI units", parser) if a.range else None
    if a.range and not a.range[0] < a.range[1]:
        parser.error("--range: the lower end comes first")
    a.times = numbers(a.times, None, "--times", "1e-3,2e-3 in s", parser) if a.times else None
    a.frames = 60 if a.frames is None else a.frames
    a.rate = 10.0 if a.rate is None else a.rate
    if not (1 <= a.frames <= 10000 and 0.1 <= a.rate <= 50):
        parser.error("--frames from 1 to 10000, --rate from 0.1 to 50 frames a second")
    if a.resolution is not None and not FEWEST <= a.resolution <= MOST_DPI:
        parser.error(f"--resolution {a.resolution}: from {FEWEST} to {MOST_DPI} points an inch")
    return a
