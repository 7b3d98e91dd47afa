"""Reads the records of a run or of a suite, and nothing of the program.

A run's folder has `report.json` (results/report.schema.json) and may have `pictures.jsonl` or `pictures.jsonl.xz`; a
suite's has `suite.json` and such a folder for each experiment. The schemas say what a record is: Debian's
python3-jsonschema checks it, and nothing else is checked here.

    for experiment in load("results/latest"):
        for row in experiment.rows:
            print(row.name, row.median_ns, row.metrics.get("l2"))
        picture = experiment.picture("ca/n:2000/holes:1")

What is missing or malformed raises RecordError, whose text is one sentence for the user. Any other exception is a fault
of ours: it is not caught, so the program ends with its traceback and exit code 1.
"""

import argparse
import contextlib
import functools
import json
import lzma
import sys
from collections.abc import Callable, Container, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, TextIO

import jsonschema

SCHEMAS = Path(__file__).resolve().parent.parent / "results"

_SUITE_SCHEMA = {"type": "object", "properties": {"plans": {"type": "array", "items": {"type": "string"}}}}


class RecordError(Exception):
    """A record is missing or malformed; the text says which and what to do."""

    exit_code = 2


class NothingToShow(RecordError):
    """The records are well, but have not what was asked for."""

    exit_code = 6


def exit_code_of(program: str, work: Callable[[], None]) -> int:
    """Does the work of a program; what is wrong with its input or output is said in one sentence."""
    try:
        work()
    except (RecordError, OSError) as error:
        print(f"{program}: {error}", file=sys.stderr)
        return getattr(error, "exit_code", RecordError.exit_code)
    return 0


def options_of_run(program: str, says: str, out: str) -> argparse.ArgumentParser:
    """Of a program that draws RUN into `out`, if --out does not say otherwise."""
    parser = argparse.ArgumentParser(prog=program, description=says)
    latest = SCHEMAS / "latest"
    parser.add_argument("run", nargs="?", default=latest, type=Path, help="folder of a run or of a suite (results/latest)")
    parser.add_argument("--out", type=Path, help=f"where to write (RUN/{out})")
    return parser


class Series(NamedTuple):
    """A method under one protocol: what is compared. Results of two protocols are never put together."""

    method: str
    protocol: str  # who chose the parameters

    @property
    def key(self) -> str:
        return "/".join(self)


def _raw(name: str) -> property:
    return property(lambda row: row.raw[name])


def _told(name: str, otherwise: Any = None) -> property:
    return property(lambda row: row.told.get(name, otherwise))


@dataclass(frozen=True)
class Row:
    """One run: a method with one parameter set on one point set. Times in nanoseconds."""

    raw: dict[str, Any]  # as results/run.schema.json
    told: dict[str, Any]  # what the summary says of it, as the schema's "row"

    name = _raw("name")  # such as polylidar/ca/n:2000/holes:0/protocol:paper
    method = _raw("method")
    dataset = _raw("dataset")
    n = _raw("n")
    holes = _raw("holes")
    status = _raw("status")
    detail = _raw("detail")  # why the status is not ok
    metrics = _raw("metrics")  # scores by name; None where one is not defined, empty when nothing was scored
    phases_ns = _raw("phases_ns")  # an object a repetition: run, extract and the steps that the method names
    time = _told("time")  # of run + extract, as the schema's "statistics"; None: no time
    paper_time = _told("paper_time")  # the same up to where the paper's clock stopped
    fastest = _told("fastest", False)  # beyond doubt, of all methods on the same points, as the program judges it

    @property
    def is_thinned(self) -> bool:
        """results/thin_records.py has left metrics, digits and identities out."""
        return "id" not in self.raw

    @property
    def faster(self) -> bool:
        """Than the core on the same points, beyond doubt, as the program judges it."""
        return self.told.get("order") == "faster"

    @property
    def series(self) -> Series:
        return Series(self.method, self.raw["protocol"])

    @property
    def case(self) -> str:
        """The case's name in pictures.jsonl, for example ca/n:2000/holes:1. Of data sets that are taken whole it says
        n:all, not their number of points, so it comes from the run's name."""
        return self.name.removeprefix(self.method + "/").rsplit("/protocol:", 1)[0]

    @property
    def ok(self) -> bool:
        return self.status == "ok"

    @property
    def median_ns(self) -> float | None:
        return self.time["median_ns"] if self.time else None

    def interval(self, which: str = "time") -> tuple[float, float] | None:
        """The 95 % interval of the median of "time" or "paper_time"; None: there is none, as of a single repetition."""
        told = getattr(self, which) or {}
        low, high = told.get("median_low_ns"), told.get("median_high_ns")
        return None if low is None or high is None else (low, high)

    def metric(self, name: str) -> float | None:
        """A score; None where the run has none. Only a run that is ok has scores to be compared."""
        return self.metrics.get(name) if self.ok else None


def member_of(dataset: str) -> tuple[str, int | None]:
    """The family and the number of star-17; for a data set of no family its name and None."""
    family, _, number = dataset.rpartition("-")
    return (family, int(number)) if family and number.isdigit() and str(int(number)) == number else (dataset, None)


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

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.report: dict[str, Any] = read_json(folder / "report.json", "report.schema.json")
        report = self.report
        self.plan: dict[str, Any] = report["plan"]
        self.name: str = self.plan.get("name") or folder.name
        self.title: str = self.plan.get("title") or self.name
        self.methods: dict[str, dict[str, Any]] = {method["name"]: method for method in report["methods"]}
        self.datasets: dict[str, dict[str, Any]] = {dataset["name"]: dataset for dataset in report["datasets"]}
        told = report["summary"]["rows"]  # one for every run
        if [row["name"] for row in told] != [run["name"] for run in report["runs"]]:
            raise RecordError(f"{folder / 'report.json'} is malformed: its summary is of other runs.")
        self.rows = [Row(*both) for both in zip(report["runs"], told)]
        self.is_thinned = any(row.is_thinned for row in self.rows)

    def series(self) -> list[Series]:
        """In the order of the records, which is that of the plan."""
        return list(dict.fromkeys(row.series for row in self.rows))

    def machines(self, with_times: bool = False) -> set[str]:
        """Where the rows were measured, or those of them with times, or their run where a row does not say."""
        rows = (row.raw for row in self.rows if row.raw["time_ns"] or not with_times)
        return {row.get("machine") or self.report["environment"]["machine_id"] for row in rows}

    def family(self, name: str) -> tuple[str, int | None]:
        """As member_of(); but a data set that is known by its whole name, such as zoo-qgis-65899, is nobody's member."""
        return (name, None) if name in self.datasets else member_of(name)

    def dataset_title(self, name: str) -> str:
        """California; for a member of a family, Simulated floor 3."""
        family, number = self.family(name)
        title = self.datasets[family]["title"] if family in self.datasets else family
        return title if number is None else f"{title} {number}"

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
        with _opened(path, "; measure again or remove it") as lines:
            for number, text in enumerate(lines, 1):
                if wanted is not None and wanted not in text:
                    continue
                line = checked(text, "picture.schema.json", f"{path}: line {number}")
                if case is None or line["case"] == case:
                    yield line

    def pictures(self, case: str | None = None, runs: Container[str] | None = None) -> dict[str, Picture]:
        """By case, of all or of one such as ca/n:2000/holes:1, with the results of these runs, or of all."""
        found: dict[str, Picture] = {}
        for line in self.picture_lines(case):
            name = line["case"]
            if line["kind"] == "case":
                found[name] = Picture(line, found[name].results if name in found else {})
            elif name in found and (runs is None or line["run"] in runs):
                found[name].results[line["run"]] = line
        return found

    def picture(self, case: str) -> Picture | None:
        """None: there is none. Reads the file once."""
        return self.pictures(case).get(case)

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
        return [Experiment(folder)]
    folders = [folder / name for name in _order(folder) if (folder / name / "report.json").is_file()]
    if not folders:
        raise RecordError(
            f"{folder} has no report.json, neither itself nor in a folder of an experiment; 'hullbench report {folder} "
            "--out NEW' writes what can be drawn of a kept reference run."
        )
    return [Experiment(one) for one in folders]


def _order(folder: Path) -> list[str]:
    """The names of a suite's experiments: those that it names, then all others."""
    here = sorted(entry.name for entry in folder.iterdir() if entry.is_dir())
    suite = folder / "suite.json"
    told = read_json(suite, _SUITE_SCHEMA).get("plans", []) if suite.is_file() else []
    return [name for name in told if name in here] + [name for name in here if name not in told]


def read_json(path: Path, schema: str | dict[str, Any], remedy: str = "") -> Any:
    """What is in the file, compressed or not, if it is as the schema says: the name of one in results/, or one itself.
    `remedy` ends the sentence of the RecordError."""
    with _opened(path, remedy) as file:
        return checked(file.read(), schema, str(path), remedy)


def checked(text: str, schema: str | dict[str, Any], where: str, remedy: str = "") -> Any:
    """What `text` says, as read_json() says it of a file's; `where` begins the sentence of the RecordError."""
    try:
        value = json.loads(text, parse_constant=_refuse)
    except ValueError as error:
        raise RecordError(f"{where} cannot be read as JSON ({error}){remedy}.") from error
    validator = _validator(schema) if isinstance(schema, str) else jsonschema.Draft202012Validator(schema)
    fault = next(validator.iter_errors(value), None)
    if fault is not None:
        named = f"results/{schema}" if isinstance(schema, str) else "expected"
        what = fault.message if len(fault.message) < 200 else f"{fault.message[:100]} … {fault.message[-100:]}"
        raise RecordError(f"{where} is malformed, not as {named}: {fault.json_path}: {what}{remedy}.")
    return value


def _refuse(constant: str) -> None:
    raise ValueError(f"{constant} is no JSON")


@functools.cache
def _validator(name: str) -> jsonschema.Draft202012Validator:
    def read(name: str) -> dict[str, Any]:
        return json.loads((SCHEMAS / name).read_text(encoding="utf-8"))

    schema = read(name)
    if name == "report.schema.json":
        schema["properties"]["runs"]["items"] = read("run.schema.json")  # where it refers to it: nothing is fetched
    if name == "picture.schema.json":
        # Single coordinates are not looked at, as there are millions.
        del (schema["properties"]["points"]["items"], schema["$defs"]["polygons"]["items"]["items"]["items"])
    return jsonschema.Draft202012Validator(schema)


@contextlib.contextmanager
def _opened(path: Path, remedy: str) -> Iterator[TextIO]:
    """The file's text, compressed or not."""
    try:
        with (lzma.open if path.suffix == ".xz" else open)(path, "rt", encoding="utf-8") as file:
            yield file
    except (OSError, EOFError, UnicodeDecodeError, lzma.LZMAError) as error:
        raise RecordError(f"{path} cannot be read ({error}){remedy}.") from error
