"""OpenCV's fillConvexPoly and line, with 8 bits below the pixel: `pip install opencv-python-headless`."""
import cv2
import numpy as np


def fill(corners, window):
    masks = np.zeros((len(corners), window[1], window[0]), np.uint8)
    for mask, case in zip(masks, corners):
        cv2.fillConvexPoly(mask, np.int32(case * 256), 1, shift=8)
    return masks


def segments(ends, window):
    masks = np.zeros((len(ends), window[1], window[0]), np.uint8)
    for mask, (first, last) in zip(masks, ends.tolist()):
        cv2.line(mask, first, last, 1)
    return masks != 0


def test_fill(rasterproof):
    rasterproof.assert_rasterizer(fill, declare="range=4096")


def test_line(rasterproof):
    rasterproof.assert_lines(segments, declare="range=4096")
