import math
import sys


def triangle(x0, y0, x1, y1, x2, y2, width, height):
    """Runs of pixels: row, first column, one past the last."""
    side = lambda ax, ay, bx, by, x, y: (bx - ax) * (y - ay) - (by - ay) * (x - ax)
    if side(x0, y0, x1, y1, x2, y2) < 0:
        x1, y1, x2, y2 = x2, y2, x1, y1
    columns = range(max(0, math.floor(min(x0, x1, x2))), min(width, math.ceil(max(x0, x1, x2))))
    bottom = min(height, math.ceil(max(y0, y1, y2) - 0.5))
    for y in range(max(0, math.floor(min(y0, y1, y2))), bottom - 1):
        for x in columns:
            inside = True
            for ax, ay, bx, by in ((x0, y0, x1, y1), (x1, y1, x2, y2), (x2, y2, x0, y0)):
                e = side(ax, ay, bx, by, x + 0.5, y + 0.5)
                inside = inside and (e > 0 or e == 0 and (ay == by and bx > ax))
            if inside:
                yield y, x, x + 1


for line in sys.stdin:
    verb, id, *words = line.split()
    if verb == "HELLO":
        print("HELLO 2 mine coverage window=1024x1024 batch=64" if id == "2" else "E - say HELLO 2")
    elif verb == "T":
        width, height, *corners = map(float, words)
        runs = list(triangle(*corners, int(width), int(height)))
        print("C", id, len(runs), *(number for run in runs for number in run))
    else:
        print("E", id, "unsupported")
    sys.stdout.flush()
