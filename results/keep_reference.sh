#!/bin/bash
# keep_reference.sh RUN: keeps the finished suite in the folder RUN as the reference run, in results/<date>-<machine>
# with its records compressed; results/reference points to it, and so do the README's links. An older reference run is
# removed. Exit codes: 0 kept; 2 not kept, as it is not finished, not drawn, or of another build than HEAD's
# (check_reference.py), and nothing was changed.
set -euo pipefail

[ $# -eq 1 ] || {
  sed -n '2,5s/^# \{0,1\}//p' "$0" >&2
  exit 2
}
run=$(realpath -m -- "$1")
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
machine=$(grep -h -m 1 -o '"machine_id": "[0-9a-f]*"' "$run"/*/run.json | head -n 1 | cut -d '"' -f 4) || {
  echo "error: no run.json in $run names its machine." >&2
  exit 2
}
kept=results/${first%%T*}-$machine

# The former one stays until this one is complete.
unfinished=$kept.unfinished
rm -rf "$unfinished"
mkdir "$unfinished"
cp "$run/suite.json" "$run/tables.md" "$unfinished"
cp -r "$run/tables" "$unfinished"
for description in "$run"/*/run.json; do
  experiment=$(basename "$(dirname "$description")")
  mkdir "$unfinished/$experiment"
  cp "$description" "$unfinished/$experiment"
  records=$run/$experiment/runs.jsonl
  # Tables of smaller experiments are made of all that a row has.
  if [ "$(wc -l <"$records")" -gt 10000 ]; then
    /usr/bin/python3 results/thin_records.py <"$records"
  else
    cat "$records"
  fi | xz -9e >"$unfinished/$experiment/runs.jsonl.xz"
done
# What was drawn of the whole run; pictures.jsonl, from which some of it is drawn, is too large to be kept.
gzip -9 --no-name <"$run/report.html" >"$unfinished/report.html.gz"
mkdir "$unfinished/figures"
cp "$run/figures/summary.png" "$unfinished/figures"
# The league, the rows that it is made of, and the search belong to no run of the suite; of an evaluation that was
# finished they are kept beside it.
[ ! -f results/evaluation/league.json ] || cp results/evaluation/league.json "$unfinished"
[ ! -f results/evaluation/runs/suite.json ] || results/keep_league.py results/evaluation/runs "$unfinished/league"
[ ! -f results/evaluation/tune/tune.json ] || xz -9e --stdout results/evaluation/tune/tune.json >"$unfinished/tune.json.xz"
[ ! -f "$run/core.json" ] || cp "$run/core.json" "$unfinished"
old=$(readlink results/reference || true)
[ -z "$old" ] || rm -rf "results/${old:?}"
rm -rf "$kept"
mv "$unfinished" "$kept"
ln -sfn "$(basename "$kept")" results/reference
sed -i -E "s#results/[0-9]{4}-[0-9]{2}-[0-9]{2}-[0-9a-f]{8}#$kept#g" README.md
echo "==> kept $run as $kept ($(du -sh "$kept" | cut -f 1))"
