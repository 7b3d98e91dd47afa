"""Shapes made of Delaunay triangles: SciPy (Qhull) makes the triangles, Shapely (GEOS) the polygons."""

import struct

import numpy
import scipy
import scipy.sparse
import scipy.sparse.csgraph
import scipy.spatial
import shapely
import shapely.geometry
import shapely.ops
import shapely.wkb

VERSION = f"scipy {scipy.__version__}, shapely {shapely.__version__}"


class Triangles:
    """The Delaunay triangles of points, (n, 2); none when the points span no area."""

    def __init__(self, points):
        self.points = points
        try:
            # Qhull loses digits far from the origin.
            delaunay = scipy.spatial.Delaunay(points - (points.min(axis=0) + points.max(axis=0)) / 2)
            self.corners = delaunay.simplices  # (m, 3) indices of points, counter-clockwise
            self.neighbours = delaunay.neighbors  # (m, 3) beyond the edge opposite to the corner; -1: none
        except (ValueError, scipy.spatial.QhullError):
            if _span_area(points):
                raise
            self.corners = self.neighbours = numpy.empty((0, 3), dtype=int)
        a, b, c = (points[self.corners[:, i]] for i in range(3))
        (ux, uy), (vx, vy) = (b - a).T, (c - a).T
        self.doubled_areas = numpy.abs(ux * vy - uy * vx)
        lengths = [numpy.hypot(*(p - q).T) for p, q in ((a, b), (b, c), (c, a))]
        # Of a triangle that is flat up to rounding the largest number there is: it comes after all others.
        self.circumradii = numpy.divide(
            numpy.prod(lengths, axis=0), 2 * self.doubled_areas, where=self.doubled_areas > 0,
            out=numpy.full(len(self.corners), numpy.finfo(float).max))

    def one_polygon_radii(self):
        """The circumradii, ascending, up to which the triangles are one polygon that has every corner.

        The last one takes all triangles: the convex hull. Triangles are connected over edges. Of those up to a radius
        there are as many regions as triangles less the edges of a minimum spanning tree, where neighbours are
        connected from the larger one's radius on.
        """
        radii = self.circumradii
        first, side = numpy.nonzero(self.neighbours > numpy.arange(len(radii))[:, None])  # each pair once
        second = self.neighbours[first, side]
        pairs = scipy.sparse.coo_matrix((numpy.maximum(radii[first], radii[second]), (first, second)),
                                        shape=(len(radii), len(radii)))
        joins = numpy.sort(scipy.sparse.csgraph.minimum_spanning_tree(pairs.tocsr()).data)
        reached = numpy.full(len(self.points), numpy.inf)  # of a point: the least radius of its triangles
        falling = numpy.argsort(-radii)
        reached[self.corners[falling]] = radii[falling, None]  # of an index that is there again the last value stays
        candidates = numpy.unique(radii)
        regions = (numpy.searchsorted(numpy.sort(radii), candidates, side="right")
                   - numpy.searchsorted(joins, candidates, side="right"))
        return candidates[(regions == 1) & (candidates >= reached[self.corners].max(initial=0))]

    def polygons(self, kept):
        """The triangles that the mask `kept` has, as Shapely polygons that touch one another in points only."""
        is_beyond_kept = numpy.where(self.neighbours >= 0, kept[self.neighbours], False)
        triangle, side = numpy.nonzero(kept[:, None] & ~is_beyond_kept)
        ends = [self.points[self.corners[triangle, (side + k) % 3]] for k in (1, 2)]
        edges = numpy.stack(ends, axis=1)  # of the boundary: (k, 2, 2), the triangle on the left
        known = set(map(tuple, edges.reshape(-1, 4).tolist()))
        faces = shapely.ops.polygonize([_lines(edges)])
        polygons = [face for face in faces if _first_edge(face) in known]  # the others are holes
        # This test is part of the method, as it chooses between the two ways to make polygons. It takes less than 0.3 %
        # of the time.
        area = self.doubled_areas[kept].sum() / 2
        if (abs(sum(polygon.area for polygon in polygons) - area) <= 1e-9 * area
                and shapely.geometry.MultiPolygon(polygons).is_valid):
            return polygons
        # Where points are on a line or a circle but for rounding, Qhull's triangles can overlap or leave gaps.
        union = shapely.ops.unary_union([shapely.geometry.Polygon(self.points[c]) for c in self.corners[kept]])
        return [part for part in getattr(union, "geoms", [union]) if part.area > 0]


def _lines(edges):
    """Edges, (k, 2, 2), as one MultiLineString: read from WKB, as Shapely 1.8 takes 10 us to make a LineString."""
    records = numpy.empty(len(edges), dtype=[("order", "u1"), ("type", "<u4"), ("points", "<u4"), ("ends", "<f8", 4)])
    records["order"], records["type"], records["points"] = 1, 2, 2
    records["ends"] = edges.reshape(-1, 4)
    return shapely.wkb.loads(struct.pack("<BII", 1, 5, len(edges)) + records.tobytes())


def _span_area(points):
    """Whether they are more than a line, beyond rounding."""
    if len(points) < 3:
        return False
    from_first = points - points[0]
    farthest = from_first[numpy.argmax(numpy.abs(from_first).sum(axis=1))]
    beside = numpy.abs(from_first[:, 0] * farthest[1] - from_first[:, 1] * farthest[0]).max()
    return bool(beside > 1e-12 * (farthest ** 2).sum())


def _first_edge(face):
    """(x, y, x, y) of an edge of its shell that has the face on the left."""
    a, b = face.exterior.coords[:2]
    return (*a, *b) if face.exterior.is_ccw else (*b, *a)
