"""scikit-image: draw.polygon(rows, columns, shape) and draw.line(row, column, row, column)."""

import numpy
import skimage
from rasterproof import serve, walkable
from skimage import draw


def triangle(points, width, height):
    mask = numpy.zeros((height, width), bool)
    mask[draw.polygon([y for x, y in points], [x for x, y in points], mask.shape)] = True
    return mask


def line(points, width, height):
    (x0, y0), (x1, y1) = walkable(points)
    rows, columns = draw.line(y0, x0, y1, x1)
    return zip(columns.tolist(), rows.tolist())


serve(f"scikit-image-{skimage.__version__}", "mask batch=64", triangle, line)
