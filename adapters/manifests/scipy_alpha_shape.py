import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "process"))
import hullbench_worker

import numpy
import scipy.spatial
import shapely.geometry
import shapely.ops


def triangles(points, alpha):
    """The corners of the Delaunay triangles whose circumradius is at most alpha: (m, 3, 2)."""
    try:
        corners = points[scipy.spatial.Delaunay(points).simplices]
    except (ValueError, scipy.spatial.QhullError):  # fewer than 3 points, or all on a line: no triangle
        return numpy.empty((0, 3, 2))
    a, b, c = (numpy.linalg.norm(corners[:, i] - corners[:, i - 1], axis=1) for i in range(3))
    half = (a + b + c) / 2
    area = numpy.sqrt(numpy.maximum(half * (half - a) * (half - b) * (half - c), 0))
    return corners[a * b * c <= 4 * alpha * area]


def polygons(corners):
    """The union of the triangles."""
    union = shapely.ops.unary_union([shapely.geometry.Polygon(triangle) for triangle in corners])
    parts = getattr(union, "geoms", [union])
    rings = [[part.exterior, *part.interiors] for part in parts if not part.is_empty]
    return [[numpy.asarray(ring.coords) for ring in polygon] for polygon in rings]


hullbench_worker.serve(version=f"scipy {scipy.__version__}, shapely {shapely.__version__}", run=triangles, extract=polygons)
