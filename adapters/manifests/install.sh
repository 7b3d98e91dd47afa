#!/usr/bin/env bash
# Installs the JavaScript methods into node_modules, in the versions of package-lock.json; does nothing when they are
# there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

[ ! node_modules/.package-lock.json -nt package-lock.json ] || exit 0
command -v npm >/dev/null || { echo "error: npm is missing: 'make deps-extra' installs it on Debian and Ubuntu." >&2; exit 2; }
echo "==> npm ci"
npm ci --no-audit --no-fund --ignore-scripts --loglevel=error >/dev/null ||
  { echo "error: npm could not install the packages: check the network and npm's registry." >&2; exit 1; }
