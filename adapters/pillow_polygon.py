"""Pillow: ImageDraw.polygon(xy, fill) and ImageDraw.line(xy, fill).

The handbook puts the centre of pixel (0, 0) at (0.5, 0.5) and promises nothing about edges.
"""

import numpy
import PIL
from PIL import Image, ImageDraw
from rasterproof import serve, walkable


def drawn(call, points, width, height):
    image = Image.new("L", (width, height))
    getattr(ImageDraw.Draw(image), call)(points, fill=255)
    return numpy.asarray(image)


serve(
    f"pillow-{PIL.__version__}",
    "mask line-set batch=64",
    lambda *request: drawn("polygon", *request),
    lambda points, *window: drawn("line", walkable(points), *window),
)
