"""Judges a rasterizer written in Python, pixel by pixel, against an exact oracle.

    import rasterproof
    rasterproof.assert_rasterizer(draw)

`draw(corners, window)` gets corners of shape (n, 3, 2) in pixels, y down, and a window (width, height). It returns masks of
shape (n, height, width), or a list of n arrays of spans. docs/python.md has the rest.
"""

from __future__ import annotations

from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy
from numpy.typing import NDArray

from . import _shapes
from ._session import Session, program, run

__all__ = ["Judge", "assert_lines", "assert_partition", "assert_rasterizer", "assert_values", "program"]

Window = Tuple[int, int]
Rasterizer = Callable[[NDArray[Any], Window], Union[NDArray[Any], Sequence[NDArray[Any]]]]
Values = Callable[[NDArray[Any], Window], Tuple[NDArray[Any], NDArray[Any]]]
Tessellator = Callable[[List[NDArray[Any]]], Union[None, NDArray[Any], Sequence[Any]]]
Families = Union[None, str, Sequence[str]]


def _judge(of: "_Of", fn: Callable[..., Any], judged: Dict[str, Any], declare: str, timeout: float) -> None:
    __tracebackhide__ = True
    cases = judged["cases"]
    if not callable(fn):
        raise TypeError(f"{of.call} takes a function; got {type(fn).__name__}")
    if isinstance(cases, bool) or not isinstance(cases, int) or cases < 1:
        raise ValueError(f"no case would be judged: cases is {cases!r}; expected at least 1")
    kind, name = _shapes.Kind(), str(getattr(fn, "__name__", type(fn).__name__))

    def answer(numbers: List[List[float]], window: Window) -> List[Optional[str]]:
        return of.ask(fn, numbers, window, name, kind)

    # What it returns for one case, in a window that is no square, says what can be seen in its answers.
    answer([of.probe], (8, 6))
    masked = " mask line-set" if of.verb == "L" else " mask"
    words = (masked if kind.first == "masks of bool" else " line-set" * (of.verb == "L" and "masks" in kind.first)).strip()
    session = Session(of.verb, of.capability, words, name, answer)
    options = {key: value for key, value in judged.items() if value is not None}
    options.update({"declare": declare} if declare else {})
    run(session, options, f"rasterproof.{of.call}({name}{{}})", timeout)


class _Of:
    """What one of the functions judges: the request, and how it is read and answered."""

    def __init__(self, call: str, verb: str, capability: str, shape: Tuple[int, int], whole: bool, write: Any, probe: List[float]) -> None:
        self.call, self.verb, self.capability, self.write, self.probe = call, verb, capability, write, probe
        self.shape, self.whole = shape, whole

    def read(self, numbers: List[List[float]]) -> NDArray[Any]:
        array = numpy.array(numbers, numpy.float64).reshape(len(numbers), *self.shape)
        # A position of a line names the pixel that contains it.
        return numpy.floor(array).astype(numpy.int64) if self.whole else array


    def ask(self, fn: Callable[..., Any], numbers: List[List[float]], window: Window, name: str, kind: Any) -> List[Optional[str]]:
        written: List[Optional[str]] = self.write(fn(self.read(numbers), window), len(numbers), window, name, kind)
        return written


class _Polygons(_Of):
    """Polygons come one by one, as lists of contours, each behind the number of its vertices."""

    def ask(self, fn: Callable[..., Any], numbers: List[List[float]], window: Window, name: str, kind: Any) -> List[Optional[str]]:
        answers = []
        for count, *rest in numbers:
            contours: List[NDArray[Any]] = []
            for _ in range(int(count)):
                end = 1 + 2 * int(rest[0])
                contours.append(numpy.array(rest[1:end]).reshape(-1, 2))
                rest = rest[end:]
            answers.append(self.write(fn(contours), name))
        return answers


_COVERAGE = _Of("assert_rasterizer", "T", "coverage", (3, 2), False, _shapes.coverage, [1, 1, 6, 1, 1, 6])
_LINES = _Of("assert_lines", "L", "line", (2, 2), True, _shapes.pixels, [1, 1, 6, 4])
_VALUES = _Of(
    "assert_values", "I", "attributes", (3, 6), False, _shapes.fragments, [1, 1, 0, 1, 0, 0, 6, 1, 0, 1, 1, 0, 1, 6, 1, 1, 0, 1]
)
_PARTITION = _Polygons("assert_partition", "Y", "partition", (0, 0), False, _shapes.triangles, [1, 3, 0, 0, 4, 0, 0, 4])


def assert_rasterizer(
    fn: Rasterizer, *, cases: int = 100, seed: int = 1, family: Families = None, case: Optional[int] = None,
    declare: str = "", seconds: Optional[float] = None, timeout: float = 60.0,
) -> None:
    """Judges which pixels of triangles are drawn.

    `fn(corners, window)` gets an array of shape (n, 3, 2), in pixels with y down, and (width, height). It returns masks
    of shape (n, height, width), of bool or of integers that count how often a pixel is drawn, or a list of n integer
    arrays of shape (k, 3): row, first column, one past the last.

    `declare` holds words of the line protocol, such as "rule=strict winding=cw range=4096". `seconds` bounds the whole run,
    `timeout` each answer. Raises AssertionError with the message of the judge.
    """
    __tracebackhide__ = True
    judged = {"cases": cases, "seed": seed, "family": family, "case": case, "seconds": seconds}
    _judge(_COVERAGE, fn, judged, declare, timeout)


def assert_lines(
    fn: Rasterizer, *, cases: int = 100, seed: int = 1, family: Families = None, case: Optional[int] = None,
    declare: str = "", seconds: Optional[float] = None, timeout: float = 60.0,
) -> None:
    """Judges which pixels of lines are drawn.

    `fn(ends, window)` gets whole pixels of shape (n, 2, 2), and returns masks of shape (n, height, width), or a list of n
    integer arrays of shape (k, 2): the pixels x y in drawing order, those outside the window left out.
    """
    __tracebackhide__ = True
    judged = {"cases": cases, "seed": seed, "family": family, "case": case, "seconds": seconds}
    _judge(_LINES, fn, judged, declare, timeout)


def assert_values(
    fn: Values, *, cases: int = 100, seed: int = 1, family: Families = None, case: Optional[int] = None,
    declare: str = "", seconds: Optional[float] = None, timeout: float = 60.0,
) -> None:
    """Judges pixels with their depth and two attributes.

    `fn(corners, window)` gets an array of shape (n, 3, 6): x y z w a b of each corner. It returns masks of shape (n, height,
    width) and values of shape (n, height, width, 3): z, linear on the screen, and a b in perspective.
    """
    __tracebackhide__ = True
    judged = {"cases": cases, "seed": seed, "family": family, "case": case, "seconds": seconds}
    _judge(_VALUES, fn, judged, declare, timeout)


def assert_partition(
    fn: Tessellator, *, cases: int = 100, seed: int = 1, family: Families = None, case: Optional[int] = None,
    declare: str = "", timeout: float = 60.0,
) -> None:
    """Judges the triangles that are made of polygons: they cover each exactly once.

    `fn(contours)` gets a list of arrays of shape (k, 2), the first one around the others, and returns an array of shape
    (m, 3, 2), or None for a polygon that it does not take.
    """
    __tracebackhide__ = True
    judged = {"cases": cases, "seed": seed, "family": family, "case": case}
    _judge(_PARTITION, fn, judged, declare, timeout)


class Judge:
    """The four functions with arguments chosen once, as the pytest fixture `rasterproof` has them."""

    def __init__(self, **chosen: Any) -> None:
        self.chosen = chosen

    def assert_rasterizer(self, fn: Rasterizer, **arguments: Any) -> None:
        __tracebackhide__ = True
        assert_rasterizer(fn, **{**self.chosen, **arguments})

    def assert_lines(self, fn: Rasterizer, **arguments: Any) -> None:
        __tracebackhide__ = True
        assert_lines(fn, **{**self.chosen, **arguments})

    def assert_partition(self, fn: Tessellator, **arguments: Any) -> None:
        __tracebackhide__ = True
        assert_partition(fn, **{**self.chosen, **arguments})

    def assert_values(self, fn: Values, **arguments: Any) -> None:
        __tracebackhide__ = True
        assert_values(fn, **{**self.chosen, **arguments})
