import numpy as np
import rasterproof

def draw(corners, window):  # (n, 3, 2) in pixels, (width, height)
    x, y = np.arange(window[0]) + 0.5, np.arange(window[1])[:, None] + 0.5
    a, b, c = corners.transpose(1, 2, 0)[..., None, None]
    edge = lambda p, q: (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
    e = np.stack([edge(a, b), edge(b, c), edge(c, a)])
    return (e > 0).all(0) | (e < 0).all(0)  # masks of shape (n, height, width)

def test_draw():
    rasterproof.assert_rasterizer(draw, declare="range=4096")
