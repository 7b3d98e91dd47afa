"""The result of concave_hull."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    import shapely.geometry


class MultiPolygon:
    """Polygons whose interiors are disjoint, each valid in the sense of OGC 06-103r4. Shells run counter-clockwise,
    holes clockwise. Whatever reads __geo_interface__ takes it; a notebook draws it.

    polygons: a list of polygons; each a list of rings, the shell first, then its holes; each ring a float64 array of
        the shape (k, 2), k >= 3, the first vertex *not* repeated. A copy: the points may change afterwards.
    indices: the same with uint32 arrays of the shape (k,): the rows of the points that the vertices are.
    area: shells minus holes, in the squared unit of the points.
    sizes: where the limit was chosen, the least, the median and the largest size that a triangle may have, place by
        place, in the unit of the points; the size of an equilateral triangle is its edge. None where a limit was given,
        where there is no triangle, and of concave_hulls.

        >>> from polylidar_core import concave_hull
        >>> square = concave_hull([(0, 0), (2, 0), (2, 2), (0, 2)])
        >>> square.polygons[0][0].tolist(), square.indices[0][0].tolist()
        ([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]], [0, 1, 2, 3])
    """

    __slots__ = ("polygons", "indices", "area", "sizes")

    polygons: list[list[npt.NDArray[np.float64]]]
    indices: list[list[npt.NDArray[np.uint32]]]
    area: float
    sizes: tuple[float, float, float] | None

    def __init__(
        self,
        points: npt.NDArray[np.float64],
        vertices: npt.NDArray[np.uint32],
        ring_ends: npt.NDArray[np.uint32],
        polygon_ends: npt.NDArray[np.uint32],
        area: float,
        sizes: tuple[float, float, float] | None = None,
    ) -> None:
        """Of the core's flat arrays: ring r is vertices[ring_ends[r - 1]:ring_ends[r]], and polygons likewise of rings."""
        self.indices = _parts(_parts(vertices, ring_ends), polygon_ends)
        self.polygons = _parts(_parts(points[vertices], ring_ends), polygon_ends)
        self.area = area
        self.sizes = sizes

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """The shape as GeoJSON has it, in lists and floats: json.dumps writes it. Rings are closed."""
        coordinates = [[np.concatenate([ring, ring[:1]]).tolist() for ring in polygon] for polygon in self.polygons]
        return {"type": "MultiPolygon", "coordinates": coordinates}

    def to_shapely(self) -> shapely.geometry.MultiPolygon:
        """The shape as Shapely has it, 1.8 or 2; always a MultiPolygon, also of one polygon or none. ImportError without
        Shapely.

            >>> from polylidar_core import concave_hull
            >>> concave_hull([(0, 0), (2, 0), (2, 2), (0, 2)]).to_shapely().wkt
            'MULTIPOLYGON (((0 0, 2 0, 2 2, 0 2, 0 0)))'
        """
        from shapely import wkt
        from shapely.geometry import MultiPolygon as ShapelyMultiPolygon

        if not self.polygons:
            # MultiPolygon() of Shapely 1.8 is a GeometryCollection.
            return wkt.loads("MULTIPOLYGON EMPTY")
        return ShapelyMultiPolygon([(polygon[0], polygon[1:]) for polygon in self.polygons])

    def _repr_svg_(self) -> str:
        """The shape as a picture, which notebooks show."""
        rings = [ring for polygon in self.polygons for ring in polygon]
        vertices = np.concatenate(rings) if rings else np.zeros((1, 2))
        low, size = vertices.min(axis=0), float(np.ptp(vertices, axis=0).max()) or 1.0
        width, height = np.ptp(vertices, axis=0) * (400 / size) + 2
        path = ""
        for ring in rings:
            # Down is up in a picture.
            places = (ring - low) * (400 / size) * (1, -1) + (1, height - 1)
            path += "M" + " ".join(f"{x:.1f},{y:.1f}" for x, y in places) + "Z"
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}">'
            f'<path d="{path}" fill="#9cc3e6" fill-rule="evenodd" stroke="#1f5a93"/></svg>'
        )

    def __len__(self) -> int:
        """How many polygons there are."""
        return len(self.polygons)

    def __repr__(self) -> str:
        rings = [ring for polygon in self.polygons for ring in polygon]
        vertices = sum(len(ring) for ring in rings)
        return (
            f"<MultiPolygon: polygons {len(self)}, holes {len(rings) - len(self)}, vertices {vertices}, "
            f"area {self.area:.6g}>"
        )


def _parts(sequence: Any, ends: npt.NDArray[np.uint32]) -> list[Any]:
    limits = [0, *ends.tolist()]
    return [sequence[begin:end] for begin, end in zip(limits, limits[1:])]
