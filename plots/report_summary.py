"""Experiment by experiment: who is fastest, who is most accurate, where each fails, computed from the records.

Every comparison is between two entrants from the times of equal work; an entrant is a method under one protocol. A case
that only one of them solved is infinitely bad for the other: a method that fails where it is slowest must not look
faster than it is. What is faster is not decided here but read from the report's summary.
"""

import math
from collections import Counter, defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from statistics import median
from typing import Any

from records import Experiment, Row, Series
from report_common import CORE, STATUS_WORDS, TOLD_BY, count_of, label, number, sentence_list

# Two errors closer than this are the same shape, written in another order: their areas differ by rounding only.
SAME_ERROR = 1e-9


@dataclass(frozen=True)
class Ratio:
    """An entrant's values over the core's, a case that only one of them solved included."""

    cases: int
    median: float
    low: float
    high: float
    lower_in: int  # cases in which the entrant's value is lower than the core's beyond doubt


@dataclass
class Standing:
    """One entrant in one experiment."""

    series: Series
    label: str
    planned: int = 0
    failures: Counter[str] = field(default_factory=Counter)  # by status, ok left out
    reasons: dict[str, Counter[str]] = field(default_factory=dict)  # by status: the details, most frequent first
    results: dict[str, Row] = field(default_factory=dict)  # the ok rows by case
    failed: set[str] = field(default_factory=set)  # the other cases; none of a method that is not installed
    fastest_in: int = 0  # cases in which it is faster beyond doubt than every other method
    most_accurate_in: int = 0
    time: Ratio | None = None  # beside the core; None: it is the core, or no case in common
    error: Ratio | None = None


@dataclass
class Summary:
    """Of one experiment."""

    experiment: Experiment
    standings: list[Standing]
    core: Standing | None  # the core's standing, under the paper's protocol if there are several
    contested: int  # cases with results of two methods or more; who tells a method's steps is no other method
    without_interval: bool  # of no time there is an interval: one repetition
    compared_errors: int


def summarise(experiment: Experiment) -> Summary:
    standings = {series: Standing(series, label([experiment], series)) for series in experiment.series()}
    for row in experiment.rows:
        _count(standings[row.series], row)
    everyone = list(standings.values())
    core = min(
        (one for one in everyone if one.series.method == CORE), key=lambda one: one.series.protocol != "paper", default=None
    )
    by_case: dict[str, list[tuple[Standing, Row]]] = defaultdict(list)
    for one in everyone:
        for case, row in one.results.items():
            by_case[case].append((one, row))
    contested = sum(len({TOLD_BY.get(row.method, row.method) for _, row in contest}) > 1 for contest in by_case.values())
    compared = sum(_award_error(contest) for contest in by_case.values())
    for one in everyone:
        if core is not None and one is not core:
            one.time = _ratio(one, core, _time_ratio, lambda row, _: row.faster)
            one.error = _ratio(one, core, _error_ratio, _is_more_accurate)
    timed = [row for one in everyone for row in one.results.values()]
    without_interval = bool(timed) and all(row.interval() is None for row in timed)
    return Summary(experiment, everyone, core, contested, without_interval, compared)


def _count(standing: Standing, row: Row) -> None:
    standing.planned += 1
    if row.ok and row.median_ns is not None:
        standing.results[row.case] = row
        standing.fastest_in += row.fastest
    elif not row.ok:
        standing.failures[row.status] += 1
        if row.status != "not_installed":
            standing.failed.add(row.case)
        standing.reasons.setdefault(row.status, Counter())[row.detail] += 1


def _award_error(contest: list[tuple[Standing, Row]]) -> int:
    """Gives the case to the entrants with the least error, several if it is the same; 1 when two could be compared."""
    scored = [(standing, error) for standing, row in contest if (error := row.metric("l2")) is not None]
    if len(scored) < 2:
        return 0
    least = min(error for _, error in scored)
    for standing, error in scored:
        standing.most_accurate_in += error <= least * (1 + SAME_ERROR)
    return 1


def _is_more_accurate(one: Row, other: Row) -> bool:
    first, second = one.metric("l2"), other.metric("l2")
    return second - first > SAME_ERROR * second


def _time_ratio(one: Row, other: Row) -> float | None:
    """The median over the rounds that both were measured in; rows that do not tell their rounds have them in order."""

    def by_round(row: Row) -> dict[int, int]:
        times = row.raw["time_ns"]
        return dict(zip(row.raw.get("rounds") or range(len(times)), times))

    beside = by_round(other)
    ratios = [time / beside[place] for place, time in by_round(one).items() if beside.get(place)]
    return median(ratios) if ratios else None


def _error_ratio(one: Row, other: Row) -> float | None:
    first, second = one.metric("l2"), other.metric("l2")
    return first / second if first is not None and second else None


def _ratio(
    one: Standing, core: Standing, ratio_of: Callable[[Row, Row], float | None], is_lower: Callable[[Row, Row], bool]
) -> Ratio | None:
    ratios, lower_in = [], 0
    for case in one.results.keys() & core.results.keys():
        row, beside = one.results[case], core.results[case]
        if (ratio := ratio_of(row, beside)) is not None:
            ratios.append(ratio)
            lower_in += is_lower(row, beside)
    if not ratios:
        return None
    only_core, only_one = len(one.failed & core.results.keys()), len(core.failed & one.results.keys())
    ratios += [math.inf] * only_core + [0.0] * only_one
    return Ratio(len(ratios), median(ratios), min(ratios), max(ratios), lower_in + only_one)


# Sentences. They are plain text: whoever puts them into a page escapes them.


def headline_sentences(summary: Summary) -> list[str]:
    """The fastest method with the same polygons as the core, then the paper's rival and what it does more."""
    headline = summary.experiment.report["summary"].get("headline")
    if not headline:  # no rival, or an older report
        return []

    def name(line: dict[str, Any]) -> str:
        return label([summary.experiment], Series(line["method"], line["protocol"]))

    core = name(headline["reference"])
    said = []
    for rival in headline["rivals"]:
        median_ratio = math.inf if rival["median"] is None else rival["median"]
        interval = ""
        if rival["low"] is not None:
            high = math.inf if rival["high"] is None else rival["high"]
            interval = f" (95 %: {number(rival['low'])} to {number(high)})"
        cases = count_of(rival["cases"], "case")
        failed = f", of which it failed {rival['failures']}" if rival["failures"] else ""
        same = "the same polygons" if rival["same_polygons"] else "other polygons"
        more = f". {rival['does_more']}" if "does_more" in rival else "."
        said.append(f"{name(rival)}, {same}: {number(median_ratio)} times the time of {core}{interval}, {cases}{failed}{more}")
    if not any(rival["same_polygons"] for rival in headline["rivals"]):
        said.insert(0, f"no other method gives the same polygons as {core}.")
    return said


# Characters of a reason in a sentence; the table of all runs has the whole.
MOST_REASON = 300


def failure_sentences(summaries: Sequence[Summary]) -> list[tuple[str, str]]:
    """(entrant, sentence) for every entrant and status that is not ok, over all experiments, with the most frequent
    reason."""
    found: dict[tuple[Series, str], list[tuple[Summary, Standing]]] = defaultdict(list)
    for summary in summaries:
        for one in summary.standings:
            for status in one.failures:
                found[one.series, status].append((summary, one))
    said = []
    for (series, status), entries in found.items():
        failed = sum(one.failures[status] for _, one in entries)
        planned = sum(one.planned for summary in summaries for one in summary.standings if one.series == series)
        where = sentence_list([f"{summary.experiment.title} {one.failures[status]}" for summary, one in entries])
        reasons = sum((one.reasons[status] for _, one in entries), Counter())
        said.append(
            (
                entries[0][1].label,
                f"{STATUS_WORDS.get(status, status)} in {failed} of {count_of(planned, 'run')}"
                + (f" ({where})" if len(summaries) > 1 else "")
                + _reason(reasons),
            )
        )
    return said


def _reason(reasons: Counter[str]) -> str:
    reason, _ = reasons.most_common(1)[0]
    if not reason:
        return "."
    often = ", most often" if len(reasons) > 1 else ""
    if len(reason) > MOST_REASON:
        return f"{often}: {reason[:MOST_REASON].rsplit(' ', 1)[0]} …"
    return f"{often}: {reason.rstrip('.')}."


def noise_sentence(experiments: Sequence[Experiment]) -> str:
    """The records' own verdict on each experiment."""
    noise = {one.title: one.report["summary"].get("noise") for one in experiments}
    said = [
        (titles, words)
        for verdict, words in (
            (True, "are noisy: differences of some per cent are nothing to go by"),
            (False, "are steady"),
            (None, "have fewer than 3 repetitions, so nothing can be said about noise"),
        )
        if (titles := [title for title, told in noise.items() if (told["noisy"] if told else None) is verdict])
    ]
    return " ".join(f"The times of {sentence_list(titles)} {words}." for titles, words in said)


def mixture_sentence(experiments: Sequence[Experiment]) -> str:
    """Whose times do not belong together, as those of a merged run; empty where all do."""

    def is_mixed(one: Experiment) -> bool:
        builds = {part["tool"]["binary_sha256"] for part in one.report.get("merged", [one.report])}
        return len(one.machines(with_times=True)) > 1 or len(builds) > 1

    mixed = [one.title for one in experiments if is_mixed(one)]
    said = "are of several machines or builds of the program: to compare them is to compare these as well"
    return f"The times of {sentence_list(mixed)} {said}." if mixed else ""
