"""Who is good at what: the errors by kind of shape and by way to sample, and who beats whom, as tables of a page."""

import math

from front import Front, lines_of
from markup import details, link_to_method, named, scroll
from ratings import KNOWS, TIE_WORDS, Part, Rating
from records import Series
from report_common import asked, count_of, number, short_name, text

# Of a cell's colour, in percent: at so many times the smallest error of its column, and above, it is the strongest.
_STRONGEST, _WORST_RATIO = 46, 10.0
# More cases than that are not listed by a cell.
MOST_LISTED = 2000


def where_html(front: Front) -> str:
    """A heat map for each division, and who beats whom."""
    parts = []
    for k, rating in enumerate(front.ratings):
        shown = _heat_map(rating, front) + _wins(rating)
        parts.append(details(f"Methods that {KNOWS[rating.division.name]}", shown) if k else shown)
    return "".join(parts) or "<p>There are no ratings.</p>"


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


def _heat_map(rating: Rating, front: Front) -> str:
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
        name = short_name(line.members[0].series, every)
        also = f"<small>and {len(line.members) - 1} more</small>" if line.members[1:] else ""
        cells = "".join(
            _heat_cell(
                part,
                line.first,
                name,
                f"{rating.division.name}/{key}" if front.own and part.cases <= MOST_LISTED else "",
                every[line.first],
                front.report,
            )
            for key, part in columns
        )
        method = every[line.first].method
        rows += f"<tr><th scope='row'>{named(method, link_to_method(name, method, front.pages))}{also}</th>{cells}</tr>"
    links = (
        " A number leads to its cases." if front.own else " The cases are of an evaluation beside this run, in its league.csv."
    )
    said = (
        "Median L2 error in %, by kind of shape and by way to sample the points; below each its number of cases. The stronger the "
        f"colour, the further behind the best of the column, which is marked with •.{links}"
    )
    table = _heat_table(f"heat-{rating.division.name}", head, rows)
    return f"<p class='muted'>{said}</p>{scroll('Errors by kind of shape and way to sample', table)}"


def _heat_table(identity: str, heads: str, rows: str) -> str:
    head = f"<thead><tr><th scope='col'>Method</th>{heads}</tr></thead>"
    return f"<table class='heat' id='{identity}'>{head}<tbody>{rows}</tbody></table>"


def _heat_cell(part: Part, place: int, name: str, key: str, series: Series, report: str) -> str:
    best, error = min(part.errors), part.errors[place]
    ratio = 1.0 if error <= best else error / best if best > 0 else math.inf
    strength = _STRONGEST * min(1.0, math.log(ratio) / math.log(_WORST_RATIO)) if math.isfinite(ratio) else _STRONGEST
    mark = (
        "<span class='best'>•<span class='hidden'> the best: </span></span>"
        if math.isfinite(best) and number(100 * error) == number(100 * best)
        else ""
    )
    shown = mark + number(100 * error)
    if key:
        label = f"{name}, {part.name}: {number(100 * error)} %, {count_of(part.cases, 'case')}{', the best' if mark else ''}"
        address = asked("runs", report, part=key, entrant=series.key)
        shown = f"<a href='{address}' data-part='{text(key)}' data-entrant='{text(series.key)}' aria-label='{text(label)}'>{shown}</a>"
    return f"<td class='number' style='--strength:{strength:.0f}%'>{shown}</td>"


def _wins(rating: Rating) -> str:
    """A line and a column for those with the same results."""
    every = [one.series for one in rating.standings]
    lines = lines_of(rating)
    names = [text(short_name(line.members[0].series, every)) for line in lines]
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
    said = (
        "On which share of the cases, in %, the method of the row beats that of the column; small: on which they are tied "
        f"({TIE_WORDS}). The stronger the colour, the more it loses."
    )
    table = scroll("Who beats whom", _heat_table(f"wins-{rating.division.name}", head, rows))
    return details("Who beats whom", f"<p class='muted'>{said}</p>{table}")
