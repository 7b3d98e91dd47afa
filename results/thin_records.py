#!/usr/bin/env python3
"""thin_records.py <runs.jsonl >thinned.jsonl: what is kept of the records of a reference run with very many rows.

Tables are made of what stays: every run with its status, time and errors, and the first twelve digits of the hashes of its
points and of its result, by which a new run can be compared with it. Left out are the metrics that no table of such an
experiment has, the digits of times and of the others behind the fifth (tables show three), but for the metrics that tell
whether two methods gave the same polygons (benchmarks/report/headline.cpp), the times of the steps, the canaries' times
(their verdict stands in the flags), and the identity, which is a hash of what stays. Where there is one method, what
tells the same polygons is left out too: there is nobody to be compared with.
"""

import json
import sys

PHASES = ("run", "extract")  # whose sum is the time
# l2_convex_hull is shortened as l2 is: beside the whole number an equal l2, once shortened, could be the larger one.
METRICS = ("l2", "l2_paper", "l2_convex_hull", "ground_truth_area", "ground_truth_convexity", "valid", "invalid_reason")
WHOLE_METRICS = ("polygons", "holes", "vertices", "area")
HASHES = ("dataset_sha256", "output_sha256")
HASH_DIGITS = 12


def shortened(value: object) -> object:
    """With five digits, of the same type; words and truth values as they are."""
    return type(value)(float(f"{value:.5g}")) if type(value) in (int, float) else value


rows = [json.loads(line) for line in sys.stdin]
KEPT = METRICS + (WHOLE_METRICS if len({row["method"] for row in rows if "method" in row}) > 1 else ())
for row in rows:
    if "name" in row:
        row["metrics"] = {
            name: value if name in WHOLE_METRICS else shortened(value) for name, value in row["metrics"].items() if name in KEPT
        }
        row["phases_ns"] = [{name: shortened(times[name]) for name in PHASES if name in times} for times in row["phases_ns"]]
        row["time_ns"] = [shortened(time) for time in row["time_ns"]]
        row.update({name: row[name][:HASH_DIGITS] for name in HASHES if name in row})
        row.pop("canary_ns", None)
        row.pop("id", None)
    print(json.dumps(row, separators=(",", ":"), sort_keys=True, ensure_ascii=False))
