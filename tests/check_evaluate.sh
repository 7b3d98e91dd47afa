#!/bin/bash
# check_evaluate.sh PROJECT: what evaluate.sh asks of the program and what it makes of its exit codes, with a program that
# only says how it was called.
set -euo pipefail
unset OMP_NUM_THREADS OMP_THREAD_LIMIT # else nproc obeys them

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cat >"$scratch/hullbench" <<'PROGRAM'
#!/bin/bash
echo "$* on cores $(taskset -cp $$ | sed 's/.*: //')" >>"$CALLS"
case $1 in
  tune) exit "${TUNE_CODE:-0}" ;;
  run) echo "part is measured" >&2; exit "${RUN_CODE:-0}" ;;
esac
PROGRAM
chmod +x "$scratch/hullbench"
export CALLS=$scratch/calls

fail() {
  echo "FAIL: $1" >&2
  cat "$CALLS" "$scratch/out" >&2
  exit 1
}

# evaluate EXPECTED_CODE: with no call known yet.
evaluate() {
  local code=0
  : >"$CALLS"
  "$project/benchmarks/league/evaluate.sh" "$scratch/hullbench" "$scratch/evaluation" >"$scratch/out" 2>&1 || code=$?
  [ "$code" -eq "$1" ] || fail "evaluate.sh ended with $code, not $1"
}
project=$1

# A method's failure (4) is part of what is evaluated.
TUNE_CODE=4 RUN_CODE=4 METHODS='a|b' evaluate 0
grep -qx "tune world_shapes world_samplers world_crossed --methods a|b --timeout 5 --out .*/tune on cores .*" "$CALLS" || fail "tune"
[ "$(grep -c "^run .*/world_crossed-tuned.json stress_degenerate --filter ^(a|b)/ .*--shard" "$CALLS")" -eq "$(nproc)" ] ||
  fail "run, a part a core"
# Each on a core of its own.
[ "$(sed -n 's/^run .* on cores \([0-9]*\)$/\1/p' "$CALLS" | sort -u | wc -l)" -eq "$(nproc)" ] || fail "run, its core"
[ "$(tail -n 2 "$CALLS" | cut -d ' ' -f 1 | tr '\n' ' ')" = "merge league " ] || fail "merge and league come last"
grep -q "part is measured" "$scratch/out" || fail "nobody is told how far it is"

# A part without a case (6) is none.
RUN_CODE=6 evaluate 0
TUNE_CODE=130 evaluate 130
if grep -q "^run" "$CALLS"; then fail "it went on after an interruption"; fi
RUN_CODE=1 evaluate 1
if grep -q "^league" "$CALLS"; then fail "a league was made of a part that failed"; fi
echo "evaluate.sh searches, measures and makes the league"
