"""Packs the pictures of a run small enough for one HTML page, where report/gallery.js draws them.

    pictures = pack(load("results/latest"))

Each case is one block: gzip, then base64. Before compression a block is

    4 bytes   length of the header, little-endian
    header    JSON: "origin" and "step": where the grid is in the data set's unit; "points": number of points; "truth", "results": the number of vertices of each ring of each polygon;
              "runs": what the page shows of each run beside the columns of RUN
    sections  the points, the ground truth and each result: numbers of 16 bits, all low bytes, then all high bytes

Coordinates are rounded to GRID steps over the larger side of the case's box. The points are sorted by x, then y: the
difference of x to the point before, then all y. A ring's vertices are differences to the vertex before (across rings and
polygons), zigzag coded (0, -1, 1, -2, ...). Apart, low and high bytes each have their own skewed distribution, and each
section starts a new Huffman table: that is worth a quarter of the size.
"""

from __future__ import annotations

import base64
import gzip
import io
import itertools
import json
import struct
import zlib
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from page import kept_data
from records import Experiment, Picture, Row
from report_common import NOT_TRIED

GRID = 4096
# The grid of pictures.jsonl has 16 times as many steps.
_SHIFT = 4
# Points a picture has at most: the first of these with which everything fits, else the last and fewer pictures. Not fewer
# than the smaller sets have, or hulls would turn where no point is to be seen.
POINT_LIMITS = (4000, 2000)
# Results with more vertices, such as hulls that visit nearly every point, take as much room as a dozen others.
MOST_VERTICES = 10_000
BUDGET_BYTES = 5 * 2**19
# Results may lie outside of the box, as far as differences fit into 16 bits.
_FARTHEST = 2 * GRID

# The columns of a run in a case's "runs"; "result" is an index into the block's results, null: no picture of it.
RUN = ("method", "protocol", "status", "l2", "median_ns", "result")

RULE = (
    "Where not all pictures fit into the page, each shows fewer points; where that is not enough, of a method's results with "
    f"more than {MOST_VERTICES} vertices only the worst is kept; then the experiment with the most pictures gives up those of "
    "its most accurate cases, one after the other."
)


@dataclass
class _Case:
    line: dict[str, Any]  # of pictures.jsonl
    title: str
    experiments: list[str] = field(default_factory=list)
    rows: dict[str, Row] = field(default_factory=dict)  # by the run's name
    polygons: dict[str, list[list[list[int]]]] = field(default_factory=dict)  # likewise
    _drawing: _Drawing | None = None

    @property
    def name(self) -> str:
        return self.line["case"]

    def drawing(self) -> _Drawing:
        """What is coded of it, once."""
        self._drawing = self._drawing or _Drawing(self)
        return self._drawing

    def leave_out(self, run: str) -> None:
        """From now on there is no picture of that run's result."""
        del self.polygons[run]
        self._drawing = None

    def badness(self) -> float:
        """The worst error of all results; a failure is worse than any error."""
        tried = [row for row in self.rows.values() if row.status not in NOT_TRIED]
        return max((_error(row) for row in tried), default=0.0)


def pack(experiments: Iterable[Experiment], budget_bytes: int = BUDGET_BYTES) -> dict[str, Any]:
    """The pictures of all experiments as an object for JSON, at most `budget_bytes` long when written as such with
    separators (",", ":"). Without any picture "cases" is empty. Raises RecordError when a file of pictures is malformed.

    "run_columns", "not_tried" (statuses), "points_limit", "rule" (a sentence), "cases" (each with "case",
    "experiments", "title", "n", "holes", "runs", "block"; worst first), "results_left_out" (a number) and, by
    experiment, "without_picture" (cases that were measured but have none) and "dropped" (those among them that did not
    fit)."""
    experiments = list(experiments)
    cases = _collect(experiments)
    room = budget_bytes - _length(_document(experiments, [], [], POINT_LIMITS[0], 0)) - 1000
    left_out = 0
    for limit in POINT_LIMITS:
        entries = [(case, case.drawing().entry(limit)) for case in cases]
        if _size(entries) <= room:
            break
    else:
        left_out = _leave_out_giants(cases)
        entries = [(case, case.drawing().entry(limit)) for case in cases]
    return _document(experiments, cases, _within(entries, room), limit, left_out)


def _collect(experiments: Sequence[Experiment]) -> list[_Case]:
    """The cases that have a picture. One that two experiments measured on the same points is one case; of a run that
    both have, the first experiment's is shown."""
    cases: dict[tuple[str, str], _Case] = {}
    for experiment in experiments:
        pictures = experiment.pictures()
        for row in experiment.rows:
            if row.case not in pictures:
                continue
            picture = pictures[row.case]
            key = (picture.name, picture.case.get("dataset_sha256", ""))
            case = cases.setdefault(key, _Case(picture.case, experiment.dataset_title(row.dataset)))
            if experiment.name not in case.experiments:
                case.experiments.append(experiment.name)
            if row.name not in case.rows:
                case.rows[row.name] = row
                if row.name in picture.results:
                    case.polygons[row.name] = picture.results[row.name]["polygons"]
    return list(cases.values())


def _error(row: Row) -> float:
    l2 = row.metric("l2")
    return float("inf") if l2 is None else l2


def _leave_out_giants(cases: Sequence[_Case]) -> int:
    """Leaves out results with more than MOST_VERTICES vertices but for the worst of each method; their number."""
    giants: dict[tuple[str, str], list[tuple[float, _Case, str]]] = {}
    for case in cases:
        for name, polygons in case.polygons.items():
            if sum(len(ring) for polygon in polygons for ring in polygon) > 2 * MOST_VERTICES:
                row = case.rows[name]
                giants.setdefault(row.series, []).append((_error(row), case, name))
    count = 0
    for results in giants.values():
        results.sort(key=lambda result: result[0])
        for _, case, name in results[:-1]:
            case.leave_out(name)
            count += 1
    return count


def _size(entries: Iterable[tuple[_Case, dict[str, Any]]]) -> int:
    return sum(_length(entry) + 1 for _, entry in entries)


def _within(entries: list[tuple[_Case, dict[str, Any]]], budget: int) -> list[dict[str, Any]]:
    """The entries that fit, worst first; RULE says which are given up."""
    entries = sorted(entries, key=lambda entry: entry[0].badness(), reverse=True)
    sizes = [_length(entry) + 1 for _, entry in entries]
    counts = Counter(case.experiments[0] for case, _ in entries)
    total = sum(sizes)
    while total > budget and entries:
        largest = max(counts, key=lambda name: counts[name])
        index = max(k for k, (case, _) in enumerate(entries) if case.experiments[0] == largest)
        total -= sizes.pop(index)
        entries.pop(index)
        counts[largest] -= 1
    return [entry for _, entry in entries]


def _document(
    experiments: Sequence[Experiment], cases: Sequence[_Case], kept: list[dict[str, Any]], limit: int, left_out: int
) -> dict[str, Any]:
    shown = {(name, entry["case"]) for entry in kept for name in entry["experiments"]}
    measured = {(experiment.name, row.case) for experiment in experiments for row in experiment.rows}
    packable = {(name, case.name) for case in cases for name in case.experiments}
    return {
        "run_columns": RUN,
        "not_tried": sorted(NOT_TRIED),
        "points_limit": limit,
        "rule": RULE,
        "results_left_out": left_out,
        "without_picture": dict(Counter(name for name, _ in sorted(measured - shown))),
        "dropped": dict(Counter(name for name, _ in sorted(packable - shown))),
        "cases": kept,
    }


def _length(value: Any) -> int:
    return len(json.dumps(value, separators=(",", ":")))


class _Drawing:
    """A case's geometry, coded; only the points are coded anew for another limit."""

    def __init__(self, case: _Case) -> None:
        self._case = case
        self._truth, truth_section = _polygons_section(case.line["ground_truth"])
        self._results: list[list[list[int]]] = []
        self._sections = [truth_section]
        self._index: dict[str, int] = {}
        known: dict[bytes, int] = {}  # methods often agree to the last vertex
        for run in case.rows:
            if run not in case.polygons:
                continue
            counts, section = _polygons_section(case.polygons[run])
            key = json.dumps(counts).encode() + section
            if key not in known:
                known[key] = len(self._results)
                self._results.append(counts)
                self._sections.append(section)
            self._index[run] = known[key]

    def entry(self, points_limit: int) -> dict[str, Any]:
        """What the page gets of the case."""
        case = self._case
        rows = list(case.rows.values())
        count, points = _points_section(case.line["points"], points_limit)
        header = {
            "origin": case.line["origin"],
            "step": case.line["step"] * (1 << _SHIFT),
            "points": count,
            "truth": self._truth,
            "results": self._results,
            "runs": [{"detail": row.detail, "metrics": _shortened(row.metrics)} for row in rows],
        }
        return {
            "case": case.name,
            "experiments": case.experiments,
            "title": case.title,
            "n": rows[0].n,
            "holes": rows[0].holes,
            "runs": [self._run(row) for row in rows],
            "block": _block(header, [points, *self._sections]),
        }

    def _run(self, row: Row) -> list[Any]:
        l2 = row.metrics.get("l2")
        return [
            row.method,
            row.series.protocol,
            row.status,
            None if l2 is None else float(f"{l2:.9g}"),
            None if row.median_ns is None else round(row.median_ns),
            self._index.get(row.name),
        ]


def _shortened(metrics: dict[str, Any]) -> dict[str, Any]:
    """Numbers to six significant digits: more than is shown, and a third of the bytes."""
    kept = {name: value for name, value in metrics.items() if value is not None and value != ""}
    return {name: float(f"{value:.6g}") if isinstance(value, float) else value for name, value in kept.items()}


def _rounded(values: Sequence[int]) -> list[int]:
    half = 1 << (_SHIFT - 1)
    return _clamped([(value + half) >> _SHIFT for value in values], -_FARTHEST, GRID + _FARTHEST)


def _clamped(values: list[int], low: int, high: int) -> list[int]:
    if not values or (min(values) >= low and max(values) <= high):
        return values
    return [min(max(value, low), high) for value in values]


def _points_section(flat: Sequence[int], limit: int) -> tuple[int, bytes]:
    count = len(flat) // 2
    chosen = range(count) if count <= limit else [k * count // limit for k in range(limit)]
    grid = _clamped(_rounded(flat), 0, GRID)
    points = sorted({(grid[2 * k], grid[2 * k + 1]) for k in chosen})
    steps = [after[0] - before[0] for before, after in zip([(0, 0), *points], points)]
    return len(points), _planes(steps) + _planes([y for _, y in points])


def _polygons_section(polygons: Sequence[Sequence[Sequence[int]]]) -> tuple[list[list[int]], bytes]:
    """The number of vertices of each ring of each polygon, and the coded vertices."""
    counts: list[list[int]] = []
    differences: list[int] = []
    last = (0, 0)
    for polygon in sorted(_in_order(polygon) for polygon in polygons):
        if not polygon:
            continue
        counts.append([len(ring) for ring in polygon])
        for ring in polygon:
            for vertex in ring:
                differences += (_zigzag(vertex[0] - last[0]), _zigzag(vertex[1] - last[1]))
                last = vertex
    return counts, _planes(differences)


def _in_order(polygon: Sequence[Sequence[int]]) -> list[list[tuple[int, int]]]:
    """The polygon's rings as vertices, the holes sorted, so that equal polygons of two methods are coded alike; without
    rings when its shell vanishes in the grid."""
    shell, *holes = (_ring(_rounded(ring)) for ring in polygon)
    return [shell, *sorted(hole for hole in holes if hole)] if shell else []


def _ring(flat: Sequence[int]) -> list[tuple[int, int]]:
    """The vertices without repeated ones and without those in the middle of a straight line; from the leftmost one on,
    towards the lower of its neighbours, since methods begin and turn as they like. Empty when fewer than three are left.
    """
    vertices: list[tuple[int, int]] = []
    for vertex in zip(flat[::2], flat[1::2]):
        if vertices and vertices[-1] == vertex:
            continue
        if len(vertices) > 1 and _straight(vertices[-2], vertices[-1], vertex):
            vertices.pop()
        vertices.append(vertex)
    if len(vertices) > 1 and vertices[0] == vertices[-1]:
        vertices.pop()
    if len(vertices) < 3:
        return []
    first = vertices.index(min(vertices))
    vertices = vertices[first:] + vertices[:first]
    return vertices if vertices[1] < vertices[-1] else [vertices[0], *vertices[:0:-1]]


def _straight(a: tuple[int, int], b: tuple[int, int], c: tuple[int, int]) -> bool:
    """Whether b lies between a and c."""
    ux, uy, vx, vy = b[0] - a[0], b[1] - a[1], c[0] - b[0], c[1] - b[1]
    return ux * vy == uy * vx and ux * vx + uy * vy > 0


def _zigzag(value: int) -> int:
    return 2 * value if value >= 0 else -2 * value - 1


def _planes(values: Sequence[int]) -> bytes:
    return bytes(value & 255 for value in values) + bytes(value >> 8 for value in values)


def _block(header: dict[str, Any], sections: Sequence[bytes]) -> str:
    text = json.dumps(header, separators=(",", ":")).encode()
    compressor = zlib.compressobj(9, wbits=31)
    packed = compressor.compress(struct.pack("<I", len(text)) + text)
    for section in sections:
        # Ends the Huffman table. Not for short sections, where a new table is longer than what it saves.
        if len(section) > 400:
            packed += compressor.flush(zlib.Z_FULL_FLUSH)
        packed += compressor.compress(section)
    return base64.b64encode(packed + compressor.flush()).decode()


# Back again.


def is_kept(folder: Path, experiments: Sequence[Experiment]) -> bool:
    """Whether a run has no pictures but those in its report.html, as a kept reference run."""
    page = folder / "report.html"
    if any(one.pictures_file() for one in experiments) or not page.is_file():
        return False
    return kept_data(page.read_text(encoding="utf-8"), "pictures") is not None


def kept_pictures(page: Path, experiments: Sequence[Experiment]) -> list[dict[str, Picture]]:
    """By experiment and case: what a report shows, in its coarser grid."""
    found: list[dict[str, Picture]] = [{} for _ in experiments]
    for entry in kept_data(page.read_text(encoding="utf-8"), "pictures")["cases"]:
        picture = _unpacked(entry)
        for place, experiment in enumerate(experiments):
            if experiment.name in entry["experiments"]:
                found[place][picture.name] = picture
    return found


def _unpacked(entry: dict[str, Any]) -> Picture:
    block = gzip.decompress(base64.b64decode(entry["block"]))
    start = 4 + struct.unpack_from("<I", block)[0]
    header, sections = json.loads(block[4:start]), io.BytesIO(block[start:])

    def numbers(count: int) -> list[int]:
        low, high = sections.read(count), sections.read(count)
        return [one | other << 8 for one, other in zip(low, high)]

    def polygons(counts: Sequence[Sequence[int]]) -> list[list[list[int]]]:
        coded = numbers(2 * sum(map(sum, counts)))
        steps = [-(one >> 1) - 1 if one & 1 else one >> 1 for one in coded]
        corners = zip(itertools.accumulate(steps[::2]), itertools.accumulate(steps[1::2]))
        return [[[value for _ in range(count) for value in next(corners)] for count in rings] for rings in counts]

    xs = itertools.accumulate(numbers(header["points"]))
    points = [value for both in zip(xs, numbers(header["points"])) for value in both]
    truth, *results = [polygons(counts) for counts in (header["truth"], *header["results"])]
    case = {"case": entry["case"], "origin": header["origin"], "step": header["step"]}
    shown = {}
    for method, protocol, _, _, _, place in entry["runs"]:
        if place is not None:
            shown[f"{method}/{entry['case']}/protocol:{protocol}"] = {"polygons": results[place]}
    return Picture({**case, "points_total": entry["n"], "points": points, "ground_truth": truth}, shown)
