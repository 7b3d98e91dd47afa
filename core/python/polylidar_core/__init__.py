"""Concave hulls of points in the plane, by the polylidar core: points in, valid multipolygons out.

    >>> import numpy, polylidar_core
    >>> points = numpy.random.default_rng(1).random((1000, 2))
    >>> shape = polylidar_core.concave_hull(points)
    >>> 0.9 < shape.area < 1
    True

polylidar_core.geopandas does the same for GeoPandas, with a group a row.
"""
from __future__ import annotations

import math
import operator
import os
from typing import Any, Protocol, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._core import __version__
from ._labels import numbered
from ._points import as_points
from .multi_polygon import MultiPolygon


class _HasGeoInterface(Protocol):
    """Shapely's MultiPoint, a GeoSeries and so on."""

    @property
    def __geo_interface__(self) -> Any:
        ...


Points = Union[npt.ArrayLike, _HasGeoInterface]

__all__ = ["MultiPolygon", "__version__", "concave_hull", "concave_hulls", "delaunay"]


def __dir__() -> list[str]:
    # What is imported here is nobody's to use.
    return __all__


def concave_hull(
    points: Points,
    *,
    alpha: float | None = None,
    max_edge_length: float | None = None,
    max_perimeter: float | None = None,
    detail: float = 1.0,
    fill_single_triangles: bool | None = None,
    cover: bool = False,
    one: bool = False,
    threads: int | None = 1,
) -> MultiPolygon:
    """The concave hull of points: their Delaunay triangulation, the triangles that all limits keep, and the outline
    of each part that is connected by edges. Without any limit given, one is chosen from the points, place by place,
    so that it follows their density. With alpha=math.inf it is the convex hull.
    O(n log n).

        . . . . . . .          +-----------+
        . .     . . .          |  +---+    |
        . .     . . .    ->    |  +---+    |
        . . . . . . .          |     +-----+
        . . . .                |     |
        . . . .                +-----+

    points: numbers of the shape (n, 2), x and y in any unit of length, in any order; they may repeat. A C-contiguous
        float64 array is used without a copy, read-only and memory-mapped ones too; anything else is converted, which
        copies it once. The GIL is released: other threads must not change the array meanwhile. A MultiPoint of
        Shapely's, and a GeoSeries or GeoDataFrame of points, are taken too; of degrees they give a UserWarning.
    alpha: largest circumradius of a triangle that is kept, in the unit of the points; zero or more; None: not given.
        For points spread evenly over a shape of known area, 2 * sqrt(area / n) suits.
    max_edge_length: longest edge of a triangle that is kept, likewise.
    max_perimeter: largest perimeter of a triangle that is kept, likewise.
    detail: how much of the outline is kept where the limit is chosen; above zero. Twice the detail keeps triangles of
        half the size. A larger one makes every limit smaller. Not used where a limit is given.
    fill_single_triangles: whether a triangle beyond a limit is kept all the same when its three neighbours are within;
        None: only where the limit is chosen.
    cover: whether the limit is widened, just enough to leave no point outside. One far outlier makes the shape coarse.
    one: whether the limit is widened, just enough to join all parts that it gave before. A part that only the wider
        limit adds, and that lies apart, is dropped. Both take some 5 times as long for 2,000 points, and 15 times for
        100,000.
    threads: how many threads compute, one or more; None: as many as this process may use processors. The result does
        not depend on it. Worth it from some 10,000 points on.

    Fewer than 3 distinct points, points all on a line, or no triangle kept: an empty multipolygon.

    ValueError: another shape, no real numbers, a coordinate that is not finite (the message names the row, from 0),
    coordinates whose magnitudes span more than a factor of 2^265, more than 2^28 points, a limit that is negative or
    NaN, a detail that is not positive and finite, threads below 1. TypeError: an option of another type.

        >>> around = [(x, y) for y in range(11) for x in range(11) if abs(x - 5) > 1 or abs(y - 5) > 1]
        >>> concave_hull(around, alpha=0.75)
        <MultiPolygon: polygons 1, holes 1, vertices 52, area 86>
    """
    array = as_points(points)
    return MultiPolygon(
        array,
        *_core.concave_hull(
            array, *_checked(alpha, max_edge_length, max_perimeter, detail, fill_single_triangles, cover, one, threads)
        ),
    )


def concave_hulls(
    points: Points,
    labels: npt.ArrayLike | Sequence[Any],
    *,
    alpha: float | None = None,
    max_edge_length: float | None = None,
    max_perimeter: float | None = None,
    detail: float = 1.0,
    fill_single_triangles: bool | None = None,
    cover: bool = False,
    one: bool = False,
    threads: int | None = 1,
) -> dict[Any, MultiPolygon]:
    """A concave hull for every label, as concave_hull makes it of that label's points alone, by ascending label. Shapes
    of different labels may overlap. The rows in their `indices` are those of all points.

    labels: one a point, of the shape (n,): integers, text or whatever else can be sorted (tuples in an array of objects
        only). The keys of the result are Python's int, str and so on, of dates numpy's. Integers are the fastest.
    The others, and the errors they raise: as of concave_hull. Labels are shared among the threads.

    ValueError, besides: there are not as many labels as points, a label is missing (None, NaN, NaT or pandas.NA), or
    labels cannot be sorted, such as numbers among text.

        >>> points = [(0, 0), (2, 0), (0, 2), (5, 5), (6, 5), (5, 6)]
        >>> {label: hull.area for label, hull in concave_hulls(points, [7, 7, 7, 3, 3, 3]).items()}
        {3: 0.5, 7: 2.0}
        >>> list(concave_hulls(points, ["oak", "oak", "oak", "elm", "elm", "elm"]))
        ['elm', 'oak']
    """
    array = as_points(points)
    numbers, names = numbered(labels, len(array))
    options = _checked(alpha, max_edge_length, max_perimeter, detail, fill_single_triangles, cover, one, threads)
    hulls = _core.concave_hulls(array, numbers, *options)
    return {
        number if names is None else names[number]: MultiPolygon(array, vertices, rings, parts, area)
        for number, vertices, rings, parts, area in hulls
    }


def delaunay(points: Points) -> npt.NDArray[np.uint32]:
    """The triangles of the Delaunay triangulation of points, an array of the shape (m, 3): row indices of points,
    each triangle counter-clockwise, the triangles in no particular order. Of equal points only the first is used.
    None (m = 0) for fewer than 3 distinct points or points all on a line. O(n log n).

    points, and the errors they raise: as of concave_hull.

        >>> delaunay([(0, 0), (2, 0), (2, 1), (0, 1), (1, 9)]).shape
        (3, 3)
    """
    return _core.delaunay(as_points(points))


# In the order of the core's arguments; threads are the last one.
_NUMBERS = ("alpha", "max_edge_length", "max_perimeter", "detail")
_FLAGS = ("fill_single_triangles", "cover", "one")


def _checked(*options: Any) -> tuple[Any, ...]:
    """The options as the core takes them. TypeError in one sentence, where pybind11 would list its signatures."""
    for name, value in zip(_NUMBERS, options):
        if value is None and name != "detail":
            continue
        try:
            math.fabs(value)
        except TypeError:
            raise _wrong_type(name, "a number", value) from None
        except OverflowError:
            raise ValueError(f"{name} is too large for a float") from None
    for name, value in zip(_FLAGS, options[len(_NUMBERS) :]):
        if not hasattr(type(value), "__bool__") or np.ndim(value) > 0:
            raise _wrong_type(name, "True or False", value)
    return (*options[:-1], _thread_count(options[-1]))


def _wrong_type(name: str, kind: str, value: Any) -> TypeError:
    return TypeError(f"{name} must be {kind}, not of the type {type(value).__name__}")


def _thread_count(threads: int | None) -> int:
    if threads is None:
        return len(os.sched_getaffinity(0))
    try:
        count = operator.index(threads)
    except TypeError:
        raise _wrong_type("threads", "a whole number", threads) from None
    if count < 1:
        raise ValueError("threads must be one or more, or None for all processors")
    return min(count, 1024)  # the core uses no more
