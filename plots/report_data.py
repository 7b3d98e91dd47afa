"""What the report's page computes with: the charts' values and all rows as columns, small enough to be put into it."""

import base64
import gzip
import json
import math
import re
from collections import defaultdict
from collections.abc import Callable, Sequence
from typing import Any

from records import Experiment, Row
from report_common import round_to

# Charts show every shape of its own up to this many; above, classes of convexity.
MOST_SHAPES = 60

# Classes of the ground truth's convexity (area over the area of the convex hull): tenths.
BIN_WIDTH = 0.1

# Significant digits: five of these columns and four of the others; in large runs, whose digits are most of the file,
# one less. A table shows four of the errors and three of the times.
MAIN_COLUMNS = {"time", "time_low", "time_high", "paper_time", "metric l2", "metric l2_paper", "metric iou"}
LARGE_RUN = 5000
# What the rows of an experiment with more runs than that have: all metrics of tens of thousands of rows would leave no room
# for pictures.
BRIEF_METRICS = ("l2", "l2_paper", "iou", "hausdorff", "hole_f1", "skill")

# What the page calls a metric's unit, and the factor from the record's number to it; no other one is named.
UNITS = {"bytes": ("MiB", 1 / 2**20), "length": ("length", 1), "length^2": ("length²", 1)}


def is_brief(experiment: Experiment) -> bool:
    return len(experiment.rows) > LARGE_RUN


def pack(value: Any) -> dict[str, Any]:
    """As gzip in base64, which the page decodes with DecompressionStream when it needs the value."""
    plain = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False).encode()
    return {"encoding": "gzip+base64", "bytes": len(plain), "data": base64.b64encode(gzip.compress(plain, 9, mtime=0)).decode()}


class MetricTable:
    """The program's table of metrics, from the records; of reports that have none it is empty and nothing is better."""

    def __init__(self, experiments: Sequence[Experiment]) -> None:
        self._known = {one["name"]: one for experiment in experiments for one in experiment.report.get("metrics", [])}

    def entry(self, name: str) -> dict[str, Any]:
        """As the page has it: "better" is "lower", "higher", "zero" or "one" (the nearer to it), None: neither; "factor"
        leads from the record's number to the unit; "charted": methods can be ranked by it."""
        one = self._known.get(name, {})
        better = one.get("better", "none")
        # A share of something that should not be there is told in percent.
        is_fault = one.get("unit") == "ratio" and better in ("lower", "zero")
        unit, factor = ("%", 100) if is_fault else UNITS.get(one.get("unit", ""), ("", 1))
        return {
            "name": name,
            "title": title_of(name),
            "definition": one.get("definition", ""),
            "unit": unit,
            "factor": factor,
            "better": None if better == "none" else better,
            # What describes the case is the same for all methods; an area says what the error says, in another unit.
            "charted": not one or (one["unit"] != "length^2" and (better != "none" or one["group"] == "size")),
            "whole": one.get("unit") == "count",
        }

    def names(self, rows: Sequence[Row]) -> list[str]:
        """Of all metrics with a number in some row, in the table's order, then the others by name. Not the coordinates of
        where another one was taken."""
        seen = {name for row in rows for name, value in row.metrics.items() if _is_number(value)}
        places = {name for name, one in self._known.items() if (one["group"], one["better"]) == ("boundary", "none")}
        return [name for name in self._known if name in seen - places] + sorted(seen - self._known.keys())

    def charted_names(self, rows: Sequence[Row]) -> list[str]:
        return [name for name in self.names(rows) if self.entry(name)["charted"]]


def title_of(metric: str) -> str:
    """Hole F1 of hole_f1."""
    words = re.sub(r"\biou\b", "IoU", metric.replace("_", " "))
    return re.sub(r"\b[lf](?=\d?\b)", lambda letter: letter.group().upper(), words[0].upper() + words[1:])


# The rows, as columns.


def columns(experiments: Sequence[Experiment]) -> dict[str, Any]:
    """All rows, in the records' order. A column is {"values": [...]}, or with "words" the values are indexes into
    them; a value is null where there is none. A data set is family-member, or family where there is no member; a case is
    its data set and its sample. Scores are called "metric NAME", parameters "parameter NAME". Times in milliseconds."""
    rows = [(index, experiment, row) for index, experiment in enumerate(experiments) for row in experiment.rows]
    large = len(rows) > LARGE_RUN
    digits = 3 if large else 4
    made: dict[str, dict[str, Any]] = {"experiment": {"values": [index for index, _, _ in rows]}}
    words: dict[str, Callable[[Experiment, Row], str]] = {
        "entrant": lambda _, row: row.series.key,
        "family": lambda experiment, row: experiment.family(row.dataset)[0],
        "sample": lambda _, row: row.case.removeprefix(f"{row.dataset}/"),
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
    if any(row.name != composed_name(row) for _, _, row in rows):
        made["name"] = words_of([row.name for _, _, row in rows])
    made["family"]["titles"] = titles_of(experiments, made["family"]["words"])
    made["member"] = {"values": [experiment.family(row.dataset)[1] for _, experiment, row in rows]}
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
            row.metrics.get(name) if name in BRIEF_METRICS or not is_brief(experiment) else None for _, experiment, row in rows
        ]
    for name in sorted({name for _, _, row in rows for name in row.raw["parameters"]}):
        made[f"parameter {name}"] = {"values": [_parameter(row, name, digits) for _, _, row in rows]}
    for name, values in numbers.items():
        kept = digits + 1 if name in MAIN_COLUMNS else digits
        made[name] = {"values": [_rounded(value, kept) for value in values]}
    return {"count": len(rows), "columns": made}


def composed_name(row: Row) -> str:
    """What the page puts a run's name together to."""
    return f"{row.series.method}/{row.case}/protocol:{row.series.protocol}"


def titles_of(experiments: Sequence[Experiment], families: Sequence[str]) -> list[str]:
    known = {name: dataset["title"] for experiment in experiments for name, dataset in experiment.datasets.items()}
    return [known.get(family, family) for family in families]


def words_of(values: list[str]) -> dict[str, Any]:
    words = list(dict.fromkeys(values))
    place = {word: index for index, word in enumerate(words)}
    return {"words": words, "values": [place[value] for value in values]}


def _times(row: Row) -> dict[str, float | None]:
    """In milliseconds."""
    interval = row.interval() or (None, None)
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
    if len(kinds) == len(shapes):  # no families: each class would be one shape
        return [*made, _by_shape(experiment, rest, shapes)]
    return made + [_by_convexity(experiment, kind, rows) for kind, rows in kinds.items()]


def _by_n(experiment: Experiment, dataset: str, holes: bool) -> dict[str, Any]:
    rows = [row for row in experiment.rows if (row.dataset, row.holes) == (dataset, holes)]
    sizes = sorted({row.n for row in rows})
    title = experiment.dataset_title(dataset) + (" with holes" if holes else "")
    series = _series(experiment, rows, lambda row: sizes.index(row.n))
    return {"title": title, "kind": "n", "axis": "Number of points", "x": sizes, **series}


def _shape(experiment: Experiment, row: Row) -> str:
    """Its title."""
    title = experiment.dataset_title(row.dataset).removeprefix("Capital letter ")
    return title + (" with holes" if row.holes else "")


def _by_shape(experiment: Experiment, rows: Sequence[Row], shapes: list[str]) -> dict[str, Any]:
    sizes = {row.n for row in rows}
    title = "Every shape" if len(shapes) > 1 else shapes[0]
    if len(sizes) == 1:
        title += f", n = {next(iter(sizes))}"
    series = _series(experiment, rows, lambda row: shapes.index(_shape(experiment, row)))
    return {"title": title, "kind": "shape", "axis": "Shape", "x": shapes, **series}


def _series(experiment: Experiment, rows: Sequence[Row], place: Callable[[Row], int]) -> dict[str, Any]:
    """The points of every entrant by x, and the rows that have none, by entrant and status."""
    series: dict[str, list[dict[str, Any]]] = {one.key: [] for one in experiment.series()}
    missing: dict[str, list[dict[str, Any]]] = defaultdict(list)
    names = MetricTable([experiment]).charted_names(rows)
    for row in rows:
        key, x = row.series.key, place(row)
        if _has_result(row):
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
        interval = row.interval(which) or (None, None)
        return [None if value is None else round_to(value / 1e6, 5) for value in (told["median_ns"], *interval)]

    scores = {name: _rounded(row.metrics.get(name), 5) for name in names}
    return {
        "x": x,
        "run": row.name,
        "case": row.case,
        "time": values(row.time, "time"),
        "paper_time": values(row.paper_time, "paper_time"),
        "metrics": {name: value for name, value in scores.items() if value is not None},
    }


def _kind(experiment: Experiment, row: Row) -> str:
    """Star-shaped polygon with holes: the title without the member's number."""
    return experiment.dataset_title(experiment.family(row.dataset)[0]) + (" with holes" if row.holes else "")


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
            missing[row.series.key].append({"x": None, "run": row.name, "status": row.status})
        if convexity is not None:
            # A convexity of 1 belongs to the uppermost class, and one of 0.6999... that is 0.7 to its own.
            classes[min(9, math.floor(convexity / BIN_WIDTH + 1e-9))][row.series.key].append(row)
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
        worst = {"lower": math.inf, "zero": math.inf, "higher": -math.inf, "one": -math.inf}
        return worst.get(table.entry(name)["better"])

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
    """The quantile by linear interpolation; infinite as soon as it leans on a value that is."""
    place = q * (len(ordered) - 1)
    below, part = math.floor(place), place % 1
    return ordered[below] * (1 - part) + ordered[below + 1] * part if part else ordered[below]
