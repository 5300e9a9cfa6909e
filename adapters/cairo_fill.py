"""Cairo: cairo_fill with ANTIALIAS_NONE on an A8 image surface, through cairocffi. It has no line of pixels."""

import cairocffi
import numpy
from rasterproof import serve


def triangle(points, width, height):
    surface = cairocffi.ImageSurface(cairocffi.FORMAT_A8, width, height)
    context = cairocffi.Context(surface)
    context.set_antialias(cairocffi.ANTIALIAS_NONE)
    for point in points:
        context.line_to(*point)
    context.close_path()
    context.fill()
    surface.flush()
    return numpy.frombuffer(surface.get_data(), numpy.uint8).reshape(height, -1)[:, :width].copy()


serve(f"cairo-{cairocffi.cairo_version_string()}", "mask batch=64", triangle)
