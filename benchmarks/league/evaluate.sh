#!/usr/bin/env bash
# evaluate.sh HULLBENCH OUT: the whole evaluation: searches the parameters of the methods on the plans of the world,
# measures what was chosen with every metric, and makes the league of it, OUT/league.json, with its results as
# OUT/league.csv. Nothing is timed, so all cores work; an evaluation that was interrupted goes on where it stopped.
# Either part says how long it will take.
#
# METHODS: a regular expression, the only methods that take part. PLANS: other plans than those of the world.
#
# Exit codes: 0 done; 2 usage; 130 interrupted; 143 ended by SIGTERM or SIGHUP; else that of the part that failed. A
# method's failures are no failure here: they are in the league.
set -euo pipefail

[ $# -eq 2 ] || { sed -n '2,10s/^# \{0,1\}//p' "$0" >&2; exit 2; }
hullbench=$1
out=$2
read -r -a plans <<<"${PLANS:-world_shapes world_samplers world_crossed}"
# All that are installed but the steps of some, which are the same methods again.
methods=${METHODS:-'(?![a-z_]*_steps(/|$))[a-z0-9_]*'}
# Seconds for one evaluation of the search. What was chosen is measured with the limits of the plans.
timeout=5

# The cores that this process may use: each part has one of its own, for its workers too.
cores=()
for range in $(taskset -cp $$ | sed 's/.*: //; s/,/ /g'); do
  for ((core = ${range%-*}; core <= ${range#*-}; ++core)); do cores+=("$core"); done
done
parts=${#cores[@]}

# run COMMAND...: a method's failures (4) are part of what is evaluated.
run() {
  local code=0
  "$@" || code=$?
  [ "$code" -eq 4 ] || return "$code"
}

mkdir -p "$out"
echo "==> searching parameters: ${#plans[@]} plans"
run "$hullbench" tune "${plans[@]}" --methods "$methods" --timeout "$timeout" --out "$out/tune" >"$out/tuning.md"

chosen=()
for plan in "${plans[@]}"; do chosen+=("$out/tune/$plan-tuned.json"); done
# Nothing is to be chosen for degenerate input: its plan is measured as it is.
chosen+=(stress_degenerate)
echo "==> measuring what was chosen, in $parts parts; the first one says how far it is"
# measure PART: into a folder of its own; its progress is seen of the first part only. A part without a case (6) is none.
measure() {
  local code=0
  run taskset -c "${cores[$1 - 1]}" "$hullbench" run "${chosen[@]}" --filter "^($methods)/" --repetitions 1 \
    --shard "$1/$parts" --out "$out/part-$1" 2>&1 >"$out/part-$1.txt" |
    if [ "$1" -eq 1 ]; then tee "$out/part-1.log" >&2; else cat >"$out/part-$1.log"; fi || code=$?
  [ "$code" -eq 6 ] || return "$code"
}
pids=()
stop() {
  trap '' INT TERM HUP
  for pid in "${pids[@]}"; do kill -TERM -- "-$pid" 2>/dev/null || true; done
  wait || true
  exit "$1"
}
set -m # each part is a process group of its own, in which an interruption is not ignored
trap 'stop 130' INT
trap 'stop 143' TERM HUP
for ((part = 1; part <= parts; ++part)); do
  measure "$part" &
  pids+=($!)
done
failed=0
for pid in "${pids[@]}"; do wait "$pid" || failed=$?; done
set +m
trap - INT TERM HUP
if [ "$failed" -ne 0 ]; then
  tail -n 3 "$out"/part-*.log >&2
  exit "$failed"
fi
run "$hullbench" merge "$out"/part-*/ --out "$out/runs" --force >/dev/null
"$hullbench" league "$out/runs" --out "$out/league.json" --csv "$out/league.csv"
