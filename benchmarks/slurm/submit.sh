#!/usr/bin/env bash
# Hands a sweep to Slurm: a job array with a task a shard, and a job that merges them when all have ended.
#
#   submit.sh [--shards N] [--out FOLDER] PLAN... [options of "hullbench run"]
#
# N is 8 unless given. FOLDER must be seen by all nodes (default: results/slurm/<time>): shards/ and logs/ go there, and
# merged/, the result. HULLBENCH names the program (default: build/hullbench of this checkout), which the nodes must see
# too. Partition, account, time limit and the like come from Slurm's own variables: SBATCH_PARTITION, SBATCH_TIMELIMIT.
# Prints the ids of the two jobs. Exit status: 0 submitted; 1 Slurm did not take one of the jobs, and the
# other is cancelled; 2 usage or configuration.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
hullbench=$(realpath -m "${HULLBENCH:-$here/../../build/hullbench}")
shards=8
folder=results/slurm/$(date -u +%Y%m%dT%H%M%SZ)

fail() {
  printf 'error: %s\n' "$*" >&2
  exit 2
}

# When a job was not submitted, and none is left: the folder goes too, unless a task has begun a run in it.
give_up() {
  if [ "$(ls -A "$folder")" = logs ]; then rm -rf -- "$folder"; fi
  printf 'error: %s\n' "$*" >&2
  exit 1
}

while [ $# -gt 0 ]; do
  case $1 in
    --shards | --out) [ $# -ge 2 ] || fail "$1 needs a value." ;;&
    --shards) shards=$2 ;;
    --out) folder=$2 ;;
    *) break ;;
  esac
  shift 2
done
for word in "$@"; do
  case $word in
    --force | --force=*) fail "leave --force out: FOLDER is new, and a requeued task would lose what it has finished." ;;
  esac
done
[ $# -gt 0 ] || fail "name at least one plan: submit.sh [--shards N] [--out FOLDER] PLAN..."
[[ $shards =~ ^[1-9][0-9]{0,3}$ ]] || fail "--shards takes a number from 1 to 9999, not '$shards'."
command -v sbatch >/dev/null || fail "there is no sbatch here: submit from a node of a Slurm cluster."
[ -x "$hullbench" ] || fail "there is no program $hullbench: build it with 'make build', or name it with HULLBENCH."
folder=$(realpath -m "$folder")
[ ! -e "$folder" ] || fail "$folder is there already: choose another folder with --out."
# A plan that is not there, or an option that is not known, is said here and not in the log of every task.
runs=$("$hullbench" run "$@" --dry-run) || fail "hullbench would not run this: see above."
# The very words of a task (shard.sbatch). That a shard has no case (6) is no fault.
status=0
"$hullbench" run "$@" --shard "1/$shards" --out "$folder/shards/1" --dry-run >/dev/null || status=$?
[ "$status" -eq 0 ] || [ "$status" -eq 6 ] || fail "hullbench would not run this in shards: see above."

mkdir -p "$folder/logs"
array=$(sbatch --parsable --array="1-$shards" --output="$folder/logs/shard-%a.txt" \
  "$here/shard.sbatch" "$hullbench" "$folder" "$shards" "$@") || give_up "Slurm did not take the shards: see above."
merge=$(sbatch --parsable --dependency="afterany:$array" --output="$folder/logs/merge.txt" \
  "$here/merge.sbatch" "$hullbench" "$folder") || {
  scancel "$array" || {
    echo "error: Slurm did not take the job that merges, and job $array, the shards, is still there: see above." >&2
    exit 1
  }
  give_up "Slurm did not take the job that merges, so the shards are cancelled: see above."
}
echo "==> $(wc -l <<<"$runs") runs in $shards shards: job $array; then job $merge merges them into $folder/merged"
