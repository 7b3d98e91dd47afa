"""What every figure is drawn from: a run's experiments and the paper's numbers, and what a figure hands back."""

import json
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from ratings import Results, read
from records import SCHEMAS, Experiment, Picture, Row, Series
from style import in_order, label


# Of captions.
FILLED = "Filled markers: parameters by the paper's rule; pale: the method's default; open: by another rule."


class Skipped(Exception):
    """The run has not what the figure shows; the text says what is missing."""


@dataclass(frozen=True)
class Drawn:
    """A figure, the name of its files and the text under it."""

    name: str
    figure: Figure
    caption: str


@dataclass
class Run:
    """A run or a suite."""

    folder: Path
    experiments: list[Experiment]
    paper: dict[str, Any] = field(default_factory=dict)  # results/paper.json
    _pictures: dict[tuple[str, str], Picture | None] = field(default_factory=dict)

    def experiment(self, name: str) -> Experiment:
        for experiment in self.experiments:
            if experiment.name == name:
                return experiment
        raise Skipped(f"the run has no experiment called {name}")

    def has(self, name: str) -> bool:
        return any(experiment.name == name for experiment in self.experiments)

    def results(self, timed: bool = False) -> Results:
        """Every result with an error, of the league that is kept beside the run (league.csv) or else of the run itself
        (cases.csv); with `timed` of the run alone, as an evaluation, which keeps all cores busy, times nothing."""
        names = ("cases.csv",) if timed else ("league.csv", "cases.csv")
        return read(self.file(*names, maker="'hullbench league RUN --all-cases --csv' writes it"))

    def file(self, *names: str, maker: str) -> Path:
        """The first of these that the run has. Raises Skipped without any, saying what makes the last one."""
        for path in (self.folder / name for name in names):
            if path.is_file():
                return path
        raise Skipped(f"{path} is not there ({maker})")

    def picture(self, experiment: Experiment, case: str) -> Picture | None:
        """As Experiment.picture; each is read from its file once."""
        key = (experiment.name, case)
        if key not in self._pictures:
            self._pictures[key] = experiment.picture(case)
        return self._pictures[key]


def read_paper() -> dict[str, Any]:
    return json.loads((SCHEMAS / "paper.json").read_text(encoding="utf-8"))


def missing_series(rows: Iterable[Row]) -> list[Series]:
    """The series of which no row is ok."""
    rows = list(rows)
    ok = {row.series for row in rows if row.ok}
    return in_order(row.series for row in rows if row.series not in ok)


def failures(rows: Iterable[Row]) -> str:
    """A sentence each on what is not installed and on what failed; empty when all rows are ok."""
    rows = list(rows)
    every = {row.series for row in rows}
    not_installed = {row.series for row in rows if row.status == "not_installed"}
    sentences = []
    if not_installed:
        names = ", ".join(dict.fromkeys(label(one, every) for one in in_order(not_installed)))
        sentences.append(f"Not installed: {names}.")
    failed = [row for row in rows if not row.ok and row.status != "not_installed"]
    if failed:
        counted = []
        for one in in_order(row.series for row in failed):
            of_one = [row.status for row in failed if row.series == one]
            kinds = ", ".join(f"{of_one.count(kind)} {kind.replace('_', ' ')}" for kind in dict.fromkeys(of_one))
            counted.append(f"{label(one, every)} ({kinds})")
        sentences.append(f"Failed: {'; '.join(counted)}.")
    return " ".join(sentences)
