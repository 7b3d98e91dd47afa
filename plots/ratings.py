"""Who is how good, from every result of a league (`hullbench league --csv`): what the ratings, their figures and the first
screen of the report are made of.

    results = read(Path("league.csv"))
    for division in divisions(results):
        rating = rate(division)

Two divisions are never put together: who sees the points only, and who was told something of the truth. In each the entrants
(a method under a protocol) are compared on the cases that all of them have; a failure is infinitely bad and is never left
out. Every stratum counts the same, and in it every shape, as in the league. Intervals are of
95 %, by a bootstrap over shapes, as the cases of one shape say nearly the same.
"""

from __future__ import annotations

import csv
import math
import warnings
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy import optimize, stats

from records import RecordError, Series
from report_common import PROTOCOLS

# By division: the protocols in it. The oracle, which tries everything with the truth, is in none.
DIVISIONS = {one["name"]: tuple(one["protocols"]) for one in PROTOCOLS["divisions"]}
KNOWS = {one["name"]: one["know"] for one in PROTOCOLS["divisions"]}
COLUMNS = ("method", "task", "fold", "error", "time", "points", "status", "shape", "kind", "sampler", "weight")

# Nobody would choose a method for less: errors are tied when they differ by at most this part of the smaller one, or by at
# most this part of the true area.
TIE_RELATIVE = 0.01
TIE_ABSOLUTE = 1e-4
TIE_WORDS = "errors that differ by at most 1 % of the smaller one, or 0.01 % of the true area, are tied"
# Errors of the same polygons differ in the last digits.
_SAME = 1e-7
# Drawn games that every pair is given, so that who wins always has a finite rating. A pair plays as many games as there are
# shapes.
PRIOR_GAMES = 1.0
ELO_MEAN = 1000.0
_ELO_UNIT = 400 / math.log(10)
SIGNIFICANCE = 0.05
# That five shapes favour the same one is chance in 2 of 32 cases.
LEAST_SHAPES = 6
_DRAWS = 1000
_ELO_DRAWS = 200

Interval = tuple[float, float]


class Case(NamedTuple):
    task: str  # ca~noise:0.5/n:2000/holes:1
    fold: str  # the seed
    points: int
    shape: str
    kind: str
    sampler: str
    weight: float


@dataclass(frozen=True)
class Results:
    """Of all entrants on all cases."""

    entrants: list[Series]
    cases: list[Case]
    errors: np.ndarray  # [entrant, case]: parts of the true area; inf: a failure; nan: not run
    seconds: np.ndarray  # likewise; nan: none

    def of(self, entrants: Sequence[int], cases: Sequence[int]) -> Results:
        """Only these, by their places."""
        grid = np.ix_(entrants, cases)
        chosen = [self.entrants[i] for i in entrants], [self.cases[i] for i in cases]
        return Results(*chosen, self.errors[grid], self.seconds[grid])

    def weights(self) -> np.ndarray:
        """Of these cases; they sum to 1. As the league weighs its own: every stratum, a way to sample and a kind of shape,
        counts the same, in it every shape, and of a shape every case."""
        strata = [(case.sampler, case.kind) for case in self.cases]
        shapes = {key: len({case.shape for case, own in zip(self.cases, strata) if own == key}) for key in set(strata)}
        cases = Counter((key, case.shape) for case, key in zip(self.cases, strata))
        return np.array([1 / (len(shapes) * shapes[key] * cases[key, case.shape]) for case, key in zip(self.cases, strata)])


@dataclass(frozen=True)
class Division:
    """Entrants that know as much, on the cases that all of them have and one of them solved."""

    name: str
    results: Results
    left_out: list[Series]  # without whom the others have enough cases in common


def read(path: Path) -> Results:
    """Raises RecordError when it is not what `hullbench league --csv` writes."""
    try:
        with path.open(newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            lines = list(reader)
        if tuple(reader.fieldnames or ()) != COLUMNS:
            raise ValueError(f"the columns are not {', '.join(COLUMNS)}")
        cases: dict[tuple[str, str], Case] = {}
        values: dict[tuple[Series, tuple[str, str]], tuple[float, float]] = {}
        for line in lines:
            key = (line["task"], line["fold"])
            facts = (int(line["points"]), line["shape"], line["kind"], line["sampler"], float(line["weight"]))
            cases.setdefault(key, Case(*key, *facts))
            method, _, protocol = line["method"].partition("/")
            seconds = float(line["time"]) if line["time"] else math.nan
            values[Series(method, protocol), key] = (float(line["error"]), seconds)
    except (OSError, csv.Error, TypeError, ValueError) as error:
        said = f"not as 'hullbench league --csv' writes it: {error}"
        raise RecordError(f"{path} cannot be read ({said}).") from error
    entrants = sorted({entrant for entrant, _ in values})
    table = np.full((2, len(entrants), len(cases)), math.nan)
    rows, columns = ({one: place for place, one in enumerate(some)} for some in (entrants, cases))
    for (entrant, key), both in values.items():
        table[:, rows[entrant], columns[key]] = both
    return Results(entrants, list(cases.values()), *table)


def divisions(results: Results) -> list[Division]:
    """Those with two entrants or more that have a case in common."""
    found = (division(results, name) for name in DIVISIONS)
    return [one for one in found if one is not None]


def division(results: Results, name: str) -> Division | None:
    members = [i for i, one in enumerate(results.entrants) if one.protocol in DIVISIONS[name]]
    # What one method alone was asked says nothing of the others, however many cases it is.
    methods = sorted({results.entrants[i].method for i in members})
    known = ~np.isnan(results.errors)
    had = [np.any([known[i] for i in members if results.entrants[i].method == one], axis=0) for one in methods]
    weights = np.array([case.weight for case in results.cases]) * (np.sum(had, axis=0) > 1)
    chosen = _with_common_cases(members, known, weights)
    if len(chosen) < 2:
        return None
    errors = results.errors[chosen]
    common = np.flatnonzero(~np.isnan(errors).any(axis=0) & np.isfinite(errors).any(axis=0))
    if not len(common):
        return None
    left_out = [results.entrants[i] for i in members if i not in chosen]
    return Division(name, results.of(chosen, common), left_out)


def _with_common_cases(members: list[int], known: np.ndarray, weights: np.ndarray) -> list[int]:
    """Those members whose common cases have at least half of the weight of what one of them has. Until they do, one after
    another leaves: the one without whom the others have most in common, of several the one with the fewest cases."""
    share = {i: float(known[i] @ weights) for i in members}
    # Sums of the same weights in another order differ in the last digits.
    half = max(share.values(), default=0.0) / 2 * (1 - 1e-9)

    def common(some: list[int]) -> float:
        return round(float(known[some].all(axis=0) @ weights), 9)

    chosen = members
    while len(chosen) > 2 and common(chosen) < half:
        leaves = max(chosen, key=lambda one: (common([i for i in chosen if i != one]), -round(share[one], 9)))
        chosen = [i for i in chosen if i != leaves]
    return [i for i in chosen if share[i] >= half]


@dataclass(frozen=True)
class Standing:
    """Of one entrant in its division. Intervals are None of fewer than two shapes."""

    series: Series
    rank: float  # mean rank, 1: the best on every case
    rank_interval: Interval | None
    elo: float  # 1000: the mean of the division
    elo_interval: Interval | None
    error: float  # weighted median; inf: most fail
    error_interval: Interval | None
    failures: int


@dataclass(frozen=True)
class Part:
    """Some of the cases: of one kind of shape, or of one way to sample."""

    name: str
    cases: int
    ranks: list[float]  # mean ranks, in the order of the standings
    errors: list[float]  # weighted medians


@dataclass(frozen=True)
class Lead:
    """Of the first one over the second."""

    shapes: int
    ranks: float  # difference of the mean ranks
    ranks_interval: Interval | None
    ratio: float  # weighted median of its error over the second one's, case by case
    ratio_interval: Interval | None

    @property
    def clear(self) -> bool:
        """The interval of `ranks` is above 0, and there are enough shapes for that not to be chance."""
        return self.shapes >= LEAST_SHAPES and self.ranks_interval is not None and self.ranks_interval[0] > 0


@dataclass(frozen=True)
class Rating:
    division: Division
    shapes: int
    standings: list[Standing]  # by mean rank
    lead: Lead
    wins: np.ndarray  # [i, j], in the order of the standings: weight of the cases on which i beats j
    ties: np.ndarray  # likewise: on which they are tied
    friedman: float | None  # p of "all are alike"; None: of fewer than three entrants or shapes
    alike: np.ndarray  # p of "i and j are alike": Wilcoxon's, by shape, corrected by Holm
    groups: list[tuple[int, int]]  # first and last of those next to each other that may all be alike, two at least
    kinds: list[Part]
    samplers: list[Part]


def rate(division: Division) -> Rating:
    order = np.argsort(mean_ranks(division.results), kind="stable")
    results = division.results.of(list(order), range(len(division.results.cases)))
    draws = Draws(results)
    won, tied = outcomes(results.errors)
    alike = pairs_alike(results)
    return Rating(
        Division(division.name, results, division.left_out),
        draws.shapes,
        _standings(results, draws, won + tied / 2),
        _lead(results, draws),
        np.einsum("ijc,c->ij", won, results.weights()),
        np.einsum("ijc,c->ij", tied, results.weights()),
        friedman(results),
        alike,
        groups_alike(alike),
        _parts(results, [case.kind for case in results.cases], ("simple", "holes", "several parts")),
        _parts(results, [case.sampler for case in results.cases], ("uniform",)),
    )


def twins(errors: np.ndarray) -> np.ndarray:
    """Entrant -> the first one whose errors are the same on every case."""
    first = np.arange(len(errors))
    for i, own in enumerate(errors):
        for j in range(i):
            with np.errstate(invalid="ignore"):
                same = (own == errors[j]) | (np.abs(own - errors[j]) <= _SAME * np.minimum(own, errors[j]))
            if first[j] == j and np.all(same):
                first[i] = j
                break
    return first


def ranks(errors: np.ndarray) -> np.ndarray:
    """[entrant, case]: 1 is the best; the mean of the places where several are the same. Entrants with the same errors on
    every case count as one, or a result that many methods share would push the others back."""
    distinct, place = np.unique(twins(errors), return_inverse=True)
    return _ranks(errors[distinct])[place]


def _ranks(errors: np.ndarray) -> np.ndarray:
    order = np.argsort(errors, axis=0, kind="stable")
    ascending = np.take_along_axis(errors, order, axis=0)
    is_new = ascending[1:] > ascending[:-1] * (1 + _SAME)
    groups = np.concatenate([np.zeros((1, errors.shape[1])), np.cumsum(is_new, axis=0)])
    group_of = np.empty_like(groups)
    np.put_along_axis(group_of, order, groups, axis=0)
    return stats.rankdata(group_of, axis=0)


def outcomes(errors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Who wins and who is tied, as [i, j, case] of 0 and 1. Two failures are tied."""
    first, second = errors[:, None, :], errors[None, :, :]
    smaller = np.minimum(first, second)
    band = np.maximum(TIE_RELATIVE * np.where(np.isfinite(smaller), smaller, 0), TIE_ABSOLUTE)
    with np.errstate(invalid="ignore"):
        tied = (first == second) | (np.abs(first - second) <= band)
    return ((first < second) & ~tied).astype(np.float32), tied.astype(np.float32)


def elo(games: np.ndarray) -> np.ndarray:
    """Bradley and Terry's strengths on Elo's scale, by maximum likelihood, of games[i, j]: how many i won against j."""
    count = len(games)
    played = games + PRIOR_GAMES / 2 * (1 - np.eye(count))
    np.fill_diagonal(played, 0)
    both = played + played.T

    def negative_likelihood(strength: np.ndarray) -> tuple[float, np.ndarray]:
        ahead = strength[:, None] - strength[None, :]
        expected = both / (1 + np.exp(-ahead))
        return float(np.sum(played * np.logaddexp(0, -ahead))), np.sum(expected - played, axis=1)

    found = optimize.minimize(negative_likelihood, np.zeros(count), jac=True, method="L-BFGS-B", options={"gtol": 1e-9})
    return ELO_MEAN + _ELO_UNIT * (found.x - found.x.mean())


class Draws:
    """Bootstrap by shape: the same draws for everything that is compared, and on every machine."""

    def __init__(self, results: Results) -> None:
        names = sorted({case.shape for case in results.cases})
        place = {name: i for i, name in enumerate(names)}
        self.shapes = len(names)
        self.shape_of = np.array([place[case.shape] for case in results.cases])
        generator = np.random.default_rng(1)
        self.counts = generator.multinomial(self.shapes, np.full(self.shapes, 1 / self.shapes), size=_DRAWS)

    def by_shape(self, values: np.ndarray) -> np.ndarray:
        """Sums over the cases, which are the last axis, of every shape, which are the first one."""
        sums = np.zeros((self.shapes, *values.shape[:-1]))
        np.add.at(sums, self.shape_of, np.moveaxis(values, -1, 0))
        return sums

    def interval(self, values: np.ndarray) -> Interval | None:
        """Of what every draw gave; failures may be its ends."""
        if self.shapes < 2:
            return None
        low, high = np.quantile(values, (0.025, 0.975), method="inverted_cdf")
        return float(low), float(high)


def mean_ranks(results: Results) -> np.ndarray:
    """By entrant, over the cases by their weights."""
    return ranks(results.errors) @ results.weights()


def weighted_median(values: np.ndarray, weights: np.ndarray) -> float:
    """The least value up to which more than half of the weight lies; where exactly half does, the mean of it and the next."""
    order = np.argsort(values, kind="stable")
    return _middle(values[order], np.cumsum(weights[order]))


def _middle(ascending: np.ndarray, sums: np.ndarray) -> float:
    half = sums[-1] / 2
    low, high = np.searchsorted(sums, [half * (1 - 1e-9), half * (1 + 1e-9)], side="right")
    return float((ascending[low] + ascending[high]) / 2) if low != high else float(ascending[low])


def _drawn_medians(values: np.ndarray, weights: np.ndarray, draws: Draws) -> np.ndarray:
    order = np.argsort(values, kind="stable")
    shapes, weights, values = draws.shape_of[order], weights[order], values[order]
    return np.array([_middle(values, np.cumsum(weights * counts[shapes])) for counts in draws.counts])


def _drawn_ranks(results: Results, draws: Draws) -> np.ndarray:
    weights = results.weights()
    sums = draws.by_shape(ranks(results.errors) * weights)
    return (draws.counts @ sums) / (draws.counts @ draws.by_shape(weights))[:, None]


def _standings(results: Results, draws: Draws, points: np.ndarray) -> list[Standing]:
    weights = results.weights()
    means, drawn_ranks = mean_ranks(results), _drawn_ranks(results, draws)
    # Games are between different results.
    distinct, place = np.unique(twins(results.errors), return_inverse=True)
    count = len(distinct)
    games = draws.by_shape((points[np.ix_(distinct, distinct)] * weights * draws.shapes).reshape(count * count, -1))
    strength = elo(games.sum(axis=0).reshape(count, count))[place]
    several = draws.counts[:_ELO_DRAWS] if draws.shapes > 1 else draws.counts[:1]
    drawn_strength = np.array([elo(one.reshape(count, count)) for one in several @ games])[:, place]
    standings = []
    for i, series in enumerate(results.entrants):
        errors = results.errors[i]
        standings.append(
            Standing(
                series,
                float(means[i]),
                draws.interval(drawn_ranks[:, i]),
                float(strength[i]),
                draws.interval(drawn_strength[:, i]),
                weighted_median(errors, weights),
                draws.interval(_drawn_medians(errors, weights, draws)) if draws.shapes > 1 else None,
                int(np.sum(np.isinf(errors))),
            )
        )
    return standings


def _lead(results: Results, draws: Draws) -> Lead:
    means, drawn = mean_ranks(results), _drawn_ranks(results, draws)
    first, second = results.errors[:2]
    same = (first == second) | ((first == 0) & (second == 0))
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = np.where(same, 1.0, np.where(np.isinf(first), np.inf, first / second))
    return Lead(
        draws.shapes,
        float(means[1] - means[0]),
        draws.interval(drawn[:, 1] - drawn[:, 0]),
        weighted_median(ratio, results.weights()),
        draws.interval(_drawn_medians(ratio, results.weights(), draws)) if draws.shapes > 1 else None,
    )


def _parts(results: Results, names: Sequence[str], first: Sequence[str]) -> list[Part]:
    """Those of `first` first, then by name."""
    found = []
    for name in sorted(set(names), key=lambda one: (first.index(one) if one in first else len(first), one)):
        some = results.of(range(len(results.entrants)), [i for i, one in enumerate(names) if one == name])
        weights = some.weights()
        means = [float(rank) for rank in mean_ranks(some)]
        found.append(Part(name, len(some.cases), means, [weighted_median(errors, weights) for errors in some.errors]))
    return found


# Who may be alike.


def errors_by_shape(results: Results) -> np.ndarray:
    """[entrant, shape]: the median over a shape's cases, which are not independent of each other."""
    places: dict[str, list[int]] = {}
    for place, case in enumerate(results.cases):
        places.setdefault(case.shape, []).append(place)
    return np.array([np.median(results.errors[:, places[shape]], axis=1) for shape in sorted(places)]).T


def friedman(results: Results) -> float | None:
    by_shape = ranks(errors_by_shape(results))
    if min(by_shape.shape) < 3 or np.all(by_shape == by_shape[0]):
        return None
    return float(stats.friedmanchisquare(*by_shape).pvalue)


def pairs_alike(results: Results) -> np.ndarray:
    by_shape = errors_by_shape(results)
    count = len(by_shape)
    pairs = [(i, j) for i in range(count) for j in range(i)]
    corrected = holm([wilcoxon(by_shape[i], by_shape[j]) for i, j in pairs])
    alike = np.ones((count, count))
    for (i, j), p in zip(pairs, corrected):
        alike[i, j] = alike[j, i] = p
    return alike


def wilcoxon(first: np.ndarray, second: np.ndarray) -> float:
    """p of the signed-rank test; a failure differs more from a result than any two results do."""
    both_failed = np.isinf(first) & np.isinf(second)
    with np.errstate(invalid="ignore"):
        difference = np.where(both_failed, 0.0, first - second)
    finite = np.isfinite(difference)
    most = 2 * np.max(np.abs(difference[finite]), initial=0.0) + 1
    difference = np.where(finite, difference, np.copysign(most, difference))
    if not np.any(difference):
        return 1.0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it says that with zeros it takes the normal approximation
        return float(stats.wilcoxon(difference, zero_method="zsplit").pvalue)


def holm(p: Sequence[float]) -> list[float]:
    """Corrected for their number (Holm, A Simple Sequentially Rejective Multiple Test Procedure, 1979)."""
    corrected = [1.0] * len(p)
    least = 0.0
    for place, i in enumerate(sorted(range(len(p)), key=lambda i: p[i])):
        least = max(least, min(1.0, (len(p) - place) * p[i]))
        corrected[i] = least
    return corrected


def groups_alike(alike: np.ndarray) -> list[tuple[int, int]]:
    """The largest runs of neighbours of which no two differ."""
    count = len(alike)
    groups: list[tuple[int, int]] = []
    for first in range(count):
        last = first
        while last + 1 < count and np.all(alike[first : last + 1, last + 1] >= SIGNIFICANCE):
            last += 1
        if last > first and not (groups and groups[-1][1] >= last):
            groups.append((first, last))
    return groups


# Solved against time.

# Of every case: so many times the smallest error of the division on it.
TARGETS = np.logspace(0, 1, 51)
# A perfect result leaves room for others beside it.
LEAST_TARGET = 1e-4
TARGET_WORDS = "51 targets a case, from 1 to 10 times the smallest error of the division on it, evenly in the logarithm"


def has_times(division: Division) -> bool:
    return bool(np.isfinite(division.results.seconds).any())


def solved_against_time(division: Division) -> dict[Series, tuple[np.ndarray, np.ndarray]]:
    """By entrant: times in microseconds a point, ascending, and what part of all pairs of case and target it has solved by
    then (Hansen et al., COCO: a platform for comparing continuous optimizers in a black-box setting, 2021). A failure solves
    none of its case's."""
    results = division.results
    weights = results.weights()
    best = np.maximum(results.errors.min(axis=0), LEAST_TARGET)
    points = np.array([max(case.points, 1) for case in results.cases])
    curves = {}
    for i, series in enumerate(results.entrants):
        limits = TARGETS[:, None] * best * (1 + _SAME)
        solved = np.mean(results.errors[i] <= limits, axis=0) * weights
        times = results.seconds[i] * 1e6 / points
        known = np.isfinite(times)
        order = np.argsort(times[known], kind="stable")
        curves[series] = (times[known][order], np.cumsum(solved[known][order]))
    return curves


def typical_times(division: Division) -> dict[Series, float]:
    """By entrant: weighted median of its times in microseconds a point; a failure is infinitely slow."""
    results = division.results
    points = np.array([max(case.points, 1) for case in results.cases])
    times = np.where(np.isfinite(results.errors) & np.isfinite(results.seconds), results.seconds * 1e6 / points, np.inf)
    return {series: weighted_median(times[i], results.weights()) for i, series in enumerate(results.entrants)}


def typical_errors(division: Division) -> dict[Series, float]:
    results = division.results
    return {series: weighted_median(results.errors[i], results.weights()) for i, series in enumerate(results.entrants)}


def pareto(places: Sequence[tuple[float, float]]) -> list[int]:
    """Those that no other one beats in both, by the first number ascending."""
    kept: list[int] = []
    for i in sorted(range(len(places)), key=lambda i: places[i]):
        if not kept or places[i][1] < places[kept[-1]][1]:
            kept.append(i)
    return kept
