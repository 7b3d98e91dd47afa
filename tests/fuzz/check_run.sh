#!/usr/bin/env bash
# run.sh searches with each target in turn, and fails where one breaks, where one does nothing and where there is none.
set -euo pipefail
run=$(dirname "${BASH_SOURCE[0]}")/run.sh
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT

fail() {
  echo "error: $1" >&2
  cat "$build/said" >&2
  exit 1
}
# A stand-in for a target: its name and what it does.
target() {
  printf '#!/bin/sh\n%s\n' "$2" >"$build/fuzz_$1"
  chmod +x "$build/fuzz_$1"
}
expect_failure() {
  ! "$run" "$build" 1 2 >"$build/said" 2>&1 || fail "it does not fail where $2"
  grep -qF -- "$1" "$build/said" || fail "it does not say '$1'"
}

expect_failure "there is no fuzz target" "there is none"
# Each waits until the other is there: they run at the same time.
both='touch "$0.runs"; for i in $(seq 100); do [ -e "${0%_*}_csv.runs" ] && [ -e "${0%_*}_wkt.runs" ] && break; sleep 0.1; done; [ "$i" -lt 100 ] || exit 1'
good='echo "$*"; echo "stat::number_of_executed_units: 7"'
target csv "$both; $good"
target wkt "$both; $good"
"$run" "$build" 3 2 >"$build/said" 2>&1 || fail "it fails where nothing breaks"
for name in csv wkt; do
  grep -qF "fuzz_$name: 7 inputs, none breaks it" "$build/said" || fail "it does not say that fuzz_$name is right"
  grep -qE -- "-max_total_time=3 .*/fuzz/corpus/$name\$" "$build/log/$name.txt" || fail "fuzz_$name does not get its corpus"
done
target gone 'exit 77'
"$run" "$build" 3 2 >"$build/said" 2>&1 || fail "a target of an older build makes it fail"
grep -qF "fuzz_gone has no corpus" "$build/said" || fail "it does not say that fuzz_gone is not run"
rm "$build/fuzz_gone"
target wkt 'echo "FAILED: a coordinate is not finite"; exit 77'
expect_failure "FAILED: a coordinate is not finite" "a target breaks"
expect_failure "an input breaks fuzz_wkt" "a target breaks"
target wkt 'echo "stat::number_of_executed_units: 0"'
expect_failure "fuzz_wkt ran nothing" "a target does nothing"
