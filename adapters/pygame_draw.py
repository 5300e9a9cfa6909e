"""pygame: draw.polygon and draw.line of width 1 on a surface of 8 bits.

Positions may be floats; the documentation of draw.line says that they are truncated, that of draw.polygon nothing.
"""

import os

os.environ["PYGAME_HIDE_SUPPORT_PROMPT"] = "1"

import pygame
from rasterproof import serve, walkable

surfaces = {}


def drawn(call, points, width, height):
    surface = surfaces.setdefault((width, height), pygame.Surface((width, height), depth=8))
    surface.fill(0)
    call(surface, 255, *points)
    return pygame.surfarray.array2d(surface).T


serve(
    f"pygame-{pygame.version.ver}",
    "mask line-set batch=64",
    lambda points, *window: drawn(pygame.draw.polygon, [points], *window),
    lambda points, *window: drawn(pygame.draw.line, walkable(points), *window),
)
