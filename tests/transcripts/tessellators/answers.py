"""A tessellator of the protocol that answers as its argument says."""
import sys
import time


def answer(kind, id, contours, points):
    if kind == "fan" and contours == "1":
        corners = [n for b, c in zip(points[1:], points[2:]) for point in (points[0], b, c) for n in point]
        return ["Z", id, len(points) - 2, *corners]
    if kind == "refuses":
        return ["E", id, "too hard"]
    if kind == "dies":
        sys.exit(3)
    if kind == "lies":
        return ["Z", id, 1, 0, 0, 1]
    if kind in ("slow", "never"):
        time.sleep(0.02 if kind == "slow" else 9)
        return ["Z", id, 0]
    return ["E", id, "unsupported"]


for line in sys.stdin:
    verb, id, *words = line.split()
    if verb == "HELLO":
        print("HELLO 2 mine partition triangles=any t-junctions", flush=True)
    else:
        print(*answer(sys.argv[1], id, words[0], list(zip(words[2::2], words[3::2]))), flush=True)
