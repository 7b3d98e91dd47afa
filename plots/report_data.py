"""What the report's page computes with: the charts' values and all rows as columns, small enough to be put into it."""

from __future__ import annotations

import base64
import gzip
import json
import math
from collections import defaultdict
from collections.abc import Callable, Sequence
from typing import Any

from records import Experiment, Row
from report_common import case_of, dataset_title, entrant_of, entrants_of, median_interval, quantile, round_to

# Charts show every shape of its own up to this many; above, classes of convexity.
MOST_SHAPES = 60

# Classes of the ground truth's convexity (area over the area of the convex hull): tenths.
BIN_WIDTH = 0.1

# The scores that come first, with the title, the unit and the factor from the record's number to that unit.
METRICS: dict[str, tuple[str, str, float]] = {
    "l2": ("Error L2, of the ground truth's area", "%", 100),
    "l2_paper": ("Error L2 as the paper divides it, of the result's area", "%", 100),
    "iou": ("Intersection over union", "", 1),
    "omission": ("Omission", "%", 100),
    "commission": ("Commission", "%", 100),
    "area_bias": ("Area bias", "%", 100),
    "perimeter_ratio": ("Perimeter over the truth's", "", 1),
    "hausdorff": ("Hausdorff distance", "length", 1),
    "hausdorff_to_truth": ("Hausdorff distance, result to truth", "length", 1),
    "hausdorff_to_result": ("Hausdorff distance, truth to result", "length", 1),
    "boundary_p95": ("Boundary distance, 95th percentile", "length", 1),
    "boundary_mean": ("Boundary distance, mean", "length", 1),
    "f_score_1h": ("Boundary F-score within 1 spacing", "", 1),
    "f_score_2h": ("Boundary F-score within 2 spacings", "", 1),
    "f_score_4h": ("Boundary F-score within 4 spacings", "", 1),
    "boundary_iou": ("Boundary IoU", "", 1),
    "polygons": ("Polygons", "", 1),
    "holes": ("Holes found", "", 1),
    "polygons_error": ("Error in the number of polygons", "", 1),
    "holes_error": ("Error in the number of holes", "", 1),
    "hole_precision": ("Holes, precision", "", 1),
    "hole_recall": ("Holes, recall", "", 1),
    "hole_f1": ("Holes, F1", "", 1),
    "slivers": ("Slivers", "", 1),
    "points_covered": ("Points covered", "%", 100),
    "vertices_from_input": ("Vertices that are input points", "%", 100),
    "vertices": ("Vertices", "", 1),
    "peak_memory_bytes": ("Peak memory", "MiB", 1 / 2**20),
    "skill": ("Skill", "", 1),
    "l2_convex_hull": ("Error L2 of the convex hull", "%", 100),
    "l2_best_triangles": ("Error L2 of the best set of triangles", "%", 100),
    "area": ("Area", "length²", 1),
    "ground_truth_area": ("Area of the ground truth", "length²", 1),
    "ground_truth_convexity": ("Convexity of the ground truth", "", 1),
    "symmetric_difference_area": ("Area of the symmetric difference", "length²", 1),
}

# Says what l2 says.
NOT_CHARTED = {"symmetric_difference_area"}

# Numbers of things.
WHOLE = {"polygons", "holes", "polygons_error", "holes_error", "slivers", "vertices"}

# In no column: what the status says already.
NO_COLUMN = {"valid", "invalid_reason"}

# Significant digits: five of these columns and four of the others; in large runs, whose digits are most of the file,
# one less. A table shows four of the errors and three of the times.
MAIN_COLUMNS = {"time", "time_low", "time_high", "paper_time", "metric l2", "metric l2_paper", "metric iou"}
LARGE_RUN = 5000
# What the rows of an experiment with more runs than that have: all metrics of tens of thousands of rows would leave no room
# for pictures.
BRIEF_METRICS = ("l2", "l2_paper", "iou", "hausdorff", "hole_f1", "skill")


def is_brief(experiment: Experiment) -> bool:
    return len(experiment.rows) > LARGE_RUN



def pack(value: Any) -> dict[str, Any]:
    """As gzip in base64, which the page decodes with DecompressionStream when it needs the value."""
    plain = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False).encode()
    return {
        "encoding": "gzip+base64",
        "bytes": len(plain),
        "data": base64.b64encode(gzip.compress(plain, 9, mtime=0)).decode(),
    }


class MetricTable:
    """The program's table of metrics, from the records; of older reports, which have none, it is empty and nothing is
    better."""

    def __init__(self, experiments: Sequence[Experiment]) -> None:
        self._known = {one["name"]: one for experiment in experiments for one in experiment.report.get("metrics", [])}

    def better(self, name: str) -> str | None:
        """Which values are: "lower", "higher", "zero" or "one" (the nearer to it); None: neither."""
        told = self._known.get(name, {}).get("better", "none")
        return None if told == "none" else told

    def is_place(self, name: str) -> bool:
        """Whether it is a coordinate of where another metric was taken."""
        one = self._known.get(name, {})
        return one.get("group") == "boundary" and one.get("better") == "none"

    def is_charted(self, name: str) -> bool:
        """What describes the case, such as the spacing, is the same for all methods and is no metric to rank by."""
        one = self._known.get(name)
        if name in NOT_CHARTED:
            return False
        return one is None or one["better"] != "none" or one["group"] == "size"

    def entry(self, name: str) -> dict[str, Any]:
        """As the page has it."""
        title, unit, factor = METRICS.get(name, (name.replace("_", " ").capitalize(), "", 1))
        return {
            "name": name,
            "title": title,
            "unit": unit,
            "factor": factor,
            "better": self.better(name),
            "charted": self.is_charted(name),
            "whole": name in WHOLE,
        }

    def names(self, rows: Sequence[Row]) -> list[str]:
        """Of all metrics with a number in some row: those with a title first, in its order, then the others by
        name."""
        seen = {name for row in rows for name, value in row.metrics.items() if _is_number(value)}
        seen = {name for name in seen - NO_COLUMN if not self.is_place(name)}
        return [name for name in METRICS if name in seen] + sorted(seen - METRICS.keys())

    def charted_names(self, rows: Sequence[Row]) -> list[str]:
        return [name for name in self.names(rows) if self.is_charted(name)]


# The rows, as columns.


def columns(experiments: Sequence[Experiment]) -> dict[str, Any]:
    """All rows, in the records' order. A column is {"values": [...]}, or with "words" the values are indexes into
    them; a value is null where there is none. A data set is family-member, or
    family where there is no member; a case is its data set and its sample. Scores are called "metric NAME", parameters "parameter NAME". Times in
    milliseconds."""
    rows = [(index, experiment, row) for index, experiment in enumerate(experiments) for row in experiment.rows]
    large = len(rows) > LARGE_RUN
    digits = 3 if large else 4
    made: dict[str, dict[str, Any]] = {"experiment": {"values": [index for index, _, _ in rows]}}
    words: dict[str, Callable[[Experiment, Row], str]] = {
        "entrant": lambda _, row: entrant_of(row).key,
        "family": lambda _, row: member_of(row.dataset)[0],
        "sample": lambda _, row: case_of(row).removeprefix(f"{row.dataset}/"),
        "status": lambda _, row: row.status,
        "detail": lambda _, row: row.detail,
        "flags": lambda _, row: " ".join(row.raw.get("flags", [])),
        "version": lambda _, row: row.raw.get("method_version", ""),
        "output": lambda _, row: row.raw.get("output_sha256", "")[:12],
    }
    if large:
        del words["output"]  # nothing compresses a hash
    for name, value in words.items():
        made[name] = words_of([value(experiment, row) for _, experiment, row in rows])
    if any(row.name != f"{row.method}/{case_of(row)}/protocol:{row.protocol}" for _, _, row in rows):
        made["name"] = words_of([row.name for _, _, row in rows])
    made["family"]["titles"] = _titles(experiments, made["family"]["words"])
    made["member"] = {"values": [member_of(row.dataset)[1] for _, _, row in rows]}
    made["n"] = {"values": [row.n for _, _, row in rows]}
    made["holes"] = {"values": [int(row.holes) for _, _, row in rows]}
    made["seed"] = {"values": [row.raw.get("seed") for _, _, row in rows]}
    made["repetitions"] = {"values": [len(row.raw["time_ns"]) for _, _, row in rows]}
    numbers: dict[str, list[float | None]] = defaultdict(list)
    for _, _, row in rows:
        for name, value in _times(row).items():
            numbers[name].append(value)
    for name in MetricTable(experiments).names([row for _, _, row in rows]):
        numbers[f"metric {name}"] = [
            row.metrics.get(name) if name in BRIEF_METRICS or not is_brief(experiment) else None
            for _, experiment, row in rows
        ]
    for name in sorted({name for _, _, row in rows for name in row.raw["parameters"]}):
        made[f"parameter {name}"] = {"values": [_parameter(row, name, digits) for _, _, row in rows]}
    for name, values in numbers.items():
        kept = digits + 1 if name in MAIN_COLUMNS else digits
        made[name] = {"values": [_rounded(value, kept) for value in values]}
    return {"count": len(rows), "columns": made}


def member_of(dataset: str) -> tuple[str, int | None]:
    """star-17 is number 17 of the family star; a single shape has no number."""
    family, _, number = dataset.rpartition("-")
    return (family, int(number)) if family and number.isdigit() and str(int(number)) == number else (dataset, None)


def _titles(experiments: Sequence[Experiment], families: Sequence[str]) -> list[str]:
    known = {name: dataset["title"] for experiment in experiments for name, dataset in experiment.datasets.items()}
    return [known.get(family, family) for family in families]


def words_of(values: list[str]) -> dict[str, Any]:
    words = list(dict.fromkeys(values))
    place = {word: index for index, word in enumerate(words)}
    return {"words": words, "values": [place[value] for value in values]}


def _times(row: Row) -> dict[str, float | None]:
    """In milliseconds."""
    interval = median_interval(row) or (None, None)
    paper = row.paper_time["median_ns"] if row.paper_time else None
    in_ns = {"time": row.median_ns, "time_low": interval[0], "time_high": interval[1], "paper_time": paper}
    return {name: None if value is None else value / 1e6 for name, value in in_ns.items()}


def _parameter(row: Row, name: str, digits: int) -> float | str | None:
    """A parameter's value; null in the record is no limit, and the method may not have it at all."""
    if name not in row.raw["parameters"]:
        return None
    value = row.raw["parameters"][name]
    return "∞" if value is None else _rounded(value, digits)


def _rounded(value: Any, digits: int) -> float | int | None:
    return round_to(float(value), digits) if _is_number(value) else None


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


# The charts.


def charts(experiments: Sequence[Experiment]) -> list[dict[str, Any]]:
    """One object a chart: {"experiment", "title", "kind", "axis", "points": [...], "series": {entrant: [point, ...]}}.

    kind "n": the x are numbers of points; "shape": names of shapes; "convexity": classes of it, of many shapes, whose
    points are medians with the 5th and 95th percentile (None: without an end, as too many failed). A point is {"x": index,
    "run", "time": [median, low, high], "paper_time": likewise, "metrics": {name: value or [median, low, high]}}; times in
    milliseconds."""
    made = []
    for index, experiment in enumerate(experiments):
        for chart in _charts(experiment):
            made.append({"id": f"chart-{len(made)}", "experiment": index, **chart})
    return made


def _charts(experiment: Experiment) -> list[dict[str, Any]]:
    by_shape: dict[tuple[str, bool], set[int]] = defaultdict(set)
    for row in experiment.rows:
        by_shape[row.dataset, row.holes].add(row.n)
    growing = [shape for shape, sizes in by_shape.items() if len(sizes) >= 2]
    made = [_by_n(experiment, *shape) for shape in growing]
    rest = [row for row in experiment.rows if (row.dataset, row.holes) not in growing]
    if not rest:
        return made
    shapes = list(dict.fromkeys(_shape(experiment, row) for row in rest))
    if len(shapes) <= MOST_SHAPES:
        return [*made, _by_shape(experiment, rest, shapes)]
    kinds: dict[str, list[Row]] = defaultdict(list)
    for row in rest:
        kinds[_kind(experiment, row)].append(row)
    return made + [_by_convexity(experiment, kind, rows) for kind, rows in kinds.items()]


def _by_n(experiment: Experiment, dataset: str, holes: bool) -> dict[str, Any]:
    rows = [row for row in experiment.rows if (row.dataset, row.holes) == (dataset, holes)]
    sizes = sorted({row.n for row in rows})
    title = dataset_title(experiment, dataset) + (" with holes" if holes else "")
    return {
        "title": title,
        "kind": "n",
        "axis": "Number of points",
        "x": sizes,
        **_series(experiment, rows, lambda row: sizes.index(row.n)),
    }


def _shape(experiment: Experiment, row: Row) -> str:
    """Its title; with what tells it from others of the experiment."""
    sizes = {other["n"] for other in experiment.plan.get("cases", []) if isinstance(other.get("n"), int)}
    title = dataset_title(experiment, row.dataset).removeprefix("Capital letter ")
    return title + (" with holes" if row.holes else "") + (f", n = {row.n}" if len(sizes) > 1 else "")


def _by_shape(experiment: Experiment, rows: Sequence[Row], shapes: list[str]) -> dict[str, Any]:
    sizes = {row.n for row in rows}
    title = "Every shape" if len(shapes) > 1 else shapes[0]
    if len(sizes) == 1:
        title += f", n = {next(iter(sizes))}"
    return {
        "title": title,
        "kind": "shape",
        "axis": "Shape",
        "x": shapes,
        **_series(experiment, rows, lambda row: shapes.index(_shape(experiment, row))),
    }


def _series(experiment: Experiment, rows: Sequence[Row], place: Callable[[Row], int]) -> dict[str, Any]:
    """The points of every entrant by x, and the rows that have none, by entrant and status."""
    series: dict[str, list[dict[str, Any]]] = {entrant.key: [] for entrant in entrants_of(experiment)}
    missing: dict[str, list[dict[str, Any]]] = defaultdict(list)
    names = MetricTable([experiment]).charted_names(rows)
    for row in rows:
        key, x = entrant_of(row).key, place(row)
        if row.ok and row.median_ns is not None:
            series[key].append(_point(row, x, names))
        else:
            missing[key].append({"x": x, "run": row.name, "status": row.status})
    for points in series.values():
        points.sort(key=lambda point: point["x"])
    return {"series": {key: points for key, points in series.items() if points}, "missing": missing}


def _point(row: Row, x: int, names: Sequence[str]) -> dict[str, Any]:
    def values(told: dict[str, Any] | None, which: str) -> list[float | None] | None:
        if not told:
            return None
        interval = median_interval(row, which) or (None, None)
        return [None if value is None else round_to(value / 1e6, 5) for value in (told["median_ns"], *interval)]

    scores = {name: _rounded(row.metrics.get(name), 5) for name in names}
    return {
        "x": x,
        "run": row.name,
        "case": case_of(row),
        "time": values(row.time, "time"),
        "paper_time": values(row.paper_time, "paper_time"),
        "metrics": {name: value for name, value in scores.items() if value is not None},
    }


def _kind(experiment: Experiment, row: Row) -> str:
    """Star-shaped polygon with holes: the title without the member's number."""
    return dataset_title(experiment, member_of(row.dataset)[0]) + (" with holes" if row.holes else "")


def _by_convexity(experiment: Experiment, kind: str, rows: Sequence[Row]) -> dict[str, Any]:
    """The shapes of a kind in classes of convexity, those that have shapes. A run without a result is infinitely bad."""
    table = MetricTable([experiment])
    names = table.charted_names(rows)
    # A run that failed has no metrics; its shape is another run's too.
    convexities = {
        (row.dataset, row.holes): row.metrics["ground_truth_convexity"]
        for row in rows
        if _is_number(row.metrics.get("ground_truth_convexity"))
    }
    classes: dict[int, dict[str, list[Row]]] = defaultdict(lambda: defaultdict(list))
    missing: dict[str, list[dict[str, Any]]] = defaultdict(list)
    for row in rows:
        convexity = convexities.get((row.dataset, row.holes))
        if not _has_result(row):
            missing[entrant_of(row).key].append({"x": None, "run": row.name, "status": row.status})
        if convexity is not None:
            # A convexity of 1 belongs to the uppermost class, and one of 0.6999... that is 0.7 to its own.
            classes[min(9, math.floor(convexity / BIN_WIDTH + 1e-9))][entrant_of(row).key].append(row)
    order = sorted(classes)
    series: dict[str, list[dict[str, Any]]] = defaultdict(list)
    for x, number in enumerate(order):
        for key, members in classes[number].items():
            series[key].append(_class_point(x, members, names, table))
    return {
        "title": f"{kind}, by convexity",
        "kind": "convexity",
        "axis": "Convexity of the ground truth",
        "x": [f"{number * BIN_WIDTH:.1f}–{(number + 1) * BIN_WIDTH:.1f}" for number in order],
        "series": dict(series),
        "missing": missing,
    }


def _has_result(row: Row) -> bool:
    return row.ok and row.median_ns is not None


def _class_point(x: int, rows: Sequence[Row], names: Sequence[str], table: MetricTable) -> dict[str, Any]:
    solved = [row for row in rows if _has_result(row)]
    failures = len(rows) - len(solved)

    def three(values: list[float], worst: float | None, factor: float = 1) -> list[float | None] | None:
        """Median and the range of nine in ten shapes; no range where it has no end, nothing where most failed."""
        ordered = sorted(values + [worst] * failures if worst is not None else values)
        if not values or not math.isfinite(middle := _of_rank(ordered, 0.5)):
            return None
        low, high = _of_rank(ordered, 0.05), _of_rank(ordered, 0.95)
        ends = [low, high] if math.isfinite(low) and math.isfinite(high) else [None, None]
        return [None if value is None else round_to(value * factor, 5) for value in (middle, *ends)]

    def worst_of(name: str) -> float | None:
        return {"lower": math.inf, "zero": math.inf, "higher": -math.inf, "one": -math.inf}.get(table.better(name) or "")

    scores = {
        name: three([row.metrics[name] for row in solved if _is_number(row.metrics.get(name))], worst_of(name))
        for name in names
    }
    return {
        "x": x,
        "count": len(solved),
        "time": three([row.median_ns for row in solved], math.inf, 1e-6),
        "paper_time": three([row.paper_time["median_ns"] for row in solved if row.paper_time], math.inf, 1e-6),
        "metrics": {name: value for name, value in scores.items() if value is not None},
    }


def _of_rank(ordered: Sequence[float], q: float) -> float:
    """The quantile of values some of which may be infinite: infinite as soon as it leans on one."""
    place = q * (len(ordered) - 1)
    neighbours = {ordered[math.floor(place)], ordered[math.ceil(place)]}
    return quantile(ordered, q) if all(map(math.isfinite, neighbours)) else next(filter(math.isinf, neighbours))
