#!/usr/bin/env python3
"""golden_hashes.py [--check] [NAME...]: the hashes that test_datasets.cpp expects, worked out apart from the library.

Prints one line for each of the states, with and without holes, and the letters (of all, or of those named): what it is
and its SHA-256. A shape's is that of its vertices, a sample's that of its points, each as little-endian doubles. What
decides, the point in polygon and the distance to a boundary, is computed in whole or rational numbers; coordinates are
doubles, made by the steps that datasets/sampling.hpp and datasets/holes.hpp describe. A difference is a fault here or
there, or a data set that was meant to change.

With --check it also compares them with those that stand there; without names, that no other ones do.

Exit codes: 0 done; 1 test_datasets.cpp expects others; 2 there is no such shape.
"""
import functools
import hashlib
import json
import math
import re
import struct
import sys
from fractions import Fraction
from pathlib import Path
from typing import Iterator

Point = tuple[float, float]
Ring = list[Point]
Polygon = list[Ring]  # the shell, then its holes
Edge = tuple[Point, Point]
BoxedEdge = tuple[float, float, float, float, Point, Point]  # low, high, right, left, and its ends

SHAPES = Path(__file__).resolve().parent.parent / "datasets" / "shapes"
EXPECTATIONS = Path(__file__).resolve().parent / "test_datasets.cpp"
STATE_SIZES = (2000, 8000)
LETTER_SIZES = (2000,)
SEED = 1
CORNERS = 64  # of a circular hole
SCALE = 2**200


def random_words(seed: int) -> Iterator[int]:
    """Of 64 bits: xoshiro256++, its state filled by SplitMix64."""
    mask = 2**64 - 1
    state = []
    for i in range(1, 5):
        mixed = (seed + i * 0x9E3779B97F4A7C15) & mask
        mixed = (mixed ^ mixed >> 30) * 0xBF58476D1CE4E5B9 & mask
        mixed = (mixed ^ mixed >> 27) * 0x94D049BB133111EB & mask
        state.append(mixed ^ mixed >> 31)

    def turned(word: int, by: int) -> int:
        return (word << by | word >> 64 - by) & mask

    a, b, c, d = state
    while True:
        drawn = (turned((a + d) & mask, 23) + a) & mask
        c, d, shifted = c ^ a, d ^ b, b << 17 & mask
        a, b, c, d = a ^ d, b ^ c, c ^ shifted, turned(d, 45)
        yield drawn


def random_numbers(seed: int) -> Iterator[float]:
    """Uniform in [0, 1)."""
    return (math.ldexp(word >> 11, -53) for word in random_words(seed))


def derived_seed(seed: int, label: str) -> int:
    return int.from_bytes(hashlib.sha256(struct.pack("<Q", seed) + label.encode()).digest()[:8], "little")


@functools.lru_cache(maxsize=4096)
def exact(p: Point) -> tuple[int, int]:
    """A multiple of the coordinates, the same for all points, that is whole."""
    (x, x_unit), (y, y_unit) = (coordinate.as_integer_ratio() for coordinate in p)
    assert max(x_unit, y_unit) <= SCALE
    return x * (SCALE // x_unit), y * (SCALE // y_unit)


def turn(a: Point, b: Point, p: Point) -> int:
    """A positive multiple of the triangle's area, exactly; the area is positive when it is counter-clockwise."""
    (ax, ay), (bx, by), (px, py) = exact(a), exact(b), exact(p)
    return (bx - ax) * (py - ay) - (by - ay) * (px - ax)


def edges(polygon: Polygon) -> list[Edge]:
    return [edge for ring in polygon for edge in zip(ring, ring[1:] + ring[:1])]


class Outline:
    """The edges of a polygon by strips of y; an edge is in every strip that it may reach into."""

    STRIPS = 500

    def __init__(self, polygon: Polygon) -> None:
        boxes = [(min(a[1], b[1]), max(a[1], b[1]), max(a[0], b[0]), min(a[0], b[0]), a, b) for a, b in edges(polygon)]
        self.low = min(box[0] for box in boxes)
        self.high = max(box[1] for box in boxes)
        self.strips: list[list[BoxedEdge]] = [[] for _ in range(self.STRIPS + 1)]
        for box in boxes:
            for strip in range(self.strip_of(box[0]), self.strip_of(box[1]) + 1):
                self.strips[strip].append(box)

    def strip_of(self, y: float) -> int:
        """Never falls as y rises, so that rounding takes no edge from a strip."""
        return int((y - self.low) / (self.high - self.low) * self.STRIPS)

    def near(self, y: float) -> list[BoxedEdge]:
        return self.strips[self.strip_of(y)] if self.low <= y <= self.high else []


def contains(outline: Outline, p: Point) -> bool:
    """By the edges that a ray to the right crosses, an even number or an odd one; the boundary belongs to it."""
    x, y = p
    inside = False
    for low, high, right, left, a, b in outline.near(y):
        if not low <= y <= high or x > right:
            continue
        crosses = (a[1] > y) != (b[1] > y)
        if x < left:
            inside ^= crosses
            continue
        side = turn(a, b, p)
        if side == 0:
            return True
        inside ^= crosses and (side > 0) == (b[1] > a[1])
    return inside


def is_nearer(a: Point, b: Point, p: Point, distance: float) -> bool:
    """Whether p is less than `distance` from the segment."""
    (ax, ay), (bx, by), (px, py) = ((Fraction(x), Fraction(y)) for x, y in (a, b, p))
    dx, dy = bx - ax, by - ay
    along = (px - ax) * dx + (py - ay) * dy
    length2 = dx * dx + dy * dy
    limit2 = Fraction(distance) ** 2
    if along <= 0:
        return (px - ax) ** 2 + (py - ay) ** 2 < limit2
    if along >= length2:
        return (px - bx) ** 2 + (py - by) ** 2 < limit2
    return (dx * (py - ay) - dy * (px - ax)) ** 2 < limit2 * length2


def directions() -> list[Point]:
    """Unit vectors in steps of 360 / CORNERS degrees, by halving the right angle."""
    x, y = 0.0, 1.0
    for _ in range((CORNERS // 4).bit_length() - 1):
        cosine = math.sqrt((1 + x) / 2)
        x, y = cosine, y / (2 * cosine)
    found = [(1.0, 0.0)]
    while len(found) < CORNERS // 4:
        before_x, before_y = found[-1]
        found.append((before_x * x - before_y * y, before_x * y + before_y * x))
    while len(found) < CORNERS:
        before_x, before_y = found[len(found) - CORNERS // 4]
        found.append((-before_y, before_x))
    return found


def box_of(shape: list[Polygon]) -> tuple[float, float, float, float]:
    points = [point for polygon in shape for ring in polygon for point in ring]
    xs, ys = zip(*points)
    return min(xs), min(ys), max(xs) - min(xs), max(ys) - min(ys)


def places(shape: list[Polygon], seed: int) -> Iterator[Point]:
    """Points of the bounding box, one after another."""
    left, low, width, height = box_of(shape)
    numbers = random_numbers(seed)
    while True:
        x = left + width * next(numbers)
        yield x, low + height * next(numbers)


def read_shape(file: str) -> list[Polygon]:
    geometry = json.loads((SHAPES / file).read_text())["geometry"]
    polygons = geometry["coordinates"] if geometry["type"] == "MultiPolygon" else [geometry["coordinates"]]
    shape = []
    for rings in polygons:
        polygon = []
        for number, positions in enumerate(rings):
            ring = [(float(x), float(y)) for x, y in positions[:-1]]
            doubled = sum(turn((0.0, 0.0), a, b) for a, b in edges([ring]))
            polygon.append(ring if (doubled > 0) == (number == 0) else ring[::-1])
        shape.append(polygon)
    return shape


def with_holes(name: str, shape: list[Polygon], count: int, radius: float, seed: int) -> list[Polygon]:
    result = [list(polygon) for polygon in shape]
    outlines = [Outline(polygon) for polygon in shape]
    left = count
    for centre in places(shape, derived_seed(seed, f"holes/{name}")):
        if left == 0:
            return result
        home = next((i for i, outline in enumerate(outlines) if contains(outline, centre)), None)
        if home is None or any(is_nearer(a, b, centre, 2 * radius) for polygon in result for a, b in edges(polygon)):
            continue
        result[home].append([(centre[0] + radius * x, centre[1] + radius * y) for x, y in reversed(directions())])
        left -= 1
    raise AssertionError("places never end")


def sample(name: str, shape: list[Polygon], holes: int, n: int) -> list[Point]:
    outlines = [Outline(polygon) for polygon in shape]
    points: list[Point] = []
    for place in places(shape, derived_seed(SEED, f"points/{name}/holes:{holes}/n:{n}")):
        if len(points) == n:
            break
        if any(contains(outline, place) for outline in outlines):
            points.append(place)
    return points


def sha256_of(points: list[Point]) -> str:
    return hashlib.sha256(b"".join(struct.pack("<2d", *point) for point in points)).hexdigest()


def golden_hashes(entry: dict) -> Iterator[tuple[str, str]]:
    """What is hashed, and its hash, of a shape of the manifest."""
    name = entry["name"]
    shape = read_shape(entry["file"])
    for holes in (0, 1) if "holes" in entry else (0,):
        if holes:
            shape = with_holes(name, shape, **entry["holes"])
        yield f"{name}/holes:{holes}", sha256_of([point for polygon in shape for ring in polygon for point in ring])
        for n in LETTER_SIZES if name.startswith("letter_") else STATE_SIZES:
            yield f"{name}/holes:{holes}/n:{n}", sha256_of(sample(name, shape, holes, n))


def main(arguments: list[str]) -> int:
    entries = {entry["name"]: entry for entry in json.loads((SHAPES / "manifest.json").read_text())["shapes"]}
    expected = None
    if arguments[:1] == ["--check"]:
        expected = set(re.findall(r"\b[0-9a-f]{64}\b", EXPECTATIONS.read_text()))
        arguments = arguments[1:]
    for name in arguments:
        if name not in entries:
            print(f"error: there is no shape '{name}'; choose from {', '.join(entries)}.", file=sys.stderr)
            return 2
    found = set()
    for name in arguments or entries:
        for what, sha256 in golden_hashes(entries[name]):
            print(f"{what} {sha256}", flush=True)
            found.add(sha256)
    if expected is not None and (found - expected or (not arguments and expected - found)):
        print(f"error: {EXPECTATIONS.name} expects other hashes: {' '.join(sorted(found ^ expected))}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
