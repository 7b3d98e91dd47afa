"""Six telling pictures of the one that leads: its best, median and worst case, one that it loses, real points and an input that
broke somebody. What the run does not have is left out, and said."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from ratings import DIVISIONS, TIE_RELATIVE, Rating
from records import Experiment, Picture, Row, Series
from report_common import NOT_TRIED, asked, count_of, number, sentence_list, short_name, text

_WIDTH, _HEIGHT, _MARGIN = 200, 150, 6
_MOST_POINTS = 500
_LEAST = 0.6  # between two corners that are drawn, in these units
_HAS_NO_TRUTH = ("real", "zoo")  # experiments


@dataclass
class Shown:
    """A case that has a picture, with one run of it."""

    experiment: Experiment
    row: Row
    picture: Picture
    others: list[Row] = field(default_factory=list)  # of the same division, on the same case

    @property
    def error(self) -> float | None:
        """inf: it fails; None: it was not scored."""
        return self.row.metric("l2") if self.row.ok else math.inf

    def best_other(self) -> Row | None:
        scored = [row for row in self.others if row.metric("l2") is not None]
        return min(scored, key=lambda row: row.metric("l2"), default=None)

    def behind(self) -> float:
        """How many times the best other's error its own one is."""
        other = self.best_other()
        return self.error / max(other.metric("l2"), 1e-4) if other else 0.0

    def failed_others(self) -> list[Row]:
        return [row for row in self.others if not row.ok]


def strip_html(
    experiments: Sequence[Experiment],
    rating: Rating | None,
    pictures: Sequence[dict[str, Picture]] | None = None,
    report: str = "",
) -> str:
    """Empty without a leader. `pictures`: by experiment, with at least the leader's runs; None: they are read.
    `report`: the address of the report that the pictures lead to, where that is not this page."""
    if rating is None:
        return ""
    leader = rating.standings[0].series
    every = [one.series for one in rating.standings]
    read = pictures or [one.pictures(runs={row.name for row in one.rows if row.series == leader}) for one in experiments]
    shown = _cases(experiments, read, leader, DIVISIONS[rating.division.name])
    name = text(short_name(leader, every))
    if not shown:
        return f"<p class='muted wide'>The run has no pictures of {name}.</p>"
    chosen = _chosen(shown, every)
    missing = [what for what, one, _ in chosen if one is None]
    cards = "".join(card(k, what, one, said, report) for k, (what, one, said) in enumerate(chosen) if one is not None)
    said = f"This run has none of these: {sentence_list([one[:1].lower() + one[1:] for one in missing])}." if missing else ""
    kept = "Best, median and worst are of the cases that have a picture; of very many runs mainly the worst have one."
    note = f"<p class='muted'>{' '.join(filter(None, [kept, said]))}</p>"
    title = f"{name} in {count_of(len(chosen) - len(missing), 'picture')}"
    return f"<div class='strip' id='strip'><h3>{title}</h3>{cards_html(cards)}{note}</div>"


def cards_html(cards: str) -> str:
    """With what the colours mean."""
    legend = "".join(
        f"<span><span class='gallery-key gallery-key-{kind}' aria-hidden='true'></span>{words}</span>"
        for kind, words in (("both", "found"), ("missed", "missed"), ("added", "wrongly added"), ("truth", "ground truth"))
    )
    return f"<ul>{cards}</ul><p class='gallery-legend'>{legend}</p>"


def _cases(
    experiments: Sequence[Experiment], pictures: Sequence[dict[str, Picture]], leader: Series, protocols: Sequence[str]
) -> list[Shown]:
    found = []
    for experiment, read in zip(experiments, pictures):
        shown = {
            row.case: Shown(experiment, row, read[row.case])
            for row in experiment.rows
            if row.series == leader and row.case in read and row.status not in NOT_TRIED
            if row.name in read[row.case].results or not row.ok
        }
        for row in experiment.rows:
            tried = row.case in shown and row.status not in NOT_TRIED
            if tried and row.series != leader and row.series.protocol in protocols:
                shown[row.case].others.append(row)
        found += shown.values()
    return found


def _chosen(shown: Sequence[Shown], every: Sequence[Series]) -> list[tuple[str, Shown | None, str]]:
    """(what it is, the case, a sentence) for each of the six."""
    judged = [one for one in shown if one.experiment.name not in _HAS_NO_TRUTH and one.picture.case["ground_truth"]]
    judged = sorted((one for one in judged if one.error is not None), key=lambda one: (one.error, one.row.name))
    best = judged[0] if judged else None
    middle = judged[len(judged) // 2] if len(judged) > 2 else None
    worst = judged[-1] if len(judged) > 1 else None
    taken = {id(one) for one in (best, middle, worst)}
    losses = [one for one in judged if id(one) not in taken and math.isfinite(one.error) and one.behind() > 1 + TIE_RELATIVE]
    lost = max(losses, key=Shown.behind, default=None)
    real = max((one for one in shown if one.experiment.name == "real" and one.row.ok), key=lambda one: one.row.n, default=None)
    zoo = max(
        (one for one in shown if one.experiment.name == "zoo" and one.row.ok),
        key=lambda one: (len(one.failed_others()), one.row.n),
        default=None,
    )
    said = ""
    if lost:
        other = lost.best_other()
        said = f"{short_name(other.series, every)} has {number(100 * other.metric('l2'))} %"
    broken = f"{len(zoo.failed_others())} of {count_of(len(zoo.others), 'other')} fail" if zoo else ""
    return [
        ("Best", best, ""),
        ("Median", middle, ""),
        ("Worst", worst, ""),
        ("A case it loses", lost, said),
        ("Real points", real, "nobody knows the truth"),
        ("An input that broke somebody", zoo, broken),
    ]


def title_of_case(one: Shown) -> str:
    """The shape, and how its points were drawn."""
    base, *ways = one.row.dataset.split("~")
    return ", ".join([one.experiment.dataset_title(base), *(way.split(":")[0] for way in ways)])


def card(place: int, what: str, one: Shown, said: str, report: str = "") -> str:
    """One of a page's pictures, the `place`-th, which leads to the gallery of the `report`."""
    row = one.row
    error = row.metric("l2")
    result = (
        row.status.replace("_", " ")
        if not row.ok
        else f"{number(100 * error)} %"
        if error is not None and one.experiment.name not in _HAS_NO_TRUTH
        else ""
    )
    words = "; ".join(part for part in (result, said) if part)
    n = f"{one.picture.case['points_total']:,}".replace(",", "\u202f")
    about = ", ".join([part for part in [title_of_case(one)] if part != what] + [f"{n} points"])
    address = asked("gallery", report, case=row.case, run=row.name)
    return (
        f"<li><a href='{address}' data-case='{text(row.case)}' data-run='{text(row.name)}'>{_svg(place, one)}"
        f"<b>{text(what)}</b> <span>{text(words)}</span><small>{text(about)}</small></a></li>"
    )


def _svg(place: int, one: Shown) -> str:
    case = one.picture.case
    result = one.picture.results.get(one.row.name, {}).get("polygons", [])
    grid = _Grid(case["points"], case["ground_truth"])
    truth, own = grid.path(case["ground_truth"]), grid.path(result)
    count = len(case["points"]) // 2
    step = max(1, -(-count // _MOST_POINTS))
    dots = "".join(
        f"M{x:.1f} {y:.1f}h0"
        for x, y in (grid(case["points"][2 * k], case["points"][2 * k + 1]) for k in range(0, count, step))
    )
    if truth:
        shapes = f"<clipPath id='strip-{place}-in'><path d='{truth}' clip-rule='evenodd'/></clipPath><path id='strip-{place}' d='{own}'/>"
        again = f"<use href='#strip-{place}'"
        drawn = (
            f"<defs>{shapes}</defs><path class='missed' d='{truth}'/>{again} class='added'/>"
            f"<g clip-path='url(#strip-{place}-in)'>{again} class='page'/>{again} class='both'/></g><path class='truth' d='{truth}'/>"
        )
    else:
        drawn = f"<path class='both outlined' d='{own}'/>"
    return f"<svg viewBox='0 0 {_WIDTH} {_HEIGHT}' aria-hidden='true'>{drawn}<path class='dots' d='{dots}'/></svg>"


class _Grid:
    """From the picture's grid to pixels."""

    def __init__(self, points: Sequence[int], truth: Sequence[Sequence[Sequence[int]]]) -> None:
        flat = [points, *(ring for polygon in truth for ring in polygon[:1])]
        xs, ys = [x for one in flat for x in one[::2]] or [0], [y for one in flat for y in one[1::2]] or [0]
        wide, high = max(max(xs) - min(xs), 1), max(max(ys) - min(ys), 1)
        self._scale = min((_WIDTH - 2 * _MARGIN) / wide, (_HEIGHT - 2 * _MARGIN) / high)
        self._x = _WIDTH / 2 - self._scale * (min(xs) + max(xs)) / 2
        self._y = _HEIGHT / 2 + self._scale * (min(ys) + max(ys)) / 2

    def __call__(self, x: int, y: int) -> tuple[float, float]:
        return self._x + self._scale * x, self._y - self._scale * y

    def path(self, polygons: Sequence[Sequence[Sequence[int]]]) -> str:
        """Without what is too small to be seen."""
        made = ""
        for ring in (ring for polygon in polygons for ring in polygon):
            corners: list[tuple[float, float]] = []
            for x, y in zip(ring[::2], ring[1::2]):
                at = self(x, y)
                if not corners or math.dist(corners[-1], at) >= _LEAST:
                    corners.append(at)
            if len(corners) > 2:
                made += "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in corners) + "Z"
        return made
