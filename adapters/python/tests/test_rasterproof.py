"""`python3 -m unittest` in this folder, with the program in RASTERPROOF and the folder above in PYTHONPATH."""

import importlib.util
import math
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np
import rasterproof
from rasterproof import _shapes

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))
from example import draw as strict

RANGE = "range=4096"


def exact(corners, window):
    """The pixel centre and the top-left rule, in whole numbers."""
    x, y = np.arange(window[0])[None, None, :] * 256 + 128, np.arange(window[1])[None, :, None] * 256 + 128
    a, b, c = (corners * 256).astype(np.int64).transpose(1, 2, 0)[..., None, None]
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    b, c = np.where(area < 0, c, b), np.where(area < 0, b, c)
    inside = np.broadcast_to(area != 0, (len(corners), window[1], window[0]))
    for p, q in ((a, b), (b, c), (c, a)):
        (dx, dy) = q - p
        top_left = (dy < 0) | ((dy == 0) & (dx > 0))
        inside = inside & (dx * (y - p[1]) - dy * (x - p[0]) >= np.where(top_left, 0, 1))
    return inside


def spans(corners, window):
    """The same, as spans."""
    rows = []
    for mask in exact(corners, window):
        row = [(y, np.flatnonzero(line)[0], np.flatnonzero(line)[-1] + 1) for y, line in enumerate(mask) if line.any()]
        rows.append(np.array(row, np.int64))
    return rows


def values(corners, window):
    x, y = np.arange(window[0])[None, None, :] + 0.5, np.arange(window[1])[None, :, None] + 0.5
    p = corners[:, :, :2].transpose(1, 2, 0)[..., None, None]
    edge = lambda p, q: (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
    with np.errstate(all="ignore"):
        weights = np.stack([edge(p[1], p[2]), edge(p[2], p[0]), edge(p[0], p[1])], -1)
        weights = weights / weights.sum(-1, keepdims=True)
        z, w, a, b = (corners[:, None, None, :, i] for i in (2, 3, 4, 5))
        inverse = (weights / w).sum(-1)
        parts = [(weights * z).sum(-1), (weights / w * a).sum(-1) / inverse, (weights / w * b).sum(-1) / inverse]
    return exact(corners[:, :, :2], window), np.stack(parts, -1)


def affine(corners, window):
    flat = corners.copy()
    flat[:, :, 3] = 1
    return values(flat, window)


def dda(round_half, kept=lambda pixels: pixels):
    def dda(ends, window):
        rows = []
        for (x0, y0), (x1, y1) in ends.tolist():
            n = max(abs(x1 - x0), abs(y1 - y0))
            i = np.arange(n + 1)
            x, y = (np.array([x0, y0])[:, None] + round_half(i * np.array([[x1 - x0], [y1 - y0]]), max(n, 1)))
            inside = (x >= 0) & (y >= 0) & (x < window[0]) & (y < window[1])
            rows.append(kept(np.stack([x, y], 1)[inside]))
        return rows

    return dda


# A tie of the project goes toward larger coordinates of a flat line, and of a steep one.
nearest = dda(lambda steps, n: (2 * steps + n) // (2 * n))


class Judged(unittest.TestCase):
    def fails(self, error, pattern, call, *arguments, **options):
        with self.assertRaisesRegex(error, pattern) as caught:
            call(*arguments, **options)
        return str(caught.exception)

    def test_right_triangles(self):
        for fn in (exact, spans, lambda *request: exact(*request).astype(np.uint8)):
            rasterproof.assert_rasterizer(fn, cases=20, declare=RANGE)

    def test_strict_triangles(self):
        said = self.fails(AssertionError, "draws nothing on an edge", rasterproof.assert_rasterizer, strict, cases=20, declare=RANGE)
        self.assertIn("repeat with: rasterproof.assert_rasterizer(draw, family='", said)
        self.assertIn("declare='rule=strict'", said)
        self.assertNotIn("_relay", said)
        self.assertIn(" mask ", said)
        # The printed call is one that fails with that case, and what is declared is right.
        call = re.search(r"rasterproof\.assert_rasterizer\(draw, family=.*\)", said).group(0)
        self.fails(AssertionError, "is not right", eval, call, {"rasterproof": rasterproof, "draw": strict})
        rasterproof.assert_rasterizer(strict, cases=20, declare=RANGE + " rule=strict", family="flat")

    def test_the_page_begins_with_the_example(self):
        for page in ("docs/python.md", "docs/zh/python.md"):
            self.assertIn((HERE / "example.py").read_text(), (HERE.parents[2] / page).read_text(encoding="utf-8"))

    def test_seed_and_family_choose_cases(self):
        asked = []
        for seed in (1, 1, 2):
            seen = []
            watched = lambda c, w: seen.append(c.copy()) or exact(c, w)
            rasterproof.assert_rasterizer(watched, cases=5, seed=seed, family=["tiny", "uniform"], declare=RANGE)
            asked.append(np.concatenate(seen))
        self.assertTrue(np.array_equal(asked[0], asked[1]))
        self.assertFalse(np.array_equal(asked[0], asked[2]))

    def test_several_families_are_printed_as_a_list(self):
        said = self.fails(AssertionError, "is not right", rasterproof.assert_rasterizer, strict, cases=2, declare=RANGE, family=["flat", "fan"])
        self.assertIn("repeat with: rasterproof.assert_rasterizer(draw, cases=2, family=['flat', 'fan'], seed=1, declare=", said)

    def test_doubles_are_seen(self):
        twice = lambda *request: exact(*request).astype(int) * 2
        said = self.fails(AssertionError, r"pixels: [\d,]+ twice", rasterproof.assert_rasterizer, twice, cases=5, declare=RANGE, family="uniform")
        self.assertNotIn(" mask", said)

    def test_values(self):
        rasterproof.assert_values(values, cases=20, declare=RANGE)
        self.fails(AssertionError, r"linearly on the screen and ignores w", rasterproof.assert_values, affine, cases=20, declare=RANGE)

    def test_lines(self):
        rasterproof.assert_lines(nearest, cases=20, declare=RANGE, family="line-axis")
        masks = lambda ends, window: np.stack([_mask(row, window) for row in nearest(ends, window)])
        rasterproof.assert_lines(masks, cases=20, declare=RANGE, family="line-axis")
        short = dda(lambda steps, n: (2 * steps + n) // (2 * n), lambda pixels: pixels[:-1])
        self.fails(AssertionError, "the last pixel is not drawn", rasterproof.assert_lines, short, cases=20, declare=RANGE)

    def test_what_is_returned_is_checked(self):
        judged = lambda change: (lambda c, w: change(exact(c, w)))
        one = rasterproof.assert_rasterizer
        self.fails(ValueError, r"shape \(1, 8\); expected \(1, 6, 8\): \(n, height, width\)", one, judged(lambda m: m[:, 0]))
        self.fails(ValueError, r"shape \(1, 8, 6\); expected \(1, 6, 8\)", one, judged(lambda m: m.transpose(0, 2, 1)))
        self.fails(TypeError, "float64; expected bool, or integers", one, judged(lambda m: m * 1.0))
        self.fails(TypeError, "no numbers: NoneType", one, lambda c, w: [None] * len(c))
        self.fails(ValueError, r"-1; a pixel is drawn at least 0 times", one, judged(lambda m: -m.astype(int)))
        self.fails(ValueError, r"a list of 0; expected 1", one, lambda c, w: [])
        self.fails(ValueError, r"\(6, 8\) for case 0; expected \(k, 3\) with the columns y x0 x1", one, judged(list))
        self.fails(TypeError, "float64 for case 0; expected integers", one, lambda c, w: [np.array([[0.5, 0, 1]])] * len(c))
        changes = lambda c, w: exact(c, w).astype(bool if len(c) == 1 else int)
        self.fails(TypeError, "returned masks of integers; in an earlier call masks of bool", one, changes, declare=RANGE)
        two = rasterproof.assert_values
        self.fails(TypeError, "ndarray; expected two arrays, masks and values", two, lambda c, w: values(c, w)[0])
        self.fails(ValueError, r"shape \(1, 6, 8\); expected \(1, 6, 8, 3\)", two, lambda c, w: (values(c, w)[0], np.ones((1, 6, 8))))
        self.fails(TypeError, "takes a function; got int", one, 3)

    def test_polygons(self):
        judge = rasterproof.assert_partition
        fan = lambda contours: None if len(contours) > 1 else np.stack([[contours[0][0], b, c] for b, c in zip(contours[0][1:], contours[0][2:])])
        fan.__name__ = "fan"
        said = self.fails(AssertionError, r"outside: the smallest polygon that was found\n +\[\[\[", judge, fan, cases=20, family="Star")
        call = re.search(r"rasterproof\.assert_partition\(fan, family=.*\)", said).group(0)
        self.fails(AssertionError, "1 polygons are not covered", eval, call, {"rasterproof": rasterproof, "fan": fan})
        turns = lambda p: np.cross(np.roll(p, -1, 0) - p, np.roll(p, -2, 0) - np.roll(p, -1, 0))
        convex = lambda contours: fan(contours) if len(contours) == 1 and (turns(contours[0]) > 0).all() else None
        judge(convex, family="SnappedCircle")
        holes = []
        def watched(contours):
            low, high = contours[0].min(0), contours[0].max(0)
            self.assertTrue(all(((hole >= low) & (hole <= high)).all() for hole in contours[1:]))
            holes.extend(contours[1:])
            return np.empty((0, 3, 2))
        self.fails(AssertionError, "gap", judge, watched, cases=20, family="Islands")
        self.assertGreater(len(holes), 20)
        self.fails(RuntimeError, "accepts none of the polygons", judge, lambda contours: None, cases=5)
        self.fails(ValueError, r"shape \(2, 2\); expected \(m, 3, 2\)", judge, lambda contours: np.ones((2, 2)))
        self.fails(ValueError, "no case would be judged", judge, fan, cases=0)

    def test_nothing_to_judge(self):
        for cases in (0, -1, 1.5, True):
            self.fails(ValueError, "no case would be judged", rasterproof.assert_rasterizer, exact, cases=cases)
        self.fails(RuntimeError, "(?s)no verdict.*'nosuch'", rasterproof.assert_rasterizer, exact, family="nosuch")

    def test_an_error_of_the_function_comes_through(self):
        def fails_late(corners, window):
            if len(corners) > 1:
                raise KeyError("mine")
            return exact(corners, window)

        begin = time.monotonic()
        self.fails(KeyError, "mine", rasterproof.assert_rasterizer, fails_late, declare=RANGE)
        self.assertLess(time.monotonic() - begin, 5)

    def test_numbers_are_written_exactly(self):
        some = [0.0, -0.0, 0.1, -1.5, 1e308, 5e-324, 2.0**-1022, -math.pi]
        read = [float.fromhex(row.tobytes().decode()) for row in _shapes.hexes(np.array(some))]
        self.assertEqual([(v, math.copysign(1, v)) for v in read], [(v, math.copysign(1, v)) for v in some])
        self.assertEqual(_shapes.hexes(np.array([math.nan, -math.inf]))[:, :4].tobytes(), b"nan nan ")

    @unittest.skipUnless(importlib.util.find_spec("pytest"), "pytest is not installed")
    def test_pytest(self):
        with tempfile.TemporaryDirectory() as folder:
            test = Path(folder) / "test_mine.py"
            test.write_text(f"""import sys; sys.path.insert(0, {str(HERE)!r})
from test_rasterproof import exact, strict
def test_chosen(rasterproof):
    assert rasterproof.chosen == {{"cases": 7, "seed": 3}}
    rasterproof.assert_rasterizer(exact, declare="range=4096")
def test_strict(rasterproof):
    rasterproof.assert_rasterizer(strict, declare="range=4096", cases=20)
""")
            # The wheel names the plugin; here it is named by hand.
            plugin = [] if importlib.util.find_spec("rasterproof").origin.find("site-packages") > 0 else ["-p", "rasterproof.pytest_plugin"]
            words = [*plugin, "-p", "no:cacheprovider", "--rasterproof-cases", "7", "--rasterproof-seed", "3", test]
            done = subprocess.run([sys.executable, "-m", "pytest", *words], cwd=folder, capture_output=True, text=True, env=dict(os.environ))
        self.assertIn("1 failed, 1 passed", done.stdout, done.stdout + done.stderr)
        self.assertIn("AssertionError", done.stdout)
        self.assertIn("rasterproof.assert_rasterizer(draw, family=", done.stdout)


def _mask(pixels, window):
    mask = np.zeros(window[::-1], bool)
    mask[pixels[:, 1], pixels[:, 0]] = True
    return mask


if __name__ == "__main__":
    unittest.main()
