"""The first screen of a page: who leads, by how much, how sure that is and where it does not; speed and accuracy in two
charts; the league; six telling pictures. And who is good at what, kind of shape by kind of shape.

A report is made of it, and so can be the front page of a site: everything here is HTML that needs no script.
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import svg
from ratings import (
    KNOWS,
    LEAST_TARGET,
    TARGET_WORDS,
    TIE_WORDS,
    Division,
    Part,
    Rating,
    Results,
    Standing,
    divisions,
    has_times,
    rate,
    read,
    solved_against_time,
    weighted_median,
)
from records import Experiment, Series
from report_common import count_of, number, sentence_list, text

_LOOKS = json.loads((Path(__file__).resolve().parent / "methods.json").read_text(encoding="utf-8"))["methods"]
WIDE, NARROW = (590, 350), (356, 300)
# Named in a chart; the others are thin and grey.
MOST_NAMED = 7
# Shown at once; the others are behind a click.
FIRST_ROWS = 8
# Exceptions that the sentence names.
_MOST_EXCEPTIONS = 3


@dataclass(frozen=True)
class Front:
    """What the first screen is of."""

    ratings: list[Rating]  # by division, blind first
    timed: list[Division]  # the run's own, with times
    own: bool  # the ratings are of the run itself, not of an evaluation beside it
    why_empty: str  # a sentence where there is no rating


def make_front(folder: Path) -> Front:
    """Of the run or suite in this folder. Raises RecordError when its results cannot be read."""
    league, cases = folder / "league.csv", folder / "cases.csv"
    if not league.is_file() and not cases.is_file():
        said = f"There are no ratings: {cases} is not there; 'hullbench league {folder} --all-cases --csv {cases}' writes it."
        return Front([], [], True, said)
    own = read(cases) if cases.is_file() else None
    rated = [rate(one) for one in divisions(read(league) if league.is_file() else own)]
    timed = [one for one in divisions(own) if has_times(one)] if own else []
    why = "" if rated else "Nobody leads: no two methods that know as much have a case with a truth in common."
    return Front(rated, timed, not league.is_file(), why)


def name_of(series: Series, among: Sequence[Series]) -> str:
    """The short title, with the protocol where the method is there more than once."""
    title = _LOOKS.get(series.method, {}).get("title", series.method)
    return f"{title} ({series.protocol})" if sum(one.method == series.method for one in among) > 1 else title


def front_html(front: Front, strip: str) -> str:
    if not front.ratings:
        return f"<p class='lead'>{text(front.why_empty)}</p>{strip}"
    first, *others = front.ratings
    timed = {one.name: one for one in front.timed}
    parts = [f"<p class='lead'>{lead_sentence(first, timed.get(first.division.name))}</p>"]
    parts.append(_charts(timed.get(first.division.name)))
    parts += [_league(first, timed.get(first.division.name)), strip]
    for other in others:
        said = lead_sentence(other, timed.get(other.division.name))
        parts.append(
            f"<details class='wide'><summary>Methods that {KNOWS[other.division.name]}</summary><p class='lead'>{said}</p>"
            f"{_charts(timed.get(other.division.name))}{_league(other, timed.get(other.division.name))}</details>"
        )
    return "".join(parts)


# The sentence.


def lead_sentence(rating: Rating, timed: Division | None) -> str:
    """As HTML, the leader in bold."""
    first, second = rating.standings[:2]
    every = [one.series for one in rating.standings]
    name, lead = text(name_of(first.series, every)), rating.lead
    others = [text(name_of(one.series, every)) for one in rating.standings if one is not first]
    same = [one for one, other in zip(others, rating.standings[1:]) if other.rank == first.rank]
    methods = len({one.method for one in every})
    field = f"{count_of(len(every), 'entry')} of {count_of(methods, 'method')} that {KNOWS[rating.division.name]}"
    if same:
        said = f"<b>{name}</b> and {sentence_list(same)} are the first of {field}, with the same mean rank {number(first.rank)} over {_cases(rating)}"
    else:
        verb = "leads" if lead.clear else "is ahead, but not clearly, of"
        said = f"<b>{name}</b> {verb} {field}: mean rank {number(first.rank)}{_range(first.rank_interval)} over {_cases(rating)}, then {others[0]} with {number(second.rank)}"
        said += f"; in the median case its error is {number(lead.ratio)} times that one’s{_range(lead.ratio_interval)}"
    said += _time_words(timed, first.series)
    return said + f". {_exceptions(rating)}"


def _cases(rating: Rating) -> str:
    return f"{count_of(len(rating.division.results.cases), 'case')} of {count_of(rating.shapes, 'shape')}"


def _range(interval: tuple[float, float] | None) -> str:
    return f" (95 %: {number(interval[0])} to {number(interval[1])})" if interval else ""


def _time_words(timed: Division | None, series: Series) -> str:
    times = typical_times(timed) if timed else {}
    return f", at {number(times[series])} µs a point" if math.isfinite(times.get(series, math.inf)) else ""


def _exceptions(rating: Rating) -> str:
    """Where the leader is not the first."""
    every = [one.series for one in rating.standings]
    parts = [part for part in [*rating.kinds, *rating.samplers] if part.cases < len(rating.division.results.cases)]
    lost = [part for part in parts if min(part.ranks) < part.ranks[0] - 1e-9]
    if not parts:
        return ""
    if not lost:
        return "It is the first on every kind of shape and way to sample."
    lost.sort(key=lambda part: min(part.ranks) - part.ranks[0])
    said = [
        f"{text(part.name)} ({text(name_of(every[int(np.argmin(part.ranks))], every))})" for part in lost[:_MOST_EXCEPTIONS]
    ]
    if len(lost) > _MOST_EXCEPTIONS:
        said.append(f"<a href='#where'>{len(lost) - _MOST_EXCEPTIONS} more</a>")
    return f"It is not the first on {sentence_list(said)}."


def typical_times(division: Division) -> dict[Series, float]:
    """By entrant: weighted median of its times in microseconds a point; a failure is infinitely slow."""
    results = division.results
    points = np.array([max(case.points, 1) for case in results.cases])
    times = np.where(np.isfinite(results.errors) & np.isfinite(results.seconds), results.seconds * 1e6 / points, np.inf)
    return {series: weighted_median(times[i], results.weights()) for i, series in enumerate(results.entrants)}


def typical_errors(division: Division) -> dict[Series, float]:
    results = division.results
    return {series: weighted_median(results.errors[i], results.weights()) for i, series in enumerate(results.entrants)}


# The charts.


def _charts(timed: Division | None) -> str:
    if timed is None:
        return "<p class='muted'>The run has no times of these methods, so there is no chart of speed.</p>"
    return f"<div class='charts wide'>{solved_figure(timed)}{time_error_figure(timed)}</div>"


def _figure(identity: str, title: str, note: str, charts: Sequence[str], table: str) -> str:
    return (
        f"<figure class='plot' id='{identity}'><figcaption>{text(title)}</figcaption>{''.join(charts)}"
        f"<p class='muted'>{text(note)}</p><details class='values'><summary>Values</summary>{table}</details></figure>"
    )


def _color(series: Series) -> str:
    return f"var(--method-{series.method},var(--muted))"


def _dashes(series: Series) -> str:
    dashes = _LOOKS.get(series.method, {}).get("line", [])
    return f";stroke-dasharray:{','.join(f'{2 * one:g}' for one in dashes)}" if dashes else ""


def solved_figure(division: Division) -> str:
    curves = solved_against_time(division)
    every = list(curves)
    times = [one[0] for one in curves.values() if len(one[0])]
    low, high = min(one[0] for one in times) / 1.2, max(one[-1] for one in times) * 1.2
    timed = [one for one in every if len(curves[one][0])]
    highest = max(timed, key=lambda one: curves[one][1][-1])
    named = sorted(timed, key=lambda one: (one != highest, -_area(curves[one], low, high)))[:MOST_NAMED]
    charts = [
        _solved_chart(curves, named, (low, high), size, css) for size, css in ((WIDE, "wide-only"), (NARROW, "narrow-only"))
    ]
    count = len(division.results.cases)
    note = f"{TARGET_WORDS[:1].upper()}{TARGET_WORDS[1:]}; {count_of(count, 'case')}. Left is faster, higher more accurate. A failure solves nothing."
    rows = "".join(
        f"<tr><th scope='row'>{text(name_of(one, every))}</th><td class='number'>{number(100 * (curves[one][1][-1] if len(curves[one][1]) else 0))}</td></tr>"
        for one in sorted(every, key=lambda one: -(curves[one][1][-1] if len(curves[one][1]) else 0))
    )
    table = f"<table><thead><tr><th scope='col'>Method</th><th scope='col' class='number'>Solved in the end, %</th></tr></thead><tbody>{rows}</tbody></table>"
    return _figure(f"solved-{division.name}", "Cases and error targets solved in time", note, charts, table)


def _area(curve: tuple[np.ndarray, np.ndarray], low: float, high: float) -> float:
    """Below the curve, over the logarithm of time: who is fast and accurate has much of it."""
    x, y = curve
    return float(np.sum(np.diff(np.log([*x, high])) * y) / math.log(high / low))


def _solved_chart(curves, named: Sequence[Series], ends: tuple[float, float], size: tuple[int, int], css: str) -> str:
    every = list(curves)
    right = 12 + svg.LETTER * max(len(name_of(one, every)) for one in named)
    chart = svg.Chart.of(size, right, ends, (0, 100), False)
    body = []
    for one in [*(other for other in every if other not in named), *reversed(named)]:
        x, y = curves[one]
        corners = [(ends[0], 0.0)]
        for at, share in _thinned(x, y):
            corners += [(at, corners[-1][1]), (at, 100 * share)]
        corners.append((ends[1], corners[-1][1]))
        style = f"stroke:{_color(one)}{_dashes(one)}" if one in named else ""
        body.append(chart.line(corners, "curve" if one in named else "curve other", style, name_of(one, every)))
    tops = [chart.y(100 * curves[one][1][-1]) for one in named]
    for one, top, place in zip(named, tops, svg.apart(tops, chart.y.end + 2, chart.y.start - 2)):
        x = chart.x.end
        body.append(f"<path class='leader' d='M{x:.0f} {top:.1f}L{x + 8:.0f} {place:.1f}' style='stroke:{_color(one)}'/>")
        body.append(
            f"<text class='name' x='{x + 10:.0f}' y='{place + 4:.1f}' style='fill:{_color(one)}'>{text(name_of(one, every))}</text>"
        )
    best = max(named, key=lambda one: curves[one][1][-1])
    label = f"In the end {name_of(best, every)} has solved the most, {number(100 * curves[best][1][-1])} % of all pairs of case and error target."
    return chart.html(label, "µs a point", "Solved, %", body, css)


def _thinned(x: np.ndarray, y: np.ndarray, step: float = 0.002) -> list[tuple[float, float]]:
    """The curve's corners, those that nobody would see left out."""
    kept: list[tuple[float, float]] = []
    for at, share in zip(x.tolist(), y.tolist()):
        if not kept or share - kept[-1][1] >= step or share == y[-1]:
            if not kept or share > kept[-1][1]:
                kept.append((at, share))
    return kept


def time_error_figure(division: Division) -> str:
    times, errors = typical_times(division), typical_errors(division)
    every = list(times)
    errors = {one: max(error, LEAST_TARGET) for one, error in errors.items()}  # the axis has no 0
    shown = [one for one in every if math.isfinite(times[one]) and math.isfinite(errors[one])]
    front = pareto([(times[one], errors[one]) for one in shown])
    missing = [name_of(one, every) for one in every if one not in shown]
    note = "Medians over the same cases. The line is the front: nobody is faster and more accurate at once."
    note += " Errors below 0.01 % are shown as that." if min(errors.values()) <= LEAST_TARGET else ""
    note += f" Not shown, as most cases fail: {sentence_list(missing)}." if missing else ""
    charts = shown and [
        _time_error_chart(times, errors, shown, front, size, css)
        for size, css in ((WIDE, "wide-only"), (NARROW, "narrow-only"))
    ]
    rows = "".join(
        f"<tr><th scope='row'>{text(name_of(one, every))}</th><td class='number'>{number(times[one])}</td>"
        f"<td class='number'>{number(100 * errors[one])}</td></tr>"
        for one in sorted(every, key=lambda one: errors[one])
    )
    table = (
        "<table><thead><tr><th scope='col'>Method</th><th scope='col' class='number'>µs a point</th>"
        f"<th scope='col' class='number'>L2 error, %</th></tr></thead><tbody>{rows}</tbody></table>"
    )
    return _figure(f"time-error-{division.name}", "Time and error", note, charts, table)


def pareto(places: Sequence[tuple[float, float]]) -> list[int]:
    """Those that no other one beats in both, by the first number ascending."""
    kept: list[int] = []
    for i in sorted(range(len(places)), key=lambda i: places[i]):
        if not kept or places[i][1] < places[kept[-1]][1]:
            kept.append(i)
    return kept


def _time_error_chart(times, errors, shown: Sequence[Series], front: Sequence[int], size: tuple[int, int], css: str) -> str:
    every = list(times)
    x, y = [times[one] for one in shown], [100 * errors[one] for one in shown]
    chart = svg.Chart.of(size, 14, (min(x) / 1.5, max(x) * 1.8), (min(y) / 1.4, max(y) * 1.4), True)
    on_front = [shown[i] for i in front]
    corners = [(x[front[0]], chart.y.high)]
    for i in front:
        corners += [(x[i], corners[-1][1]), (x[i], y[i])]
    corners.append((chart.x.high, corners[-1][1]))
    body = [chart.line(corners, "front", "", "The front")]
    places = [(chart.x(a), chart.y(b)) for a, b in zip(x, y)]
    order = sorted(range(len(shown)), key=lambda i: (shown[i] not in on_front, errors[shown[i]]))
    names = [name_of(shown[i], every) for i in order]
    box = (chart.x.start, chart.y.end - 6, chart.width - 2.0, chart.y.start)
    line = [(chart.x(a), chart.y(b)) for a, b in corners]
    found = svg.beside([places[i] for i in order], names, places, line, box)
    for i, name, at in zip(order, names, found):
        one = shown[i]
        filled = "" if one.protocol == "paper" else ";fill:var(--panel)"
        title = f"{name}: {number(x[i])} µs a point, {number(y[i])} %"
        body.append(
            chart.mark(
                x[i], y[i], 5 if one in on_front else 3.5, "mark", f"stroke:{_color(one)};fill:{_color(one)}{filled}", title
            )
        )
        if at:
            css_name = "name" if one in on_front else "name quiet"
            body.append(f"<text class='{css_name}' x='{at[0]:.1f}' y='{at[1]:.1f}' text-anchor='{at[2]}'>{text(name)}</text>")
    label = f"On the front, from the fastest on: {sentence_list([name_of(one, every) for one in on_front])}."
    return chart.html(label, "µs a point", "Median L2 error, %", body, css)


# The league.


@dataclass(frozen=True)
class _Line:
    """Entrants whose errors are the same on every case."""

    first: int  # place of the first one
    members: list[Standing]


def lines_of(rating: Rating) -> list[_Line]:
    lines: list[_Line] = []
    for place, one in enumerate(rating.standings):
        before = lines[-1].members[0] if lines else None
        if before and np.allclose(
            *(rating.division.results.errors[rating.standings.index(x)] for x in (before, one)), rtol=1e-6
        ):
            lines[-1].members.append(one)
        else:
            lines.append(_Line(place, [one]))
    return lines


def _league(rating: Rating, timed: Division | None) -> str:
    every = [one.series for one in rating.standings]
    times = typical_times(timed) if timed else {}
    rows = [_league_row(line, every, len(every), times) for line in lines_of(rating)]
    head = (
        "<thead><tr><th scope='col'>Method</th><th scope='col'>Mean rank, 95 %</th><th scope='col' class='number'>L2, %</th>"
        "<th scope='col' class='number more'>Elo</th><th scope='col' class='number more'>µs a point</th>"
        "<th scope='col' class='number'>Failures</th></tr></thead>"
    )
    table = f"<table class='league'><caption>League of {_cases(rating)}; methods with the same results share a line</caption>{head}<tbody>{''.join(rows[:FIRST_ROWS])}</tbody></table>"
    rest = rows[FIRST_ROWS:]
    if rest:
        table += f"<details><summary>{len(rest)} more</summary><table class='league'>{head}<tbody>{''.join(rest)}</tbody></table></details>"
    if rating.division.left_out:
        names = sentence_list([name_of(one, rating.division.left_out) for one in rating.division.left_out])
        table += f"<p class='muted'>With less than half of the cases, and so not rated: {text(names)}.</p>"
    return f"<div class='league-box' id='league-{rating.division.name}'>{table}</div>"


def _league_row(line: _Line, every: Sequence[Series], worst: int, times: dict[Series, float]) -> str:
    one = line.members[0]
    names = [name_of(member.series, every) for member in line.members]
    also = f"<small>and {text(sentence_list(names[1:]))}</small>" if names[1:] else ""
    known = sorted(times[member.series] for member in line.members if math.isfinite(times.get(member.series, math.inf)))
    spread = number(known[0]) + (f"–{number(known[-1])}" if known[1:] else "") if known else "–"

    def share(rank: float) -> str:
        return f"{100 * (rank - 1) / max(1, worst - 1):.1f}%"

    low, high = one.rank_interval or (one.rank, one.rank)
    bar = (
        f"<span class='bar' aria-hidden='true' style='--at:{share(one.rank)};--low:{share(low)};--high:{share(high)};"
        f"--own:{_color(one.series)}'></span>"
    )
    interval = f"<small class='inline'>{number(low)}–{number(high)}</small>" if one.rank_interval else ""
    return (
        f"<tr data-entrant='{text(one.series.key)}'><th scope='row'><span class='place'>{line.first + 1}</span>"
        f"<span class='swatch' data-method='{text(one.series.method)}'></span>{text(names[0])}{also}</th>"
        f"<td class='ranks'>{bar}<span class='value'>{number(one.rank)} {interval}</span></td>"
        f"<td class='number'>{number(100 * one.error)}</td><td class='number more'>{one.elo:.0f}</td>"
        f"<td class='number more'>{spread}</td><td class='number'>{one.failures}</td></tr>"
    )


# Who is good at what.

# Of a cell's colour, in percent: at so many times the smallest error of its column, and above, it is the strongest.
_STRONGEST, _WORST_RATIO = 46, 10.0
# More cases than that are not listed by a cell.
MOST_LISTED = 2000


def where_html(front: Front) -> str:
    """A heat map for each division, and who beats whom; empty without ratings."""
    parts = []
    for k, rating in enumerate(front.ratings):
        shown = _heat_map(rating, front.own) + _wins(rating)
        summary = f"<summary>Methods that {KNOWS[rating.division.name]}</summary>"
        parts.append(f"<details>{summary}{shown}</details>" if k else shown)
    return "".join(parts)


def listed_cases(front: Front) -> dict[str, list[str]]:
    """By part, such as blind/sampler/noise: the cases that its cells lead to. Of an evaluation, whose cases the page does not
    have, nothing."""
    if not front.own:
        return {}
    found: dict[str, list[str]] = {}
    for rating in front.ratings:
        for case in rating.division.results.cases:
            for key in (f"kind/{case.kind}", f"sampler/{case.sampler}"):
                found.setdefault(f"{rating.division.name}/{key}", []).append(case.task)
    return {key: cases for key, cases in found.items() if len(cases) <= MOST_LISTED}


def _heat_map(rating: Rating, linked: bool) -> str:
    every = [one.series for one in rating.standings]
    columns = [(f"kind/{part.name}", part) for part in rating.kinds] + [
        (f"sampler/{part.name}", part) for part in rating.samplers
    ]
    head = "".join(
        f"<th scope='col' class='number{' apart' if k == len(rating.kinds) else ''}'>{text(part.name)}<small>{part.cases}</small></th>"
        for k, (_, part) in enumerate(columns)
    )
    rows = ""
    for line in lines_of(rating):
        name = name_of(line.members[0].series, every)
        also = f"<small>and {len(line.members) - 1} more</small>" if line.members[1:] else ""
        cells = "".join(
            _heat_cell(
                part,
                line.first,
                name,
                f"{rating.division.name}/{key}" if linked and part.cases <= MOST_LISTED else "",
                every[line.first],
            )
            for key, part in columns
        )
        rows += f"<tr><th scope='row'><span class='swatch' data-method='{text(every[line.first].method)}'></span>{text(name)}{also}</th>{cells}</tr>"
    links = " A number leads to its cases." if linked else " The cases are of an evaluation beside this run, in its league.csv."
    return (
        "<p class='muted'>Median L2 error in %, by kind of shape and by way to sample the points; below each its number of cases. The stronger the "
        f"colour, the further behind the best of the column, which is marked with •.{links}</p>"
        "<div class='scroll' tabindex='0' role='region' aria-label='Errors by kind of shape and way to sample'>"
        f"<table class='heat' id='heat-{rating.division.name}'><thead><tr><th scope='col'>Method</th>{head}</tr></thead><tbody>{rows}</tbody></table></div>"
    )


def _heat_cell(part: Part, place: int, name: str, key: str, series: Series) -> str:
    best, error = min(part.errors), part.errors[place]
    ratio = 1.0 if error <= best else error / best if best > 0 else math.inf
    strength = _STRONGEST * min(1.0, math.log(ratio) / math.log(_WORST_RATIO)) if math.isfinite(ratio) else _STRONGEST
    mark = "<span class='best' title='the best'>•</span>" if number(100 * error) == number(100 * best) else ""
    shown = mark + number(100 * error)
    if key:
        label = f"{name}, {part.name}: {number(100 * error)} %, {count_of(part.cases, 'case')}"
        shown = (
            f"<a href='#runs' data-part='{text(key)}' data-entrant='{text(series.key)}' aria-label='{text(label)}'>{shown}</a>"
        )
    return f"<td class='number' style='--strength:{strength:.0f}%'>{shown}</td>"


def _wins(rating: Rating) -> str:
    """A line and a column for those with the same results."""
    every = [one.series for one in rating.standings]
    lines = lines_of(rating)
    names = [text(name_of(line.members[0].series, every)) for line in lines]
    head = "".join(f"<th scope='col' class='number'>{name}</th>" for name in names)
    rows = ""
    for one, name in zip(lines, names):
        cells = ""
        for other in lines:
            won, tied = (100 * values[one.first, other.first] for values in (rating.wins, rating.ties))
            small = f"<small>{tied:.0f}</small>" if tied >= 0.5 else ""
            cells += (
                f"<td class='number' style='--strength:{40 * rating.wins[other.first, one.first]:.0f}%'>{won:.0f}{small}</td>"
                if one is not other
                else "<td></td>"
            )
        rows += f"<tr><th scope='row'>{name}</th>{cells}</tr>"
    return (
        f"<details><summary>Who beats whom</summary><p class='muted'>On which share of the cases, in %, the method of the row beats that of the "
        f"column; small: on which they are tied ({TIE_WORDS}). The stronger the colour, the more it loses.</p><div class='scroll' tabindex='0' role='region' aria-label='Who beats whom'>"
        f"<table class='heat' id='wins-{rating.division.name}'><thead><tr><th scope='col'>Method</th>{head}</tr></thead>"
        f"<tbody>{rows}</tbody></table></div></details>"
    )
