"""The earcut of Mapbox in C++, with the even-odd rule: `pip install mapbox_earcut`."""
import mapbox_earcut
import numpy as np


def triangles(contours):
    vertices = np.concatenate(contours)
    ends = np.cumsum([len(contour) for contour in contours]).astype(np.uint32)
    return vertices[mapbox_earcut.triangulate_float64(vertices, ends)].reshape(-1, 3, 2)


def test_triangulate_float64(rasterproof):
    rasterproof.assert_partition(triangles, declare="t-junctions triangles=any")
