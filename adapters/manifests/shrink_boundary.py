import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "process"))
import hullbench_worker

import numpy
from delaunay_shapes import VERSION, Triangles


def boundary(points, shrink_factor):
    """The triangles and which of them are within the boundary."""
    triangles = Triangles(points)
    radii = triangles.one_polygon_radii()
    if len(radii) == 0:
        return triangles, triangles.circumradii > 0
    return triangles, triangles.circumradii <= radii[int((1 - shrink_factor) * (len(radii) - 1))]


def ring(shape):
    triangles, kept = shape
    # One polygon, but where Qhull's triangles overlap by rounding; then the largest is the boundary's.
    polygons = sorted(triangles.polygons(kept), key=lambda polygon: polygon.area)
    return [[numpy.asarray(polygon.exterior.coords)] for polygon in polygons[-1:]]


hullbench_worker.serve(version=VERSION, run=boundary, extract=ring)
