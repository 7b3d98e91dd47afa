#!/usr/bin/env bash
# Searches for inputs that break a fuzz target, from its kept corpus in corpus/NAME on.
#
#   run.sh BUILD SECONDS AT_ONCE [NAME]   each fuzz_NAME in the folder BUILD, or this one, for so many seconds
#
# What is found stays in BUILD: the kept corpora are only read. Exit status 1: an input breaks a target, or nothing ran.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
[ $# -ge 3 ] || { sed -n '2,6s/^# \{0,1\}//p' "$0" >&2; exit 2; }
build=$1 seconds=$2 at_once=$3 name=${4:-}

if [ -z "$name" ]; then
  names=$(for program in "$build"/fuzz_*; do [ ! -f "$program" ] || [ ! -x "$program" ] || echo "${program##*/fuzz_}"; done)
  [ -n "$names" ] || { echo "error: there is no fuzz target in $build." >&2; exit 1; }
  xargs -n 1 -P "$at_once" "$0" "$build" "$seconds" 1 <<<"$names" || exit 1
  exit 0
fi

if [ ! -d "$here/corpus/$name" ]; then
  echo "==> fuzz_$name has no corpus, so it is left from an older build: not run"
  exit 0
fi
log=$build/log/$name.txt
work=$build/work/$name
mkdir -p "$build/log" "$build/found" "$work"
longest=4000
[ "$name" != concave_hull ] || longest=1200
echo "==> fuzz_$name: searching for $seconds seconds, log in $log"
status=0
"$build/fuzz_$name" -max_total_time="$seconds" -timeout=10 -max_len=$longest -print_final_stats=1 \
  -artifact_prefix="$build/found/$name-" "$work" "$here/corpus/$name" >"$log" 2>&1 || status=$?
interrupted=72 # how libFuzzer ends on Ctrl-C
[ "$status" -ne $interrupted ] || { echo "fuzz_$name: interrupted" >&2; exit 130; }
if [ "$status" -ne 0 ]; then
  grep -A 4 -m 1 -E '^FAILED|runtime error|ERROR' "$log" >&2 || true
  grep -E '^artifact_prefix' "$log" >&2 || true
  echo "error: an input breaks fuzz_$name; see $log." >&2
  exit 1
fi
runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
[ "${runs:-0}" -gt 0 ] || { echo "error: fuzz_$name ran nothing; see $log." >&2; exit 1; }
echo "==> fuzz_$name: $runs inputs, none breaks it"
