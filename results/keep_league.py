#!/usr/bin/env python3
"""keep_league.py RUNS KEPT: keeps in the new folder KEPT what the league of the suite RUNS is made of.

    hullbench league KEPT

gives the same league again. A row keeps its method, protocol, case, status, the metrics that a league has and the first
twelve digits of its result's hash; its times, its parameters (tune.json has them) and the digits behind the ninth are left
out. What is kept follows the schemas, which take rows without an identity and without times. RUNS must be a finished suite.

Exit codes: 0 kept; 2 usage, or RUNS is no finished suite, or KEPT is there already.
"""
import json
import lzma
import sys
from pathlib import Path
from typing import Any

METRICS = (
    *("valid", "l2", "l2_paper", "skill", "hole_f1", "ground_truth_area"),
    *("polygons", "polygons_error", "holes", "holes_error"),
)
TIMES = ("time_ns", "phases_ns")
HASH_DIGITS = 12


def shortened(value: Any) -> Any:
    return float(f"{value:.9g}") if isinstance(value, float) else value


def kept_row(row: dict[str, Any]) -> dict[str, Any]:
    if "name" not in row:
        return row
    kept = {key: value for key, value in row.items() if key not in ("id", "canary_ns", "cold_time_ns", "program")}
    kept.update({key: [] for key in TIMES}, parameters={}, output_sha256=row["output_sha256"][:HASH_DIGITS])
    kept["metrics"] = {name: shortened(row["metrics"][name]) for name in METRICS if name in row["metrics"]}
    return kept


def kept_description(run: dict[str, Any]) -> dict[str, Any]:
    for entry in run["plan"]["methods"]:
        entry.pop("parameters", None)
        entry.pop("datasets", None)
    return run


def main(runs: Path, kept: Path) -> None:
    suite = json.loads((runs / "suite.json").read_text())
    kept.mkdir()
    (kept / "suite.json").write_text(json.dumps({"plans": suite["plans"]}) + "\n")
    for description in sorted(runs.glob("*/run.json")):
        folder = kept / description.parent.name
        folder.mkdir()
        (folder / "run.json").write_text(json.dumps(kept_description(json.loads(description.read_text())), indent=1) + "\n")
        with lzma.open(folder / "runs.jsonl.xz", "wt", preset=9 | lzma.PRESET_EXTREME, encoding="utf-8") as out:
            for line in (description.parent / "runs.jsonl").read_text().splitlines():
                row = kept_row(json.loads(line))
                out.write(json.dumps(row, separators=(",", ":"), sort_keys=True, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    try:
        main(Path(sys.argv[1]), Path(sys.argv[2]))
    except (OSError, ValueError, KeyError, TypeError) as error:
        print(f"error: {sys.argv[1]} cannot be kept in {sys.argv[2]}: {error!r}.", file=sys.stderr)
        sys.exit(2)
