#!/usr/bin/env bash
# Proves from nothing that the README's commands work: in bare Debian roots made by debootstrap, with nothing but git and
# make added, in a clone of HEAD.
#
#   run.sh [PROOF...]      odd, packages, root and user when none is named
#
#   first     the README's first command: "make bench" with its shortest table, as root (what CI proves)
#   root      "make bench-quick" and "make test" as root; no test is skipped, no database server left running or enabled
#   user      the same as a plain user with sudo
#   packages  "make package", and the packages installed and used in another root; PACKAGES=FOLDER takes those made already
#   odd       roots that have a part of what the tests need: nothing missing stops a configuration
#
# SUITE=trixie takes Debian 13 instead of 12. Needs root on a Debian host. TMPDIR (default /var/tmp) holds the roots while
# it runs; FRESH_CACHE, a folder, keeps the bare root for the next time. Logs stay in build/fresh.
set -euo pipefail
export LC_ALL=C

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
checkout=$(cd "$here/../.." && pwd)
logs="$checkout/build/fresh"
suite=${SUITE:-bookworm}
disk_needed_gb=10
proofs=("$@")
[ $# -gt 0 ] || proofs=(odd packages root user)

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

log_of() { printf '%s/%s.log' "$logs" "$(tr -c 'a-z0-9\n' '-' <<<"$1" | cut -c -100)"; }

# step NAME COMMAND...: one line of the result; the command's output goes to a log, whose end is shown on failure.
# "set -e" does not hold in what it calls, so those functions say "|| return" themselves.
step() {
  local name=$1 log start=$SECONDS status=0
  shift
  log=$(log_of "$name")
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

# The host's certificates, its own ones too: the bundle is made anew when ca-certificates is installed in the root.
copy_certificates() {
  local base=$1 bundle=/etc/ssl/certs/ca-certificates.crt
  [ ! -f $bundle ] || install -D -m 644 $bundle "$base$bundle" || return
  [ ! -d /usr/local/share/ca-certificates ] || cp -aL --parents /usr/local/share/ca-certificates "$base"
}

# npm in the root as on the host, for USER: where its registry is, proxies, certificates.
configure_npm() {
  local base=$1 user=$2 home file name
  file=$(npm config get globalconfig 2>/dev/null) || file=/etc/npmrc
  if [ -f "$file" ]; then
    # Where npm looks depends on who has packaged it.
    for name in /etc /usr/etc /usr/local/etc; do
      install -D -m 644 "$file" "$base$name/npmrc" || return
    done
  fi
  if [ -f "${npm_config_userconfig:-$HOME/.npmrc}" ]; then
    home=$(awk -F : -v user="$user" '$1 == user { print $6 }' "$base/etc/passwd")
    install -m 600 "${npm_config_userconfig:-$HOME/.npmrc}" "$base$home/.npmrc" || return
    in_root "$base" chown "$user:" "$home/.npmrc" || return
  fi
  # What "su -" gives to a login.
  for name in NODE_EXTRA_CA_CERTS http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
    [ -z "${!name:-}" ] || printf '%s="%s"\n' "$name" "${!name}"
  done >>"$base/etc/environment"
  if [ -f "${NODE_EXTRA_CA_CERTS:-}" ]; then
    install -D -m 644 "$NODE_EXTRA_CA_CERTS" "$base$NODE_EXTRA_CA_CERTS"
  fi
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
  copy_certificates "$base" || return
  in_root "$base" apt-get -q update || return
  in_root "$base" env DEBIAN_FRONTEND=noninteractive apt-get -q install -y --no-install-recommends git make
}

# ---- what is proven in a root --------------------------------------------------------------------------------

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
  configure_npm "$root" "$user" || return
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

# Everything that a test may need was installed: none was skipped. clang-format 14 and black 23 are Debian 12's.
none_skipped() {
  local found
  found=$(grep -E '^ +[0-9]+ skipped: ' "$1" | grep -vE '(clang-format 14|black 23) is missing' || true)
  grep -q '% tests passed' "$1" || { echo "error: $1 has no summary of ctest's."; return 1; }
  [ -z "$found" ] || { printf 'error: skipped where all was to be there:\n%s\n' "$found"; return 1; }
}

# new_root NAME USER: a copy of the bare root with the clone; its path is in "root".
new_root() {
  root="$work/$1"
  cp -a "$work/base" "$root"
  step "$1: clone" prepare "$root" "$2"
}

remove_root() { rm -rf --one-file-system -- "$root"; }

prove_first() {
  new_root first root || return 0
  step "first: make bench TABLE=alphabet" as_reader "$root" root "make bench TABLE=alphabet" || true
  step "first: no server enabled" nothing_enabled "$root" || true
  step "first: the work tree is unchanged" as_reader "$root" root 'said=$(git status --porcelain) && echo "$said" && test -z "$said"' || true
  remove_root
}

# prove_all NAME USER
prove_all() {
  local command
  new_root "$1" "$2" || return 0
  for command in "make bench-quick" "make test"; do
    step "$1: $command" as_reader "$root" "$2" "$command" || true
    step "$1: no server enabled after $command" nothing_enabled "$root" || true
  done
  step "$1: no test was skipped" none_skipped "$(log_of "$1: make test")" || true
  step "$1: the work tree is unchanged" as_reader "$root" "$2" 'said=$(git status --porcelain) && echo "$said" && test -z "$said"' || true
  remove_root
}

# ---- roots that have a part of what the tests need --------------------------------------------------------

packages_of() { awk -v name="[$1]" '/^\[/ { inside = $1 == name; next } inside && /^[a-z0-9]/ { sub("[?=].*", "", $1); print $1 }' "$checkout/cmake/packages.txt"; }

# odd_root NAME PACKAGE...: a root with what the build needs and these packages.
odd_root() {
  local name=$1
  shift
  new_root "$name" root || return
  # shellcheck disable=SC2046
  step "$name: packages" in_root "$root" env DEBIAN_FRONTEND=noninteractive \
    apt-get -q install -y --no-install-recommends $(packages_of build) "$@"
}

# configured NAME TEST...: with tests the build folder is configured, and these tests say what is missing.
configured() {
  local name=$1 tests
  shift
  tests=$(printf '|%s' "$@")
  # Those of the tests that need no program of ours, as nothing is compiled.
  step "$name: configured with tests; skipped: $*" as_reader "$root" root "
    cmake --preset release -DHULLBENCH_TESTS=ON &&
    ctest --preset release -R '^(${tests:1})\$' &&
    test \$(grep -c '^skipped: .* is missing' build/Testing/Temporary/LastTest.log) -eq $#" || true
}

prove_odd() {
  local pages="plots.report_in_browser plots.comparison_in_browser" figures="plots.records plots.figures"
  # shellcheck disable=SC2046,SC2086
  if odd_root googletest-without-the-rest $(packages_of unit); then
    configured googletest-without-the-rest docker_compose gate.workflow docs.core $figures plots.html_report plots.comparison $pages
    remove_root
  fi
  # shellcheck disable=SC2046,SC2086
  if odd_root all-but-doxygen-and-compare $(packages_of unit) python3-yaml docker-compose python3-matplotlib; then
    configured all-but-doxygen-and-compare docs.core $pages
    remove_root
  fi
  if odd_root compare-without-googletest libbenchmark-tools doxygen; then
    step "compare-without-googletest: configured without tests" as_reader "$root" root \
      "cmake --preset release -DHULLBENCH_TESTS=OFF" || true
    step "compare-without-googletest: with tests one sentence says what is missing" as_reader "$root" root \
      "! cmake --preset release -DHULLBENCH_TESTS=ON 2>../said && grep 'The tests need GoogleTest: install it' ../said" || true
    remove_root
  fi
  if odd_root node-without-npm nodejs; then
    step "node-without-npm: make deps-extra" as_reader "$root" root "make deps-extra && test -d adapters/manifests/node_modules" || true
    remove_root
  fi
}

# ---- the Debian packages ----------------------------------------------------------------------------------

# as_user_of_packages NAME COMMAND: what somebody types who has the packages and no clone.
as_user_of_packages() { step "packages: $1" in_root "$root" bash -euc "cd /tmp; $2" || true; }

prove_packages() {
  local made=${PACKAGES:-$work/made} purged
  if [ -z "${PACKAGES:-}" ]; then
    new_root make-package root || return 0
    step "packages: make package" as_reader "$root" root "make package" || { remove_root; return 0; }
    mkdir "$made"
    cp "$root/root/hullbench/build/packages"/*.deb "$made"
    remove_root
  fi
  new_root packages root || return 0
  mkdir "$root/packages"
  cp "$made"/*.deb "$root/packages"
  # The sample is what a user writes.
  mv "$root/root/hullbench/tests/package" "$root/sample"
  rm -r "$root/root/hullbench"
  step "packages: installed by apt" in_root "$root" env DEBIAN_FRONTEND=noninteractive \
    bash -c 'apt-get -q install -y --no-install-recommends /packages/*.deb' || { remove_root; return 0; }
  as_user_of_packages "hullbench makes a hull" \
    "printf '0,0\n2,0\n0,2\n' | hullbench hull - --alpha 9 --format wkt | grep POLYGON"
  as_user_of_packages "hullbench measures" \
    "hullbench run alphabet --filter '^polylidar/letter_a/' --repetitions 1 2>&1 | grep ' ok, 0 failed, 0 not installed'"
  [ ! -e "$root/usr/bin/polylidar" ] || as_user_of_packages "polylidar makes a hull" \
    "printf '0,0\n2,0\n0,2\n' | polylidar hull - --alpha 9 --format wkt | grep POLYGON"
  as_user_of_packages "the Python module makes a hull" \
    "python3 -c 'import polylidar_core as p; assert p.concave_hull([(0, 0), (2, 0), (0, 2)]).area == 2'"
  step "packages: a compiler and CMake" in_root "$root" env DEBIAN_FRONTEND=noninteractive \
    apt-get -q install -y --no-install-recommends g++ cmake make pkgconf || true
  as_user_of_packages "a program with the library, by CMake" \
    "cmake -S /sample -B build && cmake --build build && build/lattice | grep 'area 86'"
  as_user_of_packages "a program with the library, by pkg-config" \
    "g++ -std=c++20 /sample/main.cpp -o lattice \$(pkg-config --cflags --libs --static polylidar) && ./lattice | grep 'area 86'"
  purged=$(cd "$made" && ls ./*.deb | sed 's|^\./||; s|_.*||' | paste -sd ' ')
  as_user_of_packages "purged without a trace" \
    "apt-get -q purge -y $purged; ! find /usr -path '*polylidar*' -o -path '*hullbench*' | grep ."
  remove_root
}

# ---- the driver -------------------------------------------------------------------------------------------

[ "$(id -u)" -eq 0 ] || fail "debootstrap and chroot need root: run it as root."
command -v apt-get >/dev/null || fail "this needs a Debian host: there is no apt-get."
[[ "$suite" =~ ^(bookworm|trixie)$ ]] || fail "SUITE is bookworm (Debian 12) or trixie (Debian 13), not '$suite'."
for proof in "${proofs[@]}"; do
  [[ "$proof" =~ ^(first|root|user|packages|odd)$ ]] || fail "'$proof' is none of first, root, user, packages and odd."
done
# Some containers are root without the right to make namespaces and mounts.
isolated mount -t tmpfs tmpfs /mnt 2>/dev/null ||
  fail "this machine does not let root make namespaces and mounts (unshare, mount), so no bare root can be entered here."
revision=$(git -C "$checkout" rev-parse --short HEAD 2>/dev/null) || fail "$checkout is no git checkout with a commit."
[ "$(git -C "$checkout" rev-parse --is-shallow-repository)" = false ] ||
  fail "this clone has only a part of the history, so no clone can be made of it: 'git fetch --unshallow' first."
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
  step "bare $suite root with git and make" make_base "$work/base" || exit 1
  if [ -n "${FRESH_CACHE:-}" ]; then
    mkdir -p "$FRESH_CACHE"
    rm -rf --one-file-system -- "$FRESH_CACHE/$suite.partial"
    cp -a "$work/base" "$FRESH_CACHE/$suite.partial"
    mv "$FRESH_CACHE/$suite.partial" "$FRESH_CACHE/$suite"
  fi
fi

for proof in "${proofs[@]}"; do
  case $proof in
    first) prove_first ;;
    root) prove_all root root ;;
    user) prove_all user visitor ;;
    packages) prove_packages ;;
    odd) prove_odd ;;
  esac
done
echo "logs: $logs"
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
