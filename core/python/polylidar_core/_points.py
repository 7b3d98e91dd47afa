"""Points as an array, from whatever holds them."""
from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import numpy.typing as npt


def as_points(points: Any) -> npt.NDArray[np.float64]:
    """A C-contiguous array of the shape (n, 2); the caller's own where it is one. Raises ValueError."""
    # Of the type, as GeoPandas would work the attribute itself out.
    if hasattr(type(points), "__geo_interface__"):
        points = _coordinates(points)
    rows = points if isinstance(points, (list, tuple)) else [points]
    if any(isinstance(row, np.ma.MaskedArray) and np.any(row.mask) for row in rows):
        raise ValueError("points are masked: leave them out, points[~points.mask.any(axis=1)]")
    try:
        array = np.asarray(points)
    except ValueError as error:
        raise ValueError("points must be numbers of the shape (n, 2): some rows differ in length") from error
    if array.dtype.kind not in "iuf":
        raise ValueError(f"points must be real numbers, not of the type {array.dtype}")
    if array.shape == (0,):
        array = array.reshape(0, 2)
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"points must have the shape (n, 2), not {array.shape}: give one row of x and y a point")
    return np.require(array, np.float64, ["C", "ALIGNED"])


def _coordinates(points: Any) -> Any:
    """Of Shapely's MultiPoint and the like, a GeoSeries or the geometries of a GeoDataFrame."""
    if not hasattr(points, "crs"):
        geometry = points.__geo_interface__
        if geometry["type"] != "MultiPoint":
            raise ValueError(f"points must be a MultiPoint, not a {geometry['type']}")
        return [position[:2] for position in geometry["coordinates"]]
    series = points.geometry
    without = np.flatnonzero(series.isna() | series.is_empty)
    if without.size > 0:
        raise ValueError(f"point {without[0]} is missing or empty")
    others = np.flatnonzero(series.geom_type != "Point")
    if others.size > 0:
        kind = series.geom_type.iloc[others[0]]
        raise ValueError(f"row {others[0]} is a {kind}, not a Point: explode() makes points of a MultiPoint")
    if series.crs is not None and series.crs.is_geographic:
        warnings.warn(
            "the points are in degrees, in which lengths and areas are distorted: "
            "points.to_crs(points.estimate_utm_crs()) gives metres",
            stacklevel=4,
        )
    coordinates = np.column_stack([series.x, series.y])
    infinite = np.flatnonzero(~np.isfinite(coordinates).all(axis=1))
    if infinite.size > 0:
        raise ValueError(f"point {infinite[0]} is not finite")
    return coordinates
