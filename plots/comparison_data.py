"""Two runs side by side: what `hullbench compare A B --format json` found, with the records of both runs beside it.

Everything that is judged (ratios, intervals, tests, their correction) comes from the program. Here its pairs are found
again in the records, and what the page needs beside them is put together.
"""

import math
import statistics
from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from records import Experiment, RecordError, Row, Series, read_json
from report_common import label, round_to
from report_data import MetricTable, charts, composed_name, titles_of, words_of
from report_summary import SAME_ERROR

# The changes that the page tells first, in this order.
FIRST = ("now fails", "now works")

# Of times from two machines nothing is said to have become faster or slower: what differs is then only lower or higher.
ACROSS_MACHINES = {"slower": "higher time", "faster": "lower time"}

# Significant digits of the table's numbers.
DIGITS = 5

# What the errors of kept records are rounded by: they have five digits (results/thin_records.py).
THINNED_ERROR = 1e-4


@dataclass(frozen=True)
class Pair:
    """A run that both have. `told` is the program's line about it."""

    a: Row
    b: Row
    experiment: Experiment  # that of A
    told: dict[str, Any]

    @property
    def change(self) -> str:
        return self.told["change"]

    @property
    def judged(self) -> bool:
        return self.told["adjusted_p_value"] is not None

    @property
    def error_change(self) -> float | None:
        """Error L2 of B less that of A; 0 when they differ by rounding only, None when one has none."""
        a, b = self.told["l2_a"], self.told["l2_b"]
        if a is None or b is None:
            return None
        same = THINNED_ERROR if self.a.is_thinned or self.b.is_thinned else SAME_ERROR
        return 0.0 if abs(b - a) <= same * max(abs(a), abs(b)) else b - a

    @property
    def other_inputs(self) -> list[str]:
        """What of the method's input and version is not the same, in words."""
        return [word for word in ("points", "parameters", "version") if not self.told[f"same_{word}"]]

    @property
    def other_result(self) -> bool:
        """Both have a result, of the same points, and it is not the same to the byte; kept records have the first digits of
        its hash."""
        a, b = (one.raw.get("output_sha256") or "" for one in (self.a, self.b))
        return bool(a and b) and not (a.startswith(b) or b.startswith(a)) and self.told["same_points"]


@dataclass(frozen=True)
class MethodChange:
    """A method's pairs together, B over A."""

    series: Series
    label: str
    judged: int  # pairs of which a difference could have been shown
    told: dict[str, Any]  # the program's line: "pairs" with a "ratio", its interval, "faster" and "slower" pairs

    @property
    def ratio(self) -> float | None:
        return self.told["ratio"]

    @property
    def interval(self) -> tuple[float, float] | None:
        """Of 95 %; None: of one shape there is none."""
        low, high = self.told["ratio_low"], self.told["ratio_high"]
        return None if low is None or high is None else (low, high)

    @property
    def change(self) -> str:
        """ "faster" or "slower" only when the interval leaves out 1."""
        if self.ratio is None or self.interval is None:
            return "not judged"
        low, high = self.interval
        return "faster" if high < 1 else "slower" if low > 1 else "not told apart"


@dataclass
class Comparison:
    a: list[Experiment]
    b: list[Experiment]
    names: tuple[str, str]  # of A and B, their folders' names
    pairs: list[Pair]
    methods: list[MethodChange]  # those with a pair
    only_a: list[str]
    only_b: list[str]
    notes: list[str]  # the program's
    machines: tuple[set[str], set[str]]

    @property
    def same_machine(self) -> bool:
        """Both sides were measured on one machine, the same one."""
        a, b = self.machines
        return a == b and len(a) == 1

    @property
    def same_run(self) -> bool:
        """Both sides hold the same records, every repetition included."""
        same = all(pair.a.raw == pair.b.raw for pair in self.pairs)
        return same and bool(self.pairs) and not self.only_a and not self.only_b

    def word(self, change: str) -> str:
        """A pair's or a method's change as the page calls it."""
        return change if self.same_machine else ACROSS_MACHINES.get(change, change)

    def having(self, *changes: str) -> list[Pair]:
        return [pair for pair in self.pairs if pair.change in changes]


def compare(a: list[Experiment], b: list[Experiment], told: dict[str, Any], names: tuple[str, str]) -> Comparison:
    """`told` is what read_compared gives. Raises RecordError when it is not about these two."""
    pairs = _find_pairs(a, b, told["pairs"])
    judged = Counter(pair.a.series for pair in pairs if pair.judged)
    methods = []
    for one in told["methods"]:
        series = Series(one["method"], one["protocol"])
        methods.append(MethodChange(series, label([*a, *b], series), judged[series], one))
    # Stable: the rest stays in the order of A.
    pairs.sort(key=lambda pair: FIRST.index(pair.change) if pair.change in FIRST else len(FIRST))
    machines_a, machines_b = (set().union(*(one.machines() for one in side)) for side in (a, b))
    return Comparison(a, b, names, pairs, methods, told["only_a"], told["only_b"], told["notes"], (machines_a, machines_b))


def read_compared(path: Path) -> dict[str, Any]:
    """What `hullbench compare --format json` wrote. Raises RecordError when it is not that."""
    return read_json(path, "comparison.schema.json", "; 'hullbench compare A B --format json' writes it")


# Finding the program's pairs again.


def _find_pairs(a: Sequence[Experiment], b: Sequence[Experiment], told: Sequence[dict[str, Any]]) -> list[Pair]:
    """The rows of every pair of the program. A suite may have a name in two experiments; then status and time say which
    is meant, and where these are the same, too, those of the same experiment belong together."""
    in_a, in_b = _by_name(a), _by_name(b)
    return [_take(in_a[line["name"]], in_b[line["name"]], line) for line in told]


def _by_name(experiments: Sequence[Experiment]) -> dict[str, list[tuple[Experiment, Row]]]:
    found: dict[str, list[tuple[Experiment, Row]]] = defaultdict(list)
    for experiment in experiments:
        for row in experiment.rows:
            found[row.name].append((experiment, row))
    return found


def _take(in_a: list[tuple[Experiment, Row]], in_b: list[tuple[Experiment, Row]], line: dict[str, Any]) -> Pair:
    """Takes the two rows that the line is about out of those of its name."""
    fitting = [
        (one, other)
        for one in in_a
        if _is_of(one[1], line["status_a"], line["median_a_ns"])
        for other in in_b
        if _is_of(other[1], line["status_b"], line["median_b_ns"])
    ]
    if not fitting:
        raise RecordError(
            f"the comparison is not of these two runs: {line['name']} is not in them as it says; compare them "
            "again with 'hullbench compare A B --format json'."
        )
    one, other = next((pair for pair in fitting if pair[0][0].name == pair[1][0].name), fitting[0])
    in_a.remove(one)
    in_b.remove(other)
    return Pair(one[1], other[1], one[0], line)


def _is_of(row: Row, status: str, median_ns: float | None) -> bool:
    if row.status != status:
        return False
    return median_ns is None or (bool(row.raw["time_ns"]) and math.isclose(statistics.median(row.raw["time_ns"]), median_ns))


# The table and the forest plot: all pairs as columns.


def columns(comparison: Comparison) -> dict[str, Any]:
    """Columns like those of report_data.columns, in milliseconds and in the error's own unit (of the truth's area)."""
    pairs = comparison.pairs
    experiments = [experiment.name for experiment in comparison.a]
    split = [pair.experiment.family(pair.a.dataset) for pair in pairs]
    made = {
        "experiment": {"values": [experiments.index(pair.experiment.name) for pair in pairs]},
        "entrant": words_of([pair.a.series.key for pair in pairs]),
        "family": words_of([family for family, _ in split]),
        "member": {"values": [member for _, member in split]},
        "sample": words_of([pair.a.case.removeprefix(f"{pair.a.dataset}/") for pair in pairs]),
        "n": {"values": [pair.a.n for pair in pairs]},
        "holes": {"values": [int(pair.a.holes) for pair in pairs]},
        "status": words_of([comparison.word(pair.change) for pair in pairs]),
        "detail": words_of([_detail(pair) for pair in pairs]),
        "differs": words_of([_differs(pair) for pair in pairs]),
        "error_change": {"values": [_rounded(pair.error_change) for pair in pairs]},
    }
    made["family"]["titles"] = titles_of([*comparison.b, *comparison.a], made["family"]["words"])
    if any(pair.a.name != composed_name(pair.a) for pair in pairs):
        made["name"] = words_of([pair.a.name for pair in pairs])
    for key in ("ratio", "ratio_low", "ratio_high", "adjusted_p_value", "l2_a", "l2_b"):
        made[key] = {"values": [_rounded(pair.told[key]) for pair in pairs]}
    for side in ("a", "b"):
        made[f"time_{side}"] = {"values": [_rounded(pair.told[f"median_{side}_ns"], 1e-6) for pair in pairs]}
        rows = [pair.a if side == "a" else pair.b for pair in pairs]
        for end, name in enumerate(("low", "high")):
            made[f"time_{side}_{name}"] = {"values": [_end(row, end) for row in rows]}
    return {"count": len(pairs), "columns": made}


def _end(row: Row, end: int) -> float | int | None:
    interval = row.interval()
    return _rounded(interval[end], 1e-6) if interval and row.ok else None


def _detail(pair: Pair) -> str:
    """Why a side has no result."""
    a, b = (f"{row.status}{f', {row.detail}' if row.detail else ''}" if not row.ok else "" for row in (pair.a, pair.b))
    if a and a == b:
        return f"both: {a}"
    return "; ".join(f"{side}: {why}" for side, why in (("A", a), ("B", b)) if why)


def _differs(pair: Pair) -> str:
    """What differs beside the times."""
    return ", ".join(pair.other_inputs + (["result"] if pair.other_result else []))


def _rounded(value: float | None, factor: float = 1) -> float | int | None:
    return None if value is None else round_to(value * factor, DIGITS)


# The charts of time and error: those of the report, both sides in one.


def both_charts(comparison: Comparison) -> list[dict[str, Any]]:
    """The charts of report_data.charts that both sides have, with the series of A and of B: "a" and "b" are objects of
    entrants' points, x is that of both together."""
    others = {_chart_key(comparison.b, chart): chart for chart in charts(comparison.b)}
    made = []
    for chart in charts(comparison.a):
        other = others.get(_chart_key(comparison.a, chart))
        if other is None:
            continue
        x = list(dict.fromkeys([*chart["x"], *other["x"]]))
        if chart["kind"] != "shape":  # shapes stay in the records' order
            x.sort()
        made.append(
            {key: chart[key] for key in ("id", "experiment", "title", "kind", "axis")}
            | {"x": x, "a": _placed(chart, x), "b": _placed(other, x)}
        )
    return made


def _chart_key(experiments: Sequence[Experiment], chart: dict[str, Any]) -> tuple[str, ...]:
    """What it is of. The title of one of every shape tells the number of points, which a filter changes."""
    return experiments[chart["experiment"]].name, chart["kind"], "" if chart["kind"] == "shape" else chart["title"]


def _placed(chart: dict[str, Any], x: list[Any]) -> dict[str, list[dict[str, Any]]]:
    return {
        entrant: [point | {"x": x.index(chart["x"][point["x"]])} for point in points]
        for entrant, points in chart["series"].items()
    }


def charted_metrics(comparison: Comparison) -> list[dict[str, Any]]:
    experiments = [*comparison.a, *comparison.b]
    table = MetricTable(experiments)
    return [table.entry(name) for name in table.charted_names([row for one in experiments for row in one.rows])]
