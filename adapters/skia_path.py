"""Skia: Canvas.drawPath, and drawLine with width 0, without antialiasing on a raster surface (skia-python)."""

import numpy
import skia
from rasterproof import serve

FILL = skia.Paint(AntiAlias=False, Color=skia.ColorWHITE)
HAIRLINE = skia.Paint(AntiAlias=False, Color=skia.ColorWHITE, Style=skia.Paint.kStroke_Style, StrokeWidth=0)


def drawn(width, height, draw):
    pixels = numpy.zeros((height, width, 4), numpy.uint8)
    draw(skia.Surface(pixels).getCanvas())
    return pixels[:, :, 0]


def triangle(points, width, height):
    path = skia.Path().moveTo(*points[0]).lineTo(*points[1]).lineTo(*points[2]).close()
    return drawn(width, height, lambda canvas: canvas.drawPath(path, FILL))


def line(points, width, height):
    centres = [pixel + 0.5 for point in points for pixel in point]
    return drawn(width, height, lambda canvas: canvas.drawLine(*centres, HAIRLINE))


serve(f"skia-{skia.__version__}", "mask line-set batch=64", triangle, line)
