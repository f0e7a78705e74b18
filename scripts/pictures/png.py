"""Small PNG files."""

import io

from PIL import Image


def put_png(figure, resolution, path):
    """A palette of 255 colours makes the file a third as large."""
    whole = io.BytesIO()
    figure.savefig(whole, dpi=resolution)
    with Image.open(whole) as image:
        image.convert("RGB").quantize(255, method=Image.Quantize.MAXCOVERAGE).save(path, optimize=True)
