#!/usr/bin/env bash
# The gate on speed and results: builds the core of a base revision and that of the work tree as it is, each with the
# same probe in a tree of its own, and compares them. The core's own sources and compile options are what differs.
#
#   gate.sh [--instructions] [--base REVISION] [--head FOLDER] [--out FOLDER] [--driver PROGRAM] [OPTION...]
#
#   --instructions   count instructions with callgrind instead of timing
#   --base           default: the merge base of HEAD with origin/main, or with main where there is no origin/main
#   --head           a checkout to gate instead of this one
#   --out            for gate.json, log and gate-work, where everything else goes; default: build-gate of this checkout
#   --driver         a ready bench_gate; default: built here, in build
#   OPTION           for bench_gate, see 'bench_gate --help'
#
# Exit status: 0 no regression; 1 head does not build, or another error; 2 usage; 3 a regression or a changed result;
# 5 inconclusive; 6 there is no base: its revision is not known, or it does not build; 130 interrupted.
set -euo pipefail
export LC_ALL=C

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
checkout=$(cd "$here/../.." && pwd)
head_tree=$checkout
out=$checkout/build-gate
base=""
driver=""
options=()
jobs=${JOBS:-$(nproc)}

fail() {
  local status=$1
  shift
  printf 'error: %s\n' "$*" >&2
  exit "$status"
}

say() { printf '==> %s\n' "$*" >&2; }

while [ $# -gt 0 ]; do
  case "$1" in
    --base | --head | --out | --driver)
      [ -n "${2:-}" ] || fail 2 "$1 needs a value."
      case "$1" in
        --base) base=$2 ;;
        --head) head_tree=$(cd "$2" 2>/dev/null && pwd) || fail 2 "there is no folder $2." ;;
        --out) out=$2 ;;
        --driver) driver=$2 ;;
      esac
      shift
      ;;
    *) options+=("$1") ;;
  esac
  shift
done

mkdir -p "$out/log" "$out/gate-work" 2>/dev/null || fail 2 "the folders log and gate-work cannot be made in $out: name another folder with --out."
out=$(cd "$out" && pwd)
work=$out/gate-work # a folder of its own, of which things are removed: whatever else is in --out is the user's

in_head() { git -C "$head_tree" "$@"; }

default_base() {
  local branch
  for branch in origin/main main; do
    ! in_head rev-parse --verify --quiet "$branch^{commit}" >/dev/null || { in_head merge-base HEAD "$branch" && return; }
  done
  return 1
}

# logged NAME COMMAND...: the command's output goes to a log.
logged() {
  local log="$out/log/$1.txt"
  shift
  "$@" >"$log" 2>&1
}

# build_probe NAME TREE: configures and compiles gate-work/NAME/build/gate_probe with the core in TREE.
build_probe() {
  say "building $1"
  logged "configure-$1" cmake -S "$here/probe" -B "$work/$1/build" -G Ninja -DCMAKE_BUILD_TYPE=Release "-DCORE_TREE=$2" &&
    logged "build-$1" cmake --build "$work/$1/build" --parallel "$jobs" --target gate_probe
}

# The newest log of a tree's build: where it stopped.
newest_log() { find "$out/log" -name "*-$1.txt" -printf '%T@ %p\n' | sort -n | tail -n 1 | cut -d ' ' -f 2-; }

# Unpacks the base's core unless it is there. What is unpacked gets today's time, or the build would take a file of an
# older commit for one that it knows.
unpack_base() {
  local commit=$1
  [ "$(cat "$work/base/commit" 2>/dev/null)" != "$commit" ] || return 0
  rm -rf "$work/base/tree" "$work/base/commit"
  mkdir -p "$work/base/tree"
  in_head archive "$commit" core cmake 2>"$work/base/archive.txt" | tar -x -m -C "$work/base/tree" 2>/dev/null || return
  printf '%s\n' "$commit" >"$work/base/commit"
}

build_driver() {
  say "building bench_gate"
  cd "$checkout"
  # The gate needs no tests; a build folder that has them keeps them, as long as GoogleTest is there.
  local without_tests=()
  { grep -qs '^HULLBENCH_TESTS:BOOL=ON' build/CMakeCache.txt &&
    [ -d "$(sed -n 's/^GTest_DIR:PATH=//p' build/CMakeCache.txt)" ]; } || without_tests=(-DHULLBENCH_TESTS=OFF)
  { logged configure-driver cmake --preset release "${without_tests[@]}" &&
    logged build-driver cmake --build --preset release --parallel "$jobs" --target bench_gate; } ||
    fail 1 "bench_gate does not build: see $(newest_log driver)"
  cd - >/dev/null
  driver=$checkout/build/bench_gate
}

in_head rev-parse --verify --quiet HEAD >/dev/null || fail 6 "$head_tree is no git checkout with a commit, so there is no base."
base_words=$base
if [ -z "$base" ]; then
  base_words="merge base with the main branch"
  base=$(default_base) || fail 6 "there is neither origin/main nor main to compare with: name a base with BASE=<git revision>."
fi
base_commit=$(in_head rev-parse --verify --quiet "$base^{commit}") || fail 6 "git knows no revision '$base': name one that 'git log' shows (a shallow clone has only the newest)."
base_name="$(in_head rev-parse --short "$base_commit") ($base_words)"
head_name="work tree of $(in_head rev-parse --short HEAD)"
[ -z "$(in_head status --porcelain -- core cmake)" ] || head_name+=" with changes that are not committed"

[ -n "$driver" ] || build_driver
# Head first: a compiler that builds nothing is no fault of the base.
build_probe head "$head_tree" || fail 1 "the $head_name does not build: see $(newest_log head)"
unpack_base "$base_commit" || fail 6 "the base $base_name has no core/ and cmake/ to build."
build_probe base "$work/base/tree" || fail 6 "the base $base_name does not build: see $(newest_log base)"
exec "$driver" --base-probe "$work/base/build/gate_probe" --head-probe "$work/head/build/gate_probe" \
  --base-name "$base_name" --head-name "$head_name" --out "$out" "${options[@]}"
