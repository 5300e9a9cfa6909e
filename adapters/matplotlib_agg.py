"""matplotlib: RendererAgg.draw_path of a filled path and of a stroke of 1 px, without antialiasing and snapping.

Its y axis points up. Agg takes what it draws in 1/256 px; a line is a stroke of area, from centre to centre of two pixels.
"""

import matplotlib
import numpy
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.path import Path
from matplotlib.transforms import Affine2D
from rasterproof import serve


def drawn(points, width, height, fill=None, linewidth=0):
    renderer = RendererAgg(width, height, 72)
    gc = renderer.new_gc()
    gc.set_antialiased(False)
    gc.set_snap(False)
    gc.set_linewidth(linewidth)
    gc.set_foreground("black")
    to_window = Affine2D().scale(1, -1).translate(0, height)
    renderer.draw_path(gc, Path(points, closed=fill is not None), to_window, fill)
    return numpy.asarray(renderer.buffer_rgba())[:, :, 3]


serve(
    f"matplotlib-{matplotlib.__version__}-agg",
    "mask line-set batch=64",
    lambda points, *window: drawn([*points, points[0]], *window, fill=(0, 0, 0)),
    lambda points, *window: drawn([(x + 0.5, y + 0.5) for x, y in points], *window, linewidth=1),
)
