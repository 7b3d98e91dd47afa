"""The Python module polylidar_core, beside numpy, shapely and the harness's own worker.

Run by ctest with the module in PYTHONPATH; HULLBENCH names the harness, without which the comparison with it is skipped.
"""
import ast
import datetime
import doctest
import gc
import importlib
import inspect
import json
import math
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import threading
import time
import tracemalloc
import typing
import unittest
import warnings
import xml.etree.ElementTree
from fractions import Fraction

import numpy as np
import polylidar_core
import shapely.geometry
import shapely.wkb
from polylidar_core import _core, concave_hull, concave_hulls, delaunay

try:
    import geopandas
    import polylidar_core.geopandas
except ImportError:
    geopandas = None

CELL = 0.75  # keeps the halves of a unit lattice's cells (circumradius 0.71), the next triangle has 1


def lattice_with_a_hole():
    """11 x 11 points without the middle 3 x 3."""
    return [(x, y) for y in range(11) for x in range(11) if not (4 <= x <= 6 and 4 <= y <= 6)]


def scattered(count, seed=1):
    return np.random.default_rng(seed).random((count, 2))


def as_objects(items):
    """An array of one dimension, also of what numpy takes for rows."""
    array = np.empty(len(items), object)
    array[:] = items
    return array


def signed_area(ring):
    x, y = ring.T
    return (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2


class Shapes(unittest.TestCase):
    def test_lattice_with_a_hole(self):
        shape = concave_hull(lattice_with_a_hole(), alpha=CELL)
        self.assertEqual(len(shape), 1)
        self.assertEqual([len(ring) for ring in shape.polygons[0]], [40, 12])
        self.assertEqual(shape.area, 86.0)
        self.assertEqual(repr(shape), "<MultiPolygon: polygons 1, holes 1, vertices 52, area 86>")

    def test_shapely_takes_it_as_valid_and_of_the_same_area(self):
        for seed in range(20):
            shape = concave_hull(scattered(2000, seed), alpha=0.02)
            with self.subTest(seed=seed):
                taken = shapely.geometry.shape(shape)
                self.assertGreater(len(shape), 1)
                self.assertEqual(taken.geom_type, "MultiPolygon")
                self.assertTrue(taken.is_valid)
                # Thousands of terms, each rounded to within 1e-16 of the unit square.
                self.assertAlmostEqual(taken.area, shape.area, delta=1e-12)

    def test_to_shapely_is_what_the_geo_interface_says(self):
        for points in (scattered(2000), [], lattice_with_a_hole()):
            shape = concave_hull(points, alpha=0.02 if len(points) > 1000 else CELL)
            taken = shape.to_shapely()
            self.assertEqual(taken.geom_type, "MultiPolygon")
            self.assertTrue(taken.is_valid)
            self.assertTrue(taken.equals_exact(shapely.geometry.shape(shape), 0) or len(shape) == 0)
            self.assertEqual(sum(len(polygon.interiors) for polygon in taken.geoms), sum(len(p) - 1 for p in shape.polygons))

    def test_a_notebook_draws_it(self):
        namespace = "{http://www.w3.org/2000/svg}"
        picture = xml.etree.ElementTree.fromstring(concave_hull([(0, 0), (4, 0), (4, 2), (0, 2)])._repr_svg_())
        self.assertEqual((picture.get("width"), picture.get("height")), ("402", "202"))
        self.assertEqual(picture.find(namespace + "path").get("d"), "M1.0,201.0 401.0,201.0 401.0,1.0 1.0,1.0Z")
        holed = xml.etree.ElementTree.fromstring(concave_hull(lattice_with_a_hole(), alpha=CELL)._repr_svg_())
        self.assertEqual(holed.find(namespace + "path").get("d").count("Z"), 2)
        self.assertEqual(xml.etree.ElementTree.fromstring(concave_hull([])._repr_svg_())[0].get("d"), "")

    def test_rings_are_open_and_oriented_and_closed_in_geojson(self):
        shape = concave_hull(scattered(2000), alpha=0.02)
        self.assertTrue(any(len(polygon) > 1 for polygon in shape.polygons))
        interface = json.loads(json.dumps(shape.__geo_interface__))
        self.assertEqual(interface["type"], "MultiPolygon")
        for polygon, written in zip(shape.polygons, interface["coordinates"], strict=True):
            self.assertGreater(signed_area(polygon[0]), 0)
            for hole in polygon[1:]:
                self.assertLess(signed_area(hole), 0)
            for ring, closed in zip(polygon, written, strict=True):
                self.assertNotEqual(ring[0].tolist(), ring[-1].tolist())
                self.assertEqual(closed, [*ring.tolist(), ring[0].tolist()])

    def test_indices_are_rows_of_the_points(self):
        points = scattered(2000)
        shape = concave_hull(points, alpha=0.02)
        for polygon, indices in zip(shape.polygons, shape.indices, strict=True):
            for ring, rows in zip(polygon, indices, strict=True):
                self.assertEqual(rows.dtype, np.uint32)
                np.testing.assert_array_equal(points[rows], ring)

    def test_the_limits_keep_the_triangles_that_they_say(self):
        points = scattered(2000)
        corners = points[delaunay(points)]
        edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
        areas = np.array([signed_area(triangle) for triangle in corners])
        radii = edges.prod(axis=1) / (4 * areas)
        longest = edges.max(axis=1)
        kept = []
        perimeters = edges.sum(axis=1)
        cases = ((np.inf, None, None), (0.03, None, None), (None, 0.04, None), (None, None, 0.1), (0.03, 0.04, 0.09))
        for alpha, length, perimeter in (*cases, (0.0, None, None)):
            with self.subTest(alpha=alpha, length=length, perimeter=perimeter):
                inside = (
                    (radii <= (np.inf if alpha is None else alpha))
                    & (longest <= (length or np.inf))
                    & (perimeters <= (perimeter or np.inf))
                )
                kept.append(inside.sum())
                shape = concave_hull(points, alpha=alpha, max_edge_length=length, max_perimeter=perimeter)
                # Two thousand terms of at most 1, each rounded to 1e-16.
                self.assertAlmostEqual(shape.area, areas[inside].sum(), delta=1e-12)
        self.assertEqual(len(set(kept)), 6)

    def test_with_no_limits_it_is_the_convex_hull(self):
        points = scattered(500)
        hull = shapely.geometry.MultiPoint(points).convex_hull
        self.assertTrue(shapely.geometry.shape(concave_hull(points, alpha=np.inf)).equals(hull))

    def test_without_limits_it_chooses_one_and_tells_it(self):
        points = scattered(500)
        shape = concave_hull(points)
        least, median, most = shape.sizes
        self.assertTrue(0 < least <= median <= most < 1)
        self.assertIsNone(concave_hull(points, alpha=0.1).sizes)
        finer = concave_hull(points, detail=2)
        np.testing.assert_allclose(finer.sizes, np.array(shape.sizes) / 2, rtol=1e-12)
        self.assertLess(finer.area, shape.area)

    def test_it_covers_all_points_and_joins_all_parts_on_demand(self):
        points = np.concatenate([scattered(300, 1), scattered(300, 2) + [1.5, 0], [[0.5, 3]]])
        everyone = shapely.geometry.MultiPoint(points)
        for limit in ({}, {"alpha": 0.1}):
            with self.subTest(limit=limit):
                plain = concave_hull(points, **limit)
                self.assertEqual(len(plain), 2)
                covering = concave_hull(points, cover=True, **limit)
                self.assertTrue(covering.to_shapely().buffer(1e-9).covers(everyone))
                one = concave_hull(points, one=True, **limit)
                self.assertEqual(len(one), 1)
                self.assertTrue(plain.area < one.area < covering.area)
                self.assertEqual(one.sizes is None, bool(limit))
                labels = np.repeat([2, 1], [600, 1])
                self.assertEqual(
                    {label: len(hull) for label, hull in concave_hulls(points, labels, one=True).items()}, {1: 0, 2: 1}
                )
        self.assertEqual(len(concave_hull([(0, 0), (1, 1), (2, 2)], cover=True, one=True)), 0)
        with self.assertRaisesRegex(ValueError, "alpha must be zero or more"):
            concave_hull(points, alpha=-1, cover=True)

    def test_a_hull_for_every_label(self):
        points = np.concatenate([scattered(500, 1), scattered(400, 2) + [3, 0], [[9, 9]]])
        labels = np.repeat([7, -2, 5], [500, 400, 1])
        order = np.random.default_rng(3).permutation(len(points))
        hulls = concave_hulls(points[order], labels[order], threads=2)
        self.assertEqual(list(hulls), [-2, 5, 7])
        self.assertEqual(len(hulls[5]), 0)
        for label in (-2, 7):
            own = concave_hull(points[order][labels[order] == label])
            self.assertEqual(hulls[label].__geo_interface__, own.__geo_interface__)
            for polygon, rows in zip(hulls[label].polygons, hulls[label].indices, strict=True):
                np.testing.assert_array_equal(points[order][rows[0]], polygon[0])
        self.assertEqual(concave_hulls([], []), {})

    def test_labels_of_any_type_give_the_hulls_of_integers(self):
        points = np.concatenate([scattered(50, 1), scattered(40, 2) + [3, 0], scattered(30, 3) + [6, 0]])
        numbers = np.random.default_rng(4).permutation(np.repeat([0, 1, 2], [50, 40, 30]))
        expected = [hull.__geo_interface__ for hull in concave_hulls(points, numbers).values()]
        day = datetime.date(2024, 2, 28)
        for name, labels, key in (
            ("text", np.array(["ash", "beech", "oak"]), str),
            ("bytes", np.array([b"ash", b"beech", b"oak"]), bytes),
            ("objects", np.array(["ash", "beech", "oak"], object), str),
            ("floats", np.array([-np.inf, 0.5, 2]), float),
            ("float32", np.array([-1, 0.5, 2], np.float32), float),
            ("booleans", np.array([False, True, True]), bool),
            ("bytes as numbers", np.array([3, 4, 255], np.uint8), int),
            ("big-endian", np.array([-3, 4, 255], ">i4"), int),
            ("unsigned", np.array([3, 2**63, 2**64 - 1], np.uint64), int),
            ("large integers", np.array([-(2**70), 0, 2**70], object), int),
            ("dates", np.array([day, day.replace(day=29), day.replace(month=3)], object), datetime.date),
            ("numpy's dates", np.array(["2024-02-28", "2024-02-29", "2024-03-01"], "M8[ns]"), np.datetime64),
            ("pairs", as_objects([("ash", 2), ("oak", 1), ("oak", 2)]), tuple),
        ):
            for given in (labels[numbers], labels[numbers][::-1].copy()[::-1]):
                with self.subTest(name):
                    hulls = concave_hulls(points, given)
                    self.assertEqual(list(hulls), list(dict.fromkeys(labels.tolist() if key != np.datetime64 else labels)))
                    self.assertEqual({type(label) for label in hulls}, {key})
                    if key != bool:
                        self.assertEqual([hull.__geo_interface__ for hull in hulls.values()], expected)
        words = ["ash", "oak", "beech"]
        self.assertEqual(list(concave_hulls(points, [words[number] for number in numbers])), sorted(words))

    def test_labels_that_cannot_be_told_apart_or_sorted(self):
        points = scattered(4)
        for message, labels in (
            ("there must be one label a point: there are 3 labels and 4 points", [1, 2, 3]),
            ("there must be one label a point: there are 0 labels and 4 points", []),
            (r"labels must have the shape \(n,\), not \(2, 2\)", [["a", "b"], ["c", "d"]]),
            (r"not \(\)", "oak"),
            (r"label 2 is missing \(nan\): leave out", [1, 2, np.nan, 3]),
            (r"label 1 is missing \(nan\)", np.array(["a", np.nan, "a", "b"], object)),
            (r"label 3 is missing \(None\)", ["a", "a", "b", None]),
            ("labels are masked", np.ma.masked_equal([1, 2, 2, 9], 9)),
            (r"label 0 is missing \(NaT\)", np.array(["NaT", "2024-02-28", "NaT", "NaT"], "M8[D]")),
            ("of the types int and str cannot be sorted", ["1", 1, "1", "2"]),
            ("of the types int and str cannot be sorted", np.array(["1", 1, "1", "2"], object)),
            ("labels must be hashable", as_objects([[1], [2], [1], [2]])),
        ):
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                concave_hulls(points, labels)

    def test_degenerate_inputs_are_empty(self):
        line = [(i, 2 * i) for i in range(10)]
        for points in ([], np.empty((0, 2)), [(0, 0)], [(0, 0), (1, 1)], [(1, 1)] * 5, line):
            with self.subTest(points=points):
                shape = concave_hull(points)
                self.assertEqual((len(shape), shape.area, shape.polygons, shape.indices), (0, 0.0, [], []))
                self.assertEqual(shape.__geo_interface__, {"type": "MultiPolygon", "coordinates": []})
                self.assertTrue(shapely.geometry.shape(shape).is_empty)
                self.assertEqual(delaunay(points).shape, (0, 3))

    def test_result_is_a_copy_and_can_be_pickled(self):
        points = scattered(500)
        shape = concave_hull(points, alpha=0.05)
        before = shape.__geo_interface__
        points[:] = 0
        self.assertEqual(shape.__geo_interface__, before)
        self.assertEqual(pickle.loads(pickle.dumps(shape)).__geo_interface__, before)

    def test_threads_do_not_change_the_result(self):
        points = scattered(50_000)
        expected = concave_hull(points, alpha=0.005).__geo_interface__
        for threads in (2, 3, np.int64(2), None):
            with self.subTest(threads=threads):
                self.assertEqual(concave_hull(points, alpha=0.005, threads=threads).__geo_interface__, expected)

    def test_delaunay_covers_the_convex_hull_counter_clockwise(self):
        points = scattered(1000)
        triangles = delaunay(points)
        self.assertEqual((triangles.dtype, triangles.shape[1]), (np.uint32, 3))
        areas = [signed_area(corners) for corners in points[triangles]]
        self.assertGreater(min(areas), 0)
        # A thousand terms of at most 1, each rounded to 1e-16.
        self.assertAlmostEqual(sum(areas), shapely.geometry.MultiPoint(points).convex_hull.area, delta=1e-12)
        self.assertEqual(len(np.unique(triangles)), len(points))


@unittest.skipUnless("HULLBENCH" in os.environ, "HULLBENCH does not name the harness")
class BesideTheHarness(unittest.TestCase):
    def test_the_worker_gives_the_same_polygons(self):
        points = scattered(5000)
        with tempfile.TemporaryDirectory() as folder:
            points.tofile(f"{folder}/points")
            requests = [
                {"request": "hello", "protocol": 1},
                {"request": "load", "points": f"{folder}/points", "n": len(points)},
                {"request": "run", "nonce": "n", "parameters": {"alpha": 0.015}, "result": f"{folder}/wkb"},
                {"request": "quit"},
            ]
            worker = subprocess.run(
                [os.environ["HULLBENCH"], "worker", "--method", "polylidar"],
                input="".join(json.dumps(request) + "\n" for request in requests),
                stdout=subprocess.PIPE,
                text=True,
                check=True,
            )
            theirs = shapely.wkb.loads(pathlib.Path(folder, "wkb").read_bytes())
        self.assertEqual(json.loads(worker.stdout.splitlines()[0])["method"]["version"], polylidar_core.__version__)
        ours = shapely.geometry.shape(concave_hull(points, alpha=0.015))
        self.assertGreater(len(ours.geoms), 1)
        self.assertTrue(ours.equals_exact(theirs, 0))


class Inputs(unittest.TestCase):
    def test_whatever_is_converted_gives_the_same(self):
        exact = np.array(lattice_with_a_hole(), dtype=np.float64)
        shifted = np.empty(exact.nbytes + 1, np.uint8)[1:].view(np.float64).reshape(exact.shape)
        shifted[:] = exact
        self.assertFalse(shifted.flags.aligned)
        wide = np.zeros((len(exact), 5))
        wide[:, 1:4:2] = exact
        expected = concave_hull(exact, alpha=CELL).__geo_interface__
        for name, points in {
            "list": exact.tolist(),
            "int64": exact.astype(np.int64),
            "uint8": exact.astype(np.uint8),
            "float32": exact.astype(np.float32),
            "big-endian": exact.astype(">f8"),
            "by columns": np.asfortranarray(exact),
            "a view": wide[:, 1:4:2],
            "not aligned": shifted,
            "backwards twice": exact[::-1].copy()[::-1],
        }.items():
            with self.subTest(name):
                self.assertEqual(concave_hull(points, alpha=CELL).__geo_interface__, expected)
                np.testing.assert_array_equal(delaunay(points), delaunay(exact))

    def refused(self, message, *arguments, **options):
        with self.assertRaisesRegex(ValueError, message):
            concave_hull(*arguments, **options)

    def test_other_shapes_and_types(self):
        self.refused(r"must have the shape \(n, 2\), not \(4, 3\)", np.zeros((4, 3)))
        self.refused(r"not \(4,\)", np.zeros(4))
        self.refused(r"not \(0, 3\)", np.empty((0, 3)))
        self.refused(r"not \(\)", 1.0)
        self.refused(r"not \(1, 2, 2\)", [[(0, 0), (1, 1)]])
        self.refused("some rows differ in length", [(0, 0), (1, 1, 1)])
        masked = np.ma.masked_equal([[0.0, 0.0], [4.0, 0.0], [9.0, 3.0]], 9)
        self.refused("points are masked", masked)
        self.refused("points are masked", list(masked))
        self.refused("real numbers, not of the type complex128", np.zeros((4, 2), complex))
        self.refused("real numbers", [("a", "b")])
        with self.assertRaisesRegex(ValueError, "shape"):
            delaunay(np.zeros((4, 3)))

    def test_coordinates(self):
        points = scattered(1000)
        points[357, 1] = np.nan
        self.refused("point 357 is not finite", points)
        points[12, 0] = np.inf
        self.refused("point 12 is not finite", points, threads=2)
        with self.assertRaisesRegex(ValueError, "point 12 is not finite"):
            delaunay(points)
        self.refused(r"more than a factor of 2\^265", [(0, 1e-100), (1e100, 0), (1, 1)])

    def test_a_multipoint_is_its_points(self):
        points = scattered(500)
        expected = concave_hull(points).__geo_interface__
        self.assertEqual(concave_hull(shapely.geometry.MultiPoint(points)).__geo_interface__, expected)
        high = shapely.geometry.MultiPoint(np.column_stack([points, points[:, 0]]))
        self.assertEqual(concave_hull(high).__geo_interface__, expected)
        np.testing.assert_array_equal(delaunay(shapely.geometry.MultiPoint(points)), delaunay(points))
        self.refused("a MultiPoint, not a Polygon", shapely.geometry.box(0, 0, 1, 1))

    def test_type_hints_can_be_read(self):
        for function in (concave_hull, concave_hulls, delaunay):
            self.assertIn("points", typing.get_type_hints(function))

    def test_options(self):
        points = scattered(10)
        self.refused("alpha must be zero or more", points, alpha=-1)
        self.refused("alpha must be zero or more", points, alpha=float("nan"))
        self.refused("max_edge_length must be zero or more", points, max_edge_length=-1)
        for threads in (0, -1):
            self.refused("threads must be one or more", points, threads=threads)
        self.refused("alpha is too large for a float", points, alpha=10**400)
        self.assertEqual(concave_hull(points, threads=2**70).__geo_interface__, concave_hull(points).__geo_interface__)

    def test_options_of_another_type_are_named_in_one_sentence(self):
        points = scattered(10)
        for option, value, words in (
            ("alpha", "1", "a number, not of the type str"),
            ("alpha", [1], "a number, not of the type list"),
            ("max_edge_length", 1j, "a number, not of the type complex"),
            ("max_perimeter", np.ones(2), "a number, not of the type ndarray"),
            ("detail", "a", "a number, not of the type str"),
            ("detail", None, "a number, not of the type NoneType"),
            ("fill_single_triangles", "yes", "True or False, not of the type str"),
            ("cover", [1], "True or False, not of the type list"),
            ("one", "no", "True or False, not of the type str"),
            ("one", np.array([True, False]), "True or False, not of the type ndarray"),
            ("threads", 1.5, "a whole number, not of the type float"),
        ):
            with self.subTest(option=option, value=value):
                sentence = f"^{option} must be {words}$"
                with self.assertRaisesRegex(TypeError, sentence):
                    concave_hull(points, **{option: value})
                with self.assertRaisesRegex(TypeError, sentence):
                    concave_hulls(points, np.zeros(10, int), **{option: value})

    def test_numbers_and_flags_of_other_libraries_are_taken(self):
        points = scattered(100)
        expected = concave_hull(points, alpha=0.25, cover=True)
        for alpha, cover in ((np.float32(0.25), np.True_), (Fraction(1, 4), 1), (np.array(0.25), True)):
            self.assertEqual(concave_hull(points, alpha=alpha, cover=cover).area, expected.area)

    def test_only_the_points_go_without_their_name(self):
        kinds = {name: parameter.kind for name, parameter in inspect.signature(concave_hull).parameters.items()}
        self.assertEqual(kinds.pop("points"), inspect.Parameter.POSITIONAL_OR_KEYWORD)
        self.assertEqual(set(kinds.values()), {inspect.Parameter.KEYWORD_ONLY})
        with self.assertRaises(TypeError):
            concave_hull(scattered(10), 1)

    def test_the_extension_itself_takes_nothing_that_it_would_have_to_convert(self):
        exact = np.array(lattice_with_a_hole(), dtype=np.float64)
        for points in (exact.astype(np.float32), np.asfortranarray(exact), exact.tolist()):
            with self.assertRaises(TypeError):
                _core.delaunay(points)
        with self.assertRaises(ValueError):
            _core.delaunay(np.zeros((4, 3)))


@unittest.skipUnless(geopandas, "GeoPandas is missing")
class GeoPandas(unittest.TestCase):
    def frame(self, crs="EPSG:32633"):
        """500 points in a unit square and 400 in another, every third of both without a label."""
        points = np.concatenate([scattered(500, 1), scattered(400, 2) + [3, 0]])
        kinds = np.repeat(np.array(["oak", "beech"], object), [500, 400])
        kinds[::3] = None
        order = np.random.default_rng(3).permutation(len(points))
        geometry = geopandas.points_from_xy(*points[order].T)
        # Rows are not numbered from 0.
        return geopandas.GeoDataFrame({"kind": kinds[order]}, geometry=geometry, crs=crs, index=order + 7)

    def test_a_row_for_every_group(self):
        frame = self.frame()
        hulls = polylidar_core.geopandas.concave_hulls(frame, by="kind", threads=2)
        self.assertEqual((hulls.index.tolist(), hulls.index.name), (["beech", "oak"], "kind"))
        self.assertEqual(hulls.columns.tolist(), ["points", "area", "parts", "geometry"])
        self.assertEqual(hulls.crs, frame.crs)
        for kind, row in hulls.iterrows():
            own = frame[frame["kind"] == kind]
            shape = concave_hull(np.column_stack([own.geometry.x, own.geometry.y]))
            self.assertEqual((row["points"], row["area"], row["parts"]), (len(own), shape.area, len(shape)))
            self.assertTrue(row.geometry.equals_exact(shape.to_shapely(), 0))
        finer = polylidar_core.geopandas.concave_hulls(frame, by="kind", detail=2)
        self.assertLess(finer["area"].sum(), hulls["area"].sum())

    def test_groups_are_those_of_pandas(self):
        frame = self.frame()
        frame["side"] = frame.geometry.x % 1 > 0.5
        by = ["side", "kind"]
        hulls = polylidar_core.geopandas.concave_hulls(frame, by=by)
        self.assertEqual(hulls["points"].to_dict(), frame.groupby(by).size().to_dict())
        of_series = polylidar_core.geopandas.concave_hulls(frame.geometry, by=frame["kind"].to_numpy())
        self.assertEqual(of_series["area"].tolist(), polylidar_core.geopandas.concave_hulls(frame, by="kind")["area"].tolist())
        kinds = frame["kind"].astype("category").cat.add_categories("elm")
        self.assertEqual(polylidar_core.geopandas.concave_hulls(frame, by=kinds).index.tolist(), ["beech", "oak"])

    def test_without_groups_there_is_one_row_and_without_points_none(self):
        frame = self.frame()
        whole = polylidar_core.geopandas.concave_hulls(frame)
        self.assertEqual((len(whole), whole["points"].iloc[0]), (1, 900))
        self.assertTrue(whole.geometry.iloc[0].equals_exact(concave_hull(frame).to_shapely(), 0))
        self.assertEqual(concave_hull(frame.geometry).area, whole["area"].iloc[0])
        self.assertEqual(len(polylidar_core.geopandas.concave_hulls(frame[:0], by="kind")), 0)
        flat = polylidar_core.geopandas.concave_hulls(frame[:2])
        self.assertTrue(flat.geometry.iloc[0].is_empty)
        self.assertEqual((flat["area"].iloc[0], flat["parts"].iloc[0]), (0, 0))

    def test_degrees_are_noticed(self):
        with self.assertWarnsRegex(UserWarning, "in degrees.*estimate_utm_crs") as said:
            concave_hull(self.frame("EPSG:4326"))
        self.assertEqual(said.filename, __file__)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            concave_hull(self.frame())
            concave_hull(self.frame(None))

    def test_what_is_no_point_is_named(self):
        points = geopandas.points_from_xy([0, 1, 2], [0, 1, 0])
        for message, other in (
            ("point 3 is missing", None),
            ("point 3 is missing or empty", shapely.geometry.Point()),
            ("row 3 is a MultiPoint", shapely.geometry.MultiPoint([(1, 1), (2, 2)])),
        ):
            with self.assertRaisesRegex(ValueError, message):
                concave_hull(geopandas.GeoSeries([*points, other]))

    def test_a_point_that_is_not_finite_is_named_by_its_row_though_others_have_no_label(self):
        points = geopandas.points_from_xy([0, 0, math.inf, 1], [0, 1, 0, 1])
        with self.assertRaisesRegex(ValueError, "^point 2 is not finite$"):
            polylidar_core.geopandas.concave_hulls(geopandas.GeoSeries(points), by=[None, "a", "a", "a"])


class Memory(unittest.TestCase):
    def python_peak(self, points):
        """Bytes that numpy and Python held at most during a call; the core's own memory is not in it."""
        gc.collect()
        tracemalloc.start()
        try:
            concave_hull(points)
            return tracemalloc.get_traced_memory()[1]
        finally:
            tracemalloc.stop()

    def test_only_what_must_be_converted_is_copied_and_only_once(self):
        points = scattered(200_000)
        frozen = points.copy()
        frozen.flags.writeable = False
        for array in (points, frozen):
            self.assertLess(self.python_peak(array), points.nbytes / 20)
        for array in (points.astype(np.float32), np.asfortranarray(points)):
            self.assertGreaterEqual(self.python_peak(array), points.nbytes)
            self.assertLess(self.python_peak(array), 1.05 * points.nbytes)

    def test_a_file_larger_than_memory_may_be_is_taken_where_it_is(self):
        # One point more than the core takes, which it says before it reads any: 4 GiB that do not exist, in a process
        # that gets no more than half a gigabyte. Any copy on the way would need them.
        program = """
import resource, sys
import numpy as np, polylidar_core
points = np.memmap(sys.argv[1], np.float64, "r", shape=(2**28 + 1, 2))
used = next(int(line.split()[1]) * 1024 for line in open("/proc/self/status") if line.startswith("VmData"))
resource.setrlimit(resource.RLIMIT_DATA, (used + 2**29, used + 2**29))
for call in (polylidar_core.concave_hull, polylidar_core.delaunay):
    try:
        call(points)
    except ValueError as error:
        print(error)
"""
        with tempfile.NamedTemporaryFile() as file:
            file.truncate(16 * (2**28 + 1))
            result = subprocess.run([sys.executable, "-c", program, file.name], capture_output=True, text=True)
        self.assertEqual(result.stdout, 2 * "more than 2^28 points: split the input\n", result.stderr)

    def test_results_are_freed(self):
        points = scattered(100_000)

        def resident():
            gc.collect()
            with open("/proc/self/statm", encoding="ascii") as file:
                return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE")

        for _ in range(3):
            delaunay(points)
        before = resident()
        for _ in range(30):
            delaunay(points)
        # 30 results of 2.4 MB each would be 72 MB.
        self.assertLess(resident() - before, 36e6)


class Threads(unittest.TestCase):
    def test_other_threads_run_meanwhile(self):
        points = scattered(2_000_000)
        labels = np.arange(len(points)) % 3
        for call in (lambda: concave_hull(points), lambda: concave_hulls(points, labels), lambda: delaunay(points)):
            turns, seen, done = 0, [], threading.Event()

            def compute():
                seen.append(turns)
                call()
                seen.append(turns)
                done.set()

            # Nobody is asked to give way, so only who lets go of the interpreter is interrupted.
            interval = sys.getswitchinterval()
            sys.setswitchinterval(60)
            try:
                thread = threading.Thread(target=compute)
                thread.start()
                while not done.is_set():
                    turns += 1
                    time.sleep(0.0005)
                thread.join()
            finally:
                sys.setswitchinterval(interval)
            # numpy may let go for a moment too when the result is put together, but not this often.
            self.assertGreater(seen[1] - seen[0], 10)

    def test_calls_at_the_same_time(self):
        sets = [scattered(20_000, seed) for seed in range(4)]
        expected = [concave_hull(points, alpha=0.01).__geo_interface__ for points in sets]
        results = [None] * len(sets)

        def compute(i):
            results[i] = concave_hull(sets[i], alpha=0.01, threads=2).__geo_interface__

        threads = [threading.Thread(target=compute, args=(i,)) for i in range(len(sets))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(results, expected)


class Documentation(unittest.TestCase):
    def test_the_examples_in_the_docstrings_are_right(self):
        names = ["polylidar_core", "polylidar_core.multi_polygon"] + ["polylidar_core.geopandas"] * (geopandas is not None)
        for name in names:
            with self.subTest(name):
                failed, tried = doctest.testmod(importlib.import_module(name))
                self.assertEqual(failed, 0)
                self.assertGreater(tried, 3)

    def test_every_function_has_an_example(self):
        for item in (polylidar_core, concave_hull, concave_hulls, delaunay, polylidar_core.MultiPolygon):
            self.assertIn(">>> ", item.__doc__)


class Names(unittest.TestCase):
    def test_only_what_is_to_be_used_is_listed(self):
        modules = [polylidar_core] + [polylidar_core.geopandas] * (geopandas is not None)
        for module in modules:
            self.assertEqual(dir(module), sorted(module.__all__))


class Types(unittest.TestCase):
    folder = pathlib.Path(polylidar_core.__file__).parent

    def test_the_stub_names_what_the_extension_has(self):
        self.assertTrue((self.folder / "py.typed").exists())
        stub = ast.parse((self.folder / "_core.pyi").read_text())
        functions = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
        variables = {node.target.id for node in stub.body if isinstance(node, ast.AnnAssign)}
        public = {name for name in vars(_core) if not name.startswith("_")} | {"__version__"}
        self.assertEqual(set(functions) | variables, public)
        for name, node in functions.items():
            parameters = [parameter.arg for parameter in node.args.args]
            signature = getattr(_core, name).__doc__.splitlines()[0]
            self.assertEqual(
                parameters,
                [part.split(":")[0].strip() for part in signature[len(name) + 1 :].split(", ") if ":" in part.split("[")[0]],
            )

    def test_everything_public_is_typed_and_documented(self):
        public = [getattr(polylidar_core, name) for name in polylidar_core.__all__ if name != "__version__"]
        members = [
            member.fget if isinstance(member, property) else member
            for name, member in vars(polylidar_core.MultiPolygon).items()
            if inspect.isfunction(member) or isinstance(member, property)
        ]
        self.assertEqual(len(public), 4)
        self.assertGreaterEqual(len(members), 4)
        for item in public + members:
            with self.subTest(item):
                if inspect.isclass(item):
                    self.assertEqual(set(item.__annotations__), set(item.__slots__))
                else:
                    self.assertEqual(set(item.__annotations__), {*inspect.signature(item).parameters, "return"} - {"self"})
                if item.__name__ != "__repr__":
                    self.assertTrue(item.__doc__)


if __name__ == "__main__":
    unittest.main()
