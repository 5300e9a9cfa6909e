"""GDAL: GDALRasterizeGeometries of a Polygon and of a LineString, through rasterio.features.rasterize.

Its documentation promises the pixels whose centre is within the polygon. `all_touched` as the first argument
asks for ALL_TOUCHED.
"""

import sys

import rasterio
from rasterio.features import rasterize
from rasterio.transform import Affine
from rasterproof import serve, walkable

ALL_TOUCHED = sys.argv[1:] == ["all_touched"]


def drawn(geometry, width, height):
    return rasterize([geometry], (height, width), transform=Affine.identity(), all_touched=ALL_TOUCHED, dtype="uint8")


def triangle(points, width, height):
    return drawn({"type": "Polygon", "coordinates": [points + points[:1]]}, width, height)


def line(points, width, height):
    centres = [(x + 0.5, y + 0.5) for x, y in walkable(points)]
    return drawn({"type": "LineString", "coordinates": centres}, width, height)


name = f"gdal-{rasterio.__gdal_version__}" + "-all-touched" * ALL_TOUCHED
serve(name, "mask line-set batch=64", triangle, line)
