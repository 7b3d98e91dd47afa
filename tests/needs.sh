#!/usr/bin/env bash
# Runs a test that needs more than this project's own programs. When something is missing it says what and ends with 77,
# by which ctest knows a test that was skipped.
#
#   needs.sh NEED... -- COMMAND...
#
# A NEED is a program, a file or a folder; "A|B", any one of them; "PYTHON:MODULE", a module of that Python.
set -euo pipefail

skip() {
  echo "skipped: $1 is missing; 'make test' installs it on Debian and Ubuntu."
  exit 77
}

is_there() {
  local names name
  IFS='|' read -ra names <<<"$1"
  for name in "${names[@]}"; do
    [ ! -e "$name" ] && ! command -v "$name" >/dev/null || return 0
  done
  return 1
}

while [ $# -gt 0 ] && [ "$1" != -- ]; do
  program=${1%%:*}
  is_there "$program" || skip "${program//|/ or }"
  [ "$program" = "$1" ] || "$program" -c "import ${1#*:}" 2>/dev/null || skip "the module ${1#*:} of $program"
  shift
done
[ $# -gt 1 ] || { sed -n '2,7s/^# \{0,1\}//p' "$0" >&2; exit 2; }
shift
exec "$@"
