"""A small invented suite with every kind of record that the figures show, for the tests of plots/."""

from __future__ import annotations

import copy
import hashlib
import json
import lzma
import math
from pathlib import Path
from typing import Any

SIZES = (2000, 4000, 8000)
SERIES = (("polylidar", "paper"), ("cgal_alpha_shape", "paper"), ("spatialite", "paper"), ("geos_concave_hull", "auto"),
          ("geos_concave_hull", "paper"), ("somebodys_hull", "default"))
LETTERS = "abc"


def run_name(method: str, protocol: str, dataset: str, n: int, holes: bool) -> str:
    size = "all" if dataset.startswith("floor-") else n
    return f"{method}/{dataset}/n:{size}/holes:{int(holes)}/protocol:{protocol}"


def run(method: str, protocol: str, dataset: str, n: int, holes: bool = False, status: str = "ok",
        scale: float = 1.0) -> tuple[dict[str, Any], dict[str, Any]]:
    """A row and its statistics. The numbers differ from row to row and are nothing but distinct."""
    name = run_name(method, protocol, dataset, n, holes)
    key = int(hashlib.sha256(name.encode()).hexdigest()[:6], 16) / 0xFFFFFF
    row = {
        "schema_version": 1, "id": hashlib.sha256(name.encode()).hexdigest(), "name": name, "method": method,
        "method_version": "1", "dataset": dataset, "dataset_sha256": "0" * 64, "n": n, "holes": holes, "seed": 1,
        "protocol": protocol, "parameters": {}, "status": status, "detail": "" if status == "ok" else "why it failed",
        "time_ns": [], "phases_ns": [], "metrics": {}, "output_sha256": "",
    }
    summary = {"id": row["id"], "name": name, "status": status, "time": None, "paper_time": None}
    if status == "ok":
        times = [round(scale * n * (100 + 900 * key) * factor) for factor in (0.9, 1.0, 1.2)]
        row["time_ns"] = times
        row["phases_ns"] = [
            {"load": 1, "run": time - time // 10, "run.triangulation": time // 2, "run.shape": time // 4,
             "extract": time // 10, "extract.polygon": time // 10} for time in times
        ]
        error = (0.02 + 0.2 * key) * math.sqrt(2000 / n)
        row["metrics"] = {"valid": True, "l2": error, "l2_paper": 1.1 * error, "ground_truth_convexity": 0.3 + 0.6 * key,
                          "area": 1.0, "ground_truth_area": 1.0, "iou": 0.9}
        summary["time"] = {"repetitions": 3, "median_ns": times[1], "median_low_ns": times[0], "median_high_ns": times[2]}
    return row, summary


def report(name: str, datasets: dict[str, int], runs: list[tuple[dict[str, Any], dict[str, Any]]]) -> dict[str, Any]:
    """`datasets`: the members of each, 0 for a single shape."""
    methods = sorted({row["method"] for row, _ in runs})
    return {
        "schema_version": 1, "plan": {"name": name, "title": name.title()}, "environment": {},
        "methods": [{"name": method, "title": method} for method in methods],
        "datasets": [{"name": one, "title": one.title(), "members": members} for one, members in datasets.items()],
        "runs": [row for row, _ in runs], "summary": {"rows": [summary for _, summary in runs]}, "notes": [],
    }


def square(left: int, low: int, side: int) -> list[int]:
    return [left, low, left + side, low, left + side, low + side, left, low + side]


def pictures(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """For the cases of these rows: a square with a square hole, and results that are a little off."""
    lines = []
    for index, row in enumerate(rows):
        case = row["name"].split("/", 1)[1].rsplit("/", 1)[0]
        if case not in {line["case"] for line in lines}:
            points = [value for k in range(200) for value in (k * 37 % 1000, k * 91 % 1000)]
            lines.append({"kind": "case", "case": case, "dataset_sha256": "0" * 64, "origin": [10.0, 20.0], "step": 0.5,
                          "points_total": row["n"], "points": points,
                          "ground_truth": [[square(0, 0, 1000), square(300, 300, 200)]]})
        lines.append({"kind": "result", "case": case, "run": row["name"], "id": row["id"], "output_sha256": "1" * 64,
                      "polygons": [[square(20 * index, -10, 1000), square(310, 290, 210)]]})
    return lines


def core() -> dict[str, Any]:
    """As Google Benchmark writes it, with an aggregate and a failed benchmark among the entries."""
    entries = []
    for name, factor in (("concave_hull", 100), ("triangulation", 80), ("cgal_alpha_shape", 1500)):
        for n in (1000, 100_000):
            for repetition in (0.9, 1.0, 1.3):
                entries.append({"run_name": f"{name}/uniform/{n}", "run_type": "iteration", "time_unit": "us",
                                "real_time": factor * repetition * n / 1000})
            entries.append({"run_name": f"{name}/uniform/{n}", "run_type": "aggregate", "time_unit": "us", "real_time": 1e9})
    entries.append({"run_name": "concave_hull/uniform/7000", "run_type": "iteration", "error_occurred": True})
    entries.append({"run_name": "concave_hull/rgbd/1000", "run_type": "iteration", "time_unit": "us", "real_time": 1.0})
    return {"context": {}, "benchmarks": entries}


def league() -> dict[str, Any]:
    """Of league.json what is drawn; `tuned` has one curve only, which is no comparison."""
    def curve(method: str, protocol: str, *shares: float) -> dict[str, Any]:
        return {"method": method, "protocol": protocol, "shares": list(shares)}
    return {"kind": "league", "taus": [1, 2, 10], "profiles": [
        {"group": "informed", "cases": 30, "curves": [curve("polylidar", "paper", 0.5, 0.9, 1),
                                                      curve("geos_concave_hull", "paper", 0.5, 0.7, 0.95)]},
        {"group": "blind", "cases": 20, "curves": [curve("polylidar", "default", 0.7, 0.95, 1),
                                                   curve("spatialite", "default", 0.3, 0.6, 0.8)]},
        {"group": "tuned", "cases": 20, "curves": [curve("polylidar", "tuned", 1, 1, 1)]}]}


def tune() -> dict[str, Any]:
    """Of tune.json what is drawn: a method with a length, one with a number, one without a parameter."""
    def method(name: str, kind: str, tuned: float, medians: list[float | None]) -> dict[str, Any]:
        curve = [{"position": 2.0**k, "relative": {"q1": middle and 0.9 * middle, "median": middle, "q3": middle and 1.5 * middle}}
                 for k, middle in enumerate(medians)]
        return {"method": name, "axis": {"kind": kind}, "tuned": {"position": tuned}, "curve": curve,
                "tolerance_octaves": {"median": 1.25}}
    return {"kind": "tuning", "cases": [{}] * 12, "methods": [
        method("polylidar", "spacings", 2, [3, 1.1, 2, 30]), method("spatialite", "own", 4, [None, 2, 1.2, 1.5]),
        {"method": "convex_hull", "axis": None, "tuned": None, "curve": [], "tolerance_octaves": None}]}


def suite() -> dict[str, dict[str, Any]]:
    """The reports by experiment. postgis_legacy is not installed, hull_js times out at 8000 points."""
    states = [run(*series, dataset, n, holes) for dataset in ("ca", "hi") for holes in (False, True) for n in SIZES
              for series in SERIES]
    states += [run("hull_js", "auto", "ca", n, True, "timeout" if n == 8000 else "ok") for n in SIZES]
    states += [run("postgis_legacy", "paper", "ca", n, True, "not_installed") for n in SIZES]
    alphabet = [run(*series, f"letter_{letter}", 2000) for letter in LETTERS for series in SERIES]
    alphabet += [run("convex_hull", "default", f"letter_{letter}", 2000) for letter in LETTERS]
    alphabet += [run("postgis_legacy", "paper", f"letter_{letter}", 2000, status="not_installed") for letter in LETTERS]
    random = [run("polylidar", "paper", f"star-{k}", 8000) for k in range(1, 400)]
    random += [run("polylidar", "paper", f"comb-{k}", 8000) for k in range(1, 9)]
    steps = [run(method, "paper", "ca", 64000, True) for method in ("polylidar", "cgal_alpha_shape", "spatialite_steps")]
    rgbd = [run(*series, f"floor-{k}", 900 + k) for k in (1, 2) for series in SERIES]
    return copy.deepcopy({
        "rgbd": report("rgbd", {"floor": 2}, rgbd), "states": report("states", {"ca": 0, "hi": 0}, states),
        "alphabet": report("alphabet", {f"letter_{letter}": 0 for letter in LETTERS}, alphabet),
        "random": report("random", {"star": 399, "comb": 8}, random), "steps": report("steps", {"ca": 0}, steps),
    })


def write_suite(folder: Path, reports: dict[str, dict[str, Any]] | None = None) -> Path:
    """The suite with pictures; those of the alphabet are compressed."""
    reports = suite() if reports is None else reports
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "suite.json").write_text(json.dumps({"schema_version": 1, "plans": list(reports)}), encoding="utf-8")
    (folder / "core.json").write_text(json.dumps(core()), encoding="utf-8")
    (folder / "league.json").write_text(json.dumps(league()), encoding="utf-8")
    with lzma.open(folder / "tune.json.xz", "wt", encoding="utf-8") as file:
        json.dump(tune(), file)
    for name, document in reports.items():
        (folder / name).mkdir()
        (folder / name / "report.json").write_text(json.dumps(document), encoding="utf-8")
        ok = [row for row in document["runs"] if row["status"] == "ok" and row["n"] != 2000 or name == "alphabet"]
        lines = pictures([row for row in ok if row["status"] == "ok"][:40 if name == "random" else None])
        text = "".join(json.dumps(line) + "\n" for line in lines)
        if name == "alphabet":
            (folder / name / "pictures.jsonl.xz").write_bytes(lzma.compress(text.encode()))
        else:
            (folder / name / "pictures.jsonl").write_text(text, encoding="utf-8")
    return folder
