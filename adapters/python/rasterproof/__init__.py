"""Judges a rasterizer written in Python, pixel by pixel, against an exact oracle.

    import rasterproof
    rasterproof.assert_rasterizer(draw)

`draw(corners, window)` gets corners of shape (n, 3, 2) in pixels, y down, and a window (width, height). It returns masks of
shape (n, height, width), or a list of n arrays of spans. docs/python.md has the rest.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Callable, List, Sequence, Tuple, TypedDict, Union

from numpy.typing import NDArray

from . import _shapes
from ._session import Kind, judge, program

if TYPE_CHECKING:
    from typing_extensions import Unpack

# In all modules here: pytest shows the line of the test, and the function that is judged.
__tracebackhide__ = True

__all__ = ["Judge", "Options", "assert_lines", "assert_partition", "assert_rasterizer", "assert_values", "program"]

Window = Tuple[int, int]
Rasterizer = Callable[[NDArray[Any], Window], Union[NDArray[Any], Sequence[NDArray[Any]]]]
Values = Callable[[NDArray[Any], Window], Tuple[NDArray[Any], NDArray[Any]]]
Tessellator = Callable[[List[NDArray[Any]]], Union[None, NDArray[Any], Sequence[Any]]]


class Options(TypedDict, total=False):
    """What the four functions take beside the function that is judged."""

    cases: int  # of each family; 50 where it is not given
    seed: int  # decides every generated case; 1 where it is not given
    family: Union[str, Sequence[str]]  # only this one, or these
    case: int  # only the case of this number
    declare: str  # words of the line protocol for what is promised, such as "rule=strict winding=cw range=4096"
    seconds: float  # so many for the cases, for making failing ones smaller and for their causes
    hits: bool  # whether a mask of 0 and a number above 1 counts how often a pixel is drawn; refused where it is not given


_COVERAGE = Kind("assert_rasterizer", "T", "C", "coverage", _shapes.drawn((3, 2), _shapes.coverage), "8 6 1 1 6 1 1 6")
_LINES = Kind("assert_lines", "L", "P", "line", _shapes.drawn((2, 2), _shapes.pixels, True), "8 6 1 1 6 4")
_VALUES = Kind(
    "assert_values", "I", "F", "attributes", _shapes.drawn((3, 6), _shapes.fragments), "8 6 1 1 0 1 0 0 6 1 0 1 1 0 1 6 1 1 0 1"
)
_PARTITION = Kind("assert_partition", "Y", "Z", "partition", _shapes.polygons, "1 3 0 0 4 0 0 4")


def assert_rasterizer(fn: Rasterizer, **options: "Unpack[Options]") -> None:
    """Judges which pixels of triangles are drawn.

    `fn(corners, window)` gets an array of shape (n, 3, 2), in pixels with y down, and (width, height). It returns masks
    of shape (n, height, width), of bool or of integers that count how often a pixel is drawn, or a list of n integer
    arrays of shape (k, 3): row, first column, one past the last.

    `Options` has what else can be chosen, such as cases=2000. Raises AssertionError with the message of the judge.
    """
    judge(_COVERAGE, fn, options)


def assert_lines(fn: Rasterizer, **options: "Unpack[Options]") -> None:
    """Judges which pixels of lines are drawn, as assert_rasterizer does.

    `fn(ends, window)` gets whole pixels of shape (n, 2, 2), and returns masks of shape (n, height, width), or a list of n
    integer arrays of shape (k, 2): the pixels x y in drawing order, those outside the window left out.
    """
    judge(_LINES, fn, options)


def assert_values(fn: Values, **options: "Unpack[Options]") -> None:
    """Judges pixels with their depth and two attributes, as assert_rasterizer does.

    `fn(corners, window)` gets an array of shape (n, 3, 6): x y z w a b of each corner. It returns masks of shape (n, height,
    width) and values of shape (n, height, width, 3): z, linear on the screen, and a b in perspective.
    """
    judge(_VALUES, fn, options)


def assert_partition(fn: Tessellator, **options: "Unpack[Options]") -> None:
    """Judges the triangles that are made of polygons: they cover each exactly once.

    `fn(contours)` gets a list of arrays of shape (k, 2), the first one around the others, and returns an array of shape
    (m, 3, 2), or None for a polygon that it does not take.
    """
    judge(_PARTITION, fn, options)


class Judge:
    """The four functions with options chosen once, as the pytest fixture `rasterproof` has them."""

    def __init__(self, **chosen: "Unpack[Options]") -> None:
        self.chosen = chosen
        self.assert_rasterizer = partial(assert_rasterizer, **chosen)
        self.assert_lines = partial(assert_lines, **chosen)
        self.assert_values = partial(assert_values, **chosen)
        self.assert_partition = partial(assert_partition, **chosen)
