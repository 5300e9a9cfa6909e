"""Pillow's ImageDraw.polygon and ImageDraw.line: `pip install pillow`."""
import numpy as np
from PIL import Image, ImageDraw


def drawn(method):
    def draw(corners, window):
        masks = []
        for case in corners:
            image = Image.new("1", window)
            getattr(ImageDraw.Draw(image), method)([tuple(corner) for corner in case], fill=1)
            masks.append(np.array(image))
        return np.array(masks)

    draw.__name__ = method
    return draw


def test_polygon(rasterproof):
    rasterproof.assert_rasterizer(drawn("polygon"), declare="range=4096")


def test_line(rasterproof):
    rasterproof.assert_lines(drawn("line"), declare="range=4096")
