#!/usr/bin/env bash
# Checks of the project's own files. Exit status 0: fine; 1: found something, which is printed; 77: cannot tell here.
#
#   check.sh format [--fix]       our C++ is as clang-format 14 writes it
#   check.sh python [--fix]       our Python is as black 23 writes it
#   check.sh javascript [--fix]   our JavaScript is as prettier writes it, in the version of tests/report
#   check.sh tidy [JOBS]          clang-tidy has nothing to say; needs build-clang/compile_commands.json
#   check.sh paths                no file names a path of one machine
#   check.sh layout               the top level is what the design allows; its folders have a README
#   check.sh rooms                a room of benchmarks/ includes only rooms that it links and that are before it, and core/ none
#   check.sh printing             no library prints
#   check.sh version              every file that states the version states that of CMakeLists.txt
#   check.sh help                 "make help" and benchmarks/README.md name every target
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# The project's files, committed or about to be. Without git (an unpacked archive, another owner) all files but the
# built ones.
project_files() {
  git ls-files --cached --others --exclude-standard 2>/dev/null |
    while IFS= read -r file; do [ ! -f "$file" ] || printf '%s\n' "$file"; done | grep . && return
  find . -path './build*' -prune -o -path ./.git -prune -o -path ./results/runs -prune -o -path ./results/slurm -prune -o \
    -path ./results/evaluation -prune -o -name node_modules -prune -o \
    -type f -print | sed 's|^\./||'
}

sources() { project_files | grep -E '\.(cpp|hpp)$' | sort; }

# Adapters are left out: a method's version contains a hash of their sources, which reformatting would change.
scripts() { project_files | grep -E "\.$1\$" | grep -v '^adapters/' | sort; }

skip() {
  echo "skipped: $1: formatting is not checked." >&2
  exit 77
}

# What clang-format and black write differs between versions, so one version decides.
check_format() {
  local program found
  program=$(command -v clang-format-14 || command -v clang-format) &&
    "$program" --version | grep -qE 'version 14\.' ||
    skip "clang-format 14 is missing ('make deps' installs it on Debian 12)"
  if [ "${1:-}" = --fix ]; then
    sources | xargs "$program" -i
    return
  fi
  if ! found=$(sources | xargs "$program" --dry-run -Werror 2>&1); then
    sed -n 's/^\([^ :]*:[0-9]*\):[0-9]*: error: .*/\1/p' <<<"$found" | sort -u -V >&2
    not_formatted
  fi
}

check_python() {
  black --version 2>/dev/null | grep -qE '^black, 23\.' || skip "black 23 is missing ('make deps' installs it on Debian 12)"
  local check=--check
  [ "${1:-}" != --fix ] || check=
  scripts py | xargs black $check --line-length 128 --skip-magic-trailing-comma || not_formatted
}

check_javascript() {
  local prettier=tests/report/node_modules/.bin/prettier check=--check
  [ -x $prettier ] || skip "prettier is missing ('cmake/install-npm.sh tests/report' installs it)"
  [ "${1:-}" != --fix ] || check=--write
  scripts 'm?js' | xargs $prettier $check --log-level warn --print-width 128 --object-wrap collapse ||
    not_formatted
}

not_formatted() {
  echo "error: not formatted; 'make format' puts it right." >&2
  return 1
}

check_tidy() {
  [ -f build-clang/compile_commands.json ] || { echo "error: 'make build-clang' first: clang-tidy needs its compile commands." >&2; return 1; }
  command -v clang-tidy >/dev/null || { echo "error: clang-tidy is missing: 'make deps' installs it." >&2; return 1; }
  # clang-tidy 14 goes on with its own defaults when it cannot read the configuration.
  ! clang-tidy --dump-config 2>&1 >/dev/null | grep 'rror parsing' || return 1
  # Only files that a target compiles have compile commands.
  local files
  files=$(sources | grep '\.cpp$' | while IFS= read -r file; do
    ! grep -qF "\"file\": \"$PWD/$file\"" build-clang/compile_commands.json || printf '%s\n' "$file"
  done)
  [ -n "$files" ] || { echo "error: no source file is in build-clang/compile_commands.json." >&2; return 1; }
  printf '==> clang-tidy on %s files\n' "$(wc -l <<<"$files")"
  xargs -n 1 -P "${1:-2}" clang-tidy -p build-clang --quiet --warnings-as-errors='*' <<<"$files" \
    2> >(grep -vE '^[0-9]+ warnings? (generated|treated)|^Suppressed|^Use -header-filter' >&2)
}

# A path into somebody's home or work folder works on one machine only.
check_paths() {
  local found
  found=$(project_files | xargs -d '\n' grep -nIE '(^|[^[:alnum:]_.])/(home|root|work|Users)/|/tmp/[b]uild' -- || true)
  [ -z "$found" ] || { printf 'error: paths of one machine:\n%s\n' "$found" >&2; return 1; }
}

allowed_at_top="CMakeLists.txt core packaging adapters benchmarks datasets results plots tests docker-compose.yml README.md
  Makefile CMakePresets.json cmake pyproject.toml setup.py MANIFEST.in LICENSE LICENSE-THIRD-PARTY CHANGELOG.md CITATION.cff CONTRIBUTING.md"

check_layout() {
  local name names status=0
  # Not what a user leaves in the clone.
  names=$(git ls-files 2>/dev/null | cut -d / -f 1 | sort -u) || true
  [ -n "$names" ] || { echo "skipped: this is no git checkout"; return 77; }
  for name in $names; do
    case "$name" in .*) continue ;; esac
    grep -qwF -- "$name" <<<"$allowed_at_top" || { echo "error: '$name' does not belong at the top level." >&2; status=1; }
  done
  for name in $allowed_at_top; do
    [ -e "$name" ] || { echo "error: '$name' is missing at the top level." >&2; status=1; }
  done
  for name in core packaging adapters datasets benchmarks results plots tests; do
    [ -e "$name/README.md" ] || { echo "error: $name/README.md is missing: it is the map of the folder." >&2; status=1; }
  done
  [ "$(wc -l <README.md)" -le 250 ] || { echo "error: README.md is longer than 250 lines." >&2; status=1; }
  return $status
}

# The order is that of benchmarks/CMakeLists.txt; what a room links, that of its own or a line there.
check_rooms() {
  local room file library used linked before=" " status=0
  for room in $(sed -n 's/^add_subdirectory(\([a-z]*\)).*/\1/p' benchmarks/CMakeLists.txt); do
    before+="$room "
    linked=" $room "
    file=benchmarks/$room/CMakeLists.txt
    for library in $({ sed 's/#.*//' "$file"; grep "^target_link_libraries(hullbench_$room " benchmarks/CMakeLists.txt; } | grep -oE 'hullbench::[a-z_]+' | sort -u); do
      linked+="$(room_of "${library#hullbench::}") "
    done
    for used in $(grep -rhoE '#include "benchmarks/[a-z]+/' "benchmarks/$room" | sed 's|.*benchmarks/\(.*\)/|\1|' | sort -u); do
      [[ $before == *" $used "* ]] || { echo "error: benchmarks/$room includes benchmarks/$used, a later room." >&2; status=1; }
      [[ $linked == *" $used "* ]] ||
        { echo "error: benchmarks/$room includes benchmarks/$used, which $file does not link." >&2; status=1; }
      case "$room/$used" in plan/plan | statistics/statistics | */base) ;; plan/* | statistics/*)
        echo "error: benchmarks/$room may include no room but base, and includes benchmarks/$used." >&2
        status=1
        ;;
      esac
    done
  done
  [ "$before" != " " ] || { echo "error: benchmarks/CMakeLists.txt adds no room." >&2; return 1; }
  if grep -rnE '#include "(adapters|benchmarks|datasets|tests)/' core >&2; then
    echo "error: core includes what is built upon it." >&2
    status=1
  fi
  return $status
}

# The room whose CMakeLists.txt makes the library; empty where none does.
room_of() { grep -lE "^hullbench_room\($1\b|ALIAS hullbench_$1\)" benchmarks/*/CMakeLists.txt | cut -d / -f 2 || true; }

# A library gets a stream or a callback from who calls it. Programs print: the command line and what has a main().
check_printing() {
  local found
  found=$(sources | grep -E '^(core|datasets|adapters|benchmarks)/' | grep -v '^benchmarks/cli/' |
    xargs grep -L '^int main(' | xargs grep -nE 'std::(cout|cerr|clog)\b|\b(std::)?(f?printf|f?puts|putchar)\(' || true)
  [ -z "$found" ] || { printf 'error: a library prints:\n%s\n' "$found" >&2; return 1; }
}

# These files repeat the version by hand.
check_version() {
  local version stated status=0
  version=$(sed -n 's/^project(hullbench VERSION \([0-9.]*\) .*/\1/p' CMakeLists.txt)
  [ -n "$version" ] || { echo "error: CMakeLists.txt has no version." >&2; return 1; }
  while IFS=$'\t' read -r file stated; do
    [ "$stated" = "$version" ] || { echo "error: $file states version '$stated', CMakeLists.txt $version." >&2; status=1; }
  done < <(
    printf 'CITATION.cff\t%s\n' "$(sed -n 's/^version: //p' CITATION.cff)"
    printf 'CHANGELOG.md\t%s\n' "$(sed -n 's/^## \([0-9.]*\), [0-9]*-[0-9]*-[0-9]*$/\1/p' CHANGELOG.md | head -n 1)"
    printf 'core/js/README.md\t%s\n' "$(sed -n 's/.*polylidar-\([0-9.]*\)\.tgz.*/\1/p' core/js/README.md | sort -u)"
  )
  # Before 1.0 a minor version may change the interface, and is what a program asks for.
  for file in core/README.md tests/package/CMakeLists.txt; do
    grep -q "find_package(polylidar ${version%.*} REQUIRED)" "$file" ||
      { echo "error: $file does not ask for polylidar ${version%.*}." >&2; status=1; }
  done
  return $status
}

check_help() {
  local targets listing target status=0
  targets=$(sed -n 's/^\.PHONY: //p' Makefile)
  [ -n "$targets" ] || { echo "error: no .PHONY line found in the Makefile." >&2; return 1; }
  listing=$(make --no-print-directory help)
  for target in $targets; do
    grep -qE "^  make $target +[a-z]" <<<"$listing" || { echo "error: 'make help' does not list $target." >&2; status=1; }
    grep -qF "make $target\`" benchmarks/README.md ||
      { echo "error: benchmarks/README.md does not name \`make $target\`." >&2; status=1; }
  done
  # Whoever follows the README has only what "make build" built.
  listing=$(make --no-print-directory -n build)
  for target in $(grep -oE '(^|[ `"])build/(hullbench|polylidar)' README.md core/*/README.md | sed 's|.*/||' | sort -u); do
    grep -qE -- "--target .*\b$target\b" <<<"$listing" ||
      { echo "error: 'make build' does not build build/$target." >&2; status=1; }
  done
  return $status
}

case "${1:-}" in
  format | python | javascript | tidy | paths | layout | rooms | printing | version | help) "check_$1" "${@:2}" ;;
  *)
    sed -n '2,14s/^# \{0,1\}//p' "$0" >&2
    exit 2
    ;;
esac
