#!/usr/bin/env bash
# Installs what is missing of the packages in cmake/packages.txt, with apt-get on Debian and Ubuntu.
#
#   install-packages.sh SECTION...           install what is missing
#   install-packages.sh --check SECTION...   only say what is missing; exit status 1 if anything is
#
# When nothing is missing it calls neither apt nor sudo. On other distributions it prints what to install and
# exits with 2. A server that comes with the packages (PostgreSQL, Slurm) is left stopped and disabled; one that was
# there before is not touched.
set -euo pipefail
export LC_ALL=C

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
list="$here/packages.txt"
cmake_needed=3.25

say() { printf '==> %s\n' "$*"; }
fail() {
  local status=$1
  shift
  printf 'error: %s\n' "$*" >&2
  exit "$status"
}

# Lines "name<tab>what it is<tab>command" of the sections given; the command is empty for most. The name of a package
# that a distribution need not offer ends with "?".
wanted() {
  awk -v sections=" $* " '
    /^\[/ { name = substr($0, 2, index($0, "]") - 2); inside = index(sections, " " name " "); next }
    inside && /^[a-z0-9]/ { split($1, package, "="); sub(/^[^#]*# */, ""); print package[1] "\t" $0 "\t" package[2] }' "$list"
}

# The names of the packages wanted, without those whose command is there from somewhere else.
wanted_names() {
  local package command
  wanted "$@" | while IFS=$'\t' read -r package _ command; do
    { [ -n "$command" ] && command -v "$command" >/dev/null; } || printf '%s\n' "$package"
  done
}

# Those of the packages given that are not installed.
missing_of() {
  local installed package
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${@%\?}" 2>/dev/null | awk '$2 == "installed" { print $1 }') || true
  printf '%s\n' "$@" | sort -u | while IFS= read -r package; do
    grep -qxF -- "${package%\?}" <<<"$installed" || printf '%s\n' "$package"
  done
}

is_installed() { [ -z "$(missing_of "$1")" ]; }

at_least() { [ "$(printf '%s\n%s\n' "$1" "$2" | sort -V | head -n 1)" = "$2" ]; }

# shellcheck source=/dev/null
distribution() { (. /etc/os-release 2>/dev/null && printf '%s' "${PRETTY_NAME:-this system}") || printf 'this system'; }

check_cmake() {
  local found
  found=$(cmake --version 2>/dev/null | awk 'NR == 1 { print $3 }') || true
  [ -z "$found" ] || at_least "$found" "$cmake_needed" ||
    fail 2 "CMake $found ($(command -v cmake)) is older than $cmake_needed: use Debian 12, Ubuntu 24.04 or newer, or put a newer CMake first in PATH (g++ 12 and nlohmann-json 3.11 are needed too)."
}

list_for_other_distributions() {
  printf 'error: %s has no apt-get: install these by hand (Debian names), then add SKIP_DEPS=1 to the make command.\n\n' \
    "$(distribution)"
  wanted "$@" | awk -F '\t' '{ sub(/\?$/, "", $1) } !seen[$1]++ { printf "  %-22s %s\n", $1, $2 }'
} >&2

# ---- the part that runs as root ---------------------------------------------------------------------------

policy=/usr/sbin/policy-rc.d
policy_saved=/usr/sbin/policy-rc.d.before-hullbench
cluster_setting=/etc/postgresql-common/createcluster.d/zz-hullbench.conf
made_directories=()
postgres_guarded=no
new_services=()
clusters() { ls -d /etc/postgresql/*/* 2>/dev/null || true; }

# Debian's PostgreSQL packages create a cluster "main", start it and enable it at boot. The harness needs only the
# programs: no cluster is to be made.
guard_postgres() {
  postgres_guarded=yes
  local directory
  for directory in /etc/postgresql-common "$(dirname "$cluster_setting")"; do
    [ -d "$directory" ] || { mkdir "$directory" && made_directories=("$directory" "${made_directories[@]}"); }
  done
  printf 'create_main_cluster = false\n' >"$cluster_setting"
}

# guard_services PACKAGE...: no service that comes new with the packages may start.
guard_services() {
  local package
  for package in "$@"; do
    case $package in
      postgresql*) is_installed postgresql-common || new_services+=(postgresql) ;;
      munge | slurmctld | slurmd) new_services+=("$package") ;;
    esac
  done
  [ ${#new_services[@]} -gt 0 ] || return 0
  # Ours, which names the saved one, is there already only when an earlier installation was killed half-way.
  [ ! -e "$policy" ] || grep -qF "$policy_saved" "$policy" || mv "$policy" "$policy_saved"
  cat >"$policy" <<POLICY
#!/bin/sh
service=\${1%%@*}
case " ${new_services[*]} " in *" \${service%.service} "*) exit 101 ;; esac
[ ! -x "$policy_saved" ] || exec "$policy_saved" "\$@"
exit 0
POLICY
  chmod 755 "$policy"
}

unguard_postgres() {
  [ "$postgres_guarded" = yes ] || return 0
  rm -f "$cluster_setting"
  # Empty unless the package has taken them over meanwhile.
  [ ${#made_directories[@]} -eq 0 ] || rmdir "${made_directories[@]}" 2>/dev/null || true
}

unguard_services() {
  [ ${#new_services[@]} -gt 0 ] || return 0
  rm -f "$policy"
  [ ! -e "$policy_saved" ] || mv "$policy_saved" "$policy"
  local service
  for service in "${new_services[@]}"; do
    [ -e "/lib/systemd/system/$service.service" ] || [ -e "/etc/init.d/$service" ] || continue
    # Either may be absent: a machine has systemd, System V scripts or, in a container, neither.
    deb-systemd-helper disable "$service.service" >/dev/null 2>&1 || true
    update-rc.d "$service" disable >/dev/null 2>&1 || true
  done
}

# A setting that was edited stays as it is; dpkg would ask, and nobody would see the question.
apt() {
  DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 \
    -o DPkg::Options::=--force-confdef -o DPkg::Options::=--force-confold "$@"
}

# What apt-get update could not fetch, of which its exit status says nothing.
unfetched=""

# Another apt may hold the lock on the lists, for which apt-get itself does not wait.
update_lists() {
  say "apt-get update"
  local attempt output
  for attempt in $(seq 30); do
    output=$(apt update 2>&1) && { unfetched=$(grep -E '^[EW]: Failed to fetch' <<<"$output" || true); return; }
    grep -q 'Could not get lock' <<<"$output" || break
    [ "$attempt" -gt 1 ] || say "waiting for another apt to finish"
    sleep 10
  done
  printf '%s\n' "$output" >&2
  fail 1 "apt-get update failed: check the network and the apt sources."
}

without_candidate() {
  apt-cache policy "$@" | awk '/^[^ ].*:$/ { name = substr($1, 1, length($1) - 1) }
    $1 == "Candidate:" && $2 != "(none)" { print name }' | sort -u |
    comm -13 - <(printf '%s\n' "$@" | sort -u)
}

# Those of the packages given that must or can be installed: not those with a "?" that the distribution does not offer.
obtainable() {
  [ $# -eq 0 ] || comm -23 <(printf '%s\n' "$@" | sort -u) <(without_candidate "${@%\?}" | sed 's/$/?/' | sort -u)
}

install_as_root() {
  local unknown updated=no cmake_candidate clusters_before names
  if [ -n "$(without_candidate "${@%\?}")" ]; then
    update_lists
    updated=yes
  fi
  mapfile -t names < <(obtainable "$@")
  [ ${#names[@]} -gt 0 ] || return 0
  set -- "${names[@]%\?}"
  if [ $updated = yes ]; then
    unknown=$(without_candidate "$@" | paste -sd ' ')
    [ -z "$unknown" ] || [ -z "$unfetched" ] || {
      printf '%s\n' "$unfetched" >&2
      fail 1 "apt-get update failed: check the network and the apt sources."
    }
    [ -z "$unknown" ] ||
      fail 2 "$(distribution) offers no package $unknown: Debian 12, Ubuntu 24.04 (with 'universe') or newer is needed."
  fi
  if [[ " $* " == *' cmake '* ]]; then
    cmake_candidate=$(apt-cache policy cmake | awk '$1 == "Candidate:" { print $2 }')
    at_least "${cmake_candidate#*:}" "$cmake_needed" ||
      fail 2 "$(distribution) has CMake $cmake_candidate, older than $cmake_needed: Debian 12, Ubuntu 24.04 or newer is needed."
  fi
  clusters_before=$(clusters)
  [[ " $* " != *' postgresql'* ]] || guard_postgres
  guard_services "$@"
  say "apt-get install $*"
  if ! apt install -y --no-install-recommends "$@" >"$log" 2>&1; then
    # The usual reason: lists so old that a package has left the mirror.
    if [ "$updated" = no ]; then
      update_lists
      apt install -y --no-install-recommends "$@" >"$log" 2>&1 || install_failed
    else
      install_failed
    fi
  fi
  [ "$(clusters)" = "$clusters_before" ] ||
    fail 1 "installing PostgreSQL made a database cluster in /etc/postgresql although it was told not to: look at 'pg_lsclusters' and drop it with 'pg_dropcluster --stop'."
}

install_failed() {
  tail -n 25 "$log" >&2
  fail 1 "apt-get install failed: see above."
}

if [ "${1:-}" = --as-root ]; then
  shift
  umask 022
  log=$(mktemp)
  trap 'unguard_postgres; unguard_services; rm -f "$log"' EXIT
  trap 'exit 130' INT
  trap 'exit 143' TERM HUP
  install_as_root "$@"
  exit 0
fi

# ---- what the user calls ----------------------------------------------------------------------------------

check_only=no
if [ "${1:-}" = --check ]; then
  check_only=yes
  shift
fi
[ $# -gt 0 ] || fail 2 "name at least one section of $list."
for section in "$@"; do
  grep -qxF "[$section]" "$list" || fail 2 "$list has no section '$section'."
done

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  list_for_other_distributions "$@"
  exit 2
fi

check_cmake
mapfile -t packages < <(wanted_names "$@")
[ ${#packages[@]} -gt 0 ] || exit 0
mapfile -t missing < <(missing_of "${packages[@]}")
if compgen -G '/var/lib/apt/lists/*_Packages*' >/dev/null; then
  mapfile -t missing < <(obtainable "${missing[@]}")
elif ! printf '%s\n' "${missing[@]}" | grep -qv '?$'; then
  # Without lists nobody knows what the distribution offers, and nothing of this has to be there.
  missing=()
fi
[ ${#missing[@]} -gt 0 ] || exit 0

if [ "$check_only" = yes ]; then
  printf 'missing: %s\n' "${missing[*]%\?}" >&2
  exit 1
fi

say "${#missing[@]} of ${#packages[@]} packages are missing and will be installed (some minutes the first time)"
if [ "$(id -u)" -eq 0 ]; then
  bash "$here/install-packages.sh" --as-root "${missing[@]}"
elif command -v sudo >/dev/null; then
  say "installing needs root: calling sudo"
  sudo true || fail 2 "sudo does not make you root: run 'apt-get install ${missing[*]%\?}' as root."
  sudo bash "$here/install-packages.sh" --as-root "${missing[@]}"
else
  fail 2 "installing needs root and there is no sudo: run 'apt-get install ${missing[*]%\?}' as root."
fi
check_cmake
mapfile -t missing < <(missing_of "${packages[@]}")
mapfile -t needed < <(obtainable "${missing[@]}")
[ ${#needed[@]} -eq 0 ] || fail 1 "still not installed: ${needed[*]%\?}."
[ ${#missing[@]} -eq 0 ] || say "$(distribution) does not offer ${missing[*]%\?}: what needs it is skipped"
say "all packages are installed"
