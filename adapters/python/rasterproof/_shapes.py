"""Checks what a function returns, and writes it as answers of the line protocol."""

from __future__ import annotations

from typing import Any, List, Optional, Sequence, Tuple

import numpy

Array = Any


class Kind:
    """What a function returned first: it has to go on returning that."""

    def __init__(self) -> None:
        self.first = ""

    def keep(self, kind: str, call: str) -> None:
        self.first = self.first or kind
        if kind != self.first:
            raise TypeError(f"{call} returned {kind}; in an earlier call {self.first}")


def array_of(value: Any, what: str) -> Array:
    array = numpy.asarray(value)
    if array.dtype == object:
        raise TypeError(f"{what} are no numbers: {type(value).__name__}")
    return array


def masks_of(value: Any, count: int, window: Tuple[int, int], call: str, kind: Kind) -> Array:
    """How often each pixel was drawn, of shape (count, height, width)."""
    masks = array_of(value, f"masks of {call}")
    width, height = window
    if masks.dtype != bool and not numpy.issubdtype(masks.dtype, numpy.integer):
        raise TypeError(f"{call} returned masks of type {masks.dtype}; expected bool, or integers that count how often a pixel is drawn")
    if masks.shape != (count, height, width):
        raise ValueError(f"{call} returned masks of shape {masks.shape}; expected {(count, height, width)}: (n, height, width)")
    if masks.dtype != bool and masks.size and masks.min() < 0:
        raise ValueError(f"{call} returned masks with {masks.min()}; a pixel is drawn at least 0 times")
    kind.keep("masks of bool" if masks.dtype == bool else "masks of integers", call)
    return masks


def rows_of(value: Any, count: int, columns: str, call: str) -> List[str]:
    """The rows of each case as text, from an array with these columns for each."""
    if len(value) != count:
        raise ValueError(f"{call} returned a list of {len(value)}; expected {count}, one for each case")
    wide = len(columns.split())
    rows = []
    for case, each in enumerate(value):
        array = array_of(each, f"rows of {call}")
        if array.size == 0:
            array = numpy.empty((0, wide), numpy.int64)
        if array.ndim != 2 or array.shape[1] != wide:
            raise ValueError(f"{call} returned shape {array.shape} for case {case}; expected (k, {wide}) with the columns {columns}")
        if not numpy.issubdtype(array.dtype, numpy.integer):
            raise TypeError(f"{call} returned type {array.dtype} for case {case}; expected integers with the columns {columns}")
        rows.append(" ".join(map(str, [len(array), *array.ravel().tolist()])))
    return rows


def digits(column: Array) -> Array:
    """Whole numbers from 0 on as characters, all of the same length."""
    powers = 10 ** numpy.arange(len(str(column.max(initial=0))), dtype=numpy.int64)[::-1]
    return (column[:, None] // powers % 10 + ord("0")).astype(numpy.uint8)


def hexes(column: Array) -> Array:
    """Floats as characters, all of the same length: as C99 hex floats they are exact, without a loop in Python."""
    bits = numpy.ascontiguousarray(column, numpy.float64).view(numpy.uint64).astype(numpy.int64)
    exponent = bits >> 52 & 2047
    power = numpy.maximum(exponent, 1) - 1023
    text = numpy.tile(numpy.frombuffer(b" 0x1.0123456789abcp+1023", numpy.uint8), (len(column), 1))
    text[bits < 0, 0] = ord("-")
    text[exponent == 0, 3] = ord("0")
    text[:, 5:18] = numpy.frombuffer(b"0123456789abcdef", numpy.uint8)[bits[:, None] >> numpy.arange(48, -4, -4) & 15]
    text[power < 0, 19] = ord("-")
    text[:, 20:] = abs(power)[:, None] // [1000, 100, 10, 1] % 10 + ord("0")
    # Neither an infinity nor a NaN has an exponent.
    text[exponent == 2047] = numpy.frombuffer(b"nan".ljust(24), numpy.uint8)
    return text


def joined(columns: Sequence[Array], cases: Array, count: int) -> List[str]:
    """What is drawn in each case as text, the number of its rows first; `cases` says in order which row is whose."""
    blank = numpy.full((len(cases), 1), ord(" "), numpy.uint8)
    written = [hexes(column) if column.dtype == numpy.float64 else digits(column) for column in columns]
    rows = numpy.concatenate([part for column in written for part in (blank, column)], axis=1)
    ends = numpy.searchsorted(cases, numpy.arange(count + 1)).tolist()
    return [f"{end - first}{rows[first:end].tobytes().decode()}" for first, end in zip(ends, ends[1:])]


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


def coverage(value: Any, count: int, window: Tuple[int, int], call: str, kind: Kind) -> List[str]:
    if isinstance(value, (list, tuple)):
        kind.keep("a list of spans", call)
        return rows_of(value, count, "y x0 x1", call)
    return spans(masks_of(value, count, window, call, kind))


def pixels(value: Any, count: int, window: Tuple[int, int], call: str, kind: Kind) -> List[str]:
    if isinstance(value, (list, tuple)):
        kind.keep("a list of pixels", call)
        return rows_of(value, count, "x y", call)
    masks = masks_of(value, count, window, call, kind)
    case, y, x = numpy.nonzero(masks)
    case, y, x = (numpy.repeat(part, masks[case, y, x].astype(numpy.int64)) for part in (case, y, x))
    return joined([x, y], case, count)


def fragments(value: Any, count: int, window: Tuple[int, int], call: str, kind: Kind) -> List[str]:
    if not isinstance(value, (list, tuple)) or len(value) != 2:
        raise TypeError(f"{call} returned {type(value).__name__}; expected two arrays, masks and values")
    masks = masks_of(value[0], count, window, call, kind)
    values = array_of(value[1], f"values of {call}")
    if not numpy.issubdtype(values.dtype, numpy.number) or numpy.issubdtype(values.dtype, numpy.complexfloating):
        raise TypeError(f"{call} returned values of type {values.dtype}; expected floats")
    if values.shape != (*masks.shape, 3):
        raise ValueError(f"{call} returned values of shape {values.shape}; expected {(*masks.shape, 3)}: (n, height, width, 3), each z a b")
    case, y, x = numpy.nonzero(masks)
    drawn = values[case, y, x].astype(numpy.float64)
    return joined([x, y, *drawn.T], case, count)


def triangles(value: Any, call: str) -> Optional[str]:
    if value is None:
        return None
    array = array_of(value, f"triangles of {call}")
    if array.size == 0:
        return "0"
    if array.ndim != 3 or array.shape[1:] != (3, 2):
        raise ValueError(f"{call} returned triangles of shape {array.shape}; expected (m, 3, 2), or None for a polygon that is not taken")
    if not numpy.issubdtype(array.dtype, numpy.number) or numpy.issubdtype(array.dtype, numpy.complexfloating):
        raise TypeError(f"{call} returned triangles of type {array.dtype}; expected numbers")
    return " ".join([str(len(array)), *map(repr, array.astype(numpy.float64).ravel().tolist())])
