"""Pictures and movies as files: PNG, PDF, SVG; GIF, PNG that moves, MP4. Each carries a mark; a file without it is not
replaced."""

import io
import os
import shutil
import stat
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image, PngImagePlugin

from .results import BadFile

MARK = "made by Railwave's scripts for pictures, which may replace it"
FORMATS = ("png", "pdf", "svg")
MOVIES = ("gif", "png", "mp4")
BEGINNINGS = {".png": b"\x89PNG\r\n\x1a\n", ".gif": b"GIF8", ".pdf": b"%PDF-", ".svg": b"<?xml", ".mp4": b""}
FEW_COLOURS_BELOW = 200  # points an inch: a smaller PNG, for a screen, gets a palette, which makes it a third as large
OFTEN = 128  # colours of a palette that are exact
LARGEST = 1 << 28  # bytes of a file in which the mark is looked for


def made_by_us(path):
    """Whether a file is a picture or movie that these scripts wrote: it begins as its ending says and holds the
    mark."""
    begins = BEGINNINGS.get(os.path.splitext(path)[1].lower())
    if begins is None or os.path.getsize(path) > LARGEST:
        return False
    with open(path, "rb") as file:
        data = file.read()
    return data.startswith(begins) and MARK.encode() in data.replace(b"\\'", b"'")


def place_for(path, overwrite=False, inputs=()):
    """Where a picture named `path` is written: links are followed. Throws BadFile where it must not be: an input of the
    command, what is not a regular file, a file that may not be written, and, unless `overwrite`, one that these scripts
    did not write."""
    real = os.path.realpath(path)
    folder = os.path.dirname(real)
    if not os.path.isdir(folder):
        raise BadFile(f"cannot write {path}: there is no folder {folder}")
    if not os.path.lexists(real):
        return real
    there = f"; {path} is a link to it" if os.path.islink(path) else ""
    state = os.stat(real)
    if not stat.S_ISREG(state.st_mode):
        raise BadFile(f"cannot write {path}: {real} is no regular file; name another")
    for name in inputs:
        if os.path.exists(name) and os.path.samefile(name, real):
            raise BadFile(f"cannot write {path}: this command reads {name}; name another")
    if not state.st_mode & 0o222:
        raise BadFile(f"cannot write {path}: {real} is read-only; make it writable (chmod u+w), or name another")
    if not overwrite and not made_by_us(real):
        raise BadFile(
            f"{real} is there{there}, and these scripts did not write it: move it away, name another folder with --out,"
            " or replace it with --overwrite"
        )
    return real


def check_places(program, paths, overwrite, inputs=()):
    """For a script before it computes for minutes: ends it with 2 and the reason where one of its pictures must not be
    written."""
    try:
        for path in paths:
            place_for(str(path), overwrite, inputs)
    except BadFile as error:
        print(f"{program}: error: {error}", file=sys.stderr)
        sys.exit(2)


def put(path, write, overwrite=False, inputs=()):
    """Calls write(name) with the name of a file beside `path`, and puts that file in its place when it is whole."""
    real = place_for(path, overwrite, inputs)
    handle, beside = tempfile.mkstemp(prefix=".railwave-", suffix=os.path.splitext(path)[1], dir=os.path.dirname(real))
    os.close(handle)
    try:
        write(beside)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(beside, 0o666 & ~mask)
        os.replace(beside, real)
    except OSError as error:
        raise BadFile(f"cannot write {path}: {error.strerror or error}") from None
    finally:
        if os.path.exists(beside):
            os.remove(beside)


def put_figure(figure, path, resolution, overwrite=False, inputs=()):
    """Writes a figure; the path's ending is the format."""
    ending = os.path.splitext(path)[1].lower()

    def write(name):
        if ending == ".png":
            whole = io.BytesIO()
            figure.savefig(whole, dpi=resolution, format="png")
            with Image.open(whole) as image:
                image = image.convert("RGB")
                if resolution < FEW_COLOURS_BELOW:
                    image = _one_palette([image])[0]
                image.save(name, optimize=True, dpi=(resolution, resolution), pnginfo=_png_mark())
        elif ending == ".pdf":
            figure.savefig(name, dpi=resolution, format="pdf", metadata={"Creator": MARK, "CreationDate": None})
        elif ending == ".svg":
            figure.savefig(name, dpi=resolution, format="svg", metadata={"Creator": MARK, "Date": None})
        else:
            raise BadFile(f"cannot write {path}: pictures end in .{', .'.join(FORMATS)}")

    put(path, write, overwrite, inputs)


def _png_mark():
    info = PngImagePlugin.PngInfo()
    info.add_text("Software", MARK)
    return info


def _one_palette(frames):
    """All frames in the same 256 colours, so that a colour means the same in each: of a few frames, rare ones too."""
    few = [frames[i] for i in sorted({round(k * (len(frames) - 1) / 5) for k in range(6)})]
    pixels = np.concatenate([np.asarray(frame).reshape(-1, 3) for frame in few]).astype(np.uint32)
    there, count = np.unique(pixels @ np.array([65536, 256, 1], dtype=np.uint32), return_counts=True)
    there = there[np.argsort(-count, kind="stable")]
    colours = np.stack([there >> 16, there >> 8 & 255, there & 255], axis=1)
    colours = colours[(colours.min(axis=1) < 244) | (colours.min(axis=1) == 255)]
    # The most frequent ones exactly: even areas. Of the rest, shades and edges of lines, as many that are spread over
    # them. None but white is nearly white, or the ground would be grey.
    entries = colours[:OFTEN].flatten().tolist()
    rest = np.unique(colours[OFTEN:] & 0xFC, axis=0)
    if len(rest):
        strip = Image.fromarray(rest[None].astype(np.uint8), "RGB").quantize(
            256 - OFTEN, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE
        )
        entries += strip.getpalette()[: 3 * (256 - OFTEN)]
    palette = Image.new("P", (1, 1))
    palette.putpalette((entries + entries[:3] * 256)[: 3 * 256])
    return [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]


def check_movie(ending):
    """Throws BadFile where movies of this format can't be made on this machine."""
    if ending == "mp4" and not shutil.which("ffmpeg"):
        raise BadFile(
            "--format mp4 needs the program ffmpeg, which is not installed (Debian: apt-get install ffmpeg); gif and"
            " png need nothing more"
        )


def put_movie(frames, path, rate, overwrite=False, inputs=()):
    """Writes frames (RGB images of one size) as a movie of `rate` frames a second; the path's ending is the format."""
    ending = os.path.splitext(path)[1].lower()
    duration = max(20, round(1000 / rate))

    def write(name):
        if ending == ".gif":
            first, *rest = _one_palette(frames)
            first.save(
                name, save_all=True, append_images=rest, duration=duration, loop=0, optimize=False,
                comment=MARK.encode(),
            )
        elif ending == ".png":
            frames[0].save(
                name, save_all=True, append_images=frames[1:], duration=duration, loop=0, pnginfo=_png_mark()
            )
        elif ending == ".mp4":
            _write_mp4(frames, name, rate)
        else:
            raise BadFile(f"cannot write {path}: movies end in .{', .'.join(MOVIES)}")

    put(path, write, overwrite, inputs)


def _write_mp4(frames, path, rate):
    check_movie("mp4")
    width, height = (size - size % 2 for size in frames[0].size)  # H.264 wants even numbers
    command = [
        "ffmpeg", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r",
        str(rate), "-i", "-", "-pix_fmt", "yuv420p", "-metadata", f"comment={MARK}", path,
    ]
    data = b"".join(frame.crop((0, 0, width, height)).tobytes() for frame in frames)
    done = subprocess.run(command, input=data, stderr=subprocess.PIPE, check=False)
    if done.returncode != 0:
        raise BadFile(f"ffmpeg could not make {path}: {done.stderr.decode(errors='replace').strip()}")
