#!/usr/bin/env python3
"""golden_stress.py [--check] [NAME...]: the hashes that test_stress.cpp expects, worked out apart from the library.

Prints the SHA-256 of 1000 points with the seed 1 of each data set named, such as ca~noise:0.5, or of all that
test_stress.cpp names and this program knows: shapes of the manifest, and every kind of stress but clusters, poisson,
lattice, boundary and outline. Points are made by the steps that datasets/stress.hpp and datasets/samplers describe; a point in
a polygon is decided in whole numbers, as in golden_hashes.py. A difference is a fault here or there, or a data set
that was meant to change.

With --check it also compares them with those that stand there.

Exit codes: 0 done; 1 test_stress.cpp expects others; 2 there is no such data set.
"""
import json
import math
import re
import sys
from pathlib import Path
from typing import Callable, Iterator

from golden_hashes import SHAPES, Outline, Point, Polygon, contains, derived_seed, places, random_words
from golden_hashes import read_shape, sha256_of

EXPECTATIONS = Path(__file__).resolve().parent / "test_stress.cpp"
COUNT = 1000
SEED = 1


def series(coefficients: list[float], z: float) -> float:
    total = 0.0
    for coefficient in reversed(coefficients):
        total = (total + coefficient) * z
    return total


def natural_log(x: float) -> float:
    mantissa, exponent = math.frexp(x)
    if mantissa < 0.5 * math.sqrt(2):
        mantissa, exponent = mantissa * 2, exponent - 1
    s = (mantissa - 1) / (mantissa + 1)
    log_mantissa = 2 * (s + s * series([1 / odd for odd in range(3, 24, 2)], s * s))
    high, low = float.fromhex("0x1.62e42fefp-1"), float.fromhex("0x1.473de6af278edp-34")
    return exponent * high + (exponent * low + log_mantissa)


def rounded(x: float) -> float:
    """To the nearest whole number, halves away from zero."""
    whole = math.floor(abs(x))
    return math.copysign(whole + (abs(x) - whole >= 0.5), x)


def unit_vector(turns: float) -> Point:
    part = turns - rounded(turns)
    quarters = rounded(4 * part)
    angle = 2 * math.pi * (part - quarters / 4)
    square = angle * angle
    signs = [(-1) ** (i // 2) for i in range(2, 18)]
    cosine = 1 + series([signs[i - 2] / math.factorial(i) for i in range(2, 17, 2)], square)
    sine = angle + angle * series([signs[i - 2] / math.factorial(i) for i in range(3, 18, 2)], square)
    return {0: (cosine, sine), 1: (-sine, cosine), -1: (sine, -cosine)}.get(int(quarters), (-cosine, -sine))


class Random:
    def __init__(self, seed: int) -> None:
        self.words = random_words(seed)

    def uniform(self) -> float:
        return math.ldexp(next(self.words) >> 11, -53)

    def between(self, low: float, high: float) -> float:
        return low + (high - low) * self.uniform()

    def normal(self) -> float:
        square = 0.0
        while square == 0 or square >= 1:
            x = self.between(-1, 1)
            y = self.between(-1, 1)
            square = x * x + y * y
        return x * math.sqrt(-2 * natural_log(square) / square)

    def below(self, bound: int) -> int:
        refused = (2**64 - bound) % bound
        while (drawn := next(self.words)) < refused:
            pass
        return drawn % bound


class Shape:
    def __init__(self, polygons: list[Polygon]) -> None:
        self.polygons = polygons
        self.outlines = [Outline(polygon) for polygon in polygons]
        self.corners = [corner for polygon in polygons for corner in polygon[0]]
        xs, ys = zip(*self.corners)
        self.low, self.high = (min(xs), min(ys)), (max(xs), max(ys))

    def contains(self, point: Point) -> bool:
        return any(contains(outline, point) for outline in self.outlines)

    def area(self) -> float:
        total = 0.0
        for polygon in self.polygons:
            for number, ring in enumerate(polygon):
                (x, y), twice = ring[0], 0.0
                for a, b in zip(ring[1:], ring[2:]):
                    twice += (a[0] - x) * (b[1] - y) - (a[1] - y) * (b[0] - x)
                total += abs(twice / 2) if number == 0 else -abs(twice / 2)
        return total

    def spacing(self, n: int) -> float:
        return math.sqrt(self.area() / n)

    def uniform(self, seed: int) -> Iterator[Point]:
        return (place for place in places(self.polygons, seed) if self.contains(place))


class Frame:
    """The shape turned, so that x runs along a direction."""

    def __init__(self, shape: Shape, turns: float) -> None:
        self.x, self.y = unit_vector(turns)
        xs, ys = zip(*((x * self.x + y * self.y, y * self.x - x * self.y) for x, y in shape.corners))
        self.low, self.high = (min(xs), min(ys)), (max(xs), max(ys))

    def in_plane(self, x: float, y: float) -> Point:
        return x * self.x - y * self.y, x * self.y + y * self.x


def moved(point: Point, deviation: float, random: Random) -> Point:
    x = point[0] + deviation * random.normal()
    return x, point[1] + deviation * random.normal()


def gradient(shape: Shape, n: int, level: float, seed: int) -> list[Point]:
    random, points = Random(derived_seed(seed, "gradient")), []
    width = shape.high[0] - shape.low[0]
    for point in shape.uniform(seed):
        density = 1 + (level - 1) * (shape.high[0] - point[0]) / width
        if level * random.uniform() < density:
            points.append(point)
        if len(points) == n:
            return points
    raise AssertionError("points never end")


def hotspot(shape: Shape, n: int, level: float, seed: int) -> list[Point]:
    background, random, points = shape.uniform(seed), Random(derived_seed(seed, "hotspot")), []
    middle = next(shape.uniform(derived_seed(seed, "place")))
    deviation = 0.1 * math.sqrt(shape.area())
    bump = 2 * math.pi * 0.1 * 0.1 * (level - 1)
    while len(points) < n:
        if random.uniform() >= bump / (1 + bump):
            points.append(next(background))
            continue
        point = moved(middle, deviation, random)
        if shape.contains(point):
            points.append(point)
    return points


def cascade(shape: Shape, n: int, level: float, seed: int) -> list[Point]:
    random, points = Random(derived_seed(seed, "cascade")), []
    frame = Frame(shape, random.uniform())
    is_second_dense = [random.below(2) == 1 for _ in range(1024)]
    while len(points) < n:
        low, high, part = list(frame.low), list(frame.high), 1
        for halving in range(10):
            axis = halving % 2
            is_second = (random.uniform() < level / (level + 1)) == is_second_dense[part]
            middle = low[axis] + (high[axis] - low[axis]) / 2
            (low if is_second else high)[axis] = middle
            part = 2 * part + is_second
        x = random.between(low[0], high[0])
        point = frame.in_plane(x, random.between(low[1], high[1]))
        if shape.contains(point):
            points.append(point)
    return points


def transcripts(shape: Shape, n: int, level: float, seed: int) -> list[Point]:
    uniform, random, points = shape.uniform(seed), Random(derived_seed(seed, "transcripts")), []
    nucleus = next(shape.uniform(derived_seed(seed, "place")))
    strays = int(rounded(n * level / 100))
    while len(points) < n - strays:
        if random.uniform() >= 0.5:
            points.append(next(uniform))
            continue
        point = moved(nucleus, 0.2 * math.sqrt(shape.area()), random)
        while not shape.contains(point):
            point = moved(nucleus, 0.2 * math.sqrt(shape.area()), random)
        points.append(point)
    while len(points) < n:
        point = moved(next(uniform), 2 * shape.spacing(n), random)
        if not shape.contains(point):
            points.append(point)
    return points


def scan_exactly(shape: Shape, n: int, seed: int, scan: Callable[[float, Random], list[Point]]) -> list[Point]:
    pitch, tries = shape.spacing(n), 1
    while True:
        random = Random(seed)
        points = scan(pitch, random)
        if len(points) >= n and (len(points) <= n + n // 20 + 8 or tries >= 20):
            return lose(points, n, random)
        factor = math.sqrt((len(points) + 2) / (1.02 * n + 4))
        pitch *= min(max(factor, 0.5), 2.0) if tries < 20 else 0.9
        tries += 1


def lose(points: list[Point], n: int, random: Random) -> list[Point]:
    kept: list[Point] = []
    for i, point in enumerate(points):
        if len(kept) < n and random.below(len(points) - i) < n - len(kept):
            kept.append(point)
    return kept


def depth_image(shape: Shape, pitch: float, level: float, random: Random) -> list[Point]:
    frame = Frame(shape, random.uniform())
    (left, low), (right, high) = frame.low, frame.high
    distance = right - left
    height = distance / level
    foot_x, foot_y = left - distance / 2, (low + high) / 2
    row_offset = random.uniform()
    column_offset = random.uniform()
    slant = math.sqrt(distance * distance + height * height)
    focal = slant / (pitch * math.sqrt(height / slant))

    def depth(forward: float) -> float:
        return (forward * distance + height * height) / slant

    def row_of(forward: float) -> float:
        return focal * (height * (forward - distance) / slant) / depth(forward)

    def seen(row: int, column: int, distortion: float = 0.01) -> Point:
        v, u = first_row + row + row_offset, first_column + column + column_offset
        bent = 1 + distortion * ((v * v + u * u) / (focal * focal))
        v, u = v * bent, u * bent
        forward = height * (v * height + focal * distance) / (focal * height - v * distance)
        return forward, u * depth(forward) / focal

    low_row, high_row = row_of(distance / 2) - row_offset, row_of(1.5 * distance) - row_offset
    far_column = focal * ((high - low) / 2) / depth(distance / 2)
    low_column, high_column = -far_column - column_offset, far_column - column_offset
    first_row, first_column = math.ceil(low_row), math.ceil(low_column)
    rows = max(math.floor(high_row) - first_row + 1, 0)
    columns = max(math.floor(high_column) - first_column + 1, 0)
    floor = set()
    for row in range(rows):
        for column in range(columns):
            x, y = seen(row, column)
            if shape.contains(frame.in_plane(foot_x + x, foot_y + y)):
                floor.add((row, column))
    white = {(row, column): random.normal() for row in range(-1, rows + 1) for column in range(-1, columns + 1)}
    points = []
    for row, column in sorted(floor):
        neighbours = {(row, column - 1), (row, column + 1), (row - 1, column), (row + 1, column)}
        if not neighbours <= floor and random.uniform() < 0.5:
            continue
        noise = 0.0
        for i in (row - 1, row, row + 1):
            noise += white[i, column - 1] + white[i, column] + white[i, column + 1]
        disparity = focal * (1 / 40 * distance) / depth(seen(row, column)[0])
        measured = 1 / 32 * rounded((disparity + 0.05 * (noise / 3)) / (1 / 32))
        if measured >= disparity / 2:
            x, y = seen(row, column, 0.0)
            stretch = focal * (1 / 40 * distance) / depth(x) / measured
            points.append(frame.in_plane(foot_x + stretch * x, foot_y + stretch * y))
    return points


def flight(shape: Shape, pitch: float, level: float, swings: bool, random: Random) -> list[Point]:
    frame = Frame(shape, random.uniform())
    along, across = pitch / math.sqrt(level), pitch * math.sqrt(level)
    swath = 0.4 * (frame.high[1] - frame.low[1])
    points = []
    for strip in range(3):
        side = frame.low[1] + 0.75 * strip * swath
        start = frame.low[0] - across * (1 + random.uniform())
        for line in range(int((frame.high[0] - frame.low[0]) / across) + 3):
            phase, shot = random.uniform(), 0
            while (y := along * (shot + phase)) < swath:
                x = start + line * across
                if swings:
                    x += across * (y if line % 2 == 0 else swath - y) / swath
                dx = 0.1 * along * random.between(-1, 1)
                dy = 0.1 * along * random.between(-1, 1)
                points.append(frame.in_plane(x + dx, side + y + dy))
                shot += 1
    return [point for point in points if shape.contains(point)]


def rings(shape: Shape, foot: Point, pitch: float, level: float, random: Random) -> list[Point]:
    reach = max(math.sqrt((x - foot[0]) * (x - foot[0]) + (y - foot[1]) * (y - foot[1])) for x, y in shape.corners)
    height, half, turn = 1 / 4 * reach, reach / 2, 2 * math.pi
    beam_step = pitch * math.sqrt(level) * height / (half * half + height * height) / turn
    shots = int(max(rounded(turn * half / (pitch / math.sqrt(level))), 3.0))
    points, beam, phase = [], 0, random.uniform()
    while (beam + phase) * beam_step < 0.25:
        down, out = unit_vector((beam + phase) * beam_step)
        radius = 1 / 4 * reach * out / down
        if radius > reach:
            break
        start = random.uniform()
        for shot in range(shots):
            x, y = unit_vector((shot + start) / shots)
            points.append((foot[0] + radius * x, foot[1] + radius * y))
        beam += 1
    return [point for point in points if shape.contains(point)]


def roads(shape: Shape, pitch: float, level: float, random: Random) -> list[Point]:
    turns = random.uniform()
    step = pitch * math.sqrt(2 / level)
    distance = level * step
    points = []
    for direction in (turns, turns + 0.25):
        frame = Frame(shape, direction)
        first = frame.low[1] - distance * random.uniform()
        steps = int((frame.high[0] - frame.low[0]) / step) + 1
        for road in range(int((frame.high[1] - frame.low[1]) / distance) + 3):
            side = first + distance * (road + random.between(-0.25, 0.25))
            for i in range(steps):
                x = frame.low[0] + step * (i + random.uniform())
                points.append(frame.in_plane(x, side + step * random.between(-0.1, 0.1)))
    return [point for point in points if shape.contains(point)]


def scanned(kind: str, shape: Shape, n: int, level: float, seed: int) -> list[Point]:
    foot = next(shape.uniform(derived_seed(seed, "place")))
    scans: dict[str, Callable[[float, Random], list[Point]]] = {
        "depthcamera": lambda pitch, random: depth_image(shape, pitch, level, random),
        "airborne": lambda pitch, random: flight(shape, pitch, level, False, random),
        "zigzag": lambda pitch, random: flight(shape, pitch, level, True, random),
        "rotating": lambda pitch, random: rings(shape, foot, pitch, level, random),
        "tracks": lambda pitch, random: roads(shape, pitch, level, random),
    }
    label = "airborne" if kind == "zigzag" else kind
    return scan_exactly(shape, n, derived_seed(seed, label), scans[kind])


SCANNED = ("depthcamera", "airborne", "zigzag", "rotating", "tracks")
CHANGES = ("water", "noise", "outliers", "quantised")


def make_points(name: str, shape: Shape) -> list[Point]:
    """What datasets/stress.hpp says of the name; a KeyError when this program does not know one of its kinds."""
    base, *stresses = name.split("~")
    levels = {kind: float(level) for kind, level in (stress.split(":") for stress in stresses)}
    seed = derived_seed(SEED, f"points/{base}/holes:0/n:{COUNT}")
    percent, noise, step, wet = (levels.pop(kind, 0.0) for kind in ("outliers", "noise", "quantised", "water"))
    outliers = int(rounded(COUNT * percent / 100))
    drawn = COUNT - outliers
    lakes = [point for point, _ in zip(shape.uniform(derived_seed(seed, "water")), range(4))] if wet else []
    radius = math.sqrt(wet / 100 * shape.area() / (4 * math.pi))

    def is_dry(x: float, y: float) -> bool:
        return all((x - lake[0]) * (x - lake[0]) + (y - lake[1]) * (y - lake[1]) >= radius * radius for lake in lakes)

    if not levels:
        dry = (point for point in shape.uniform(seed) if is_dry(*point))
        points = [point for point, _ in zip(dry, range(drawn))]
    else:
        ((kind, level),) = levels.items()
        draw = {"gradient": gradient, "hotspot": hotspot, "cascade": cascade, "transcripts": transcripts}.get(kind)
        asked, points = drawn, []
        while True:
            points = draw(shape, asked, level, seed) if draw else scanned(kind, shape, asked, level, seed)
            points = [point for point in points if is_dry(*point)]
            if len(points) >= drawn:
                break
            asked = int(drawn * 1.02 / ((len(points) + 1) / (asked + 1))) + 2
        points = lose(points, drawn, Random(derived_seed(seed, "dry")))
    random = Random(derived_seed(seed, "noise"))
    if noise > 0:
        points = [moved(point, noise * shape.spacing(COUNT), random) for point in points]
    (left, low), (right, high) = shape.low, shape.high
    margin = max(right - left, high - low) / 10
    random = Random(derived_seed(seed, "outliers"))
    for _ in range(outliers):
        x = random.between(left - margin, right + margin)
        points.append((x, random.between(low - margin, high + margin)))
    if step > 0:
        step *= shape.spacing(COUNT)
        points = [(step * rounded(x / step), step * rounded(y / step)) for x, y in points]
    return points


def main(arguments: list[str]) -> int:
    entries = {entry["name"]: entry for entry in json.loads((SHAPES / "manifest.json").read_text())["shapes"]}
    golden = dict(re.findall(r'\{"([^"]+)",\s*"([0-9a-f]{64})"\}', EXPECTATIONS.read_text()))
    check = arguments[:1] == ["--check"]
    known = {"gradient", "hotspot", "cascade", "transcripts", *SCANNED, *CHANGES}

    def is_known(name: str) -> bool:
        base, *stresses = name.split("~")
        return base in entries and all(re.fullmatch(r"[a-z]+:[0-9.]+", one) and one.split(":")[0] in known for one in stresses)

    names = arguments[check:] or [name for name in golden if is_known(name)]
    wrong = [] if names else ["that it can be checked at all"]
    for name in names:
        if not is_known(name):
            print(f"error: there is no data set '{name}', or it is none of those that this program knows.", file=sys.stderr)
            return 2
        sha256 = sha256_of(make_points(name, Shape(read_shape(entries[name.split("~")[0]]["file"]))))
        print(f"{name} {sha256}", flush=True)
        if golden.get(name) != sha256:
            wrong.append(name)
    if check and wrong:
        print(f"error: {EXPECTATIONS.name} expects other hashes of {', '.join(wrong)}.", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
