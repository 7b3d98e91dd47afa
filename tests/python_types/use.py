"""What a program that uses the package and checks its types may do."""
from __future__ import annotations

import datetime

import numpy as np
import numpy.typing as npt
import polylidar_core
from polylidar_core import MultiPolygon, concave_hull, concave_hulls, delaunay

points: npt.NDArray[np.float64] = np.zeros((4, 2))
hull: MultiPolygon = concave_hull(points, alpha=1.0, max_edge_length=2, max_perimeter=None, fill_single_triangles=True)
same: MultiPolygon = concave_hull([(0, 0), (1, 0), (0, 1)], detail=2.0, threads=None)
shells: list[npt.NDArray[np.float64]] = [polygon[0] for polygon in hull.polygons]
rows: list[npt.NDArray[np.uint32]] = [ring for polygon in same.indices for ring in polygon]
numbers: tuple[float, int] = (hull.area, len(hull))
sizes: tuple[float, float, float] | None = hull.sizes
areas: dict[str, float] = {label: each.area for label, each in concave_hulls(points, ["a", "a", "b", "b"]).items()}
triangles: npt.NDArray[np.uint32] = delaunay(points)
dated: dict[object, MultiPolygon] = concave_hulls(points, [datetime.date(2026, 1, day) for day in (1, 1, 2, 2)])
version: str = polylidar_core.__version__
geometry: dict[str, object] = hull.__geo_interface__
