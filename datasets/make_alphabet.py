#!/usr/bin/env python3
"""Makes the outlines of the capital letters A-Z in datasets/shapes and their part of the manifest there, from the font
EB Garamond 12 Regular as Debian packages it.

    /usr/bin/python3 datasets/make_alphabet.py [OUTPUT_FOLDER]

Needs, beyond what building and running hullbench needs, Debian's packages fonts-ebgaramond (the font), python3-freetype
(reads it) and python3-shapely (checks what came out). The files are committed: this script is run only to change them.
Running it again with the same font gives the same bytes. It stops with an error, and writes nothing, when an outline is
not valid. In the manifest it rewrites the set "alphabet" and its shapes, and keeps the rest.
"""

import hashlib
import json
import math
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

try:
    import freetype
    from shapely.geometry import Polygon
    from shapely.validation import explain_validity
except ImportError as error:
    sys.exit(f"make_alphabet: {error}: install python3-freetype and python3-shapely, and run the system's Python")

SET = "alphabet"
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
PACKAGE = "fonts-ebgaramond"
FONT_FILE = "EBGaramond12-Regular.otf"
COPYRIGHT = (
    "Copyright 2010-2013, Georg A. Duffner (<http://www.georgduffner.at/ebgaramond|g.duffner@gmail.com>), " "2013 Siva Kalyan"
)
LICENCE = "SIL Open Font License 1.1"

# Length units an em.
SIZE = 200
# How far the straight pieces may be from the curve, in length units.
TOLERANCE = Fraction(2, 100)
DECIMALS = 6
# Vertices are integers, multiples of this part of a length unit, so that areas are exact.
UNITS_PER_LENGTH = 10**DECIMALS

# Area over the convex hull's, from the paper's letters.
PAPER_CONVEXITY = {"A": 0.46, "B": 0.46, "C": 0.32}

# Name table of the font (OpenType): which record, and Windows' platform, whose strings are UTF-16.
NAME_VERSION, NAME_LICENCE, PLATFORM_WINDOWS = 5, 13, 3


def fail(what):
    sys.exit(f"make_alphabet: {what}")


def packaged(*command):
    try:
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return fail(f"'{' '.join(command)}' failed: install {PACKAGE} on Debian or Ubuntu")


def font_path():
    for line in packaged("dpkg", "-L", PACKAGE).splitlines():
        if Path(line).name == FONT_FILE:
            return Path(line)
    return fail(f"the package {PACKAGE} has no {FONT_FILE}")


def name_record(face, name_id):
    records = (face.get_sfnt_name(i) for i in range(face.sfnt_name_count))
    for record in records:
        if record.name_id == name_id and record.platform_id == PLATFORM_WINDOWS:
            return record.string.decode("utf-16-be").strip()
    return fail(f"the font has no name record {name_id}")


def bezier(points, t):
    """The point at t of the curve with these control points (de Casteljau), exact."""
    while len(points) > 1:
        points = [tuple(a + t * (b - a) for a, b in zip(p, q)) for p, q in zip(points, points[1:])]
    return points[0]


def piece_count(points, tolerance):
    """How many pieces of equal parameter keep the chords within `tolerance` of the curve.

    A curve B over a parameter interval of length h is at most h^2 / 8 * max |B''| from its chord, the bound of linear
    interpolation. For degree d, B'' is a Bezier curve of degree d - 2 with the control points d (d - 1) (P[i] - 2
    P[i+1] + P[i+2]), and so never longer than the longest of them.
    """
    degree = len(points) - 1
    bend = max(math.hypot(*(a - 2 * b + c for a, b, c in zip(p, q, r))) for p, q, r in zip(points, points[1:], points[2:]))
    return max(1, math.ceil(math.sqrt(degree * (degree - 1) * bend / (8 * tolerance))))


def contours(face, letter):
    """The closed contours of a glyph in font units, flattened: lists of exact (x, y), the first not repeated."""
    face.load_char(letter, freetype.FT_LOAD_NO_SCALE | freetype.FT_LOAD_NO_HINTING)
    tolerance = TOLERANCE * face.units_per_EM / SIZE
    rings = []

    def move_to(point, _):
        rings.append([(point.x, point.y)])

    def curve_to(*arguments):
        control = [rings[-1][-1]] + [(point.x, point.y) for point in arguments[:-1]]
        pieces = piece_count(control, tolerance) if len(control) > 2 else 1
        rings[-1].extend(bezier(control, Fraction(i, pieces)) for i in range(1, pieces + 1))

    face.glyph.outline.decompose(None, move_to=move_to, line_to=curve_to, conic_to=curve_to, cubic_to=curve_to)
    return rings


def without_repeats(ring):
    """`ring` without vertices that equal the one before; the last vertex counts as before the first."""
    return [vertex for i, vertex in enumerate(ring) if vertex != ring[i - 1]]


def fit(rings, units_per_em):
    """Scaled and moved so that the smallest x and y are 0; integer vertices, rounded half to even."""
    scale = Fraction(SIZE * UNITS_PER_LENGTH, units_per_em)
    low = [min(vertex[axis] for ring in rings for vertex in ring) for axis in (0, 1)]
    return [
        without_repeats([tuple(round((value - least) * scale) for value, least in zip(vertex, low)) for vertex in ring])
        for ring in rings
    ]


def twice_area(ring):
    """Positive when the ring runs counter-clockwise."""
    return sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]))


def to_polygons(letter, rings):
    """Polygons as lists of rings, shell first: contours that run counter-clockwise are shells, as PostScript outlines
    have them, the others holes in the shell around them. The font's non-zero winding rule gives this shape only when
    contours do not overlap; otherwise the polygons are not valid, or a hole is in no shell, and that is an error.
    """
    polygons = [[ring] for ring in rings if twice_area(ring) > 0]
    for hole in (ring for ring in rings if twice_area(ring) <= 0):
        around = [polygon for polygon in polygons if Polygon(polygon[0]).contains(Polygon(hole))]
        if len(around) != 1:
            fail(f"a contour of {letter} runs clockwise and lies in {len(around)} others, not in 1")
        around[0].append(hole)
    return polygons


def check(letter, polygons):
    """The polygons as GEOS has them; stops when one is not valid or two touch."""
    shapes = [Polygon(shell, holes) for shell, *holes in polygons]
    if not shapes:
        fail(f"{letter} has no contour")
    for i, shape in enumerate(shapes):
        if not shape.is_valid:
            fail(f"{letter} is not valid: {explain_validity(shape)}")
        if any(shape.intersects(other) for other in shapes[:i]):
            fail(f"contours of {letter} overlap")
    return shapes


def decimal(value):
    return f"{value / UNITS_PER_LENGTH:.{DECIMALS}f}".rstrip("0").rstrip(".")


def geojson(name, letter, polygons):
    """One vertex a line: a change in an outline then shows in a diff."""
    properties = {"name": name, "title": letter, "copyright": COPYRIGHT, "licence": f"{LICENCE}, see OFL.txt"}
    ring_texts = [
        ["[\n" + ",\n".join(f"[{decimal(x)}, {decimal(y)}]" for x, y in ring + ring[:1]) + "\n]" for ring in rings]
        for rings in polygons
    ]
    coordinates = ",\n".join("[" + ", ".join(rings) + "]" for rings in ring_texts)
    return (
        f'{{"type": "Feature", "properties": {json.dumps(properties)},\n'
        f'"geometry": {{"type": "MultiPolygon", "coordinates": [\n{coordinates}\n]}}}}\n'
    )


def plain(value):
    """Whole numbers without '.0', as JSON.stringify has them: both writers of the manifest give the same bytes."""
    return int(value) if value == int(value) else value


def describe(letter, name, polygons, shapes, text, font):
    area = Fraction(sum(twice_area(ring) for rings in polygons for ring in rings), 2 * UNITS_PER_LENGTH**2)
    corners = [vertex for shape in shapes for vertex in shape.exterior.coords[:-1]]
    hull_area = Polygon(corners).convex_hull.area / UNITS_PER_LENGTH**2
    entry = {
        "name": name,
        "title": letter,
        "set": SET,
        "file": f"{name}.geojson",
        "sha256": hashlib.sha256(text.encode()).hexdigest(),
        "source": f"EB Garamond 12 Regular {font['version']}, capital letter {letter}",
        "source_package": {**font["package"], "licence": "OFL-1.1", "file": FONT_FILE},
        "licence": LICENCE,
        "copyright": COPYRIGHT,
        "polygons": len(polygons),
        "vertices": sum(len(ring) for rings in polygons for ring in rings),
        "area": plain(round(float(area), DECIMALS)),
        "bounding_box": [
            plain(pick(vertex[axis] for vertex in corners) / UNITS_PER_LENGTH) for pick in (min, max) for axis in (0, 1)
        ],
        "convexity": round(float(area) / hull_area, 4),
    }
    if letter in PAPER_CONVEXITY:
        entry["paper"] = {
            "convexity": PAPER_CONVEXITY[letter],
            "note": "The paper used another Garamond, so its figure is for comparison only.",
        }
    return entry


def describe_set(font):
    return {
        "name": SET,
        "made_by": "datasets/make_alphabet.py",
        "how_made": f"Outlines in font units, unscaled and unhinted, y up; every Bezier curve replaced by chords at "
        f"most {float(TOLERANCE)} length units away from it; scaled so that one em is {SIZE} length units "
        f"(the paper's letters were scaled by {SIZE} too, from outlines in a unit that is not known); "
        f"each letter moved so that its smallest x and y are 0; coordinates rounded to {DECIMALS} "
        f"decimals; shells counter-clockwise, holes (the letters' counters) clockwise. convexity is the area "
        f"over the area of the convex hull.",
        "licences": f"The letters are derived from the font named here, by a change of format, and are under the same "
        f"licence, the {LICENCE} (OFL.txt in this folder, which must be passed on with them). The font "
        f"declares no Reserved Font Name, and the letters are data, not a font: no font is presented under "
        f"the font's name, which stands here only to say where they come from. Points, hulls, scores and "
        f"pictures made from the letters are taken to be documents in the licence's sense, to which it "
        f"does not extend.",
        "font": font,
    }


def describe_font(path, face):
    return {
        "name": f"{face.family_name.decode()} {face.style_name.decode()}",
        "version": name_record(face, NAME_VERSION).removeprefix("Version "),
        "copyright": COPYRIGHT,
        "licence": LICENCE,
        "file": FONT_FILE,
        "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
        "units_per_em": face.units_per_EM,
        "package": {"name": PACKAGE, "version": packaged("dpkg-query", "-W", "-f", "${Version}", PACKAGE)},
    }


def replaced(elements, is_own, own):
    """`own` in the place of the elements that are; at the end when there are none."""
    first = next((i for i, element in enumerate(elements) if is_own(element)), len(elements))
    return elements[:first] + own + [element for element in elements[first:] if not is_own(element)]


def write_manifest(path, description, entries):
    manifest = json.loads(path.read_text()) if path.exists() else {}
    manifest["sets"] = replaced(manifest.get("sets", []), lambda one: one["name"] == SET, [description])
    manifest["shapes"] = replaced(manifest.get("shapes", []), lambda shape: shape["set"] == SET, entries)
    path.write_text(json.dumps(manifest, indent=2, ensure_ascii=False) + "\n")


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent / "shapes"
    path = font_path()
    face = freetype.Face(str(path))
    if not " ".join(name_record(face, NAME_LICENCE).split()).startswith(COPYRIGHT):
        fail("the font has another copyright notice: correct it here and in OFL.txt")
    font = describe_font(path, face)
    texts, entries = [], []
    for letter in LETTERS:
        name = f"letter_{letter.lower()}"
        polygons = to_polygons(letter, fit(contours(face, letter), face.units_per_EM))
        shapes = check(letter, polygons)
        texts.append(geojson(name, letter, polygons))
        entries.append(describe(letter, name, polygons, shapes, texts[-1], font))
    folder.mkdir(parents=True, exist_ok=True)
    for entry, text in zip(entries, texts):
        (folder / entry["file"]).write_text(text)
    write_manifest(folder / "manifest.json", describe_set(font), entries)
    for entry in entries:
        print(
            f"{entry['file']}: {entry['polygons']} polygons, {entry['vertices']} vertices, area {entry['area']}, "
            f"convexity {entry['convexity']}"
        )


if __name__ == "__main__":
    main()
