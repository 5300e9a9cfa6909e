"""matplotlib's Agg renderer, a filled path without antialiasing: `pip install matplotlib`."""
import numpy as np
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.path import Path
from matplotlib.transforms import IdentityTransform


def fill(corners, window):
    width, height = window
    renderer, masks = RendererAgg(width, height, 72), []
    pen = renderer.new_gc()
    pen.set_antialiased(False)
    pen.set_snap(False)
    pen.set_linewidth(0)
    for case in corners:
        renderer.clear()
        upright = np.stack([case[:, 0], height - case[:, 1]], 1)
        renderer.draw_path(pen, Path(np.append(upright, upright[:1], 0)), IdentityTransform(), (0, 0, 0))
        masks.append(np.asarray(renderer.buffer_rgba())[:, :, 3] > 0)
    return np.array(masks)


def test_fill(rasterproof):
    rasterproof.assert_rasterizer(fill, declare="range=4096")
