"""OpenCV: fillPoly or fillConvexPoly (the first argument), lineType LINE_8, shift 8; line with LINE_8.

Corners are fixed-point numbers of 32 bits, 8 of them after the point.
"""

import sys

import cv2
import numpy
from rasterproof import serve

CALL = sys.argv[1] if len(sys.argv) > 1 else "fillPoly"


def triangle(points, width, height):
    mask = numpy.zeros((height, width), numpy.uint8)
    corners = (numpy.array(points) * 256).astype(numpy.int32)
    if CALL == "fillConvexPoly":
        cv2.fillConvexPoly(mask, corners, 255, cv2.LINE_8, 8)
    else:
        cv2.fillPoly(mask, [corners], 255, cv2.LINE_8, 8)
    return mask


def line(points, width, height):
    mask = numpy.zeros((height, width), numpy.uint8)
    cv2.line(mask, *points, 255, 1, cv2.LINE_8)
    return mask


serve(f"opencv-{cv2.__version__}-{CALL}", "grid=256 range=8388607 mask line-set batch=64", triangle, line)
