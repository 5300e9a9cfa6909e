"""The line protocol (docs/protocol.md) for Python libraries that draw into an image.

    serve("name-1.0", "mask line-set", triangle, line)

triangle(points, width, height) gets three (x, y) in pixels, y down, and returns an array of height x width,
not 0 where it drew; line gets two whole pixels and returns such an array, or pixels (x, y) in drawing order.
The second argument says what the library promises; requests off a declared grid or range are refused.
"""

import math
import os
import sys
import traceback

import numpy

MOST_BYTES, MOST_SIDE, MOST_STEPS = 65536, 1024, 1 << 20


class Refused(Exception):
    pass


def runs(mask):
    """Rows, first columns, one past the last."""
    edges = numpy.zeros((mask.shape[0], mask.shape[1] + 2), numpy.int8)
    edges[:, 1:-1] = mask != 0
    steps = numpy.diff(edges, axis=1)
    rows, firsts = numpy.nonzero(steps == 1)
    ends = numpy.nonzero(steps == -1)[1]
    return numpy.stack([rows, firsts, ends], axis=1).tolist()


def pixels(drawn, width, height):
    if isinstance(drawn, numpy.ndarray):
        rows, columns = numpy.nonzero(drawn)
        return numpy.stack([columns, rows], axis=1).tolist()
    return [(x, y) for x, y in drawn if 0 <= x < width and 0 <= y < height]


def walkable(points):
    """The ends of a line, for a library that walks it outside the window, too: refused if that takes seconds."""
    (x0, y0), (x1, y1) = points
    if max(abs(x1 - x0), abs(y1 - y0)) > MOST_STEPS:
        raise Refused(f"unsupported: the library walks the whole line, here at most {MOST_STEPS} px of it")
    return points


def declared(declares, word):
    """The number N of a declaration word=N, or 0."""
    return next((int(w[len(word) + 1 :]) for w in declares.split() if w.startswith(word + "=")), 0)


def number(word, declares):
    try:
        value = float.fromhex(word) if "x" in word.lower() else float(word)
    except (ValueError, OverflowError):
        value = math.nan
    if not -(2.0**31) <= value < 2.0**31:
        raise Refused("a coordinate is not a number within 2^31 px")
    grid, most = declared(declares, "grid"), declared(declares, "range")
    if most and abs(value) > most:
        raise Refused("unsupported: out of the declared range")
    if grid and value * grid != math.floor(value * grid):
        raise Refused("unsupported: off the declared grid")
    return value


def draw(words, declares, call):
    verb, count = words[0], 6 if words[0] == "T" else 4
    if len(words) != count + 4:
        raise Refused(f"{verb} takes id width height and {count} numbers")
    width, height = (int(word) if word.isdecimal() and len(word) < 9 else 0 for word in words[2:4])
    if not (1 <= width <= MOST_SIDE and 1 <= height <= MOST_SIDE):
        raise Refused(f"the window must be from 1x1 to {MOST_SIDE}x{MOST_SIDE}")
    numbers = [number(word, declares) for word in words[4:]]
    if verb == "L":
        numbers = [math.floor(value) for value in numbers]
    drawn = call(list(zip(numbers[::2], numbers[1::2])), width, height)
    return runs(drawn) if verb == "T" else pixels(drawn, width, height)


def answer(words, name, declares, calls):
    verb, id = words[0], words[1] if len(words) > 1 else "-"
    if verb == "HELLO":
        known = f"{name} {'coverage ' * ('T' in calls)}{'line ' * ('L' in calls)}".strip()
        hello = {"1": f"HELLO 1 {known}", "2": f"HELLO 2 {known} window={MOST_SIDE}x{MOST_SIDE} {declares}".strip()}
        return hello.get(" ".join(words[1:]), "E - say HELLO 1 or HELLO 2")
    if verb not in calls:
        return f"E {id} unsupported"
    try:
        found = draw(words, declares, calls[verb])
    except Refused as refused:
        return f"E {id} {refused}"
    except Exception as error:
        traceback.print_exc()
        return f"E {id} raised {type(error).__name__}"
    return " ".join(["C" if verb == "T" else "P", id, str(len(found))] + [str(n) for group in found for n in group])


def serve(name, declares="", triangle=None, line=None):
    """Answers requests until the input ends. What the library prints goes to the error output."""
    calls = {verb: call for verb, call in (("T", triangle), ("L", line)) if call}
    protocol = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    read = lambda: sys.stdin.buffer.readline(MOST_BYTES + 1)
    try:
        while request := read():
            if len(request) > MOST_BYTES and not request.endswith(b"\n"):
                while (rest := read()) and not rest.endswith(b"\n"):
                    pass
                reply = f"E - a request has at most {MOST_BYTES} bytes"
            elif words := [word.decode("latin-1") for word in request.split()]:
                reply = answer(words, name, declares, calls)
            else:
                continue
            protocol.write(reply.encode("latin-1") + b"\n")
            protocol.flush()
    except (BrokenPipeError, KeyboardInterrupt):
        os._exit(0)
