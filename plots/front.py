"""The first screen of a page: who leads, by how much, how sure that is and where it does not; speed and accuracy in two
charts; the league; six telling pictures.

A report is made of it, and so can be the front page of a site: everything here is HTML that needs no script.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from front_charts import charts_html, color_of
from markup import details, link_to_method, named, row_of, table
from ratings import KNOWS, Division, Rating, Standing, divisions, has_times, rate, read, twins, typical_times
from records import Series, read_json
from report_common import count_of, number, sentence_list, short_name, text

# Shown at once; the others are behind a click.
FIRST_ROWS = 8
# Of a commit.
BUILD_DIGITS = 9
# Exceptions that the sentence names.
_MOST_EXCEPTIONS = 3


@dataclass(frozen=True)
class Front:
    """What the first screen is of."""

    ratings: list[Rating]  # by division, blind first
    timed: list[Division]  # the run's own, with times
    own: bool  # the ratings are of the run itself, not of an evaluation beside it
    why_empty: str  # a sentence where there is no rating
    build: str = ""  # commit of the build that was rated, of an evaluation that says it
    # Of pages that stand elsewhere: those of methods, by name, and the report; empty: there is none.
    pages: Mapping[str, str] = field(default_factory=dict)
    report: str = ""


def make_front(folder: Path, mixed_times: bool = False) -> Front:
    """Of the run or suite in this folder; mixed_times: its times are of several machines or builds, and so not shown.
    Raises RecordError when its results cannot be read."""
    league, cases = folder / "league.csv", folder / "cases.csv"
    if not league.is_file() and not cases.is_file():
        said = f"There are no ratings: {cases} is not there; 'hullbench league {folder} --all-cases --csv {cases}' writes it."
        return Front([], [], True, said)
    own = read(cases) if cases.is_file() else None
    rated = [rate(one) for one in divisions(read(league) if league.is_file() else own)]
    timed = [one for one in divisions(own) if has_times(one)] if own and not mixed_times else []
    why = "" if rated else "Nobody leads: no two methods that know as much have a case with a truth in common."
    return Front(rated, timed, not league.is_file(), why, _build(folder / "league.json") if league.is_file() else "")


def _build(league: Path) -> str:
    return read_json(league, "league.schema.json")["tool"].get("commit", "") if league.is_file() else ""


def front_html(front: Front, strip: str) -> str:
    if not front.ratings:
        return f"<p class='lead'>{text(front.why_empty)}</p>{strip}"
    timed = {one.name: one for one in front.timed}

    def shown(rating: Rating) -> str:
        own = timed.get(rating.division.name)
        return f"<p class='lead'>{lead_sentence(rating, own)}</p>{charts_html(own)}{_league(rating, own, front)}"

    first, *others = front.ratings
    more = (details(f"Methods that {KNOWS[one.division.name]}", shown(one), " class='wide'") for one in others)
    return shown(first) + strip + "".join(more)


# The sentence.


def lead_sentence(rating: Rating, timed: Division | None) -> str:
    """As HTML, the leader in bold."""
    first, second = rating.standings[:2]
    every = [one.series for one in rating.standings]
    name, lead = text(short_name(first.series, every)), rating.lead
    others = [text(short_name(one.series, every)) for one in rating.standings if one is not first]
    same = [one for one, other in zip(others, rating.standings[1:]) if other.rank == first.rank]
    methods = len({one.method for one in every})
    field = f"{count_of(len(every), 'entry')} of {count_of(methods, 'method')} that {KNOWS[rating.division.name]}"
    if same:
        said = f"<b>{name}</b> and {sentence_list(same)} are the first of {field}, with the same mean rank {number(first.rank)} over {_cases(rating)}"
    else:
        verb = "leads" if lead.clear else "is ahead, but not clearly, of"
        said = f"<b>{name}</b> {verb} {field}: mean rank {number(first.rank)}{interval_words(first.rank_interval)} over {_cases(rating)}, then {others[0]} with {number(second.rank)}"
        said += f"; in the median case its error is {number(lead.ratio)} times that one’s{interval_words(lead.ratio_interval)}"
    said += time_words(rating, timed, first.series)
    return said + f". {_exceptions(rating)}"


def _cases(rating: Rating) -> str:
    return f"{count_of(len(rating.division.results.cases), 'case')} of {count_of(rating.shapes, 'shape')}"


def interval_words(interval: tuple[float, float] | None) -> str:
    return f" (95 %: {number(interval[0])} to {number(interval[1])})" if interval else ""


def time_words(rating: Rating, timed: Division | None, series: Series) -> str:
    times = typical_times(timed) if timed else {}
    if timed is None or not math.isfinite(times.get(series, math.inf)):
        return ""
    return f", at {number(times[series])} µs a point{_where_timed(rating, timed)}"


def _where_timed(rating: Rating, timed: Division) -> str:
    """The ratings may be of an evaluation, whose cases nobody timed."""
    same = timed.results.cases == rating.division.results.cases
    return "" if same else f" in {count_of(len(timed.results.cases), 'case')} of this run"


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
        f"{text(part.name)} ({text(short_name(every[int(np.argmin(part.ranks))], every))})" for part in lost[:_MOST_EXCEPTIONS]
    ]
    if len(lost) > _MOST_EXCEPTIONS:
        said.append(f"<a href='#where'>{len(lost) - _MOST_EXCEPTIONS} more</a>")
    return f"It is not the first on {sentence_list(said)}."


# The league.


@dataclass(frozen=True)
class _Line:
    """Entrants whose errors are the same on every case."""

    first: int  # place of the first one
    members: list[Standing]


def lines_of(rating: Rating) -> list[_Line]:
    lines: dict[int, _Line] = {}
    for place, (one, first) in enumerate(zip(rating.standings, twins(rating.division.results.errors))):
        lines.setdefault(int(first), _Line(place, [])).members.append(one)
    return list(lines.values())


_LEAGUE = {
    "Method": "",
    "Mean rank, 95 %": "ranks",
    "L2, %": "number",
    "Elo": "number more",
    "µs a point": "number more",
    "Failures": "number",
}


def _league(rating: Rating, timed: Division | None, front: Front) -> str:
    every = [one.series for one in rating.standings]
    times = typical_times(timed) if timed else {}
    rows = [_league_row(place, line, every, times, front.pages) for place, line in enumerate(lines_of(rating), 1)]
    caption = f"League of {_cases(rating)}; methods with the same results share a line"
    if front.build:
        caption += f"; the ranks are of build {text(front.build[:BUILD_DIGITS])}"
    if timed and (where := _where_timed(rating, timed)):
        caption += f"; times are medians{where}"
    shown = table(_LEAGUE, "".join(rows[:FIRST_ROWS]), " class='league'", caption)
    rest = rows[FIRST_ROWS:]
    if rest:
        shown += details(f"{len(rest)} more", table(_LEAGUE, "".join(rest), " class='league'", caption))
    if rating.division.left_out:
        names = sentence_list([short_name(one, rating.division.left_out) for one in rating.division.left_out])
        shown += f"<p class='muted'>Not rated, as the others have more cases in common without them: {text(names)}.</p>"
    return f"<div class='league-box' id='league-{rating.division.name}'>{shown}</div>"


def _league_row(place: int, line: _Line, every: Sequence[Series], times: dict[Series, float], pages: Mapping[str, str]) -> str:
    one = line.members[0]
    names = [short_name(member.series, every) for member in line.members]
    also = f"<small>and {text(sentence_list(names[1:]))}</small>" if names[1:] else ""
    known = sorted(times[member.series] for member in line.members if math.isfinite(times.get(member.series, math.inf)))
    spread = number(known[0]) + (f"–{number(known[-1])}" if known[1:] else "") if known else "–"

    def share(rank: float) -> str:
        return f"{100 * (rank - 1) / max(1, len(every) - 1):.1f}%"

    low, high = one.rank_interval or (one.rank, one.rank)
    bar = (
        f"<span class='bar' aria-hidden='true' style='--at:{share(one.rank)};--low:{share(low)};--high:{share(high)};"
        f"--own:{color_of(one.series)}'></span>"
    )
    interval = f"<small class='inline'>{number(low)}–{number(high)}</small>" if one.rank_interval else ""
    name = named(one.series.method, link_to_method(names[0], one.series.method, pages))
    cells = [
        f"<span class='place'>{place}</span>{name}{also}",
        f"{bar}<span class='value'>{number(one.rank)} {interval}</span>",
        number(100 * one.error),
        f"{one.elo:.0f}",
        spread,
        one.failures,
    ]
    return row_of(_LEAGUE, cells, f" data-entrant='{text(one.series.key)}'")
