"""A run as the pages of the site need it."""

import functools
import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from front import Front, make_front
from page import PLOTS
from pictures import is_kept, kept_pictures
from ratings import DIVISIONS, Division, Results, divisions, read
from records import Experiment, Picture, Row, load, member_of
from report_common import method_look
from report_html import methods_of
from report_summary import Summary, mixture_sentence, summarise
from report_tables import documents
from strip import Shown

# Who chose the parameters: those that see the points only first.
_PROTOCOLS = [protocol for protocols in DIVISIONS.values() for protocol in protocols]


@dataclass(frozen=True)
class ZooCase:
    """As datasets/zoo/zoo.json has it."""

    name: str
    title: str
    fault: str
    issue: str  # libgeos/geos#754
    answer: str  # what a right one is, in words

    @property
    def address(self) -> str:
        """Of the issue."""
        return f"https://github.com/{self.issue.replace('#', '/issues/')}"


@functools.cache
def zoo_cases() -> dict[str, ZooCase]:
    """By name."""
    zoo = json.loads((PLOTS.parent / "datasets" / "zoo" / "zoo.json").read_text(encoding="utf-8"))
    return {one["name"]: ZooCase(**{**one, "answer": zoo["answers"][one["answer"]]}) for one in zoo["cases"]}


def what_it_is(method: str) -> str:
    """A clause that begins with a capital letter; empty for a method that methods.json does not know."""
    what = method_look(method).get("what", "")
    return what[:1].upper() + what[1:]


@dataclass(frozen=True)
class SiteRun:
    """`methods` and `datasets` are by name, as results/report.schema.json has them; the zoo's data sets are among them."""

    folder: Path
    experiments: list[Experiment]
    front: Front
    summaries: list[Summary]
    results: list[Results]  # of the run, then of an evaluation beside it
    pictures: list[dict[str, Picture]]  # by experiment
    methods: dict[str, dict[str, Any]]
    datasets: dict[str, dict[str, Any]]

    @property
    def name(self) -> str:
        """Of its folder, which is its address in the site."""
        return self.folder.resolve().name

    @property
    def created(self) -> str:
        return self.experiments[0].report["created"]

    def family(self, dataset: str) -> str:
        """The data set that has a page: star of star-17~noise:0.5."""
        base = dataset.split("~")[0]
        return base if base in self.datasets or base in zoo_cases() else member_of(base)[0]

    @functools.cached_property
    def cases(self) -> dict[str, Counter[str]]:
        """By data set: how many cases each experiment, by its title, has of it."""
        seen = {(self.family(row.dataset), one.title, row.case) for one in self.experiments for row in one.rows}
        found: dict[str, Counter[str]] = {}
        for family, title, _ in sorted(seen):
            found.setdefault(family, Counter())[title] += 1
        return found

    def divisions(self, dataset: str) -> list[Division]:
        """On the cases of this data set: of the run, or else of the evaluation beside it."""
        for results, places in zip(self.results, self._places):
            if dataset in places:
                return divisions(results.of(range(len(results.entrants)), places[dataset]))
        return []

    @functools.cached_property
    def _places(self) -> list[dict[str, list[int]]]:
        """By results and data set: the places of its cases."""
        found = []
        for results in self.results:
            places: dict[str, list[int]] = {}
            for place, case in enumerate(results.cases):
                places.setdefault(self.family(case.task.split("/")[0]), []).append(place)
            found.append(places)
        return found

    @functools.cached_property
    def drawn(self) -> list[Shown]:
        """Every result that has a picture, once."""
        found: dict[str, Shown] = {}
        for experiment, pictures in zip(self.experiments, self.pictures):
            for row in experiment.rows:
                if row.case in pictures and row.name in pictures[row.case].results:
                    found.setdefault(row.name, Shown(experiment, row, pictures[row.case]))
        return list(found.values())

    @functools.cached_property
    def zoo_answers(self) -> dict[str, list[tuple[str, str]]]:
        """By case of the zoo: method and word, as the program's table of the zoo has them; empty without that table."""
        tables = [table for document in documents(self.experiments, self.folder) for table in document["tables"]]
        found: dict[str, list[tuple[str, str]]] = {}
        for table in tables:
            titles = [column["title"] for column in table["columns"]]
            for first, _, *cells in table["rows"] if table["id"] == "zoo_cases" else []:
                if first["text"] in zoo_cases():
                    found[first["text"]] = list(zip(titles[2:], (cell["text"] for cell in cells)))
        return found


def protocol_order(row: Row) -> int:
    protocol = row.series.protocol
    return _PROTOCOLS.index(protocol) if protocol in _PROTOCOLS else len(_PROTOCOLS)


def load_run(folder: Path) -> SiteRun:
    """Raises RecordError when it is no run, or something in it is malformed."""
    experiments = load(folder)
    kept = is_kept(folder, experiments)
    pictures = kept_pictures(folder / "report.html", experiments) if kept else [one.pictures() for one in experiments]
    files = [folder / name for name in ("cases.csv", "league.csv")]
    return SiteRun(
        folder,
        experiments,
        make_front(folder, bool(mixture_sentence(experiments))),
        [summarise(one) for one in experiments],
        [read(file) for file in files if file.is_file()],
        pictures,
        _in_order(methods_of(experiments)),
        {name: one for experiment in experiments for name, one in experiment.datasets.items()},
    )


def _in_order(methods: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    return dict(sorted(methods.items(), key=lambda one: (method_look(one[0])["order"], one[0])))


def with_listing(run: SiteRun, listing: dict[str, Sequence[dict[str, Any]]]) -> SiteRun:
    """With what `hullbench list --json` names beside: methods and data sets that the run did not measure."""
    methods, datasets = ({one["name"]: one for one in listing[kind]} for kind in ("methods", "datasets"))
    return replace(run, methods=_in_order({**methods, **run.methods}), datasets={**datasets, **run.datasets})
