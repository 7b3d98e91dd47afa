#!/usr/bin/env bash
# evaluate.sh HULLBENCH OUT: the whole evaluation: searches the parameters of the methods on all stress suites and the
# letters, measures what was chosen with every metric, and makes the league of it, OUT/league.json. Nothing is timed, so
# all cores work; an evaluation that was interrupted goes on where it stopped.
#
# Exit codes: 0 done; 2 usage; 130 interrupted; else that of the part that failed. A method's failures are no failure here:
# they are in the league.
set -euo pipefail

[ $# -eq 2 ] || { sed -n '2,7s/^# \{0,1\}//p' "$0" >&2; exit 2; }
hullbench=$1
out=$2
plans=(alphabet stress_density stress_noise stress_outliers stress_gradient stress_clusters stress_sampling stress_holes
  stress_width stress_gaps stress_degenerate)
# All that are installed but three: the steps of the databases are the same methods again, and PostGIS up to 3.2 takes some
# ten seconds for one of the 33 values that are tried on each of some 500 cases.
methods='(?!postgis_legacy$|.*_steps$).*'
parts=$(nproc)

# run COMMAND...: a method's failures (4) are part of what is evaluated.
run() {
  local code=0
  "$@" || code=$?
  [ "$code" -eq 4 ] || return "$code"
}

mkdir -p "$out"
echo "==> searching parameters: ${#plans[@]} plans"
run "$hullbench" tune "${plans[@]}" --methods "$methods" --out "$out/tune" >"$out/tuning.md"

chosen=()
for plan in "${plans[@]}"; do chosen+=("$out/tune/$plan-tuned.json"); done
echo "==> measuring what was chosen, in $parts parts"
pids=()
for ((part = 1; part <= parts; ++part)); do
  run "$hullbench" run "${chosen[@]}" --repetitions 1 --shard "$part/$parts" --out "$out/part-$part" \
    >"$out/part-$part.txt" 2>"$out/part-$part.log" &
  pids+=($!)
done
failed=0
for pid in "${pids[@]}"; do wait "$pid" || failed=$?; done
if [ "$failed" -ne 0 ]; then
  tail -n 3 "$out"/part-*.log >&2
  exit "$failed"
fi
run "$hullbench" merge "$out"/part-*/ --out "$out/runs" --force >/dev/null
"$hullbench" league "$out/runs" --out "$out/league.json"
