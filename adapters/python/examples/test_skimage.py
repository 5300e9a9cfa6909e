"""scikit-image's draw.polygon and draw.line: `pip install scikit-image`."""
import numpy as np
from skimage.draw import line, polygon


def fill(corners, window):
    masks = np.zeros((len(corners), window[1], window[0]), bool)
    for mask, case in zip(masks, corners):
        # Pixel centres lie on whole numbers there.
        mask[polygon(case[:, 1] - 0.5, case[:, 0] - 0.5, mask.shape)] = True
    return masks


def segments(ends, window):
    lines = [np.stack(line(y0, x0, y1, x1)[::-1], 1) for (x0, y0), (x1, y1) in ends]
    return [pixels[((pixels >= 0) & (pixels < window)).all(1)] for pixels in lines]


def test_polygon(rasterproof):
    rasterproof.assert_rasterizer(fill, declare="range=4096")


def test_line(rasterproof):
    rasterproof.assert_lines(segments, declare="range=4096")
