#!/usr/bin/env bash
# The paper's PostGIS for the method postgis_legacy: Debian 11's PostgreSQL 13 with PostGIS 3.1, unpacked into a folder.
#
#   install-legacy.sh            get it, if it is not there
#   install-legacy.sh --remove   remove it
#
# The folder is /var/cache/hullbench/postgis-legacy for root, as the server then runs as another user who cannot read
# root's home, and ~/.cache/hullbench/postgis-legacy (XDG_CACHE_HOME) for everybody else. The adapter looks there.
#
# Needs apt-get and Debian's archive keys, but neither root nor a chroot: apt fetches and checks the packages in a state
# of its own, dpkg-deb unpacks them. The programs start through the loader and the libraries in the folder, so nothing
# of it meets the system's libraries, and nothing is registered anywhere.
set -euo pipefail
export LC_ALL=C
umask 022

release=bullseye
postgres=13
packages=("postgresql-$postgres" "postgresql-$postgres-postgis-3")
# What the packages ask for but these programs never load, which is two thirds of it all: said to be installed already.
not_needed=(debconf dpkg libgdal28 libllvm11 libsfcgal1 locales perl "postgresql-client-$postgres" postgresql-common
  proj-data ssl-cert tzdata)
mirror=http://deb.debian.org/debian
archive=http://archive.debian.org/debian

if [ "$(id -u)" -eq 0 ]; then
  folder=/var/cache/hullbench/postgis-legacy
else
  folder=${XDG_CACHE_HOME:-${HOME:?}/.cache}/hullbench/postgis-legacy
fi

say() { printf '==> %s\n' "$*"; }
fail() {
  local status=$1
  shift
  printf 'error: %s\n' "$*" >&2
  exit "$status"
}

# apt in the state of its own. The machine's own settings (proxies, passwords) hold, but not its hooks.
own_apt() {
  local command=$1
  shift
  "$command" -q -c "$work/apt.conf" "$@"
}

# configure_apt URI: makes that state, for the release in URI alone.
configure_apt() {
  local package
  rm -rf "$work/state" "$work/cache"
  mkdir -p "$work/state/lists/partial" "$work/cache/archives/partial"
  printf 'deb [signed-by=%s] %s %s main\n' "$keys" "$1" "$release" >"$work/sources.list"
  for package in "${not_needed[@]}"; do
    printf 'Package: %s\nStatus: install ok installed\nVersion: 99:1\nArchitecture: %s\nMulti-Arch: allowed\n' \
      "$package" "$architecture"
    printf 'Maintainer: nobody\nDescription: not needed\n\n'
  done >"$work/state/status"
  cat >"$work/apt.conf" <<CONF
Dir::State "$work/state";
Dir::State::status "$work/state/status";
Dir::Cache "$work/cache";
Dir::Etc::SourceList "$work/sources.list";
Dir::Etc::SourceParts "/dev/null";
Dir::Etc::Preferences "/dev/null";
Dir::Etc::PreferencesParts "/dev/null";
Acquire::Languages "none";
Acquire::Retries "3";
APT::Update::Error-Mode "any";
APT::Install-Recommends "false";
#clear APT::Update::Pre-Invoke;
#clear APT::Update::Post-Invoke;
#clear APT::Update::Post-Invoke-Success;
CONF
}

# Debian's mirrors in the machine's own apt sources.
mirrors_here() {
  # The $(...) belong to apt-get.
  # shellcheck disable=SC2016
  apt-get indextargets --format '$(ORIGIN) $(COMPONENT) $(REPO_URI)' 'Created-By: Packages' 2>/dev/null |
    awk '$1 == "Debian" && $2 == "main" && $3 !~ /security/ { sub("/$", "", $3); print $3 }' | sort -u
}

download() {
  local uri
  while read -r uri; do
    say "fetching Debian's $release packages from $uri"
    configure_apt "$uri"
    if own_apt apt-get update >"$work/log" 2>&1 &&
      own_apt apt-get install -y --download-only "${packages[@]}" >>"$work/log" 2>&1; then
      return
    fi
    cat "$work/log" >>"$work/failures"
  done < <({ mirrors_here; printf '%s\n' "$mirror" "$archive"; } | awk '!seen[$0]++')
  grep -E '^[EW]:' "$work/failures" | sort -u | tail -n 20 >&2 || true
  fail 1 "apt could not fetch ${packages[*]} of Debian's $release: check the network and apt's proxy."
}

# script NAME LINE...: a shell script in the folder's bin that knows where it is, however it is called.
script() {
  local name=$1
  shift
  # The variables belong to the script.
  # shellcheck disable=SC2016
  printf '%s\n' '#!/bin/sh' 'bin=$(cd "${0%/*}" && pwd -P)' 'usr=${bin%/lib/postgresql/*}' 'root=${usr%/usr}' "$@" \
    >"$bin/$name"
  chmod 755 "$bin/$name"
}

# start_program NAME: has NAME start through the folder's own loader. It stays in that folder under another name, by
# whose place PostgreSQL finds all its files.
start_program() {
  mv "$bin/$1" "$bin/$1.program"
  script "$1" "exec \"\$root$loader\" --library-path \"\$root$libraries:\$usr$libraries\" \"\$bin/$1.program\" \"\$@\""
}

# Every library that FILE needs must be in the folder: the system's are of another age.
check_libraries() {
  local strange
  strange=$("$work/root$loader" --library-path "$work/root$libraries:$work/root/usr$libraries" --list "$1" |
    awk -v root="$work/root/" '/=>/ { name = $1; sub(/^.*=> /, ""); if (index($0, root) != 1) print name }')
  [ -z "$strange" ] || fail 1 "the packages lack libraries that $(basename "$1") needs: ${strange//$'\n'/ }."
}

unpack() {
  local package share=$work/root/usr/share/postgresql/$postgres file
  for package in "$work"/cache/archives/*.deb; do dpkg-deb -x "$package" "$work/root"; done
  bin=$work/root/usr/lib/postgresql/$postgres/bin
  # /lib/x86_64-linux-gnu/ld-2.31.so
  loader=/$(cd "$work/root" && echo lib/*-linux-gnu/ld-[0-9]*.so)
  libraries=${loader%/*}
  [ -x "$work/root$loader" ] || fail 1 "the packages hold no loader at $loader."
  for file in "$bin/postgres" "$bin/initdb" "$bin/../lib/postgis-3.so"; do check_libraries "$file"; done
  start_program postgres
  start_program initdb
  # shellcheck disable=SC2016
  script pg_config 'case $1 in' '  --bindir) echo "$bin" ;;' \
    "  --sharedir) echo \"\$usr/share/postgresql/$postgres\" ;;" \
    '  *) echo "pg_config: only --bindir and --sharedir are known here" >&2; exit 1 ;;' 'esac'
  # Done by the package's scripts otherwise.
  [ -e "$share/extension/postgis.control" ] || ln -s postgis-3.control "$share/extension/postgis.control"
  ln -s "usr/lib/postgresql/$postgres/bin" "$work/root/bin"
}

is_there() { "$folder/bin/postgres" --version >/dev/null 2>&1; }

if [ "${1:-}" = --remove ]; then
  rm -rf "$folder"
  rmdir "$(dirname "$folder")" 2>/dev/null || true
  say "removed $folder"
  exit 0
fi
[ $# -eq 0 ] || { sed -n '2,5s/^# \{0,1\}//p' "$0" >&2; exit 2; }

if is_there; then exit 0; fi
for tool in apt-get dpkg-deb; do
  command -v "$tool" >/dev/null ||
    fail 2 "$tool is missing, and the paper's PostGIS comes from Debian's packages: take 'docker-compose up -d" \
      "postgis-legacy' instead."
done
for keys in /usr/share/keyrings/debian-archive-keyring.gpg /usr/share/keyrings/debian-archive-keyring.pgp none; do
  [ ! -f "$keys" ] || break
done
[ "$keys" != none ] || fail 2 "Debian's archive keys are missing: 'sudo apt-get install debian-archive-keyring'."
architecture=$(dpkg --print-architecture)

mkdir -p "$(dirname "$folder")"
# Beside the folder, so that it appears at once and whole.
work=$(mktemp -d "$folder.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP
# Not mktemp's 700: root's apt downloads as the user _apt.
chmod 755 "$work"

download
unpack
"$work/root/bin/postgres" --version >/dev/null || fail 1 "the unpacked PostgreSQL does not start."
rm -rf "$folder"
mv "$work/root" "$folder"
say "PostGIS for postgis_legacy is in $folder"
