#!/usr/bin/env python3
"""median_errors.py RECORDS: the median and the mean error of each method in a run's runs.jsonl or runs.jsonl.xz, in % of the
true area. A run without a valid result, or with an error above 100 %, counts as 100 %; one of a method that was not
installed does not count.

    results/median_errors.py results/reference/towns/runs.jsonl.xz
"""
import collections
import json
import lzma
import statistics
import sys

if len(sys.argv) != 2:
    sys.exit(__doc__)
errors = collections.defaultdict(list)
try:
    with (lzma.open if sys.argv[1].endswith(".xz") else open)(sys.argv[1], "rt") as records:
        for line in records:
            run = json.loads(line)
            if run["status"] == "not_installed":
                continue
            l2 = run["metrics"].get("l2") if run["status"] == "ok" else None
            errors[f"{run['method']} ({run['protocol']})"].append(1 if l2 is None else min(l2, 1))
except (OSError, lzma.LZMAError, ValueError, KeyError) as error:
    sys.exit(f"median_errors: {sys.argv[1]} cannot be read as records of runs: {error}")
for method, values in sorted(errors.items(), key=lambda item: statistics.median(item[1])):
    print(f"{100 * statistics.median(values):5.1f} {100 * statistics.mean(values):5.1f}  {method}")
