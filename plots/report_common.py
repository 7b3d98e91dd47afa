"""What every part of the report shares: entrants, cases, intervals, and text that is safe in HTML."""

from __future__ import annotations

import html
import math
import statistics
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from records import Experiment, Row

CORE = "polylidar"

PROTOCOLS = {
    "paper": "chosen by the paper's rules, which look at the ground truth",
    "default": "the method's own defaults",
    "auto": "chosen by a rule from the points alone",
    "tuned": "tuned on other shapes",
    "oracle": "the best for this very case, found with the ground truth",
}

STATUS_WORDS = {
    "ok": "ok",
    "timeout": "timed out",
    "memory": "out of memory",
    "crash": "crashed",
    "error": "ended with an error",
    "invalid_output": "gave an invalid polygon",
    "unsupported": "does not support the case",
    "not_installed": "not installed",
}


@dataclass(frozen=True, order=True)
class Entrant:
    """A method under one protocol: what is compared. Results of two protocols are never put together."""

    method: str
    protocol: str

    @property
    def key(self) -> str:
        return f"{self.method}/{self.protocol}"


def entrant_of(row: Row) -> Entrant:
    return Entrant(row.method, row.protocol)


def case_of(row: Row) -> str:
    """The run's name without method and protocol, such as ca/n:2000/holes:0; with the seed where a name has it."""
    parts = row.name.split("/")
    return "/".join(parts[1:-1]) if len(parts) > 2 else row.case


def entrants_of(experiment: Experiment) -> list[Entrant]:
    """In the order of the records, which is that of the plan."""
    return list(dict.fromkeys(entrant_of(row) for row in experiment.rows))


def method_title(experiments: Sequence[Experiment], method: str) -> str:
    for experiment in experiments:
        if method in experiment.methods:
            return experiment.methods[method]["title"]
    return method


def label(experiments: Sequence[Experiment], entrant: Entrant) -> str:
    """As the tables write it: CGAL alpha shape (paper)."""
    return f"{method_title(experiments, entrant.method)} ({entrant.protocol})"


def dataset_title(experiment: Experiment, name: str) -> str:
    """California; for a member of a family, Simulated floor 3."""
    if name in experiment.datasets:
        return experiment.datasets[name]["title"]
    family, _, member = name.rpartition("-")
    if family in experiment.datasets and member.isdigit():
        return f"{experiment.datasets[family]['title']} {member}"
    return name


def median_interval(row: Row, which: str = "time") -> tuple[float, float] | None:
    """The 95 % interval of the median in nanoseconds: that of the record, or for records that have none yet the order
    statistics whose coverage is at least 95 % whatever the distribution (binomial); None for fewer than 6 times."""
    told = getattr(row, which)
    if told is None:
        return None
    low, high = told.get("median_low_ns"), told.get("median_high_ns")
    if low is not None and high is not None:
        return low, high
    if which != "time" or "median_low_ns" in told:
        return None
    times = sorted(row.raw["time_ns"])
    rank = _binomial_rank(len(times))
    return (float(times[rank]), float(times[-1 - rank])) if rank is not None else None


def _binomial_rank(count: int) -> int | None:
    """The largest k for which the k-th smallest and k-th largest (from 0) enclose the median with 95 %; None: none."""
    outside, rank = 0.0, None
    for k in range(count // 2):
        outside += 2 * math.comb(count, k) / 2**count
        if outside > 0.05:
            break
        rank = k
    return rank


def spread(row: Row) -> float | None:
    """Median absolute deviation over median; None below 3 repetitions."""
    told = row.time
    if not told or told["repetitions"] < 3 or not told["median_ns"]:
        return None
    return told["mad_ns"] / told["median_ns"]


def quantile(values: Sequence[float], q: float) -> float:
    """By linear interpolation between the order statistics at q * (n - 1), as the program's own."""
    ordered = sorted(values)
    place = q * (len(ordered) - 1)
    below = math.floor(place)
    above = min(below + 1, len(ordered) - 1)
    return ordered[below] + (ordered[above] - ordered[below]) * (place - below)


def median(values: Iterable[float]) -> float:
    return statistics.median(values)


def round_to(value: float, digits: int) -> float | int:
    """To significant digits; a whole number becomes an int, which is shorter in JSON."""
    rounded = float(f"{value:.{digits}g}")
    return int(rounded) if rounded.is_integer() and abs(rounded) < 1e15 else rounded


def number(value: float) -> str:
    """For people: three significant digits, no exponent between a thousandth and a million."""
    if math.isinf(value):
        return "∞"
    value = float(f"{value:.3g}")  # first, so that 0.9999 and 1 are written alike
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e6:
        digits = max(0, 2 - math.floor(math.log10(abs(value))))
        return f"{value:.{digits}f}"
    return f"{value:.3g}"


def milliseconds(ns: float) -> str:
    return number(ns / 1e6)


def count_of(count: int, noun: str) -> str:
    """1 case, 2 cases."""
    return f"{count} {noun}{'' if count == 1 else 's'}"


def sentence_list(words: Sequence[str]) -> str:
    """a, b and c."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def text(value: object) -> str:
    """Escaped for HTML text and attributes: whatever a record says stays text."""
    return html.escape(str(value), quote=True)
