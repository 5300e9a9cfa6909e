"""Shapely, by GEOS; polygons that are not valid there are not taken: `pip install shapely`."""
import numpy as np
import shapely


def triangles(contours):
    if min(len(contour) for contour in contours) < 3:
        return None
    polygon = shapely.Polygon(contours[0], contours[1:])
    if not polygon.is_valid:
        return None
    try:
        parts = shapely.constrained_delaunay_triangles(polygon).geoms
    except shapely.errors.GEOSException:
        return np.empty((0, 3, 2))  # which is a gap
    return np.array([shapely.get_coordinates(part)[:3] for part in parts])


def test_constrained_delaunay_triangles(rasterproof):
    rasterproof.assert_partition(triangles, declare="t-junctions triangles=any")
