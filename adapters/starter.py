# 1. Put your code into triangle() and line() below; write `line = None` if you draw no lines.
# 2. Say in DECLARES what your code promises, for example "origin=0,0 rule=none" (docs/protocol.md).
# 3. Judge it: rasterproof judge -- python3 starter.py
import math
import operator
import os
import sys
import traceback

NAME = "mine"
DECLARES = "batch=64"


# ---- YOUR PLACE: replace the bodies of these two functions ----


def triangle(x0, y0, x1, y1, x2, y2, width, height, set_pixel):
    """Corners in pixels, y down; set_pixel(x, y) for every pixel drawn.

    As it stands it draws every sample on an edge, so two neighbours both draw the edge they share.
    """

    def side(ax, ay, bx, by, x, y):
        return (bx - ax) * (y - ay) - (by - ay) * (x - ax)

    for y in range(max(0, math.floor(min(y0, y1, y2))), min(height, math.ceil(max(y0, y1, y2)))):
        for x in range(max(0, math.floor(min(x0, x1, x2))), min(width, math.ceil(max(x0, x1, x2)))):
            e0 = side(x0, y0, x1, y1, x + 0.5, y + 0.5)
            e1 = side(x1, y1, x2, y2, x + 0.5, y + 0.5)
            e2 = side(x2, y2, x0, y0, x + 0.5, y + 0.5)
            if (e0 >= 0 and e1 >= 0 and e2 >= 0) or (e0 <= 0 and e1 <= 0 and e2 <= 0):
                set_pixel(x, y)


def line(x0, y0, x1, y1, width, height, set_pixel):
    """From one pixel to another, both drawn, in drawing order. As it stands, a plain DDA."""
    dx, dy = x1 - x0, y1 - y0
    steps = max(abs(dx), abs(dy))
    # Of the longer direction, only the steps inside the window.
    start, step, size = (x0, dx, width) if abs(dx) >= abs(dy) else (y0, dy, height)
    first = max(0, -start if step >= 0 else start - size + 1)
    last = min(steps, size - 1 - start if step >= 0 else start)
    for i in range(first, last + 1):
        set_pixel(math.floor(x0 + dx * i / max(steps, 1) + 0.5), math.floor(y0 + dy * i / max(steps, 1) + 0.5))


# What else there is (verbs I, S, D, N and A): write functions in their stead, as `rasterproof course start` has them. And verb W:
# wide_line(x0, y0, x1, y1, line_width, width, height, set_pixel), set_pixel(x, y) for every pixel of a line with a width. And verb R:
# area, as triangle, with set_pixel(x, y, level), where 255 is a pixel that is covered whole. And verb X: sample_values, as values,
# with set_samples(x, y, mask, z, a, b) for covered samples that have the same values (say where in DECLARES: "values-at=sample").
# And verb Q: formula(name, numbers).
values = samples = depth = clip = clip_attributes = wide_line = area = sample_values = formula = None


# ---- the line protocol: nothing to change from here on ----

MOST_BYTES, MOST_SIDE, MOST_HITS = 65536, 1024, 1 << 22


class Refused(Exception):
    pass


def drawn(draw, numbers, width, height):
    hits = []

    def set_pixel(x, y, *more):
        x, y = operator.index(x), operator.index(y)
        if 0 <= x < width and 0 <= y < height:
            if len(hits) == MOST_HITS:
                raise Refused(f"more than {MOST_HITS} pixels set")
            hits.append((y, x, *more))

    draw(*numbers, width, height, set_pixel)
    return hits


def runs(hits):
    """Rows, first columns, one past the last; a pixel hit twice is in two runs."""
    found = []
    for y, x in sorted(hits):
        if found and found[-1][0] == y and found[-1][2] == x:
            found[-1][2] += 1
        else:
            found.append([y, x, x + 1])
    return found


def number(word, is_coordinate=True):
    try:
        value = float.fromhex(word) if "x" in word.lower() else float(word)
    except (ValueError, OverflowError):
        value = math.nan
    if not (-(2.0**31) <= value < 2.0**31 if is_coordinate else math.isfinite(value)):
        raise Refused("a coordinate is not a number within 2^31 px")
    return value


def answer(words):
    verb, id = words[0], words[1] if len(words) > 1 else "-"
    wide, shares, sampled, formulas = (globals().get(name) for name in ("wide_line", "area", "sample_values", "formula"))
    if verb == "HELLO":
        known = "coverage" + " line" * (line is not None)
        more = {"attributes": values, "samples4": samples, "depth": depth, "clip": clip}
        more.update({"clip-attributes": clip_attributes, "wide-line": wide, "area": shares})
        more.update({"sample-values": sampled, "formulas": formulas})
        known += "".join(f" {word}" for word, has in more.items() if has is not None)
        declared = f" window={MOST_SIDE}x{MOST_SIDE} {DECLARES}"
        return {
            ("1",): f"HELLO 1 {NAME} {known}",
            ("2",): f"HELLO 2 {NAME} {known}{declared}",
        }.get(tuple(words[1:]), "E - say HELLO 1 or HELLO 2")
    verbs = {"T": (triangle, 6, "C"), "L": (line, 4, "P"), "I": (values, 18, "F"), "S": (samples, 6, "M")}
    verbs.update({"D": (depth, 9 * max(1, (len(words) - 4) // 9), "V"), "N": (clip, 12, "G"), "A": (clip_attributes, 15, "B")})
    verbs.update({"W": (wide, 5, "C"), "R": (shares, 6, "K"), "X": (sampled, 18, "U")})
    verbs["Q"] = (formulas, max(0, len(words) - 3), "O")
    draw, count, letter = verbs.get(verb, (None, 0, ""))
    if draw is None:
        return f"E {id} unsupported"
    try:
        first = 2 if verb in "NA" else 3 if verb == "Q" else 4  # the near plane and formulas have no window
        if len(words) != count + first:
            raise Refused(f"{verb} takes id {'name ' * (verb == 'Q')}{'width height ' * (first == 4)}and {count} numbers")
        if verb == "Q":
            given = [float(n) for n in draw(words[2], [number(word, False) for word in words[3:]])]
            return " ".join([letter, id, str(len(given))] + [str(n) for n in given])
        sides = [int(word) if word.isdecimal() and len(word) < 9 else 0 for word in words[2:first]]
        if not all(1 <= side <= MOST_SIDE for side in sides):
            raise Refused(f"the window must be from 1x1 to {MOST_SIDE}x{MOST_SIDE}")
        # Of each corner the first two are coordinates of the window.
        size = {"I": 6, "X": 6, "D": 3}.get(verb, 2)
        numbers = [number(word, verb not in "NA" and i % size < 2) for i, word in enumerate(words[first:])]
        if verb in "TW":
            found = runs(drawn(draw, numbers, *sides))
        elif verb in "IX":
            hits = drawn(draw, [[numbers[0:6], numbers[6:12], numbers[12:18]]], *sides)
            found = [(x, y, *map(operator.index, more[:-3]), *map(float, more[-3:])) for y, x, *more in hits]
        elif verb == "D":
            corners = [numbers[i : i + 3] for i in range(0, count, 3)]
            triangles = [corners[i : i + 3] for i in range(0, count // 3, 3)]
            found = [(y, x, x + 1, operator.index(t)) for y, x, t in drawn(draw, [triangles], *sides)]
        elif verb in "NA":
            size = count // 3
            corners = [numbers[i : i + size] for i in range(0, count, size)]
            found = [tuple(map(float, corner)) for corner in draw(corners)]
            if any(len(corner) != size for corner in found):
                raise Refused("a corner of the polygon has x, y, z, w" + ", a" * (verb == "A"))
        elif verb in "SR":
            found = [(y, x, x + 1, operator.index(mask)) for y, x, mask in drawn(draw, numbers, *sides) if mask]
        else:
            found = [(x, y) for y, x in drawn(draw, [math.floor(n) for n in numbers], *sides)]
    except Refused as refused:
        return f"E {id} {refused}"
    except Exception as error:
        traceback.print_exc()
        return f"E {id} raised {type(error).__name__}"
    return " ".join([letter, id, str(len(found))] + [str(n) for group in found for n in group])


def main():
    protocol = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what your code prints goes to the error output
    read = lambda: sys.stdin.buffer.readline(MOST_BYTES + 1)
    while request := read():
        reply = None
        if len(request) > MOST_BYTES and not request.endswith(b"\n"):
            while (rest := read()) and not rest.endswith(b"\n"):
                pass
            reply = f"E - a request has at most {MOST_BYTES} bytes"
        elif words := [word.decode("latin-1") for word in request.split()]:
            reply = answer(words)
        if reply:
            protocol.write(reply.encode("latin-1") + b"\n")
            protocol.flush()


if __name__ == "__main__":
    try:
        main()
    except (BrokenPipeError, KeyboardInterrupt):
        os._exit(0)
