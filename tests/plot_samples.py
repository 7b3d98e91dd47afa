"""A small invented suite with every kind of record that the figures show, for the tests of plots/."""

import copy
import hashlib
import json
import lzma
import math
import statistics
from pathlib import Path
from typing import Any

SIZES = (2000, 4000, 8000)
SERIES = (
    ("polylidar", "paper"),
    ("cgal_alpha_shape", "paper"),
    ("spatialite", "paper"),
    ("geos_concave_hull", "auto"),
    ("geos_concave_hull", "paper"),
    ("somebodys_hull", "default"),
)
LETTERS = "abc"
HASH = "0" * 64
TITLES = {"ca": "California", "hi": "Hawaii"}
STATUSES = ("ok", "timeout", "memory", "crash", "error", "invalid_output", "unsupported", "not_installed")
SPLIT = {"shapes": {"ca": "test"}, "samplers": {"uniform": "training"}}
TOOL = {"name": "hullbench", "version": "0.1.0", "commit": None, "dirty": None, "binary_sha256": HASH}
FAILED = {"time_ns": [], "phases_ns": [], "metrics": {}, "output_sha256": ""}


def run_name(method: str, protocol: str, dataset: str, n: int, holes: bool) -> str:
    size = "all" if dataset.startswith("floor-") else n
    return f"{method}/{dataset}/n:{size}/holes:{int(holes)}/protocol:{protocol}"


def run(
    method: str,
    protocol: str,
    dataset: str,
    n: int,
    holes: bool = False,
    status: str = "ok",
    scale: float = 1.0,
    times: list[int] | None = None,
    detail: str = "why it failed",
    **metrics: Any,
) -> dict[str, Any]:
    """A row. The numbers that are not given differ from row to row and are nothing but distinct."""
    name = run_name(method, protocol, dataset, n, holes)
    identity = hashlib.sha256(name.encode()).hexdigest()
    key = int(identity[:6], 16) / 0xFFFFFF
    row = {
        "schema_version": 1,
        "id": identity,
        "name": name,
        "method": method,
        "method_version": "1",
        "dataset": dataset,
        "dataset_sha256": HASH,
        "n": n,
        "holes": holes,
        "seed": 1,
        "protocol": protocol,
        "parameters": {"alpha": 2.5, "max_edge_length": None},
        "status": status,
        "detail": "" if status == "ok" else detail,
        **FAILED,
    }
    if status == "ok":
        row["time_ns"] = times or [round(scale * n * (100 + 900 * key) * factor) for factor in (0.9, 1.0, 1.2)]
        row["phases_ns"] = [phases(time) for time in row["time_ns"]]
        error = (0.02 + 0.2 * key) * math.sqrt(2000 / n)
        row["metrics"] = {
            "valid": True,
            "l2": error,
            "l2_paper": 1.1 * error,
            "ground_truth_convexity": 0.3 + 0.6 * key,
            "ground_truth_area": 1.0,
            "iou": 0.9,
            **metrics,
        }
        row["output_sha256"] = HASH
    return row


def phases(time: int) -> dict[str, int]:
    part = time // 10
    steps = {"run.triangulation": time // 2, "run.shape": time // 4, "extract.polygon": part}
    return {"load": 1, "run": time - part, "extract": part, **steps}


def summary_row(row: dict[str, Any]) -> dict[str, Any]:
    """What the report's summary says of the row; the interval of its median is all of its times."""
    times, told = row["time_ns"], None
    if times and row["status"] == "ok":
        middle = statistics.median(times)
        told = {
            "repetitions": len(times),
            "median_ns": middle,
            **dict.fromkeys(("median_low_ns", "min_ns"), min(times)),
            **dict.fromkeys(("median_high_ns", "max_ns"), max(times)),
            "mad_ns": statistics.median(abs(time - middle) for time in times),
            "mean_ns": statistics.mean(times),
            "std_ns": None,
        }
    scores = {name: row["metrics"].get(name) for name in ("l2", "l2_paper", "iou", "valid")}
    return {"id": row["id"], "name": row["name"], "status": row["status"], "time": told, "paper_time": told, **scores}


def judged(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """What the summary says of every row. Faster is here who always was: the program's own judge looks at the ratios."""
    points: dict[str, list[dict[str, Any]]] = {}
    for row in rows:
        if row["status"] == "ok":
            points.setdefault(case_of(row), []).append(row)

    def is_faster(row: dict[str, Any], other: dict[str, Any]) -> bool:
        return max(row["time_ns"]) < min(other["time_ns"])

    made = {row["id"]: {**summary_row(row), "order": None, "fastest": False} for row in rows}
    for here in points.values():
        core = next((row for row in here if (row["method"], row["protocol"]) == SERIES[0]), None)
        for row in here:
            others = [other for other in here if other["method"] != row["method"]]
            made[row["id"]]["fastest"] = bool(others) and all(is_faster(row, other) for other in others)
            if core and row is not core:
                order = "faster" if is_faster(row, core) else "slower" if is_faster(core, row) else "undecided"
                made[row["id"]]["order"] = order
    return list(made.values())


def environment() -> dict[str, Any]:
    cpu = {"model": "Invented", "architecture": "none", "logical_cores": 1, "allowed_cores": 1}
    compiler = {"id": "none", "version": "1", "build_type": "Release", "native": False, "flags": "", "statement": "none"}
    return {
        "machine_id": "0123abcd",
        "cpu": {**cpu, "governors": None, "boost": None, "virtualised": None},
        "memory_bytes": 1,
        "load_average": None,
        "aslr": None,
        "kernel": None,
        "os": None,
        "compiler": {**compiler, "flags_by_target": {}},
        "libraries": {},
    }


def report(name: str, datasets: dict[str, int], rows: list[dict[str, Any]], **more: Any) -> dict[str, Any]:
    """As results/report.schema.json says. `datasets`: the members of each, 0 for a single shape."""
    about = {"version": "1", "licence": "MIT", "citation": "", "native_output": "", "capabilities": {}, "parameters": []}
    installed = {"installed": True, "detail": "", "remedy": ""}
    source = {"source": "invented", "licence": "none", "sha256": None, "area": None, "holes_area": None}
    return {
        "schema_version": 1,
        "created": "2026-01-02T03:04:05Z",
        "tool": TOOL,
        "environment": environment(),
        "plan": {"name": name, "title": name.title()},
        "seed": 1,
        "filter": None,
        "repetitions": 3,
        "methods": [
            {"name": method, "title": method.title(), **about, **installed}
            for method in dict.fromkeys(row["method"] for row in rows)
        ],
        "datasets": [
            {"name": one, "title": TITLES.get(one, one.title()), "members": members, **source}
            for one, members in datasets.items()
        ],
        "runs": rows,
        "summary": {
            "totals": {status: sum(row["status"] == status for row in rows) for status in STATUSES},
            "rows": judged(rows),
            "claims": [],
        },
        "notes": [],
        **more,
    }


def square(left: int, low: int, side: int) -> list[int]:
    return [left, low, left + side, low, left + side, low + side, left, low + side]


def case_line(case: str, points: list[int], truth: list[Any], total: int) -> dict[str, Any]:
    grid = {"origin": [10.0, 20.0], "step": 0.5, "points_total": total}
    return {"kind": "case", "case": case, "dataset_sha256": HASH, **grid, "points": points, "ground_truth": truth}


def result_line(row: dict[str, Any], polygons: list[Any]) -> dict[str, Any]:
    told = {"run": row["name"], "id": row["id"], "output_sha256": "1" * 64, "l2": None}
    return {"kind": "result", "case": case_of(row), **told, "polygons": polygons}


def case_of(row: dict[str, Any]) -> str:
    return row["name"].split("/", 1)[1].rsplit("/", 1)[0]


def pictures(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """For the cases of these rows: a square with a square hole, and results that are a little off."""
    lines, seen = [], set()
    points = [value for k in range(200) for value in (k * 37 % 1000, k * 91 % 1000)]
    for index, row in enumerate(rows):
        if case_of(row) not in seen:
            seen.add(case_of(row))
            lines.append(case_line(case_of(row), points, [[square(0, 0, 1000), square(300, 300, 200)]], row["n"]))
        lines.append(result_line(row, [[square(20 * index, -10, 1000), square(310, 290, 210)]]))
    return lines


def core() -> dict[str, Any]:
    """As Google Benchmark writes it, with an aggregate and a failed benchmark among the entries."""

    def entry(name: str, kind: str, **more: Any) -> dict[str, Any]:
        return {"run_name": name, "run_type": kind, "time_unit": "us", **more}

    entries = []
    for name, factor in (("concave_hull", 100), ("triangulation", 80), ("cgal_alpha_shape", 1500)):
        for n in (1000, 100_000):
            times = [factor * repetition * n / 1000 for repetition in (0.9, 1.0, 1.3)]
            entries += [entry(f"{name}/uniform/{n}", "iteration", real_time=time) for time in times]
            entries.append(entry(f"{name}/uniform/{n}", "aggregate", real_time=1e9))
    entries.append({"run_name": "concave_hull/uniform/7000", "run_type": "iteration", "error_occurred": True})
    entries.append(entry("concave_hull/rgbd/1000", "iteration", real_time=1.0))
    return {"context": {}, "benchmarks": entries}


def league() -> dict[str, Any]:
    """As results/league.schema.json says; `tuned` has one curve only, which is no comparison, and `oracle` no case."""

    def profile(group: str, cases: int, protocol: str, **shares: list[float]) -> dict[str, Any]:
        curves = [{"method": method, "protocol": protocol, "shares": values} for method, values in shares.items()]
        return {"group": group, "cases": cases, "curves": curves, "left_out": []}

    profiles = [
        profile("informed", 30, "paper", polylidar=[0.5, 0.9, 1], geos_concave_hull=[0.5, 0.7, 0.95]),
        profile("blind", 20, "default", polylidar=[0.7, 0.95, 1], spatialite=[0.3, 0.6, 0.8]),
        profile("tuned", 20, "tuned", polylidar=[1, 1, 1]),
        profile("oracle", 0, "oracle", polylidar=[0, 0, 0], spatialite=[0, 0, 0]),
    ]
    numbers = {"schema_version": 1, "shapes": 5, "cases": 30, "taus": [1, 2, 10], "plans": ["p"], "methods": []}
    parts = {"kinds": [], "samplers": []}
    origin = {"created": "now", "tool": TOOL, "environment": {}, "split": {**SPLIT, "cases_of": "all"}}
    return {"kind": "league", **origin, **numbers, **parts, "profiles": profiles, "not_installed": []}


def cases_csv(reports: dict[str, dict[str, Any]]) -> str:
    """As 'hullbench league --all-cases --csv' writes it, of the experiments of all methods; every case counts the same."""
    lines = ["method,task,fold,error,time,points,status,shape,kind,sampler,weight"]
    rows = [row for name in sorted(reports.keys() - {"random", "steps"}) for row in reports[name]["runs"]]
    for row in [one for one in rows if one["status"] != "not_installed"]:
        ok = row["status"] == "ok"
        error = row["metrics"]["l2"] if ok else "inf"
        time = statistics.median(row["time_ns"]) / 1e9 if ok else ""
        kind = "holes" if row["holes"] else "simple"
        task = f"{case_of(row)},{row['seed']},{error},{time},{row['n']},{row['status']},{row['dataset']},{kind},uniform,1"
        lines.append(f"{row['method']}/{row['protocol']},{task}")
    return "\n".join(lines) + "\n"


def tune() -> dict[str, Any]:
    """As results/tune.schema.json says: a method with a length, one with a number, one without a parameter."""

    def method(name: str, kind: str | None, tuned: float, medians: list[float | None]) -> dict[str, Any]:
        def spread(middle: float | None) -> dict[str, float | None]:
            return {"q1": middle and 0.9 * middle, "median": middle, "q3": middle and 1.5 * middle}

        range_ = {"parameter": "p", "unit": "1", "power": 1, "low": 1, "high": 8, "grid": [1, 8]}
        chosen = {"position": tuned, "training_median": 0.1, "training_cases": 1, "at_end": False}
        curve = [
            {"position": 2.0**k, "cases": 1, "failed": 0, "l2": spread(middle), "relative": spread(middle)}
            for k, middle in enumerate(medians)
        ]
        about = {"version": "1", "installed": True, "detail": "", "remedy": "", "fixed": {}}
        nothing = {"rounds": [], "oracle": []}
        cost = {"cases": 1, "l2_interval": [0.01, None]}
        reached = [{"evaluations": k + 1, "l2_median": error, **cost} for k, error in enumerate((None, 0.5, 0.25))]
        score = {"failed": 0, "l2_interval": None, "regret_median": None, "regret_interval": None}
        protocols = [{"protocol": one, "cases": 1, "l2_median": 0.75, **score} for one in ("default", "tuned", "oracle")]
        return {
            "method": name,
            "title": name,
            **about,
            **nothing,
            "protocols": protocols,
            "search": reached if kind else [],
            "axis": {"kind": kind, **range_} if kind else None,
            "tuned": chosen if kind else None,
            "curve": curve,
            "tolerance_octaves": {"q1": 1, "median": 1.25, "q3": 2, "cases": 1} if kind else None,
        }

    shape = {"dataset": "ca", "shape": "ca", "side": "test", "kind": "simple"}
    about = {"case": "ca/n:1/holes:0", **shape, "n": 1, "holes": False, "seed": 1}
    methods = [
        method("polylidar", "spacings", 2, [3, 1.1, 2, 30]),
        method("spatialite", "own", 4, [None, 2, 1.2, 1.5]),
        method("convex_hull", None, 0, []),
    ]
    budget = {"plans": ["p"], "split": SPLIT, "budget": {"grid": 2, "sweep": 2, "refinement": 0}}
    cases = [{**about, "dataset_sha256": HASH, "spacing": 1}] * 12
    return {"kind": "tuning", "schema_version": 1, "tool": TOOL, **budget, "cases": cases, "methods": methods}


def suite() -> dict[str, dict[str, Any]]:
    """The reports by experiment. postgis_legacy is not installed, hull_js times out at 8000 points."""
    states = [
        run(*series, dataset, n, holes)
        for dataset in ("ca", "hi")
        for holes in (False, True)
        for n in SIZES
        for series in SERIES
    ]
    states += [run("hull_js", "auto", "ca", n, True, "timeout" if n == 8000 else "ok") for n in SIZES]
    states += [run("postgis_legacy", "paper", "ca", n, True, "not_installed") for n in SIZES]
    alphabet = [run(*series, f"letter_{letter}", 2000) for letter in LETTERS for series in SERIES]
    alphabet += [run("convex_hull", "default", f"letter_{letter}", 2000) for letter in LETTERS]
    alphabet += [run("postgis_legacy", "paper", f"letter_{letter}", 2000, status="not_installed") for letter in LETTERS]
    random = [run("polylidar", "paper", f"star-{k}", 8000) for k in range(1, 400)]
    random += [run("polylidar", "paper", f"comb-{k}", 8000) for k in range(1, 9)]
    steps = [run(method, "paper", "ca", 64000, True) for method in ("polylidar_steps", "cgal_alpha_shape", "spatialite_steps")]
    rgbd = [run(*series, f"floor-{k}", 900 + k) for k in (1, 2) for series in SERIES]
    return copy.deepcopy(
        {
            "rgbd": report("rgbd", {"floor": 2}, rgbd),
            "states": report("states", {"ca": 0, "hi": 0}, states),
            "alphabet": report("alphabet", {f"letter_{letter}": 0 for letter in LETTERS}, alphabet),
            "random": report("random", {"star": 399, "comb": 8}, random),
            "steps": report("steps", {"ca": 0}, steps),
        }
    )


def write_report(folder: Path, document: dict[str, Any]) -> Path:
    """As report.json into the folder, which is made."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "report.json").write_text(json.dumps(document), encoding="utf-8")
    return folder


def json_lines(lines: list[dict[str, Any]]) -> str:
    return "".join(json.dumps(line) + "\n" for line in lines)


def write_suite(folder: Path, reports: dict[str, dict[str, Any]] | None = None) -> Path:
    """The suite with pictures; those of the alphabet are compressed."""
    reports = suite() if reports is None else reports
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "suite.json").write_text(json.dumps({"plans": list(reports)}), encoding="utf-8")
    (folder / "core.json").write_text(json.dumps(core()), encoding="utf-8")
    (folder / "league.json").write_text(json.dumps(league()), encoding="utf-8")
    (folder / "cases.csv").write_text(cases_csv(reports), encoding="utf-8")
    with lzma.open(folder / "tune.json.xz", "wt", encoding="utf-8") as file:
        json.dump(tune(), file)
    for name, document in reports.items():
        place = write_report(folder / name, document)
        ok = [row for row in document["runs"] if row["status"] == "ok" and row["n"] != 2000 or name == "alphabet"]
        text = json_lines(pictures([row for row in ok if row["status"] == "ok"][: 40 if name == "random" else None]))
        if name == "alphabet":
            (place / "pictures.jsonl.xz").write_bytes(lzma.compress(text.encode()))
        else:
            (place / "pictures.jsonl").write_text(text, encoding="utf-8")
    return folder
