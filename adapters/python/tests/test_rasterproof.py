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

RANGE = "range=4096"
COVERAGE, LINES, VALUES, PARTITION = (getattr(rasterproof, f"assert_{name}") for name in ("rasterizer", "lines", "values", "partition"))


def filled(keeps, name="filled"):
    """A function that draws where all three edges say so, in whole numbers."""

    def filled(corners, window):
        x, y = np.arange(window[0])[None, None, :] * 256 + 128, np.arange(window[1])[None, :, None] * 256 + 128
        a, b, c = (corners * 256).astype(np.int64).transpose(1, 2, 0)[..., None, None]
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        b, c = np.where(area < 0, c, b), np.where(area < 0, b, c)
        inside = np.broadcast_to(area != 0, (len(corners), window[1], window[0]))
        for p, q in ((a, b), (b, c), (c, a)):
            dx, dy = q - p
            inside = inside & keeps(dx * (y - p[1]) - dy * (x - p[0]), dx, dy)
        return inside

    filled.__name__ = name
    return filled


exact = filled(lambda e, dx, dy: e >= np.where((dy < 0) | ((dy == 0) & (dx > 0)), 0, 1))
strict = filled(lambda e, dx, dy: e > 0, "draw")


def spans(corners, window):
    """The same, as spans."""
    rows = lambda mask: [(y, np.flatnonzero(line)[0], np.flatnonzero(line)[-1] + 1) for y, line in enumerate(mask) if line.any()]
    return [np.array(rows(mask), np.int64) for mask in exact(corners, window)]


def values(corners, window, flat=False):
    x, y = np.arange(window[0])[None, None, :] + 0.5, np.arange(window[1])[None, :, None] + 0.5
    p = corners[:, :, :2].transpose(1, 2, 0)[..., None, None]
    edge = lambda p, q: (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
    with np.errstate(all="ignore"):
        weights = np.stack([edge(p[1], p[2]), edge(p[2], p[0]), edge(p[0], p[1])], -1)
        weights = weights / weights.sum(-1, keepdims=True)
        z, w, a, b = (corners[:, None, None, :, i] for i in (2, 3, 4, 5))
        w = np.ones_like(w) if flat else w
        inverse = (weights / w).sum(-1)
        parts = [(weights * z).sum(-1), (weights / w * a).sum(-1) / inverse, (weights / w * b).sum(-1) / inverse]
    return exact(corners[:, :, :2], window), np.stack(parts, -1)


def dda(missing=0):
    """Lines without so many pixels at their end."""

    def dda(ends, window):
        rows = []
        for (x0, y0), (x1, y1) in ends.tolist():
            dx, dy = x1 - x0, y1 - y0
            n = max(abs(dx), abs(dy))
            # A tie comes to the same pixel from either end.
            tie = n - ((dx if abs(dx) == n else dy) < 0)
            at = lambda d: (2 * np.arange(n + 1 - missing) * abs(d) + tie) // (2 * max(n, 1)) * np.sign(d)
            x, y = x0 + at(dx), y0 + at(dy)
            inside = (x >= 0) & (y >= 0) & (x < window[0]) & (y < window[1])
            rows.append(np.stack([x, y], 1)[inside])
        return rows

    return dda


def fan(contours):
    return None if len(contours) > 1 else np.stack([[contours[0][0], b, c] for b, c in zip(contours[0][1:], contours[0][2:])])


def judge(fn, call=COVERAGE, **options):
    call(fn, **{"cases": 20, **({} if call is PARTITION else {"declare": RANGE}), **options})


class Judged(unittest.TestCase):
    def fails(self, error, pattern, *arguments, **options):
        with self.assertRaisesRegex(error, pattern) as caught:
            judge(*arguments, **options)
        return str(caught.exception)

    def repeats(self, said, fn):
        """The printed call is one that fails."""
        call = re.search(rf"rasterproof\.assert_\w+\({fn.__name__}, family=.*, case=.*\)", said).group(0)
        with self.assertRaisesRegex(AssertionError, "is not right"):
            eval(call, {"rasterproof": rasterproof, fn.__name__: fn})

    def test_right_triangles(self):
        for fn in (exact, spans, lambda *request: exact(*request).astype(np.uint8)):
            judge(fn)

    def test_strict_triangles(self):
        said = self.fails(AssertionError, "draws nothing on an edge", strict)
        self.assertIn("to be judged by it: declare='rule=strict'", said)
        self.assertIn(" mask ", said)
        self.repeats(said, strict)
        judge(strict, declare=RANGE + " rule=strict", family="flat")

    def test_seed_and_family_choose_cases(self):
        asked = []
        for seed in (1, 1, np.int64(2)):
            seen = []
            judge(lambda c, w: seen.append(c.copy()) or exact(c, w), cases=5, seed=seed, family=["tiny", "uniform"])
            asked.append(np.concatenate(seen))
        self.assertTrue(np.array_equal(asked[0], asked[1]))
        self.assertFalse(np.array_equal(asked[0], asked[2]))

    def test_several_families_are_printed_as_a_list(self):
        said = self.fails(AssertionError, "is not right", strict, cases=2, family=["flat", "fan"])
        self.assertIn(f"repeat with: rasterproof.assert_rasterizer(draw, family=['flat', 'fan'], cases=2, seed=1, declare='{RANGE}')", said)

    def test_doubles_are_seen(self):
        said = self.fails(AssertionError, r"pixels: [\d,]+ twice", lambda *request: exact(*request).astype(int) * 2, family="uniform", hits=True)
        self.assertNotIn(" mask", said)

    def test_values(self):
        judge(values, VALUES)
        self.fails(AssertionError, "linearly on the screen and ignores w", lambda c, w: values(c, w, True), VALUES)

    def test_lines(self):
        def masks(ends, window):
            masks = np.zeros((len(ends), window[1], window[0]), bool)
            for mask, pixels in zip(masks, dda()(ends, window)):
                mask[pixels[:, 1], pixels[:, 0]] = True
            return masks

        for fn in (dda(), masks):
            judge(fn, LINES)
        self.fails(AssertionError, "the last pixel is not drawn", dda(1), LINES)

    def test_what_is_returned_is_checked(self):
        changed = lambda change: (lambda c, w: change(exact(c, w)))
        each = lambda row: (lambda c, w: [row] * len(c))
        wrong = self.fails
        wrong(ValueError, r"shape \(1, 8\); expected \(1, 6, 8\): \(n, height, width\)", changed(lambda m: m[:, 0]))
        wrong(ValueError, r"shape \(1, 8, 6\); expected \(1, 6, 8\)", changed(lambda m: m.transpose(0, 2, 1)))
        wrong(TypeError, "float64; expected bool, or integers", changed(lambda m: m * 1.0))
        wrong(TypeError, "no numbers: NoneType", each(None))
        wrong(ValueError, r"-1; a pixel is drawn at least 0 times", changed(lambda m: -m.astype(int)))
        wrong(ValueError, r"a list of 0; expected 1", lambda c, w: [])
        wrong(ValueError, r"\(6, 8\) for case 0; expected \(k, 3\) with the columns y x0 x1, or one array of masks", changed(list))
        wrong(TypeError, "float64 for case 0; expected integers", each(np.array([[0.5, 0, 1]])))
        changes = lambda c, w: exact(c, w).astype(bool if len(c) == 1 else int)
        wrong(TypeError, "returned masks of integers; in an earlier call masks of bool", changes)
        wrong(TypeError, "ndarray; expected two arrays, masks and values", lambda c, w: values(c, w)[0], VALUES)
        wrong(ValueError, r"shape \(1, 6, 8\); expected \(1, 6, 8, 3\)", lambda c, w: (values(c, w)[0], np.ones((1, 6, 8))), VALUES)
        wrong(ValueError, r"shape \(2, 2\); expected \(m, 3, 2\)", lambda contours: np.ones((2, 2)), PARTITION)
        wrong(TypeError, "takes a function; got int", 3)

    def test_polygons(self):
        self.repeats(self.fails(AssertionError, r"outside: the smallest polygon that was found\n +\[\[\[", fan, PARTITION, family="Star"), fan)
        turns = lambda p: np.array([1, -1]) @ ((np.roll(p, -1, 0) - p) * (np.roll(p, -2, 0) - np.roll(p, -1, 0))[:, ::-1]).T
        one_way = lambda p: (turns(p) > 0).all() or (turns(p) < 0).all()
        judge(lambda contours: fan(contours) if len(contours) == 1 and one_way(contours[0]) else None, PARTITION, family="SnappedCircle")
        holes = []

        def watched(contours):
            low, high = contours[0].min(0), contours[0].max(0)
            self.assertTrue(all(((hole >= low) & (hole <= high)).all() for hole in contours[1:]))
            holes.extend(contours[1:])
            return np.empty((0, 3, 2))

        self.fails(AssertionError, "gap", watched, PARTITION, family="Islands")
        self.assertGreater(len(holes), 20)
        self.fails(ValueError, "accepts none of the polygons", lambda contours: None, PARTITION)

    def test_options_are_checked(self):
        for cases in (0, -1, 1.5, True, "x"):
            self.fails(ValueError, f"^cases is {cases}; expected a whole number from 1 to 18446744073709551615", exact, cases=cases)
        for seed in (-7, 2**70):
            self.fails(ValueError, f"^seed is {seed}; expected a whole number from 0 to 18446744073709551615", exact, seed=seed)
        self.fails(ValueError, "^no option is case_; expected cases, seed", exact, case_=1)
        self.fails(ValueError, "^no family is nosuch; expected .*flat", exact, family="nosuch")
        self.fails(ValueError, "no case was judged", exact, family="line-axis")

    def test_an_error_of_the_function_comes_through(self):
        def fails_late(corners, window):
            if len(corners) > 1:
                raise KeyError("mine")
            return exact(corners, window)

        begin = time.monotonic()
        self.fails(KeyError, "mine", fails_late)
        self.assertLess(time.monotonic() - begin, 5)

    def test_the_message_begins_with_the_cause(self):
        self.assertTrue(self.fails(AssertionError, "is not right", strict).startswith("Triangles: it samples at the pixel's centre"))

    @unittest.skipUnless(hasattr(BaseException, "add_note"), "notes are shown from Python 3.11 on")
    def test_an_error_of_the_function_carries_its_case(self):
        corners_of = {}

        def fails_once(corners, window):
            for one in corners:
                if np.ptp(one[:, 0]) > 40 and len(corners) > 1 or one.tobytes() in corners_of:
                    corners_of.setdefault(one.tobytes(), one.copy())
                    raise KeyError("mine")
            return exact(corners, window)

        with self.assertRaises(KeyError) as caught:
            judge(fails_once, family="uniform", seed=3)
        note = "\n".join(caught.exception.__notes__)
        self.assertRegex(note, r"rasterproof asked: corners \[\[.*\]\], window \(\d+, \d+\)\nfor family uniform, case \d+, seed 3\n")
        # The printed call raises the same.
        call = re.search(r"repeat with: (.*)", note).group(1)
        with self.assertRaises(KeyError):
            eval(call, {"rasterproof": rasterproof, "fails_once": fails_once})
        with self.assertRaises(ZeroDivisionError) as caught:
            judge(lambda contours: 1 // (len(contours[0]) < 5) and fan(contours), PARTITION, family="Star")
        self.assertIn("for family Star, case 0, seed 1", caught.exception.__notes__[0])

    def test_misuses_are_refused_in_seconds(self):
        """What people got wrong: none passes, and none takes long."""
        as_type = lambda type, factor=1: (lambda c, w: exact(c, w).astype(type) * type(factor))

        def late(c, w):
            return exact(c, w).astype(np.uint8) * (255 if len(c) > 1 else 1)

        def rows(c, w):
            return (row for row in exact(c, w))

        def raises(c, w):
            raise IndexError("mine")

        misuses = [
            (ValueError, "masks of 0 and 255; .* return masks > 0, or pass hits=True", as_type(np.uint8, 255), {}),
            (ValueError, "masks of 0 and 2; ", as_type(np.int64, 2), {}),
            (AssertionError, r"answer: +H 1 \d+  \d+ \d+ \d+ 255", as_type(np.uint8, 255), {"hits": True}),
            (AssertionError, "255", late, {}),
            (AssertionError, r"hits=True\)", as_type(np.uint8, 4), {"hits": True, "family": "uniform"}),
            (ValueError, "hits is 1; expected True or False", exact, {"hits": 1}),
            (TypeError, "masks of type float64", as_type(np.float64), {}),
            (ValueError, "expected .*: .n, height, width.", lambda c, w: exact(c, w).transpose(0, 2, 1), {}),
            (ValueError, r"shape \(6, 8\); expected \(1, 6, 8\)", lambda c, w: exact(c, w)[0], {}),
            (TypeError, "no numbers: generator", rows, {}),
            (TypeError, "no numbers: NoneType", lambda c, w: None, {}),
            (ValueError, "a list of 0; expected 1", lambda c, w: [], {}),
            (TypeError, "takes a function; got NoneType", None, {}),
            (IndexError, "mine", raises, {}),
            (ValueError, "declare: 'rule=topleft' is not understood; did you mean 'rule=top-left'", exact, {"declare": "rule=topleft"}),
            (ValueError, "declare: 'rul=strict' is not understood; did you mean 'rule=strict'", exact, {"declare": "rul=strict"}),
            (ValueError, "declare: 'range=0' is not understood; expected range=N, a whole", exact, {"declare": "range=0"}),
            (ValueError, "cases is 1.5; expected a whole number from 1", exact, {"cases": 1.5}),
            (ValueError, "cases is True; expected a whole number", exact, {"cases": True}),
            (ValueError, "cases is x; expected a whole number", exact, {"cases": "x"}),
            (ValueError, "seed is 1180591620717411303424; expected a whole number from 0 to", exact, {"seed": 2**70}),
            (ValueError, "seconds is 0; expected a number above 0", exact, {"seconds": 0}),
            (ValueError, "no family is flatt; expected", exact, {"family": "flatt"}),
            (ValueError, "no option is case_; expected", exact, {"case_": 1}),
        ]
        self.assertEqual(len(misuses), 24)
        for error, pattern, fn, options in misuses:
            with self.subTest(pattern, **options):
                # Of the processor, here and in the judge: other programs may keep the clock waiting.
                begin = sum(os.times()[:4])
                said = self.fails(error, pattern, fn, **{"cases": 100, **options})
                seconds = sum(os.times()[:4]) - begin
                if "RASTERPROOF_TABLE" in os.environ:
                    print(f"{seconds:6.2f} s  {error.__name__}: {said.splitlines()[0][:110]}")
                self.assertLess(seconds, 10)

    def test_numbers_are_written_exactly(self):
        some = [0.0, -0.0, 0.1, -1.5, 1e308, 5e-324, 2.0**-1022, -math.pi]
        read = [float.fromhex(row.tobytes().decode()) for row in _shapes.hexes(np.array(some))]
        self.assertEqual([(v, math.copysign(1, v)) for v in read], [(v, math.copysign(1, v)) for v in some])
        self.assertEqual(_shapes.hexes(np.array([math.nan, -math.inf]))[:, :4].tobytes(), b" nan-inf")

    @unittest.skipUnless(importlib.util.find_spec("pytest"), "pytest is not installed")
    def test_pytest(self):
        with tempfile.TemporaryDirectory() as folder:
            test = Path(folder) / "test_mine.py"
            test.write_text(f"""import sys; sys.path.insert(0, {str(Path(__file__).parent)!r})
from test_rasterproof import exact, strict
def test_chosen(rasterproof):
    assert rasterproof.chosen == {{"cases": 7, "seed": 3}}
    rasterproof.assert_rasterizer(exact, declare="range=4096")
def test_strict(rasterproof):
    rasterproof.assert_rasterizer(strict, declare="range=4096", cases=20)
""")
            # The wheel names the plugin; here it is named by hand.
            plugin = [] if importlib.util.find_spec("rasterproof").origin.find("site-packages") > 0 else ["-p", "rasterproof.pytest_plugin"]
            Path(folder, "pytest.ini").write_text("[pytest]\nrasterproof_cases = 9\nrasterproof_seed = 3\n")
            # The command line stands above the ini file.
            words = [*plugin, "-p", "no:cacheprovider", "--rasterproof-cases", "7", "--junit-xml", "junit.xml", test]
            done = subprocess.run([sys.executable, "-m", "pytest", *words], cwd=folder, capture_output=True, text=True, env=dict(os.environ))
            self.assertIn("1 failed, 1 passed", done.stdout, done.stdout + done.stderr)
            junit = Path(folder, "junit.xml").read_text()
        self.assertIn("AssertionError: Triangles: it samples at", junit)
        self.assertRegex(done.stdout, r"FAILED .*::test_strict - AssertionError: Triangles: ")
        self.assertIn("rasterproof.assert_rasterizer(draw, family=", done.stdout)


if __name__ == "__main__":
    unittest.main()
