"""raylib: ImageDrawTriangle and ImageDrawLine on an image of 8 bits, or DrawTriangle and DrawLineV in the window of its
software renderer, rlsw (the first argument says which).

Positions are floats, those of ImageDrawLine int; as in OpenGL, rlsw has a pixel's centre at (0.5, 0.5), and a line is
drawn from centre to centre. DrawTriangle asks for counter-clockwise corners. One window, with SDL's dummy driver, holds
all others.
"""

import os
import sys
from importlib.metadata import version

os.environ["SDL_VIDEODRIVER"] = "dummy"
# raylib logs to the standard output: what it prints while it is loaded goes to the error output.
protocol = os.dup(1)
os.dup2(2, 1)
import numpy
import raylib as rl
from raylib import ffi
from rasterproof import MOST_SIDE, serve, walkable

os.dup2(protocol, 1)
WHITE, BLACK = (255, 255, 255, 255), (0, 0, 0, 255)

def on_image(draw, width, height):
    image = ffi.new("Image *", rl.GenImageColor(width, height, BLACK))
    rl.ImageFormat(image, rl.PIXELFORMAT_UNCOMPRESSED_GRAYSCALE)
    draw(image)
    mask = numpy.frombuffer(ffi.buffer(image.data, width * height), numpy.uint8).reshape(height, width).copy()
    rl.UnloadImage(image[0])
    return mask


def in_window(draw, width, height):
    if not rl.IsWindowReady():
        rl.SetTraceLogLevel(rl.LOG_NONE)
        rl.InitWindow(MOST_SIDE, MOST_SIDE, b"rasterproof")
    rl.ClearBackground(BLACK)
    rl.rlViewport(0, 0, width, height)
    rl.rlMatrixMode(rl.RL_PROJECTION)
    rl.rlLoadIdentity()
    rl.rlOrtho(0, width, height, 0, 0, 1)
    rl.rlMatrixMode(rl.RL_MODELVIEW)
    rl.rlLoadIdentity()
    draw()
    rl.rlDrawRenderBatchActive()
    pixels = rl.rlReadScreenPixels(width, height)
    # rlReadScreenPixels turns the rows around, as OpenGL's need it; those of rlsw run from the top already.
    mask = numpy.frombuffer(ffi.buffer(pixels, 4 * width * height), numpy.uint32).reshape(height, width)[::-1] != 0xFF000000
    rl.MemFree(pixels)
    return mask


if sys.argv[1:] == ["rlsw"]:
    drawn, declares = in_window, "winding=ccw mask line-set batch=64"
    fill = lambda points: rl.DrawTriangle(*points, WHITE)
    stroke = lambda ends: rl.DrawLineV(*[(x + 0.5, y + 0.5) for x, y in ends], WHITE)
else:
    drawn, declares = on_image, "mask line-set batch=64"
    fill = lambda image, points: rl.ImageDrawTriangle(image, *points, WHITE)
    stroke = lambda image, ends: rl.ImageDrawLine(image, *ends[0], *ends[1], WHITE)
serve(
    f"raylib-{version('raylib-software')}-{sys.argv[1]}",
    declares,
    lambda points, *window: drawn(lambda *image: fill(*image, points), *window),
    lambda points, *window: drawn(lambda *image: stroke(*image, walkable(points)), *window),
)
