#!/bin/bash
# keep_reference.sh RUN: keeps the finished suite in the folder RUN as the reference run, in results/<date>-<machine>
# with its records compressed; results/reference points to it, and so do the README's links. An older reference run is
# removed. Exit codes: 0 kept; 2 not kept, as it is not finished, not drawn, or of another build than HEAD's
# (check_reference.py), and nothing was changed.
set -euo pipefail

run=$1
cd "$(dirname "$0")/.."
if [ ! -f "$run/suite.json" ] || [ ! -f "$run/tables.md" ]; then
  echo "error: $run is not a finished 'make bench'; run that first." >&2
  exit 2
fi
if [ ! -f "$run/report.html" ] || [ ! -f "$run/figures/summary.png" ]; then
  echo "error: $run is not drawn; 'make figures report RUN=$run' does it, and so does 'make reference'." >&2
  exit 2
fi

results/check_reference.py "$run"

first=$(sed -n 's/^ *"created": "\([^"]*\)".*/\1/p' "$run/suite.json" | head -n 1)
machine=$(grep -h -m 1 -o '"machine_id": "[0-9a-f]*"' "$run"/*/run.json | head -n 1 | cut -d '"' -f 4)
kept=results/${first%%T*}-$machine

old=$(readlink results/reference || true)
[ -z "$old" ] || rm -rf "results/${old:?}"
rm -rf "$kept"
mkdir "$kept"
cp "$run/suite.json" "$run/tables.md" "$kept"
cp -r "$run/tables" "$kept"
for description in "$run"/*/run.json; do
  experiment=$(basename "$(dirname "$description")")
  mkdir "$kept/$experiment"
  cp "$description" "$kept/$experiment"
  records=$run/$experiment/runs.jsonl
  # Tables of smaller experiments are made of all that a row has.
  if [ "$(wc -l <"$records")" -gt 10000 ]; then
    /usr/bin/python3 results/thin_records.py <"$records"
  else
    cat "$records"
  fi | xz -9e >"$kept/$experiment/runs.jsonl.xz"
done
# What was drawn of the whole run; pictures.jsonl, from which some of it is drawn, is too large to be kept.
gzip -9 --no-name <"$run/report.html" >"$kept/report.html.gz"
mkdir "$kept/figures"
cp "$run/figures/summary.png" "$kept/figures"
# The league, the rows that it is made of, and the search belong to no run of the suite; of an evaluation that was
# finished they are kept beside it.
[ ! -f results/evaluation/league.json ] || cp results/evaluation/league.json "$kept"
[ ! -f results/evaluation/runs/suite.json ] || results/keep_league.py results/evaluation/runs "$kept/league"
[ ! -f results/evaluation/tune/tune.json ] || xz -9e --stdout results/evaluation/tune/tune.json >"$kept/tune.json.xz"
[ ! -f "$run/core.json" ] || cp "$run/core.json" "$kept"
ln -sfn "$(basename "$kept")" results/reference
sed -i -E "s#results/[0-9]{4}-[0-9]{2}-[0-9]{2}-[0-9a-f]{8}#$kept#g" README.md
echo "==> kept $run as $kept ($(du -sh "$kept" | cut -f 1))"
