#!/usr/bin/env bash
# Tests what plots/ makes for a browser in one; ctest runs it.
#
#   run.sh PART HULLBENCH WRITE_INVENTED_REPORT OUTPUT   report, comparison or site; these programs of the build; the folder for
#                                                        the page and its screenshots
set -euo pipefail

[ $# -eq 4 ] || { sed -n '2,5s/^# \{0,1\}//p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..

command -v node >/dev/null || { echo "error: node is missing: 'make deps' installs it on Debian and Ubuntu." >&2; exit 1; }
for folder in tests/report plots; do
  [ -d "$root/$folder/node_modules" ] ||
    { echo "error: the npm packages of $folder are missing: 'cmake/install-npm.sh $folder' installs them." >&2; exit 1; }
done
# The Python of the distribution, if there is one: another may come first.
python=/usr/bin/python3
[ -x "$python" ] || python=python3
HULLBENCH=$2 WRITE_INVENTED_REPORT=$3 OUTPUT=$4 PYTHON=$python \
  exec node --test --test-reporter=spec "$here/$1.test.mjs"
