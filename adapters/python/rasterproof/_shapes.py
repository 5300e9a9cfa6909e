"""Calls a function with what requests of the line protocol ask, checks what it returns, and writes it as answers."""

from __future__ import annotations

from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple

import numpy

__tracebackhide__ = True
Array = Any
# Pixels that are drawn by one call.
MOST_PIXELS = 1 << 24
# More hits than a byte holds are not told apart.
MOST_HITS = 255
# The characters of a byte and of the exponent of a float.
PAIRS = numpy.array([f"{byte:02x}" for byte in range(256)], "S2").view(numpy.uint16)
POWERS = numpy.array([f"{max(exponent, 1) - 1023:+05}" for exponent in range(2048)], "S5").view(numpy.uint8).reshape(-1, 5)


class Judged:
    """A function, and what it returned first: it has to go on returning that."""

    def __init__(self, fn: Callable[..., Any], hits: bool = False) -> None:
        self.fn, self.name, self.kind = fn, str(getattr(fn, "__name__", type(fn).__name__)), ""
        # Whether numbers above 1 in the first mask are meant as counts.
        self.hits = hits
        # Whether the last call raised.
        self.raised = False

    def __call__(self, *arguments: Any) -> Any:
        self.raised = True
        value = self.fn(*arguments)
        self.raised = False
        return value

    def keep(self, kind: str) -> None:
        self.kind = self.kind or kind
        if kind != self.kind:
            raise TypeError(f"{self.name} returned {kind}; in an earlier call {self.kind}")


def drawn(shape: Tuple[int, int], write: Callable[..., List[str]], whole: bool = False) -> Any:
    """Asks for all requests with one window together, each a window and an array of this shape."""

    def ask(judged: Judged, requests: List[List[str]]) -> List[str]:
        replies = [""] * len(requests)
        windows: Dict[Tuple[int, int], List[int]] = {}
        for i, words in enumerate(requests):
            windows.setdefault((int(words[0]), int(words[1])), []).append(i)
        for window, members in windows.items():
            most = max(1, MOST_PIXELS // (window[0] * window[1]))
            for part in (members[first : first + most] for first in range(0, len(members), most)):
                array = numpy.array([requests[i][2:] for i in part]).astype(numpy.float64).reshape(-1, *shape)
                # A position of a line names the pixel that contains it.
                array = numpy.floor(array).astype(numpy.int64) if whole else array
                for i, reply in zip(part, write(judged, judged(array, window), len(part), window)):
                    replies[i] = reply
        return replies

    return ask


def polygons(judged: Judged, requests: List[List[str]]) -> List[Optional[str]]:
    """Polygons are lists of contours, each behind the number of its vertices; the function gets them one by one."""
    made = []
    for words in requests:
        contours: List[Array] = []
        rest = list(map(float, words[1:]))
        while rest:
            end = 1 + 2 * int(rest[0])
            contours.append(numpy.array(rest[1:end]).reshape(-1, 2))
            rest = rest[end:]
        made.append(triangles(judged, judged(contours)))
    counts = [0 if each is None else len(each) for each in made]
    rows = numpy.concatenate([numpy.empty((0, 3, 2)), *(each for each in made if each is not None)]).reshape(-1, 6)
    texts = joined([*rows.T], numpy.repeat(numpy.arange(len(made)), counts), len(made))
    return [None if each is None else text for each, text in zip(made, texts)]


def array_of(value: Any, what: str) -> Array:
    array = numpy.asarray(value)
    if array.dtype == object:
        raise TypeError(f"{what} are no numbers: {type(value).__name__}")
    return array


def reals_of(value: Any, what: str) -> Array:
    array = array_of(value, what)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{what} are of type {array.dtype}; expected floats")
    return array


def masks_of(judged: Judged, value: Any, count: int, window: Tuple[int, int]) -> Array:
    """How often each pixel was drawn, of shape (count, height, width)."""
    masks = array_of(value, f"masks of {judged.name}")
    width, height = window
    if masks.dtype != bool and not numpy.issubdtype(masks.dtype, numpy.integer):
        raise TypeError(f"{judged.name} returned masks of type {masks.dtype}; expected bool, or integers that count how often a pixel is drawn")
    if masks.shape != (count, height, width):
        raise ValueError(f"{judged.name} returned masks of shape {masks.shape}; expected {(count, height, width)}: (n, height, width)")
    if masks.dtype != bool and masks.size and masks.min() < 0:
        raise ValueError(f"{judged.name} returned masks with {masks.min()}; a pixel is drawn at least 0 times")
    if masks.dtype != bool:
        check_counts(judged, masks)
    judged.keep("masks of bool" if masks.dtype == bool else "masks of integers")
    return masks


def check_counts(judged: Judged, masks: Array) -> None:
    """Refuses a picture, which many libraries draw in 0 and 255, in the place of counts."""
    most = int(masks.max(initial=0))
    is_picture = not judged.kind and not judged.hits and most > 1 and bool(((masks == 0) | (masks == most)).all())
    if is_picture:
        raise ValueError(
            f"{judged.name} returned masks of 0 and {most}; a number says how often a pixel is drawn: "
            f"return masks > 0, or pass hits=True if a pixel really is drawn {most} times"
        )


def rows_of(judged: Judged, value: Any, count: int, columns: str) -> List[str]:
    """The rows of each case as text, from an array with these columns for each."""
    judged.keep("a list")
    if len(value) != count:
        raise ValueError(f"{judged.name} returned a list of {len(value)}; expected {count}, one for each case")
    wide = len(columns.split())
    rows = []
    for case, each in enumerate(value):
        array = array_of(each, f"rows of {judged.name}")
        if array.size == 0:
            array = numpy.empty((0, wide), numpy.int64)
        if array.ndim != 2 or array.shape[1] != wide:
            expected = f"(k, {wide}) with the columns {columns}, or one array of masks in place of a list"
            raise ValueError(f"{judged.name} returned shape {array.shape} for case {case}; expected {expected}")
        if not numpy.issubdtype(array.dtype, numpy.integer):
            raise TypeError(f"{judged.name} returned type {array.dtype} for case {case}; expected integers with the columns {columns}")
        rows.append(" ".join(map(str, [len(array), *array.ravel().tolist()])))
    return rows


def digits(column: Array) -> Array:
    """Whole numbers from 0 on as characters, all of the same length."""
    powers = 10 ** numpy.arange(len(str(column.max(initial=0))), dtype=numpy.int64)[::-1]
    return (column[:, None] // powers % 10 + ord("0")).astype(numpy.uint8)


def hexes(column: Array) -> Array:
    """Floats as characters, all of the same length: as C99 hex floats they are exact, without a loop in Python."""
    bits = numpy.ascontiguousarray(column, "<f8").view("<i8")
    exponent = bits >> 52 & 2047
    text = numpy.tile(numpy.frombuffer(b" 0x1.0123456789abcp+1023", numpy.uint8), (len(column), 1))
    text[bits < 0, 0] = ord("-")
    text[exponent == 0, 3] = ord("0")
    text[:, 5:18] = numpy.take(PAIRS, bits.view(numpy.uint8).reshape(-1, 8)[:, 6::-1]).view(numpy.uint8)[:, 1:]
    text[:, 19:] = POWERS[exponent]
    # Neither an infinity nor a NaN has an exponent.
    for word, has in ((b"inf", numpy.isinf(column)), (b"nan", numpy.isnan(column))):
        text[has, 1:] = numpy.frombuffer(word.ljust(23), numpy.uint8)
    return text


def joined(columns: Sequence[Array], cases: Array, count: int) -> List[str]:
    """What is drawn in each case as text, the number of its rows first; `cases` says in order which row is whose."""
    blank = numpy.full((len(cases), 1), ord(" "), numpy.uint8)
    written = [hexes(column) if column.dtype == numpy.float64 else digits(column) for column in columns]
    rows = numpy.concatenate([part for column in written for part in (blank, column)], axis=1)
    ends = numpy.searchsorted(cases, numpy.arange(count + 1)).tolist()
    return [f"{end - first}{rows[first:end].tobytes().decode()}" for first, end in zip(ends, ends[1:])]


def counted_runs(mask: Array) -> str:
    """Runs of one picture with their hits: row, first column, one past the last, hits."""
    runs = []
    for y, row in enumerate(numpy.minimum(mask, MOST_HITS).astype(numpy.int64)):
        ends = [0, *(numpy.flatnonzero(numpy.diff(row)) + 1).tolist(), len(row)]
        runs += [(y, first, end, int(row[first])) for first, end in zip(ends, ends[1:]) if row[first]]
    return " ".join(map(str, [len(runs), *(number for run in runs for number in run)]))


def spans(masks: Array) -> List[str]:
    """Runs of row, first column, one past the last; a pixel that is drawn twice is in two of them."""
    parts, cases = [], []
    for level in range(1, int(masks.max(initial=0)) + 1):
        edges = numpy.zeros((*masks.shape[:2], masks.shape[2] + 2), numpy.int8)
        edges[:, :, 1:-1] = masks >= level
        steps = numpy.diff(edges, axis=2)
        case, row, first = numpy.nonzero(steps == 1)
        parts.append([row, first, numpy.nonzero(steps == -1)[2]])
        cases.append(case)
    if not parts:
        return ["0"] * len(masks)
    case = numpy.concatenate(cases)
    order = numpy.argsort(case, kind="stable")
    return joined([numpy.concatenate(column)[order] for column in zip(*parts)], case[order], len(masks))


def coverage(judged: Judged, value: Any, count: int, window: Tuple[int, int]) -> List[str]:
    if isinstance(value, (list, tuple)):
        return rows_of(judged, value, count, "y x0 x1")
    masks = masks_of(judged, value, count, window)
    # A picture with a pixel that is drawn more than twice has runs with their hits, and begins with the letter of such an answer.
    often = masks.max(axis=(1, 2), initial=0) > 2
    texts = spans(numpy.where(often[:, None, None], 0, masks) if often.any() else masks)
    for case in numpy.flatnonzero(often):
        texts[case] = f"H{counted_runs(masks[case])}"
    return texts


def pixels(judged: Judged, value: Any, count: int, window: Tuple[int, int]) -> List[str]:
    if isinstance(value, (list, tuple)):
        return rows_of(judged, value, count, "x y")
    masks = masks_of(judged, value, count, window)
    case, y, x = numpy.nonzero(masks)
    # A pixel of a line is drawn once or it is not; how often more is not told apart.
    hits = numpy.minimum(masks[case, y, x], 2).astype(numpy.int64)
    case, y, x = (numpy.repeat(part, hits) for part in (case, y, x))
    return joined([x, y], case, count)


def fragments(judged: Judged, value: Any, count: int, window: Tuple[int, int]) -> List[str]:
    if not isinstance(value, (list, tuple)) or len(value) != 2:
        raise TypeError(f"{judged.name} returned {type(value).__name__}; expected two arrays, masks and values")
    masks = masks_of(judged, value[0], count, window)
    values = reals_of(value[1], f"values of {judged.name}")
    if values.shape != (*masks.shape, 3):
        raise ValueError(f"{judged.name} returned values of shape {values.shape}; expected {(*masks.shape, 3)}: (n, height, width, 3), each z a b")
    case, y, x = numpy.nonzero(masks)
    drawn = values[case, y, x].astype(numpy.float64)
    return joined([x, y, *drawn.T], case, count)


def triangles(judged: Judged, value: Any) -> Optional[Array]:
    if value is None:
        return None
    array = reals_of(value, f"triangles of {judged.name}")
    if array.size == 0:
        return numpy.empty((0, 3, 2))
    if array.ndim != 3 or array.shape[1:] != (3, 2):
        raise ValueError(f"{judged.name} returned triangles of shape {array.shape}; expected (m, 3, 2), or None for a polygon that is not taken")
    return array.astype(numpy.float64)
