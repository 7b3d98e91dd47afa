"""The summary: who is fastest, who is most accurate, where each fails, computed from the records.

Every comparison is between two entrants from the times of equal work; an entrant is a method under one protocol. A case
that only one of them solved is infinitely bad for the other: a method that fails where it is slowest must not look
faster than it is. What is faster is not decided here but read from the report's summary.
"""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from statistics import median
from typing import Any

from records import Experiment, Row, Series
from report_common import CORE, STATUS_WORDS, count_of, label, number, sentence_list

# Two errors closer than this are the same shape, written in another order: their areas differ by rounding only.
SAME_ERROR = 1e-9

# An error up to so many times the core's is comparable with it.
COMPARABLE = 2


@dataclass(frozen=True)
class Ratio:
    """An entrant's values over the core's, a case that only one of them solved included."""

    cases: int
    failures: int  # of these: only the core has a result
    median: float
    low: float
    high: float
    lower_in: int  # cases in which the entrant's value is lower than the core's beyond doubt
    higher_in: int


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

    name: str
    title: str
    standings: list[Standing]
    core: Standing | None  # the core's standing, under the paper's protocol if there are several
    contested: int  # cases with results of two methods or more
    fastest_in: Counter[str]  # by method: the contested cases in which one of its entrants is the fastest
    without_interval: bool  # of no time there is an interval: one repetition
    compared_errors: int
    headline: dict[str, Any] | None  # as results/report.schema.json; None: no rival, or an older report
    titles: dict[str, str]  # of the methods in it


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
    contests = [contest for contest in by_case.values() if len({row.method for _, row in contest}) > 1]
    # Two methods cannot both be the fastest, but two protocols of one can.
    fastest_in = Counter(method for contest in contests for method in {row.method for _, row in contest if row.fastest})
    compared = sum(_award_error(contest) for contest in by_case.values())
    for one in everyone:
        if core is not None and one is not core:
            one.time = _ratio(one, core, _time_ratio, lambda row, _: row.order)
            one.error = _ratio(one, core, _error_ratio, _error_order)
    timed = [row for one in everyone for row in one.results.values()]
    return Summary(
        experiment.name,
        experiment.title,
        everyone,
        core,
        len(contests),
        fastest_in,
        bool(timed) and all(row.interval() is None for row in timed),
        compared,
        experiment.report["summary"].get("headline"),
        {name: method["title"] for name, method in experiment.methods.items()},
    )


def _count(standing: Standing, row: Row) -> None:
    standing.planned += 1
    if row.ok and row.median_ns is not None:
        standing.results[row.case] = row
        standing.fastest_in += row.fastest
    else:
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


def _error_order(one: Row, other: Row) -> int:
    first, second = one.metric("l2"), other.metric("l2")
    if abs(first - second) <= SAME_ERROR * max(first, second):
        return 0
    return (first > second) - (first < second)


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
    one: Standing, core: Standing, ratio_of: Callable[[Row, Row], float | None], order: Callable[[Row, Row], int]
) -> Ratio | None:
    orders: Counter[int] = Counter()
    ratios = []
    for case in one.results.keys() & core.results.keys():
        row, beside = one.results[case], core.results[case]
        if (ratio := ratio_of(row, beside)) is not None:
            ratios.append(ratio)
            orders[order(row, beside)] += 1
    if not ratios:
        return None
    only_core, only_one = len(one.failed & core.results.keys()), len(core.failed & one.results.keys())
    ratios += [math.inf] * only_core + [0.0] * only_one
    orders.update({1: only_core, -1: only_one})
    return Ratio(len(ratios), only_core, median(ratios), min(ratios), max(ratios), orders[-1], orders[1])


# Sentences. They are plain text: whoever puts them into a page escapes them.


def headline_sentences(summary: Summary) -> list[str]:
    """The fastest method with the same polygons as the core, then the paper's rival and what it does more."""
    if not summary.headline:
        return []

    def name(line: dict[str, Any]) -> str:
        return f"{summary.titles.get(line['method'], line['method'])} ({line['protocol']})"

    core = name(summary.headline["reference"])
    said = []
    for rival in summary.headline["rivals"]:
        median_ratio = math.inf if rival["median"] is None else rival["median"]
        interval = ""
        if rival["low"] is not None:
            high = math.inf if rival["high"] is None else rival["high"]
            interval = f" (95 %: {number(rival['low'])} to {number(high)})"
        cases = count_of(rival["cases"], "case")
        failed = f", of which it failed {rival['failures']}" if rival["failures"] else ""
        same = "the same polygons" if rival["same_polygons"] else "other polygons"
        more = f". {rival['does_more']}" if "does_more" in rival else "."
        said.append(f"{name(rival)}, {same}: {times(median_ratio)} the time of {core}{interval}, {cases}{failed}{more}")
    if not any(rival["same_polygons"] for rival in summary.headline["rivals"]):
        said.insert(0, f"no other method gives the same polygons as {core}.")
    return said


def fastest_sentence(summary: Summary) -> str:
    """Who is fastest in this experiment, by how much, and at which price in accuracy."""
    if not summary.contested:
        return _alone(summary)
    if not summary.fastest_in:
        return f"no method is the fastest beyond doubt in {share(summary.contested, summary.contested)}."
    [(method, cases)] = summary.fastest_in.most_common(1)
    said = f"{_name(summary, method)} is the fastest in {share(cases, summary.contested)}"
    if undecided := summary.contested - summary.fastest_in.total():
        said += f" ({undecided} undecided)"
    winner = max(_entrants(summary, method), key=lambda one: (one is summary.core, one.fastest_in))
    return said + _margin(summary, winner) + "."


def _entrants(summary: Summary, method: str) -> list[Standing]:
    return [one for one in summary.standings if one.series.method == method]


def _name(summary: Summary, method: str) -> str:
    """With the protocol where there is only one."""
    entrants = _entrants(summary, method)
    return entrants[0].label if len(entrants) == 1 else summary.titles[method]


def _margin(summary: Summary, winner: Standing) -> str:
    if winner is summary.core:
        others = [one for one in summary.standings if one.time is not None and one.series.method != winner.series.method]
        if not others:
            return ""
        nearest = min(others, key=lambda one: one.time.median)
        return f"; the next, {nearest.label}, takes {times(nearest.time.median)} the time of {winner.label}{_spanned(nearest.time)}"
    if winner.time is None:
        return ""
    subject = "it" if len(_entrants(summary, winner.series.method)) == 1 else winner.label
    said = f"; {subject} takes {times(winner.time.median)} the time of {summary.core.label}{_spanned(winner.time)}"
    said += f" at {times(winner.error.median)} its error" if winner.error else ""
    return said + _fastest_of_the_accurate(summary)


def _fastest_of_the_accurate(summary: Summary) -> str:
    """A hull that is far off is made in no time, so the fastest of those near the core's error is told too."""
    near = [
        (one.time.median, one.label) for one in summary.standings if one.time and one.error and one.error.median <= COMPARABLE
    ]
    ratio, name = min([*near, (1.0, summary.core.label)])
    if name == summary.core.label:
        return f". Of those with up to twice its error, {name} is the fastest"
    return f". Of those with up to twice the error of {summary.core.label}, {name} is the fastest, at {times(ratio)} its time"


def _spanned(ratio: Ratio) -> str:
    return f" (median of {ratio.cases} cases, {span(ratio)})" if ratio.cases > 1 else ""


def accurate_sentence(summary: Summary) -> str:
    """Who has the smallest error in this experiment."""
    if summary.compared_errors == 0:
        return "no two entrants have an error in the same case." if summary.contested else _alone(summary)
    most = max(one.most_accurate_in for one in summary.standings)
    winners = [one for one in summary.standings if one.most_accurate_in == most]
    verb = "has" if len(winners) == 1 else "have"
    each = " each" if len(winners) > 1 and most < summary.compared_errors else ""
    said = (
        f"{sentence_list([one.label for one in winners])} {verb} the smallest error in "
        f"{share(most, summary.compared_errors)}{each}"
    )
    if summary.core is None or len(winners) > 1 or summary.core in winners:
        return said + "."
    ratio = winners[0].error
    return said + (f"; it is {times(ratio.median)} that of {summary.core.label}{_spanned(ratio)}." if ratio else ".")


# Characters of a reason in a sentence; the table of all runs has the whole.
MOST_REASON = 300

# So many of those who beat the core are named in the sentence; the table has all.
MOST_NAMED = 3


def losses_sentences(summary: Summary) -> list[str]:
    """Who beats the core beyond doubt, in time and in error, at which price; empty: nobody."""
    parts = [
        _losses(summary, "faster", "time", lambda one: one.time, "error", lambda one: one.error),
        _losses(summary, "more accurate", "error", lambda one: one.error, "time", lambda one: one.time),
    ]
    return [part for part in parts if part]


def _losses(
    summary: Summary,
    better: str,
    quantity: str,
    own: Callable[[Standing], Ratio | None],
    price: str,
    other: Callable[[Standing], Ratio | None],
) -> str:
    winners = sorted(
        (one for one in summary.standings if (ratio := own(one)) and ratio.lower_in),
        key=lambda one: -own(one).lower_in / own(one).cases,
    )
    if not winners:
        return ""
    said = [
        f"{one.label} in {share(own(one).lower_in, own(one).cases)} ({number(own(one).median)} times its {quantity}"
        + (f" at {number(other(one).median)} times its {price}" if other(one) else "")
        + ")"
        for one in winners[:MOST_NAMED]
    ]
    if len(winners) > MOST_NAMED:
        said.append(f"{count_of(len(winners) - MOST_NAMED, 'other')}")
    return f"{better.capitalize()} than {summary.core.label}: {sentence_list(said)}."


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
        where = sentence_list([f"{summary.title} {one.failures[status]}" for summary, one in entries])
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


def _alone(summary: Summary) -> str:
    """What there is to say when no two methods can be compared."""
    with_results = {one.series.method for one in summary.standings if one.results}
    if not with_results:
        return "nothing has a result."
    if len(with_results) == 1:
        return f"only {_name(summary, with_results.pop())} has results, so there is nothing to compare it with."
    return "no case has results of two methods, so nothing can be compared."


def share(count: int, of: int) -> str:
    """3 of 11 cases; all 11 cases; the one case."""
    if count == of:
        return "the one case" if of == 1 else f"all {of} cases"
    return f"{count} of {count_of(of, 'case')}"


def times(ratio: float) -> str:
    """13.2 times; three significant digits."""
    return f"{number(ratio)} times"


def span(ratio: Ratio) -> str:
    return f"from {number(ratio.low)} to {number(ratio.high)}"
