#!/usr/bin/env bash
# Proves from nothing that the README's commands work: in a bare Debian 12 root made by debootstrap, with nothing but
# git and make added, a clone of HEAD runs "make bench-quick" and "make test", once as root and once as a plain user
# with sudo; and no database server is left running or enabled.
#
#   run.sh [root|user]     both when none is named
#
# Needs root on a Debian host. TMPDIR (default /var/tmp) holds the roots while it runs; FRESH_CACHE, a folder, keeps
# the pristine root for the next time. Logs stay in build/fresh.
set -euo pipefail
export LC_ALL=C

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
checkout=$(cd "$here/../.." && pwd)
logs="$checkout/build/fresh"
suite=bookworm
disk_needed_gb=10
variants=("${@:-root user}")
[ $# -gt 0 ] || variants=(root user)

passed=0
failed=0
child=""
work=""

fail() {
  printf 'error: %s\n' "$*" >&2
  exit 2
}

clean_up() {
  local status=$?
  trap '' INT TERM HUP
  # The namespace dies with its first process, and its mounts and other processes with it, but not at once.
  if [ -n "$child" ]; then
    kill -KILL "$child" 2>/dev/null || true
    wait "$child" 2>/dev/null || true
  fi
  if [ -n "$work" ]; then
    rm -rf --one-file-system -- "$work" 2>/dev/null || { sleep 2; rm -rf --one-file-system -- "$work"; }
  fi
  exit "$status"
}

# isolated COMMAND...: runs COMMAND in mount and process namespaces of its own; none of its mounts and processes
# outlives it.
isolated() {
  unshare --mount --propagation private --pid --mount-proc --fork --kill-child "$@" </dev/null &
  child=$!
  local status=0
  wait "$child" || status=$?
  child=""
  return $status
}

# in_root ROOT COMMAND...: runs COMMAND as root inside ROOT.
in_root() { isolated bash "$here/enter.sh" "$@"; }

# step NAME COMMAND...: one line of the result; the command's output goes to a log, whose end is shown on failure.
# "set -e" does not hold in what it calls, so those functions say "|| return" themselves.
step() {
  local name=$1 log start=$SECONDS status=0
  shift
  log="$logs/$(tr -c 'a-z0-9\n' '-' <<<"$name").log"
  printf '==> %s ...\n' "$name"
  "$@" >"$log" 2>&1 || status=$?
  if [ $status -eq 0 ]; then
    passed=$((passed + 1))
    printf 'PASS  %s (%d s)\n' "$name" $((SECONDS - start))
  else
    failed=$((failed + 1))
    tail -n 40 "$log" | sed 's/^/      /'
    printf 'FAIL  %s (%d s, exit status %d): %s\n' "$name" $((SECONDS - start)) $status "$log"
  fi
  return $status
}

# ---- the pristine root ------------------------------------------------------------------------------------

# Debian's own sources of the host as "uri suite signed-by"; other vendors' stay out, a fresh machine has none.
host_sources() {
  # The $(...) belong to apt-get.
  # shellcheck disable=SC2016
  apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT) $(SIGNED_BY)' 'Created-By: Packages' |
    awk -v suite="^$1(-updates|-security)?\$" '$2 ~ suite && $3 == "main" { print $1, $2, $4 }' | sort -u
}

make_base() {
  local base=$1 host_suite mirror include=()
  # shellcheck source=/dev/null
  host_suite=$(. /etc/os-release && printf '%s' "${VERSION_CODENAME:-}")
  mirror=$(host_sources "$host_suite" | awk -v suite="$host_suite" '$2 == suite { print $1; exit }')
  [ -n "$mirror" ] || { echo "error: the apt sources of this host name no mirror for '$host_suite main'."; return 1; }
  [[ "$mirror" != https:* ]] || include=(--include=ca-certificates)
  isolated debootstrap --variant=minbase "${include[@]}" "$suite" "$base" "$mirror" ||
    { cat "$base/debootstrap/debootstrap.log"; return 1; }
  configure_apt "$base" "$mirror" "$host_suite"
}

# apt in the root as on the host: sources and their keys, options, proxies, names.
configure_apt() {
  local base=$1 mirror=$2 host_suite=$3 uri release key file
  if [ "$host_suite" = "$suite" ]; then
    while read -r uri release key; do
      if [ -f "$key" ]; then
        install -D -m 644 "$key" "$base$key" || return
        printf 'deb [signed-by=%s] %s %s main\n' "$key" "$uri" "$release"
      else
        printf 'deb %s %s main\n' "$uri" "$release"
      fi
    done < <(host_sources "$suite") >"$base/etc/apt/sources.list"
  else
    printf 'deb %s %s main\n' "$mirror" "$suite" >"$base/etc/apt/sources.list"
  fi
  cp -a /etc/apt/trusted.gpg.d/. "$base/etc/apt/trusted.gpg.d/"
  for file in /etc/apt/apt.conf /etc/apt/apt.conf.d/* /etc/apt/auth.conf /etc/apt/auth.conf.d/*; do
    # Hooks call programs of the host that a bare root does not have.
    [ -f "$file" ] || continue
    grep -qE 'Pre-Install-Pkgs|Pre-Invoke|Post-Invoke' "$file" || cp -a --parents "$file" "$base"
  done
  for file in http_proxy https_proxy; do
    [ -z "${!file:-}" ] || printf 'Acquire::%s::Proxy "%s";\n' "${file%_proxy}" "${!file}"
  done >"$base/etc/apt/apt.conf.d/95proxy-of-the-host"
  # A root that is thrown away needs no fsync after every file.
  printf 'force-unsafe-io\n' >"$base/etc/dpkg/dpkg.cfg.d/throw-away"
  cp -L /etc/resolv.conf /etc/hosts "$base/etc/"
  if [ -f /etc/ssl/certs/ca-certificates.crt ] && grep -q 'https:' "$base/etc/apt/sources.list"; then
    install -D -m 644 /etc/ssl/certs/ca-certificates.crt "$base/etc/ssl/certs/ca-certificates.crt"
  fi
  in_root "$base" apt-get -q update || return
  in_root "$base" env DEBIAN_FRONTEND=noninteractive apt-get -q install -y --no-install-recommends git make
}

# ---- one variant: as root, or as a plain user with sudo ---------------------------------------------------

prepare() {
  local root=$1 user=$2
  cp "$work/checkout.bundle" "$root/checkout.bundle"
  chmod 644 "$root/checkout.bundle"
  if [ "$user" != root ]; then
    in_root "$root" env DEBIAN_FRONTEND=noninteractive apt-get -q install -y --no-install-recommends sudo || return
    in_root "$root" useradd --create-home --shell /bin/bash "$user" || return
    printf '%s ALL=(ALL) NOPASSWD: ALL\n' "$user" >"$root/etc/sudoers.d/$user"
    # A machine whose package lists were never fetched, as container images are.
    find "$root/var/lib/apt/lists" -type f -delete
  fi
  in_root "$root" su - "$user" -c 'git clone --quiet /checkout.bundle hullbench'
}

# as_reader ROOT USER COMMAND: what a reader of the README types in the clone. Fails too when a database server
# outlives the command.
as_reader() {
  # Expanded inside the root, where the namespace shows only that root's processes.
  # shellcheck disable=SC2016
  in_root "$1" bash -c '
    su - "$0" -c "cd hullbench && $1"
    status=$?
    sleep 1
    servers=$(grep -lsxE "postgres|postmaster" /proc/[0-9]*/comm)
    [ -z "$servers" ] || { echo "error: a database server is still running: $servers"; exit 90; }
    exit $status' "$2" "$3"
}

# Nothing of PostgreSQL is set up or enabled, and none of the means to that end is left behind.
nothing_enabled() {
  local found
  found=$(find "$1"/etc/postgresql/*/* "$1"/var/lib/postgresql/*/* -maxdepth 0 2>/dev/null
    find "$1/etc/systemd/system" -path '*.wants/*postgresql*' 2>/dev/null
    find "$1"/etc/rc[S2-5].d -name 'S*postgresql*' 2>/dev/null
    ls "$1"/usr/sbin/policy-rc.d* "$1"/etc/postgresql-common/createcluster.d/*.conf 2>/dev/null) || true
  [ -z "$found" ] || { printf 'error: left behind:\n%s\n' "$found"; return 1; }
  compgen -G "$1/usr/lib/postgresql/*/bin/initdb" >/dev/null || { echo "error: PostgreSQL was not installed, so this proves nothing."; return 1; }
}

run_variant() {
  local variant=$1 root="$work/$1" user=root command
  [ "$variant" = root ] || user=visitor
  cp -a "$work/base" "$root"
  step "$variant: clone" prepare "$root" "$user" || return 0
  for command in "make bench-quick" "make test"; do
    step "$variant: $command" as_reader "$root" "$user" "$command" || true
    step "$variant: no server enabled after $command" nothing_enabled "$root" || true
  done
  step "$variant: the work tree is unchanged" as_reader "$root" "$user" '! git status --porcelain | grep .' || true
  rm -rf --one-file-system -- "$root"
}

# ---- the driver -------------------------------------------------------------------------------------------

[ "$(id -u)" -eq 0 ] || fail "debootstrap and chroot need root: run it as root."
command -v apt-get >/dev/null || fail "this needs a Debian host: there is no apt-get."
for variant in "${variants[@]}"; do
  [[ "$variant" =~ ^(root|user)$ ]] || fail "'$variant' is neither root nor user."
done
revision=$(git -C "$checkout" rev-parse --short HEAD 2>/dev/null) || fail "$checkout is no git checkout with a commit."
parent=${TMPDIR:-/var/tmp}
free_gb=$(df --output=avail -BG "$parent" | tail -n 1 | tr -dc 0-9)
[ "$free_gb" -ge $disk_needed_gb ] || fail "$parent has $free_gb GB free, $disk_needed_gb are needed: set TMPDIR to another place."
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP
work=$(mktemp -d "$parent/hullbench-fresh.XXXXXX")
chmod 755 "$work"
mkdir -p "$logs"

if ! command -v debootstrap >/dev/null; then
  echo "==> installing debootstrap"
  DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 install -y --no-install-recommends \
    debootstrap debian-archive-keyring gpgv wget >"$logs/debootstrap-install.log" 2>&1 ||
    fail "debootstrap could not be installed: see $logs/debootstrap-install.log"
fi

echo "==> proving revision $revision from nothing in $work"
[ -z "$(git -C "$checkout" status --porcelain)" ] || echo "note: the work tree has changes that are not committed; HEAD is what is proven."
branch=$(git -C "$checkout" symbolic-ref -q HEAD || true)
git -C "$checkout" bundle create --quiet "$work/checkout.bundle" HEAD ${branch:+"$branch"}

if [ -n "${FRESH_CACHE:-}" ] && [ -d "$FRESH_CACHE/$suite" ]; then
  echo "==> using the pristine root in $FRESH_CACHE"
  cp -a "$FRESH_CACHE/$suite" "$work/base"
else
  step "bare Debian 12 root with git and make" make_base "$work/base" || exit 1
  if [ -n "${FRESH_CACHE:-}" ]; then
    mkdir -p "$FRESH_CACHE"
    cp -a "$work/base" "$FRESH_CACHE/$suite.partial"
    mv "$FRESH_CACHE/$suite.partial" "$FRESH_CACHE/$suite"
  fi
fi

for variant in "${variants[@]}"; do
  run_variant "$variant"
done
echo "logs: $logs"
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
