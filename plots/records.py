"""Reads the records of a run or of a suite, and nothing of the program.

A run's folder has `report.json` (results/report.schema.json) and may have `pictures.jsonl` or `pictures.jsonl.xz`; a
suite's has `suite.json` and such a folder for each experiment. Only the standard library is needed.

    for experiment in load("results/latest"):
        for row in experiment.rows:
            print(row.name, row.median_ns, row.metrics.get("l2"))
        picture = experiment.picture("ca/n:2000/holes:1")

What is missing or malformed raises RecordError, whose text is one sentence for the user; programs end with
EXIT_CONFIGURATION then.
"""

from __future__ import annotations

import json
import lzma
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TextIO

EXIT_CONFIGURATION = 2
EXIT_NOTHING = 6

# The order of a suite that does not say its own.
USUAL_ORDER = ("rgbd", "states", "alphabet", "random", "steps")

# What a report must have for anything to be shown of it, with the types.
_REPORT_KEYS = {"plan": dict, "environment": dict, "methods": list, "datasets": list, "runs": list, "summary": dict}
_RUN_KEYS = {
    "id": str, "name": str, "method": str, "dataset": str, "n": int, "holes": bool, "protocol": str, "status": str,
    "detail": str, "time_ns": list, "phases_ns": list, "metrics": dict, "parameters": dict,
}
_CASE_KEYS = {"case": str, "origin": list, "step": (int, float), "points": list, "ground_truth": list}
_RESULT_KEYS = {"case": str, "run": str, "polygons": list}


class RecordError(Exception):
    """A record is missing or malformed; the text says which and what to do."""


@dataclass(frozen=True)
class Row:
    """One run: a method with one parameter set on one point set. Times in nanoseconds."""

    raw: dict[str, Any]  # as results/run.schema.json
    time: dict[str, float | None] | None  # statistics of run + extract, as the schema's "statistics"; None: no time
    paper_time: dict[str, float | None] | None  # the same up to where the paper's clock stopped

    @property
    def name(self) -> str:
        """For example polylidar/ca/n:2000/holes:0/protocol:paper."""
        return self.raw["name"]

    @property
    def method(self) -> str:
        return self.raw["method"]

    @property
    def protocol(self) -> str:
        """Who chose the parameters; results of two protocols are never one series."""
        return self.raw["protocol"]

    @property
    def series(self) -> tuple[str, str]:
        """(method, protocol)."""
        return self.method, self.protocol

    @property
    def dataset(self) -> str:
        return self.raw["dataset"]

    @property
    def n(self) -> int:
        return self.raw["n"]

    @property
    def holes(self) -> bool:
        return self.raw["holes"]

    @property
    def case(self) -> str:
        """The case's name in pictures.jsonl, for example ca/n:2000/holes:1. Of data sets that are taken whole it says
        n:all, not their number of points, so it comes from the run's name."""
        return self.name.removeprefix(self.method + "/").rsplit("/protocol:", 1)[0]

    @property
    def status(self) -> str:
        return self.raw["status"]

    @property
    def ok(self) -> bool:
        return self.status == "ok"

    @property
    def detail(self) -> str:
        """Why the status is not ok."""
        return self.raw["detail"]

    @property
    def metrics(self) -> dict[str, Any]:
        """Scores by name; None where one is not defined, empty when nothing was scored."""
        return self.raw["metrics"]

    @property
    def phases_ns(self) -> list[dict[str, int]]:
        """One object a repetition: run, extract and the steps that the method names."""
        return self.raw["phases_ns"]

    @property
    def median_ns(self) -> float | None:
        return self.time["median_ns"] if self.time else None

    def metric(self, name: str) -> float | None:
        """A score; None where the run has none. Only a run that is ok has scores to be compared."""
        return self.metrics.get(name) if self.ok else None


@dataclass
class Picture:
    """The points, the ground truth and the results of one case, in the integer grid of pictures.jsonl."""

    case: dict[str, Any]  # the line of the case
    results: dict[str, dict[str, Any]] = field(default_factory=dict)  # the line of each result by its run's name

    @property
    def name(self) -> str:
        return self.case["case"]

    def place(self, flat: Sequence[int]) -> list[tuple[float, float]]:
        """A flat list of grid coordinates (points or a ring) as (x, y) in the data set's length unit."""
        x0, y0 = self.case["origin"]
        step = self.case["step"]
        return [(x0 + step * flat[k], y0 + step * flat[k + 1]) for k in range(0, len(flat) - 1, 2)]

    def points(self) -> list[tuple[float, float]]:
        """At most 4000 of the points, evenly chosen."""
        return self.place(self.case["points"])

    def ground_truth(self) -> list[list[list[tuple[float, float]]]]:
        """Polygons of rings: the shell, then its holes. The first vertex is not repeated."""
        return [[self.place(ring) for ring in polygon] for polygon in self.case["ground_truth"]]

    def polygons(self, run: str) -> list[list[list[tuple[float, float]]]] | None:
        """The result of a run, by the run's name; None: no picture of it was kept."""
        result = self.results.get(run)
        if result is None:
            return None
        return [[self.place(ring) for ring in polygon] for polygon in result["polygons"]]


class Experiment:
    """One experiment's report."""

    def __init__(self, folder: Path, report: dict[str, Any]) -> None:
        self.folder = folder
        self.report = report
        self.plan: dict[str, Any] = report["plan"]
        self.name: str = self.plan.get("name") or folder.name
        self.title: str = self.plan.get("title") or self.name
        self.methods: dict[str, dict[str, Any]] = {method["name"]: method for method in report["methods"]}
        self.datasets: dict[str, dict[str, Any]] = {dataset["name"]: dataset for dataset in report["datasets"]}
        statistics = {row["id"]: row for row in report["summary"].get("rows", [])}
        self.rows: list[Row] = [_row(raw, statistics.get(raw["id"], {})) for raw in report["runs"]]

    def pictures_file(self) -> Path | None:
        """The file of the pictures; None: the run has none."""
        for name in ("pictures.jsonl", "pictures.jsonl.xz"):
            if (self.folder / name).is_file():
                return self.folder / name
        return None

    def picture_lines(self, case: str | None = None) -> Iterator[dict[str, Any]]:
        """The lines of the pictures in the file's order, one at a time; with `case` only those of that case, which is
        much faster. A later line for the same case or run replaces an earlier one."""
        path = self.pictures_file()
        if path is None:
            return
        wanted = None if case is None else json.dumps(case)
        try:
            with _open_text(path) as lines:
                for number, text in enumerate(lines, 1):
                    if wanted is not None and wanted not in text:
                        continue
                    line = _picture_line(path, number, text)
                    if case is None or line["case"] == case:
                        yield line
        except (OSError, EOFError, UnicodeDecodeError, lzma.LZMAError) as error:
            raise RecordError(f"{path} cannot be read ({error}); measure again or remove it.") from error

    def picture(self, case: str) -> Picture | None:
        """The pictures of one case, such as ca/n:2000/holes:1; None: there are none. Reads the file once."""
        found: Picture | None = None
        for line in self.picture_lines(case):
            if line["kind"] == "case":
                found = Picture(line, found.results if found else {})
            elif found is not None:
                found.results[line["run"]] = line
        return found

    def picture_cases(self) -> list[str]:
        """The names of the cases that have pictures, in the file's order."""
        return list(dict.fromkeys(line["case"] for line in self.picture_lines() if line["kind"] == "case"))


def load(folder: str | Path) -> list[Experiment]:
    """The experiments in the folder of a run or of a suite: as many as have been run, in the suite's order.
    Raises RecordError when there is none, or when a record is malformed."""
    folder = Path(folder)
    if not folder.is_dir():
        raise RecordError(f"{folder} is not a folder; name that of a run, such as results/latest.")
    if (folder / "report.json").is_file():
        return [_experiment(folder)]
    folders = [folder / name for name in _order(folder) if (folder / name / "report.json").is_file()]
    if not folders:
        raise RecordError(
            f"{folder} has no report.json, neither itself nor in a folder of an experiment; of a kept reference run "
            f"'hullbench merge {folder} --out NEW' makes a run that has them."
        )
    return [_experiment(one) for one in folders]


def _order(folder: Path) -> list[str]:
    """The names of a suite's experiments."""
    here = sorted(entry.name for entry in folder.iterdir() if entry.is_dir())
    told = USUAL_ORDER
    if (folder / "suite.json").is_file():
        suite = _json(folder / "suite.json")
        plans = suite.get("plans", list(told)) if isinstance(suite, dict) else None
        if not isinstance(plans, list) or not all(isinstance(plan, str) for plan in plans):
            raise RecordError(f'{folder / "suite.json"} is malformed: "plans" must be a list of names.')
        told = tuple(plans)
    return [name for name in told if name in here] + [name for name in here if name not in told]


def _experiment(folder: Path) -> Experiment:
    path = folder / "report.json"
    report = _json(path)
    _check(report, _REPORT_KEYS, str(path))
    if report.get("schema_version") != 1:
        raise RecordError(f'{path} has schema_version {report.get("schema_version")!r}; only 1 is known here.')
    for index, run in enumerate(report["runs"]):
        _check(run, _RUN_KEYS, f"{path}: runs[{index}]")
    for part in ("methods", "datasets"):
        for index, entry in enumerate(report[part]):
            _check(entry, {"name": str, "title": str}, f"{path}: {part}[{index}]")
    for index, row in enumerate(report["summary"].get("rows", [])):
        _check(row, {"id": str}, f"{path}: summary.rows[{index}]")
    return Experiment(folder, report)


def _row(raw: dict[str, Any], summary: dict[str, Any]) -> Row:
    return Row(raw, summary.get("time"), summary.get("paper_time"))


def _json(path: Path) -> Any:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, json.JSONDecodeError) as error:
        raise RecordError(f"{path} cannot be read as JSON ({error}).") from error


def _check(value: Any, keys: dict[str, Any], where: str) -> None:
    """Raises unless `value` is an object with these keys of these types."""
    if not isinstance(value, dict):
        raise RecordError(f"{where} is malformed: it is not an object.")
    for key, kind in keys.items():
        if key not in value:
            raise RecordError(f'{where} is malformed: "{key}" is missing.')
        if not isinstance(value[key], kind):
            raise RecordError(f'{where} is malformed: "{key}" is not what results/report.schema.json says.')


def _open_text(path: Path) -> TextIO:
    if path.suffix == ".xz":
        return lzma.open(path, "rt", encoding="utf-8")
    return path.open(encoding="utf-8")


def _picture_line(path: Path, number: int, text: str) -> dict[str, Any]:
    where = f"{path}: line {number}"
    try:
        line = json.loads(text)
    except json.JSONDecodeError as error:
        raise RecordError(f"{where} cannot be read as JSON ({error}).") from error
    _check(line, {"kind": str}, where)
    if line["kind"] not in ("case", "result"):
        raise RecordError(f'{where} is malformed: its "kind" is neither "case" nor "result".')
    _check(line, _CASE_KEYS if line["kind"] == "case" else _RESULT_KEYS, where)
    return line
