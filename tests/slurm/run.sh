#!/usr/bin/env bash
# Tries the Slurm scripts (benchmarks/slurm, core/tool/slurm) on a real Slurm of one node: its own munged, slurmctld and
# slurmd, from Debian's packages, in a temporary folder and on 127.0.0.1 only; nothing of them is left when this ends.
#
#   run.sh HULLBENCH POLYLIDAR     the programs; needs root, since slurmd does
#
# Exit status: 0 all passed; 1 something failed; 2 it cannot be tried here.
set -euo pipefail
export LC_ALL=C

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
submit=$here/../../benchmarks/slurm/submit.sh
hull=$here/../../core/tool/slurm/hull.sbatch

fail() {
  printf 'error: %s\n' "$*" >&2
  exit 2
}

[ $# -eq 2 ] || fail "name the programs: run.sh build/hullbench build/polylidar"
for program in "$1" "$2"; do [ -x "$program" ] || fail "there is no program $program."; done
[ "$(id -u)" -eq 0 ] || fail "slurmd needs root: run 'make test-slurm' as root."
for program in munged slurmctld slurmd sbatch ss python3; do
  command -v "$program" >/dev/null || fail "there is no $program: 'cmake/install-packages.sh slurm' installs Slurm."
done
HULLBENCH=$(realpath "$1")
POLYLIDAR=$(realpath "$2")
export HULLBENCH POLYLIDAR

work=$(mktemp -d)
export SLURM_CONF=$work/slurm.conf # from here on no command reaches a cluster of this machine
daemons=()
passed=0
failed=0

clean_up() {
  local status=$? pid
  trap '' INT TERM HUP PIPE
  set +e
  scancel --user root 2>/dev/null
  # The controller last, so that it hears of the end of what runs.
  for pid in "${daemons[@]}"; do
    kill -TERM "$pid" 2>/dev/null
    wait "$pid" 2>/dev/null
  done
  rm -rf --one-file-system -- "$work"
  exit "$status"
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP PIPE

check() {
  local what=$1
  shift
  if "$@"; then
    passed=$((passed + 1))
    echo "ok: $what"
  else
    failed=$((failed + 1))
    echo "FAILED: $what"
  fi
}

# wait_for SECONDS COMMAND...: until the command succeeds.
wait_for() {
  local end=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    [ "$SECONDS" -lt "$end" ] || return 1
    sleep 0.5
  done
}

# A port that nobody listens on. Another program could take it before we do; then the daemon says so and ends.
free_port() { python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }

# ---- a Slurm of one node ----------------------------------------------------------------------------------

# munged trusts no path that others can write to.
chmod 755 "$work"
mkdir "$work/munge" "$work/state" "$work/spool"
dd if=/dev/urandom of="$work/munge/key" bs=1024 count=1 status=none
chmod 600 "$work/munge/key"
node=$(hostname -s)
cat >"$SLURM_CONF" <<CONF
ClusterName=hullbench
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
# Without these two the daemons listen on every address of the host.
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmUser=root
AuthType=auth/munge
# A requeued job may start again only when its credential has expired: two minutes unless said otherwise.
AuthInfo=socket=$work/munge/socket,cred_expire=5
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
# A container may have no control groups.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_interval=1
MpiDefault=none
ReturnToService=2
MailProg=/bin/true
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc)
PartitionName=test Nodes=$node Default=YES MaxTime=10 State=UP
CONF
printf 'CgroupAutomount=no\n' >"$work/cgroup.conf"

munged --foreground --key-file="$work/munge/key" --socket="$work/munge/socket" --pid-file="$work/munge/pid" \
  --log-file="$work/munge/log" --seed-file="$work/munge/seed" >"$work/munged.txt" 2>&1 &
daemons=("$!")
wait_for 10 test -S "$work/munge/socket" || { cat "$work/munged.txt"; fail "munged did not start: see above."; }
slurmctld -D >"$work/slurmctld.txt" 2>&1 &
daemons=("$!" "${daemons[@]}")
slurmd -D -N "$node" >"$work/slurmd.txt" 2>&1 &
daemons=("$!" "${daemons[@]}")
is_idle() { [ "$(sinfo --noheader --format=%t)" = idle ]; }
wait_for 60 is_idle || { tail -n 20 "$work"/slurm*.txt; fail "Slurm did not start: see above."; }

# Every line of ours that ss shows is about 127.0.0.1; three daemons of which two listen on a port.
listens_here_only() {
  local lines
  lines=$(ss -Hltnp | grep -E '"(munged|slurmctld|slurmd|slurmstepd)"') || return 1
  [ "$(wc -l <<<"$lines")" -ge 2 ] && ! grep -v ' 127\.0\.0\.1:[0-9]' <<<"$lines"
}
check "no daemon listens beyond this host" listens_here_only

# ---- a sweep ----------------------------------------------------------------------------------------------

# plan NAME REPETITIONS: two methods on six cases.
plan() {
  local alpha='"protocol": "paper", "parameters": {"alpha": {"rule": "paper_alpha"}}'
  printf '{"name": "%s", "repetitions": %s, "cases": [{"dataset": "ca", "holes": [false, true], "n": [500, 1000, 2000]}],
    "methods": [{"method": "polylidar", %s}, {"method": "cgal_alpha_shape", %s}]}\n' "$1" "$2" "$alpha" "$alpha" >"$work/$1.json"
}

# The rows without what is not accuracy.
accuracy() {
  python3 - "$1/runs.jsonl" <<'PYTHON'
import json, sys
for line in open(sys.argv[1]):
    row = json.loads(line)
    row["metrics"].pop("peak_memory_bytes", None)
    print(json.dumps({k: v for k, v in row.items() if k not in ("time_ns", "phases_ns", "canary_ns", "machine", "flags")}))
PYTHON
}

same_accuracy() { [ -s "$1/runs.jsonl" ] && diff <(accuracy "$1") <(accuracy "$2") >/dev/null; }
has_ended() { [ -z "$(squeue --noheader)" ]; }
show_logs() { tail -n 5 "$1"/logs/*; }

cd "$work"
plan small 2
"$HULLBENCH" run small.json --out whole >/dev/null 2>&1
check "submits a sweep of three shards" "$submit" --shards 3 --out sweep small.json
check "the sweep ends" wait_for 120 has_ended
check "each task of the array measured its shard" test "$(find sweep/shards -name report.json | wc -l)" -eq 3
check "the merged run has the accuracy of a whole one" same_accuracy whole sweep/merged || show_logs sweep
check "the merged run is valid" "$HULLBENCH" validate sweep/merged/report.json
check "it has times, since all nodes are the same" grep -q 'time of equal work, ms' sweep/merged/tables.md

# ---- a hull in shards -------------------------------------------------------------------------------------

"$HULLBENCH" points ca --n 200000 --out hull.npy >/dev/null 2>&1
limit=(--max-perimeter 4)
"$POLYLIDAR" hull hull.npy "${limit[@]}" --stream --out whole.geojson 2>/dev/null
# As core/tool/README.md has it.
submit_hull() {
  array=$(sbatch --parsable --array=1-4 --output="$work/hull-%a.txt" "$hull" hull.npy "${limit[@]}") &&
    sbatch --dependency=afterok:"$array" --output="$work/hull-merge.txt" \
      --wrap="'$POLYLIDAR' merge part-? --out merged.geojson" >/dev/null
}
check "submits a hull of four shards" submit_hull
check "the hull ends" wait_for 120 has_ended
check "each task of the array made its part" test "$(find . -maxdepth 1 -name 'part-*' | wc -l)" -eq 4
check "the merged hull has the bytes of one run" cmp whole.geojson merged.geojson || cat "$work"/hull-*.txt
rm part-3
SHARDS=4 sbatch --parsable --array=3 --output="$work/hull-again.txt" "$hull" hull.npy "${limit[@]}" >/dev/null
check "a shard made again ends" wait_for 120 has_ended
check "and fits to the others" cmp whole.geojson <("$POLYLIDAR" merge part-? 2>/dev/null)

# ---- a task that is requeued ------------------------------------------------------------------------------

plan long 2000
check "submits a sweep that takes longer" "$submit" --shards 1 --out requeued long.json
measures() { [ -s requeued/shards/1-"$node"/runs.jsonl ] || [ "$(wc -l <requeued/shards/1-"$node"/repetitions.jsonl)" -gt 100 ]; }
check "it measures" wait_for 60 measures
scontrol requeue "$(squeue --noheader --states=RUNNING --format=%A | head -n 1)"
check "the requeued task ends" wait_for 180 has_ended
resumed() { python3 -c 'import json, sys; sys.exit(0 if json.load(open(sys.argv[1]))["resumed"] else 1)' "$1"; }
check "it went on where it had stopped" resumed requeued/shards/1-"$node"/run.json
check "all of its runs are there" test "$(wc -l <requeued/merged/runs.jsonl)" -eq 12
all_ok() { python3 -c 'import json, sys; sys.exit(any(json.loads(line)["status"] != "ok" for line in open(sys.argv[1])))' "$1"; }
check "and ok" all_ok requeued/merged/runs.jsonl

# ---- what submit.sh refuses -------------------------------------------------------------------------------

refuses() { ! "$submit" "$@" >refusal.txt 2>&1 && [ "$(grep -c '^error: ' refusal.txt)" -eq 1 ]; }
check "refuses a folder that is there" refuses --out sweep small.json
check "refuses a plan that is not" refuses --out new nothing.json
check "refuses a wrong number of shards" refuses --shards 0 --out new small.json
check "refuses a folder for every task" refuses --out new/out small.json --out other
check "refuses a shard of its own" refuses --out new/shard small.json --shard 1/2
check "refuses to start anew" refuses --out new/force small.json --force
check "and submits nothing then" test ! -e new

# ---- a job that Slurm does not take -----------------------------------------------------------------------

# An sbatch that takes no job to merge, and lets no other one begin.
mkdir bin
cat >bin/sbatch <<SBATCH
#!/bin/sh
case "\$*" in *merge.sbatch*) echo "sbatch: error: no more jobs" >&2; exit 1 ;; esac
exec $(command -v sbatch) --hold "\$@"
SBATCH
chmod 755 bin/sbatch
gives_up() {
  local status=0
  PATH=$work/bin:$PATH "$submit" --shards 2 --out halved long.json >refusal.txt 2>&1 || status=$?
  [ "$status" -eq 1 ] && [ "$(grep -c '^error: ' refusal.txt)" -eq 1 ]
}
check "says when Slurm does not take the merge" gives_up
check "cancels the shards then" wait_for 60 has_ended
check "and leaves no folder" test ! -e halved

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
