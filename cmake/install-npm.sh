#!/usr/bin/env bash
# install-npm.sh FOLDER: installs what FOLDER/package-lock.json names into FOLDER/node_modules, in these versions; does
# nothing when it is there.
set -euo pipefail

[ $# -eq 1 ] || { sed -n '2,3s/^# \{0,1\}//p' "$0" >&2; exit 2; }
cd "$1"

[ ! node_modules/.package-lock.json -nt package-lock.json ] || exit 0
command -v npm >/dev/null || { echo "error: npm is missing: 'make deps' installs it on Debian and Ubuntu." >&2; exit 2; }
echo "==> npm ci in $1"
npm ci --no-audit --no-fund --ignore-scripts --loglevel=error >/dev/null ||
  { echo "error: npm could not install the packages: check the network and npm's registry." >&2; exit 1; }
