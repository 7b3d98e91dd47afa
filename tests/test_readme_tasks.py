"""The tasks of the READMEs, done as by somebody who has only these pages: the marked blocks of code, as they stand there.

A mark is the line "<!-- tried: NAME -->" before a block. ctest runs each class by itself, as readme.NAME, where its
needs are there. The environment names what is built: POLYLIDAR (the program), PACKAGE (the npm package).
"""
import contextlib
import io
import json
import os
import pathlib
import random
import re
import struct
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
MARK = re.compile(r"^<!-- tried: (\w+) -->\n(?:```\w+\n([\s\S]*?)^```$|((?:    .*\n)+))", re.MULTILINE)
PAGES = ("README.md", "core/tool/README.md", "core/js/README.md")
BLOCKS = {
    name: fenced or indented
    for page in PAGES
    for name, fenced, indented in MARK.findall((ROOT / page).read_text(encoding="utf-8"))
}
# What each task's commands of the block "tool" have, and no other command.
WORD_OF_TASK = {"hull": "points.csv", "footprint": "tiles/", "groups": "species"}


def commands(name):
    """The commands of a block but for those of make, which have built what is tried here."""
    lines = [line.strip() for line in BLOCKS[name].splitlines()]
    return [line for line in lines if not line.startswith("make ")]


def commands_of_task(task):
    return [line for line in commands("tool") if WORD_OF_TASK[task] in line]


def signed_area(ring):
    return sum(x * v - u * y for (x, y), (u, v) in zip(ring, ring[1:])) / 2


def is_inside(point, ring):
    """Whether a point is inside a closed ring or on it."""
    x, y = point
    inside = False
    for (a, b), (c, d) in zip(ring, ring[1:]):
        is_between = (x - a) * (x - c) <= 0 and (y - b) * (y - d) <= 0
        if is_between and abs((c - a) * (y - b) - (d - b) * (x - a)) < 1e-9:
            return True
        inside ^= (b > y) != (d > y) and x < a + (c - a) * (y - b) / (d - b)
    return inside


def square(count, corner=(0, 0), radius=0):
    """That many points in a square of 100 by 100, those in a disc in its middle left out."""
    numbers = random.Random(1)
    points = ((round(numbers.uniform(0, 100), 2), round(numbers.uniform(0, 100), 2)) for _ in range(count))
    return [(corner[0] + x, corner[1] + y) for x, y in points if (x - 50) ** 2 + (y - 50) ** 2 >= radius**2]


def las(points):
    """LAS 1.2 in UTM zone 32, half of the points ground and half buildings."""
    keys = struct.pack("<12H", 1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 25832)
    record = struct.pack("<H16sHH32s", 0, b"LASF_Projection", 34735, len(keys), b"") + keys
    xs, ys = zip(*points)
    counts = (len(points), len(points), 0, 0, 0, 0)
    box = (max(xs), min(xs), max(ys), min(ys), 0, 0)
    start = (b"LASF", 0, 0, b"", 1, 2, b"", b"", 1, 2026, 227, 227 + len(record), 1, 0, 20)
    numbers = (0.01, 0.01, 0.01, 500000, 5600000, 0)
    header = struct.pack("<4sHH16sBB32s32sHHHIIBH6I12d", *start, *counts, *numbers, *box)
    rows = (
        struct.pack("<iiiHBBbBH", round((x - 500000) * 100), round((y - 5600000) * 100), 0, 0, 9, 2 + i % 2 * 4, 0, 0, 0)
        for i, (x, y) in enumerate(points)
    )
    return header + record + b"".join(rows)


class Task(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def write(self, name, content):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())

    def run_line(self, line, folder=None, **environment):
        """What a shell says to the line of a README."""
        return subprocess.run(
            ["bash", "-c", line],
            cwd=folder or self.folder,
            env={**os.environ, **environment},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            timeout=120,
        )

    def do(self, lines, folder=None, **environment):
        self.assertGreater(len(lines), 0)
        for line in lines:
            done = self.run_line(line, folder, **environment)
            self.assertEqual(done.returncode, 0, f"{line}\n{done.stdout}{done.stderr}")

    def place_program(self):
        """The program is where "make tool" puts it, and in the PATH, as core/tool/README.md has it."""
        (self.folder / "build-tool").mkdir()
        (self.folder / "build-tool" / "polylidar").symlink_to(os.environ["POLYLIDAR"])
        return {"PATH": f"{self.folder / 'build-tool'}{os.pathsep}{os.environ['PATH']}"}

    def write_trees(self):
        oaks, beeches = square(2000, (500000, 5600000)), square(1500, (500300, 5600000), 25)
        rows = [f"{x:.2f},{y:.2f},oak" for x, y in oaks] + [f"{x:.2f},{y:.2f},beech" for x, y in beeches]
        self.write("trees.csv", "x,y,species\n" + "\n".join(rows) + "\n")
        return {"oak": (len(oaks), 10000, 0), "beech": (len(beeches), 10000 - 1963, 1)}

    def write_tiles(self):
        tiles = {"a.las": square(4000, (500000, 5600000), 25), "b.las": square(4000, (500100, 5600000))}
        for name, points in tiles.items():
            self.write("tiles/" + name, las(points))
        return {"a.las": (len(tiles["a.las"]), 10000 - 1963, 1), "b.las": (4000, 10000, 0)}

    def check_feature(self, feature, points, area, holes):
        properties, geometry = feature["properties"], feature["geometry"]
        self.assertEqual(feature["type"], "Feature")
        self.assertEqual(geometry["type"], "MultiPolygon")
        self.assertEqual((properties["points"], properties["parts"], properties["holes"]), (points, 1, holes))
        (rings,) = geometry["coordinates"]
        self.assertEqual(len(rings), 1 + holes)
        for ring in rings:
            self.assertEqual(ring[0], ring[-1])
            self.assertEqual(signed_area(ring) > 0, ring is rings[0], "shells run counter-clockwise, holes clockwise")
        # The sums are of coordinates of up to 5.6e6.
        self.assertAlmostEqual(properties["area"], sum(map(signed_area, rings)), delta=0.1)
        self.assertAlmostEqual(properties["area"], area, delta=0.06 * area)

    def check_collection(self, text, expected, key):
        collection = json.loads(text)
        self.assertEqual(collection["type"], "FeatureCollection")
        self.assertIn("EPSG::25832", collection["crs"]["properties"]["name"])
        features = {feature["properties"][key]: feature for feature in collection["features"]}
        self.assertEqual(features.keys(), expected.keys())
        self.assertEqual(len(collection["features"]), len(expected))
        for name, feature in features.items():
            with self.subTest(name):
                self.check_feature(feature, *expected[name])
        return features

    def read_by_gdal(self, name):
        done = self.run_line(f"ogr2ogr -f GeoJSON /vsistdout/ {name}")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout


class Marks(unittest.TestCase):
    def test_every_mark_is_tried_once(self):
        marks = [name for page in PAGES for name in re.findall(r"tried: (\w+)", (ROOT / page).read_text(encoding="utf-8"))]
        self.assertEqual(sorted(marks), sorted(["tool", "shapely", "gdal", "npm", "package", "concaveman"]))
        self.assertEqual(sorted(marks), sorted(BLOCKS), "a mark stands right before a block of code")

    def test_every_command_belongs_to_one_task(self):
        for line in commands("tool"):
            self.assertEqual(sum(word in line for word in WORD_OF_TASK.values()), 1, line)
        for task in WORD_OF_TASK:
            self.assertGreater(len(commands_of_task(task)), 0, task)

    def test_make_has_the_targets(self):
        targets = re.findall(r"^\.PHONY: (.*)$", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
        lines = [line.split() for name in BLOCKS for line in BLOCKS[name].splitlines() if line.strip().startswith("make ")]
        self.assertEqual([words[1] for words in lines], ["tool", "js"])
        self.assertLessEqual({words[1] for words in lines}, set(" ".join(targets).split()))


class Hull(Task):
    def test_points_become_a_feature(self):
        self.place_program()
        points = square(3000, radius=25)
        self.write("points.csv", "x,y\n" + "".join(f"{x},{y}\n" for x, y in points))
        self.do(commands_of_task("hull"))
        feature = json.loads((self.folder / "hull.geojson").read_text())
        self.check_feature(feature, len(points), 10000 - 1963, 1)


class Footprint(Task):
    def test_tiles_become_an_index(self):
        self.place_program()
        expected = self.write_tiles()
        self.do(commands_of_task("footprint"))
        features = self.check_collection((self.folder / "index.geojson").read_text(), expected, "name")
        for name, feature in features.items():
            properties, (points, *_) = feature["properties"], expected[name]
            self.assertEqual(properties["path"], "tiles/" + name)
            self.assertEqual(properties["crs"], "EPSG:25832")
            self.assertEqual(properties["classes"], {"2": points - points // 2, "6": points // 2})
            self.assertAlmostEqual(properties["density"], points / properties["area"])
            (shell, *_), *_ = feature["geometry"]["coordinates"]
            sides = [side(axis) for side in (min, max) for axis in zip(*shell)]
            for side, bound in zip(sides, properties["bounds"]):
                self.assertAlmostEqual(side, bound, delta=5)


class Groups(Task):
    def test_groups_become_a_layer(self):
        self.place_program()
        expected = self.write_trees()
        self.do(commands_of_task("groups"))
        self.check_collection((self.folder / "species.geojson").read_text(), expected, "label")
        self.check_collection(self.read_by_gdal("species.gpkg"), expected, "label")


class WithGdal(Task):
    def test_it_writes_layers_itself(self):
        path = self.place_program()
        trees, tiles = self.write_trees(), self.write_tiles()
        self.do(commands("gdal"), **path)
        self.check_collection(self.read_by_gdal("species.gpkg"), trees, "label")
        self.check_collection(self.read_by_gdal("index.fgb"), tiles, "name")


class WithoutGdal(Task):
    def test_it_says_what_to_do(self):
        path = self.place_program()
        self.write_trees()
        self.write_tiles()
        for line in commands("gdal"):
            done = self.run_line(line, **path)
            self.assertEqual(done.returncode, 2, line)
            self.assertRegex(done.stderr, r"^polylidar: [^\n]*'ogr2ogr [^\n]*'make tool GDAL=1'\)\n$")
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"build-tool", "tiles", "trees.csv"})


class Shapely(unittest.TestCase):
    def test_an_array_becomes_polygons(self):
        names, out = {}, io.StringIO()
        with contextlib.redirect_stdout(out):
            exec(BLOCKS["shapely"], names)
        self.assertRegex(out.getvalue(), r"^1 0\.9\d+ \[\[")
        self.assertEqual(names["points"].shape, (1000, 2))
        self.assertEqual(names["polygons"].geom_type, "MultiPolygon")
        self.assertTrue(names["polygons"].is_valid)
        self.assertAlmostEqual(names["polygons"].area, names["shape"].area)
        self.assertEqual(names["largest"].geom_type, "Polygon")


class Npm(Task):
    def setUp(self):
        super().setUp()
        self.project = self.folder / "project"
        self.project.mkdir()
        (self.folder / "build-js").mkdir()
        (self.folder / "build-js" / "polylidar").symlink_to(os.environ["PACKAGE"])
        lines = [line.replace("/path/to/hullbench", str(self.folder)) for line in commands("npm")]
        self.do(lines, self.project, HOME=str(self.folder), npm_config_offline="true")

    def run_code(self, block, before="", after=""):
        """What the code of a block writes last, saved as hull.mjs."""
        (self.project / "hull.mjs").write_text(f"{before}\n{BLOCKS[block]}\n{after}\n", encoding="utf-8")
        done = self.run_line("node hull.mjs", self.project)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout.splitlines()[-1])

    def test_the_package_makes_hulls(self):
        hull, area = self.run_code("package", after="console.log(JSON.stringify([hull, hull.area]))")
        self.assertEqual(area, 6)
        ((ring,),) = hull["coordinates"]
        self.assertEqual(hull["type"], "MultiPolygon")
        self.assertEqual(signed_area(ring), 6)

    def test_the_package_can_be_kept_as_a_file(self):
        (file,) = self.project.glob("*.tgz")
        self.assertIn(file.name, (ROOT / "core/js/README.md").read_text(encoding="utf-8"))

    def test_concaveman_is_replaced(self):
        points = [[x, y] for x, y in square(800) if x < 60 or not 40 < y < 60]
        ring = self.run_code(
            "concaveman", before=f"const points = {json.dumps(points)};", after="console.log(JSON.stringify(ring))"
        )
        self.assertEqual(ring[0], ring[-1])
        self.assertTrue(all(vertex in points for vertex in ring))
        self.assertTrue(all(is_inside(point, ring) for point in points))
        self.assertLess(signed_area(ring), 0, "it runs clockwise, as concaveman's")
        self.assertAlmostEqual(-signed_area(ring), 9200, delta=500)


if __name__ == "__main__":
    unittest.main()
