"""Adafruit's GFX library for CircuitPython: GFX.fill_triangle and GFX.line, with a pixel function of ours.

A display hands over a faster horizontal line where it has one, and so does this. Both calls walk every row or pixel of
the shape, in Python: those that are longer than MOST_ROWS are refused.
"""

from importlib.metadata import version

import numpy
from adafruit_gfx.gfx import GFX
from rasterproof import Refused, serve

MOST_ROWS = 1 << 14


def drawn(call, points, width, height):
    numbers = [int(value) for point in points for value in point]
    if max(numbers) - min(numbers) > MOST_ROWS:
        raise Refused(f"unsupported: the library walks the whole shape, here at most {MOST_ROWS} px of it")
    hits = []

    def pixel(x, y):
        if 0 <= x < width and 0 <= y < height:
            hits.append((x, y))

    def hline(x, y, length):
        if 0 <= y < height:
            hits.extend((x, y) for x in range(max(x, 0), min(x + length, width)))

    getattr(GFX(width, height, pixel, hline=hline), call)(*numbers)
    return hits


def triangle(*request):
    _, width, height = request
    mask = numpy.zeros((height, width), numpy.uint8)
    for x, y in drawn("fill_triangle", *request):
        mask[y, x] = 1
    return mask


serve(
    f"adafruit-gfx-{version('adafruit-circuitpython-gfx')}",
    "grid=1 mask batch=64",
    triangle,
    lambda *request: drawn("line", *request),
)
