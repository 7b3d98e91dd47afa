"""The pages of a run, as HTML without scripts. A link within the site begins with a mark; make_site.py writes there where that
is, seen from the page."""

import math
import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any
from urllib.parse import quote

import numpy as np

from front import front_html, interval_words, lines_of, time_words
from markup import facts_of, link_to_method, named, table_of
from page import PLOTS, Section, byline
from ratings import KNOWS, Division, Rating, mean_ranks, typical_errors, typical_times
from records import RecordError
from report_common import count_of, number, protocol_words, sentence_list, short_name, text
from report_html import PARAMETER, abilities, entry_parameters, parameter_cells, standings_table, version_html
from site_run import SiteRun, protocol_order, what_it_is, zoo_cases
from strip import Shown, card, cards_html, strip_html, title_of_case
from where import where_html

# Where a link leads from: the pages of the run, its files (its report among them), the site's first folder.
PAGE, FILE, TOP = "\ue000", "\ue001", "\ue002"
REPORT = f"{FILE}report.html"
MOST_PICTURES = 10
_ADDRESS = re.compile(r"https?://[^\s,<>\"']*[^\s,;.)<>\"']")


@dataclass(frozen=True)
class SitePage:
    address: str  # among the run's pages
    title: str
    kind: str  # what the search calls it
    words: str  # what else the search finds it by
    sections: list[Section]


@dataclass(frozen=True)
class Download:
    address: str  # among the run's files
    kind: str  # the heading that it stands under
    what: str
    size: int  # in bytes


def pages_of(run: SiteRun, runs: Sequence[SiteRun], files: Sequence[Download]) -> list[SitePage]:
    """`runs`: all of the site, the newest first. The first page of each kind leads to the others. Raises RecordError where two
    would be one file."""
    pages = _pages(run, runs, files)
    taken: dict[str, SitePage] = {}
    for page in pages:
        # A file system may not tell capitals from small letters.
        other = taken.setdefault(page.address.lower(), page)
        if other is not page:
            raise RecordError(
                f"the pages of '{other.title}' and '{page.title}' would be one file, {page.address}; give one another name"
            )
    return pages


def _pages(run: SiteRun, runs: Sequence[SiteRun], files: Sequence[Download]) -> list[SitePage]:
    datasets = {name: one for name, one in run.datasets.items() if name not in zoo_cases()}
    adding = [Section("steps", "Steps", "Step by step", (PLOTS / "add_method.html").read_text(encoding="utf-8"))]
    methods = [Section("list", "Methods", "All methods", _methods(run))]
    lists = [Section("list", "Data sets", "All data sets", _datasets(run, datasets))]
    front = _front(run, runs, datasets)
    return [
        SitePage("index.html", "Concave hulls: who is good at what", "Page", "hullbench league home", front),
        SitePage("methods/index.html", "Methods", "Page", "", methods),
        *(
            SitePage(address_of("methods", name), one["title"], "Method", name, _method(run, name, one))
            for name, one in run.methods.items()
        ),
        SitePage("datasets/index.html", "Data sets", "Page", "", lists),
        *(
            SitePage(address_of("datasets", name), one["title"], "Data set", name, _dataset(run, name, one))
            for name, one in datasets.items()
        ),
        SitePage("zoo/index.html", "The zoo", "Page", "inputs that broke somebody", _zoo(run)),
        *(
            SitePage(address_of("zoo", name), one.title, "Zoo", f"{name} {one.fault}", _zoo_case(run, name))
            for name, one in zoo_cases().items()
        ),
        SitePage("add.html", "Add your method", "Page", "adapter manifest", adding),
        SitePage("downloads.html", "Downloads", "Page", "CSV JSON schema tables records", _downloads(files)),
    ]


def address_of(folder: str, name: str) -> str:
    return f"{folder}/{re.sub(r'[^A-Za-z0-9_-]', '-', name)}.html"


def _link(address: str, words: str) -> str:
    """`address` with its mark, `words` as they are."""
    return f"<a href='{text(address)}'>{text(words)}</a>"


def _linked(words: str) -> str:
    """A record's text as HTML, in which addresses are links."""
    made, end = "", 0
    for one in _ADDRESS.finditer(words):
        made += text(words[end : one.start()]) + _link(one[0], one[0])
        end = one.end()
    return made + text(words[end:]) or "–"


def _method_pages(run: SiteRun) -> dict[str, str]:
    return {name: PAGE + address_of("methods", name) for name in run.methods}


# The front page.


def _front(run: SiteRun, runs: Sequence[SiteRun], datasets: dict[str, Any]) -> list[Section]:
    front = replace(run.front, pages=_method_pages(run), report=REPORT)
    strip = strip_html(run.experiments, front.ratings[0] if front.ratings else None, run.pictures, REPORT)
    return [
        Section("summary", "Summary", "Summary", front_html(front, strip)),
        Section("where", "Who is good at what", "Who is good at what", where_html(front)),
        Section("here", "What is here", "What is here", _doors(run, datasets)),
        Section("releases", "Runs", "Runs", _releases(runs)),
    ]


def _doors(run: SiteRun, datasets: dict[str, Any]) -> str:
    doors = [
        ("methods/index.html", count_of(len(run.methods), "method"), "what each is, its parameters, where it is good"),
        ("datasets/index.html", count_of(len(datasets), "data set"), "where each is from, and who does best on it"),
        ("zoo/index.html", count_of(len(zoo_cases()), "input") + " that broke somebody", "what went wrong, and what is right"),
        ("add.html", "Add your method", "in any language, step by step"),
        ("downloads.html", "Downloads", "every result and table, as CSV and JSON"),
    ]
    items = "".join(f"<li>{_link(PAGE + address, words)}<small>{text(more)}</small></li>" for address, words, more in doors)
    whole = _link(REPORT, "The whole report")
    return f"<ul class='doors'>{items}<li>{whole}<small>every run of this suite, with charts and pictures</small></li></ul>"


def _releases(runs: Sequence[SiteRun]) -> str:
    rows = []
    for one in runs:
        folder = f"{TOP}runs/{quote(one.name)}"
        rows.append(
            [_link(f"{folder}/index.html", one.name), byline(one.experiments), _link(f"{folder}/report.html", "report")]
        )
    table = table_of("Runs", {"Run": "", "Of": "", "Report": ""}, rows)
    return f"<p class='muted'>The newest first. These addresses stay.</p>{table}"


# Methods.


def _entries(run: SiteRun, method: str) -> list[tuple[Rating, int]]:
    """Where it stands: divisions, with its places among the standings."""
    return [
        (rating, place)
        for rating in run.front.ratings
        for place, one in enumerate(rating.standings)
        if one.series.method == method
    ]


def _place_in(values: Iterable[float], own: float) -> int:
    """1: nobody has a smaller one; those with the same count once."""
    return 1 + len({round(value, 9) for value in values if value < own - 1e-9})


def _rank(rating: Rating, place: int) -> int:
    return _place_in((one.rank for one in rating.standings), rating.standings[place].rank)


_METHOD = {"Method": "", "Place, points only": "", "Place, informed": "", "Holes": "", "Several polygons": "", "Licence": ""}


def _methods(run: SiteRun) -> str:
    rows = []
    for name, method in run.methods.items():
        places = []
        for division in KNOWS:
            ranks = [(_rank(rating, k), rating) for rating, k in _entries(run, name) if rating.division.name == division]
            best = min(ranks, key=lambda one: one[0], default=None)
            places.append(f"{best[0]} of {len(lines_of(best[1]))}" if best else "–")
        title = link_to_method(method["title"], name, _method_pages(run))
        what = f"<small>{text(what_it_is(name))}</small>"
        can = method["capabilities"]
        able = ["yes" if can.get(one) else "no" if can else "–" for one in ("holes", "several_polygons")]
        rows.append([named(name, title + what), *places, *able, text(method["licence"])])
    said = "; ".join(
        f"{words}: methods that {KNOWS[name]}" for name, words in (("blind", "Points only"), ("informed", "informed"))
    )
    table = table_of("Methods", _METHOD, rows)
    return f"<p class='muted'>Places are by mean rank, of a method’s best entry. {text(said)}.</p>{table}"


def _method(run: SiteRun, name: str, method: dict[str, Any]) -> list[Section]:
    facts = {
        "Name in plans and records": f"<code>{text(name)}</code>",
        "Citation": _linked(method["citation"]),
        "Licence": text(method["licence"]) or "–",
        "Version": version_html(method) or "–",
        "The library returns": text(method["native_output"]) or "–",
        "Can do": text(abilities(method)),
    }
    what = what_it_is(name)
    about = (f"<p>{text(what)}.</p>" if what else "") + facts_of(facts)
    meaning = [[text(one["name"]), *parameter_cells(one)] for one in method["parameters"]]
    parameters = table_of("Parameters", {"Parameter": "", **PARAMETER}, meaning) if meaning else "<p>It has none.</p>"
    good = "".join(_rated(run, rating, place) for rating, place in _entries(run, name))
    standing = standings_table(run.summaries, name)
    pictures = _pictures(_method_pictures(run, name))
    return [
        Section("about", "Description", "What it is", about),
        Section("good", "Where it is good", "Where it is good", good or f"<p>{_unrated(run, name)}</p>"),
        *([Section("pictures", "Pictures", "Pictures", pictures)] if pictures else []),
        Section("parameters", "Parameters", "Parameters", parameters + _chosen(run, name)),
        *([Section("standing", "By experiment", "Experiment by experiment", standing)] if standing else []),
    ]


def _unrated(run: SiteRun, name: str) -> str:
    left_out = [series for rating in run.front.ratings for series in rating.division.left_out]
    if any(series.method == name for series in left_out):
        return "It is not rated, as the others have more cases in common without it."
    return "This run has no results of it that can be rated."


def _rated(run: SiteRun, rating: Rating, place: int) -> str:
    """An entry's standing in its division, and on each part of the cases."""
    every = [one.series for one in rating.standings]
    one, count = rating.standings[place], len(lines_of(rating))
    timed = {division.name: division for division in run.front.timed}.get(rating.division.name)
    said = (
        f"<b>{text(short_name(one.series, every))}</b> has place {_rank(rating, place)} of {count} among the different results of methods that "
        f"{KNOWS[rating.division.name]}: mean rank {number(one.rank)}{interval_words(one.rank_interval)}, median error "
        f"{number(100 * one.error)} %{time_words(rating, timed, one.series)}, {count_of(one.failures, 'failure')}."
    )
    rows, firsts = [], []
    for part in [*rating.kinds, *rating.samplers]:
        first, own = int(np.argmin(part.ranks)), _place_in(part.ranks, part.ranks[place])
        firsts += [part.name] if own == 1 else []
        errors = (number(100 * part.errors[k]) for k in (first, place))
        rows.append([text(part.name), text(short_name(every[first], every)), *errors, own, part.cases])
    said += f" It is the first on {text(sentence_list(firsts))}." if firsts else ""
    columns = {"Kind of shape, or way to sample": "", "First by mean rank": ""}
    columns |= dict.fromkeys(("Its error, %", "Here, %", "Place", "Cases"), "number")
    return f"<p>{said}</p>{table_of(f'Places of {short_name(one.series, every)}', columns, rows)}"


def _chosen(run: SiteRun, name: str) -> str:
    """What each protocol gave it."""
    found: dict[tuple[str, str, str], list[str]] = {}
    for experiment in run.experiments:
        for entry in experiment.plan.get("methods", []):
            if entry.get("method") == name:
                key = (entry.get("protocol", ""), entry_parameters(entry, experiment), entry.get("note", ""))
                found.setdefault(key, []).append(experiment.title)
    words = protocol_words(run.experiments)
    rows = [
        [
            f"{text(protocol)}<small>{text(words.get(protocol, ''))}</small>",
            f"{text(values)}<small>{_linked(note) if note else ''}</small>",
            text(", ".join(dict.fromkeys(titles))),
        ]
        for (protocol, values, note), titles in found.items()
    ]
    table = table_of("Chosen", {"Protocol": "", "Parameters": "prose", "Experiments": ""}, rows)
    return f"<h3>In this run</h3>{table}" if rows else ""


# Pictures.


def _pictures(chosen: Sequence[tuple[str, Shown]]) -> str:
    """Each with what it is called; empty without any."""
    cards = "".join(card(place, what, one, one.row.series.protocol, REPORT) for place, (what, one) in enumerate(chosen))
    return f"<div class='strip many'>{cards_html(cards)}</div>" if cards else ""


def _badness(one: Shown) -> tuple[float, str]:
    return (math.inf if one.error is None else one.error, one.row.name)


def _method_pictures(run: SiteRun, method: str) -> list[tuple[str, Shown]]:
    """Under the protocol that most are of, evenly from the best case to the worst."""
    own = [one for one in run.drawn if one.row.method == method]
    counts = Counter(protocol_order(one.row) for one in own)
    most = max(counts, key=lambda order: (counts[order], -order), default=0)
    ordered = sorted((one for one in own if protocol_order(one.row) == most), key=_badness)
    last = min(len(ordered), MOST_PICTURES) - 1
    chosen = [ordered[round(k * (len(ordered) - 1) / max(last, 1))] for k in range(last + 1)]
    return [(title_of_case(one), one) for one in chosen]


def _dataset_pictures(run: SiteRun, dataset: str) -> list[tuple[str, Shown]]:
    """The case that most methods have a picture of, the smallest of them, and what each made of it, the best first."""
    cases: dict[str, dict[str, Shown]] = {}
    for one in run.drawn:
        if run.family(one.row.dataset) == dataset:
            methods = cases.setdefault(one.row.case, {})
            before = methods.get(one.row.method)
            if before is None or protocol_order(one.row) < protocol_order(before.row):
                methods[one.row.method] = one
    best = min(cases.items(), key=lambda one: (-len(one[1]), next(iter(one[1].values())).row.n, one[0]), default=("", {}))[1]
    ordered = sorted(best.values(), key=_badness)[:MOST_PICTURES]
    return [(short_name(one.row.series, [one.row.series]), one) for one in ordered]


# Data sets.


def _members(name: str, one: dict[str, Any]) -> str:
    count = one.get("members", 0)
    return f"{name}-1 to {name}-{count}" if count else name


def _datasets(run: SiteRun, datasets: dict[str, dict[str, Any]]) -> str:
    rows = [
        [
            f"{_link(PAGE + address_of('datasets', name), one['title'])}<small>{text(_members(name, one))}</small>",
            _linked(one["source"]),
            _linked(one["licence"]),
            sum(run.cases.get(name, {}).values()),
        ]
        for name, one in datasets.items()
    ]
    columns = {"Data set": "", "Source": "prose", "Licence": "", "Cases in this run": "number"}
    return table_of("Data sets", columns, rows)


def _dataset(run: SiteRun, name: str, one: dict[str, Any]) -> list[Section]:
    member = f"{name}-1" if one.get("members") else name
    area = "–" if one["area"] is None else f"{number(one['area'])} in the square of the points’ unit"
    if one["holes_area"] is not None:
        area += f", {number(one['holes_area'])} with holes"
    measured = ", ".join(f"{text(title)}: {count_of(count, 'case')}" for title, count in run.cases.get(name, {}).items())
    facts = {
        "Name": f"<code>{text(_members(name, one))}</code>",
        "Source": _linked(one["source"]),
        "Licence": _linked(one["licence"]),
        "Area": text(area),
        "SHA-256 of its file": f"<code>{text(one['sha256'])}</code>" if one["sha256"] else "–",
        "In this run": measured or "not measured",
    }
    points = (
        f"<p><code>build/hullbench points {text(member)} --n 2000 --out points.csv</code> writes points of it into a file, "
        "without <code>--n</code> where they come with the shape.</p>"
    )
    tables = "".join(_division_table(run, division) for division in run.divisions(name))
    pictures = _pictures(_dataset_pictures(run, name))
    return [
        Section("about", "Description", "What it is", facts_of(facts) + points),
        Section("results", "Who does best", "Who does best", tables or "<p>This run has no results that can be compared.</p>"),
        *([Section("pictures", "Pictures", "The same points", pictures)] if pictures else []),
    ]


def _division_table(run: SiteRun, division: Division) -> str:
    results = division.results
    every, ranks = results.entrants, mean_ranks(results)
    errors, times = typical_errors(division), typical_times(division)
    rows = []
    for i in np.argsort(ranks, kind="stable"):
        one = every[i]
        name = named(one.method, link_to_method(short_name(one, every), one.method, _method_pages(run)))
        time = number(times[one]) if math.isfinite(times[one]) else "–"
        failures = int(np.sum(np.isinf(results.errors[i])))
        rows.append([name, number(float(ranks[i])), number(100 * errors[one]), time, failures])
    columns = {"Method": "", **dict.fromkeys(("Mean rank", "L2, %", "µs a point", "Failures"), "number")}
    title = f"Methods that {KNOWS[division.name]}"
    return f"<h3>{title}, {count_of(len(results.cases), 'case')}</h3>{table_of(title, columns, rows)}"


# The zoo.


def _right(run: SiteRun, name: str) -> str:
    """How many methods are right."""
    answers = [word for _, word in run.zoo_answers.get(name, []) if word != "–"]
    return f"{sum(word == 'ok' for word in answers)} of {len(answers)}" if answers else "–"


def _zoo(run: SiteRun) -> list[Section]:
    rows = [
        [f"{_link(PAGE + address_of('zoo', name), one.title)}<small>{text(name)}</small>", text(one.fault), _right(run, name)]
        for name, one in zoo_cases().items()
    ]
    said = (
        "Inputs that made some public tool crash, hang, or give a result that is wrong, empty, not valid or short of points, each "
        "made anew after the description in its issue."
    )
    columns = {"Points": "", "What went wrong": "prose", "Right answers in this run": "number"}
    table = table_of("The zoo", columns, rows)
    return [Section("list", "Cases", "Inputs that broke somebody", f"<p>{said}</p>{table}")]


def _zoo_case(run: SiteRun, name: str) -> list[Section]:
    one, names = zoo_cases()[name], list(zoo_cases())
    facts = {
        "Name": f"<code>{text(name)}</code>",
        "What went wrong": text(one.fault),
        "Issue": _link(one.address, one.issue),
        "A right answer": text(one.answer),
        "Its points": f"<code>build/hullbench points {text(name)} --out points.csv</code>",
        "Every method": f"<code>build/hullbench run zoo --filter '/{text(name)}/'</code>",
    }
    rows = [[text(method), text(word)] for method, word in run.zoo_answers.get(name, [])]
    answers = table_of("Answers", {"Method": "", "Answer": ""}, rows) if rows else "<p>This run did not ask the methods.</p>"
    pictures = _pictures(_dataset_pictures(run, name))
    place = names.index(name)
    others = [(place - 1, "Before"), (place + 1, "Next")]
    beside = " · ".join(
        f"{words}: {_link(PAGE + address_of('zoo', names[k]), zoo_cases()[names[k]].title)}"
        for k, words in others
        if 0 <= k < len(names)
    )
    return [
        Section("about", "Description", "What it is", facts_of(facts)),
        Section("answers", "Answers", "How the methods answer", answers + ("" if pictures else f"<p>{beside}</p>")),
        *([Section("pictures", "Pictures", "Pictures", f"{pictures}<p>{beside}</p>")] if pictures else []),
    ]


# Downloads.


def _downloads(files: Sequence[Download]) -> list[Section]:
    sections = []
    columns = {"File": "", "What is in it": "prose", "KiB": "number"}
    for place, kind in enumerate(dict.fromkeys(one.kind for one in files)):
        rows = [
            [_link(FILE + one.address, one.address.rpartition("/")[2]), text(one.what), number(one.size / 1024)]
            for one in files
            if one.kind == kind
        ]
        sections.append(Section(f"files-{place}", kind, kind, table_of(kind, columns, rows)))
    return sections
