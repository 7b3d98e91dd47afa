"""Concave hulls of the points of a GeoDataFrame or a GeoSeries. Needs GeoPandas, which polylidar_core itself does not."""
from __future__ import annotations

from typing import Any

import geopandas as gpd
import numpy as np

from . import concave_hulls as hulls_by_label
from ._points import as_points

__all__ = ["concave_hulls"]


def __dir__() -> list[str]:
    return __all__


def concave_hulls(points: gpd.GeoDataFrame | gpd.GeoSeries, by: Any = None, **options: Any) -> gpd.GeoDataFrame:
    """A concave hull for every group of points: a row a group, with the columns points (how many), area, parts (how many
    polygons) and geometry (a MultiPolygon, empty where a group has none), in the coordinate system of the points. The
    index are the groups, as of points.groupby(by).

    points: geometries of the type Point.
    by: what groupby() takes: the name of a column or several, or one label a point, of any type. Points without a label
        belong to no group. None: all points are one group.
    options: alpha, max_edge_length, max_perimeter, detail, fill_single_triangles, cover, one and threads, as of
        polylidar_core.concave_hulls.

    UserWarning: the coordinate system is one of degrees. ValueError: as of polylidar_core.concave_hull; a geometry is
    missing, empty or no Point.

        >>> import geopandas, polylidar_core.geopandas
        >>> x, y = [0, 2, 2, 0, 5, 7, 6], [0, 0, 2, 2, 0, 0, 2]
        >>> trees = geopandas.GeoDataFrame({"kind": list("oooobbb")}, geometry=geopandas.points_from_xy(x, y))
        >>> hulls = polylidar_core.geopandas.concave_hulls(trees, by="kind")
        >>> hulls["points"].to_dict(), hulls["area"].to_dict()
        ({'b': 3, 'o': 4}, {'b': 2.0, 'o': 4.0})
    """
    array = as_points(points)
    groups = points.groupby(np.zeros(len(points), np.int64) if by is None else by, observed=True)
    sizes = groups.size()
    # Numbers without a label are -1 or NaN, as pandas' version has it.
    labels = groups.ngroup().fillna(-1).to_numpy(np.int64)
    inside = labels >= 0
    hulls = list(hulls_by_label(array[inside], labels[inside], **options).values())
    columns = {
        "points": sizes.to_numpy(),
        "area": np.array([hull.area for hull in hulls], np.float64),
        "parts": np.array([len(hull) for hull in hulls], np.int64),
    }
    shapes = gpd.GeoSeries([hull.to_shapely() for hull in hulls], index=sizes.index, crs=points.crs)
    return gpd.GeoDataFrame(columns, geometry=shapes, index=sizes.index)
