#!/usr/bin/env bash
# Hands a sweep to Slurm: a job array with a task a shard, and a job that merges them when all have ended.
#
#   submit.sh [--shards N] [--out FOLDER] PLAN... [options of "hullbench run"]
#
# N is 8 unless given. FOLDER must be seen by all nodes (default: results/slurm/<time>): shards/ and logs/ go there, and
# merged/, the result. HULLBENCH names the program (default: build/hullbench of this checkout), which the nodes must see
# too. Partition, account, time limit and the like come from Slurm's own variables: SBATCH_PARTITION, SBATCH_TIMELIMIT.
# Prints the ids of the two jobs. Exit status: 0 submitted; 2 usage or configuration.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
hullbench=$(realpath -m "${HULLBENCH:-$here/../../build/hullbench}")
shards=8
folder=results/slurm/$(date -u +%Y%m%dT%H%M%SZ)

fail() {
  printf 'error: %s\n' "$*" >&2
  exit 2
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
[ $# -gt 0 ] || fail "name at least one plan: submit.sh [--shards N] [--out FOLDER] PLAN..."
[[ $shards =~ ^[1-9][0-9]{0,3}$ ]] || fail "--shards takes a number from 1 to 9999, not '$shards'."
command -v sbatch >/dev/null || fail "there is no sbatch here: submit from a node of a Slurm cluster."
[ -x "$hullbench" ] || fail "there is no program $hullbench: build it with 'make build', or name it with HULLBENCH."
folder=$(realpath -m "$folder")
[ ! -e "$folder" ] || fail "$folder is there already: choose another folder with --out."
# A plan that is not there, or an option that is not known, is said here and not in the log of every task.
runs=$("$hullbench" run "$@" --dry-run) || fail "hullbench would not run this: see above."

mkdir -p "$folder/logs"
array=$(sbatch --parsable --array="1-$shards" --output="$folder/logs/shard-%a.txt" \
  "$here/shard.sbatch" "$hullbench" "$folder" "$shards" "$@")
merge=$(sbatch --parsable --dependency="afterany:$array" --output="$folder/logs/merge.txt" \
  "$here/merge.sbatch" "$hullbench" "$folder")
echo "==> $(wc -l <<<"$runs") runs in $shards shards: job $array; then job $merge merges them into $folder/merged"
