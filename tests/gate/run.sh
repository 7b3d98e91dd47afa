#!/usr/bin/env bash
# Shows that the gate works on this machine: identical code passes, 10 % more work in the triangulation is found every
# time, fewer instructions are listed, a changed result is caught, what does not build has its exit code, and no gate
# takes more than two minutes beside building.
#
#   GATES=N        gates of identical code (default 20; at most one in 20 may say 3, half or more must say 0, the rest 5)
#   SLOW_GATES=N   gates of the slower core (default 10; all must say 3 and name the triangulated cases)
#
# Runs on copies of core/ and cmake/ as they are in the work tree. Needs a built bench_gate ("make test-gate" sees to
# it) and a machine with nothing else to do. Logs stay in build/gate-test.
set -euo pipefail
export LC_ALL=C

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
checkout=$(cd "$here/../.." && pwd)
logs="$checkout/build/gate-test"
gates=${GATES:-20}
slow_gates=${SLOW_GATES:-10}
work=""
log=""
status=0
longest=0
passed=0
failed=0

fail() {
  printf 'error: %s\n' "$*" >&2
  exit 2
}

clean_up() { [ -z "$work" ] || rm -rf -- "$work"; }

in_tree() { GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_NOSYSTEM=1 git -C "$work/tree" -c user.name=gate -c user.email=gate@example.org -c core.hooksPath=/dev/null "$@"; }

# add_revision NAME: the clean core with NAME.patch, as a tag of that name.
add_revision() {
  in_tree checkout --quiet clean
  in_tree apply "$here/$1.patch" || fail "tests/gate/$1.patch no longer fits the core: make the same change again with 'git diff'."
  in_tree commit --quiet --all --message "$1"
  in_tree tag "$1"
}

make_tree() {
  local name
  mkdir "$work/tree"
  cp -a "$checkout/core" "$checkout/cmake" "$work/tree"
  in_tree init --quiet
  in_tree add --all
  in_tree commit --quiet --message clean
  in_tree tag clean
  for name in ten-percent-more-work five-percent-more-work changed-result broken; do
    add_revision "$name"
  done
}

# gate NAME BASE HEAD [OPTION...]: one gate of tag BASE against tag HEAD; sets `status` and `log`, keeps the
# `longest` time that one took beside building, prints a line.
gate() {
  local name=$1 base=$2 head=$3 start=$SECONDS seconds
  shift 3
  log="$logs/$name.txt"
  in_tree checkout --quiet "$head"
  status=0
  "$checkout/benchmarks/gate/gate.sh" --driver "$checkout/build/bench_gate" --head "$work/tree" --base "$base" \
    --out "$work/out" "$@" >"$log" 2>&1 || status=$?
  [ ! -f "$work/out/gate.json" ] || mv "$work/out/gate.json" "$logs/$name.json"
  seconds=$(sed -nE 's/^gate \([a-z]+, ([0-9]+) s\): .*/\1/p' "$log")
  longest=$((${seconds:-0} > longest ? seconds : longest))
  printf '%-28s exit %d, %3d s: %.150s\n' "$name" "$status" $((SECONDS - start)) "$(tail -n 1 "$log")"
  [ "$status" -ne 130 ] || exit 130
}

# check WHAT COMMAND...: counts one condition.
check() {
  local what=$1
  shift
  if "$@"; then
    passed=$((passed + 1))
    printf 'PASS  %s\n' "$what"
  else
    failed=$((failed + 1))
    printf 'FAIL  %s\n' "$what"
  fi
}

# says STATUS [PATTERN]: the last gate's exit status, and a line of its log.
says() { [ "$status" -eq "$1" ] && grep -qE -- "${2:-}" "$log"; }

identical_gates() {
  local i count=(0 0 0 0 0 0 0)
  for i in $(seq "$gates"); do
    gate "identical-$i" clean clean --seed "$i"
    count[status]=$((${count[status]:-0} + 1))
  done
  check "identical code: ${count[3]} of $gates gates say 3, at most one in 20 may" [ $((count[3] * 20)) -le $((gates > 20 ? gates : 20)) ]
  check "identical code: ${count[0]} of $gates gates say 0, half or more must (${count[5]} say 5)" [ $((count[0] * 2)) -ge "$gates" ]
  check "identical code: every gate says 0, 3 or 5" [ $((count[0] + count[3] + count[5])) -eq "$gates" ]
}

slow_gates() {
  local i found=0
  # Seven of the steps that are timed triangulate; noise may hide some of them in a gate, but never most.
  for i in $(seq "$slow_gates"); do
    gate "slower-$i" clean ten-percent-more-work --seed "$i"
    ! says 3 'regression: (concave_hull[^,]*(, |$)){4}' || found=$((found + 1))
  done
  check "10 % more work in the triangulation: found in $found of $slow_gates gates" [ "$found" -eq "$slow_gates" ]
}

[[ "$gates" =~ ^[0-9]+$ && "$slow_gates" =~ ^[0-9]+$ ]] || fail "GATES and SLOW_GATES are numbers."
[ -x "$checkout/build/bench_gate" ] || fail "build/bench_gate is missing: 'make test-gate' builds it."
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP
work=$(mktemp -d "${TMPDIR:-/tmp}/hullbench-gate.XXXXXX")
rm -rf "$logs"
mkdir -p "$logs"
make_tree
mkdir -p "$work/out/results" "$work/out/base/tree"
touch "$work/out/results/kept" "$work/out/base/tree/kept"

gate instructions-identical clean clean --instructions
check "instructions: identical code passes" says 0 'no regression'
check "what else is in the folder of results stays" [ -f "$work/out/results/kept" -a -f "$work/out/base/tree/kept" ]
gate instructions-slower clean ten-percent-more-work --instructions
check "instructions: 10 % more work is a regression" says 3 'regression: .*triangulation ca-8000'
gate instructions-improvement five-percent-more-work clean --instructions
check "instructions: 5 % fewer are listed as an improvement" says 0 '^improvement: triangulation ca-8000'
gate changed-result clean changed-result --instructions
check "instructions: a changed result is caught" says 3 'result changed: .*ca-8000'
gate changed-result-time clean changed-result --blocks 10
check "time: a changed result is caught" says 3 'result changed: .*ca-8000'
gate unknown-base no-such-revision clean
check "a base that git does not know" says 6 "^error: git knows no revision 'no-such-revision'"
gate broken-base broken clean
check "a base that does not build" says 6 '^error: the base .* does not build: see '
gate broken-head clean broken
check "a head that does not build" says 1 '^error: the work tree .* does not build: see '
[ "$gates" -eq 0 ] || identical_gates
[ "$slow_gates" -eq 0 ] || slow_gates
check "the longest gate took $longest s beside building, at most 120 s are allowed" [ "$longest" -le 120 ]
echo "logs: $logs"
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
