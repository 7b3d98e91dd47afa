import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "process"))
import hullbench_worker

import numpy
from delaunay_shapes import VERSION, Triangles


def alpha_shape(points, alpha):
    """The triangles and which of them the shape has."""
    triangles = Triangles(points)
    if alpha == 0 and len(triangles.corners) > 0:
        alpha = triangles.one_polygon_radii()[0]
    return triangles, triangles.circumradii <= alpha


def rings(shape):
    triangles, kept = shape
    return [[numpy.asarray(ring.coords) for ring in (polygon.exterior, *polygon.interiors)]
            for polygon in triangles.polygons(kept)]


hullbench_worker.serve(version=VERSION, run=alpha_shape, extract=rings)
