#!/usr/bin/env bash
# Checks of the project's own files. Exit status 0: fine; 1: found something, which is printed; 77: cannot tell here.
#
#   check.sh format [--fix]   our C++ is as clang-format 14 writes it
#   check.sh tidy [JOBS]      clang-tidy has nothing to say; needs build-clang/compile_commands.json
#   check.sh paths            no file names a path of one machine
#   check.sh layout           the top level is what the design allows
#   check.sh printing         no library prints
#   check.sh help             "make help" and the README name every target
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# The project's files, committed or about to be. Without git (an unpacked archive, another owner) all files but the
# built ones.
project_files() {
  git ls-files --cached --others --exclude-standard 2>/dev/null |
    while IFS= read -r file; do [ ! -f "$file" ] || printf '%s\n' "$file"; done | grep . && return
  find . -path './build*' -prune -o -path ./.git -prune -o -path ./results/runs -prune -o -name node_modules -prune -o \
    -type f -print | sed 's|^\./||'
}

sources() { project_files | grep -E '\.(cpp|hpp)$' | sort; }

# clang-format's output differs between versions, so one version decides.
clang_format_14() {
  local program
  for program in clang-format-14 clang-format; do
    if "$program" --version 2>/dev/null | grep -qE 'version 14\.'; then
      command -v "$program"
      return
    fi
  done
  echo "skipped: clang-format 14 is missing ('make deps' installs it on Debian 12): formatting is not checked." >&2
  exit 77
}

check_format() {
  local program found
  program=$(clang_format_14)
  if [ "${1:-}" = --fix ]; then
    sources | xargs "$program" -i
    return
  fi
  if ! found=$(sources | xargs "$program" --dry-run -Werror 2>&1); then
    sed -n 's/^\([^ :]*:[0-9]*\):[0-9]*: error: .*/\1/p' <<<"$found" | sort -u -V >&2
    echo "error: not formatted; 'make format' puts it right." >&2
    return 1
  fi
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

allowed_at_top="CMakeLists.txt core adapters benchmarks datasets results plots tests docker-compose.yml README.md
  Makefile CMakePresets.json cmake LICENSE CHANGELOG.md"

check_layout() {
  local name status=0
  for name in $(project_files | cut -d / -f 1 | sort -u); do
    case "$name" in .*) continue ;; esac
    grep -qwF -- "$name" <<<"$allowed_at_top" || { echo "error: '$name' does not belong at the top level." >&2; status=1; }
  done
  for name in $allowed_at_top; do
    [ -e "$name" ] || { echo "error: '$name' is missing at the top level." >&2; status=1; }
  done
  return $status
}

# A library gets a stream or a callback from who calls it. Programs print: the command line and what has a main().
check_printing() {
  local found
  found=$(sources | grep -E '^(core|datasets|adapters|benchmarks)/' | grep -v '^benchmarks/cli/' |
    xargs grep -L '^int main(' | xargs grep -nE 'std::(cout|cerr|clog|printf|puts)\b' || true)
  [ -z "$found" ] || { printf 'error: a library prints:\n%s\n' "$found" >&2; return 1; }
}

check_help() {
  local targets listing target status=0
  targets=$(sed -n 's/^\.PHONY: //p' Makefile)
  [ -n "$targets" ] || { echo "error: no .PHONY line found in the Makefile." >&2; return 1; }
  listing=$(make --no-print-directory help)
  for target in $targets; do
    grep -qE "^  make $target +[a-z]" <<<"$listing" || { echo "error: 'make help' does not list $target." >&2; status=1; }
    grep -qF "make $target\`" README.md || { echo "error: README.md does not name \`make $target\`." >&2; status=1; }
  done
  return $status
}

case "${1:-}" in
  format | tidy | paths | layout | printing | help) "check_$1" "${@:2}" ;;
  *)
    sed -n '2,10s/^# \{0,1\}//p' "$0" >&2
    exit 2
    ;;
esac
