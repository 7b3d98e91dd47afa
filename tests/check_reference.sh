#!/bin/bash
# check_reference.sh PROJECT: which records may become the reference run, with an invented project, run and evaluation.
set -euo pipefail

command -v git >/dev/null || { echo "git is not installed: not tested"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/project" "$scratch/project/results"
cp "$1"/results/{check_reference.py,keep_reference.sh,thin_records.py,keep_league.py,add_experiment.py} "$scratch/project/results"
cd "$scratch/project"
export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b

# describe FILE COMMIT DIRTY: a record of that build.
describe() {
  mkdir -p "$(dirname "$1")"
  echo "{\"environment\": {\"machine_id\": \"01234567\"}, \"tool\": {\"commit\": $2, \"dirty\": $3}}" >"$1"
}

# refuses WORDS COMMAND...: exit code 2, nothing on standard output, and one sentence that has the words.
refuses() {
  local words=$1 code=0
  shift
  "$@" >out 2>err || code=$?
  if [ "$code" -ne 2 ] || [ -s out ] || [ "$(wc -l <err)" -ne 1 ] || ! grep -qF -- "$words" err; then
    echo "FAIL: '$*' ended with $code; expected: $words" >&2
    cat out err >&2
    exit 1
  fi
}

check() { results/check_reference.py run; }

describe run/states/run.json null null
refuses "no git checkout" env GIT_CEILING_DIRECTORIES="$scratch" results/check_reference.py run
git init -q .
git commit -q --allow-empty -m one
old=\"$(git rev-parse HEAD)\"
git commit -q --allow-empty -m two
head=\"$(git rev-parse HEAD)\"

refuses "nowhere has no experiment" results/check_reference.py nowhere
refuses "outside git" check
describe run/states/run.json "$head" true
refuses "not committed; commit, and measure it again with 'make bench'" check
describe run/states/run.json "$head" false
check
describe run/random/run.json "$old" false
refuses "run/random/run.json is of a build of ${old:1:12}, not of HEAD ${head:1:12}" check
echo '{"merged": [' "$(cat run/states/run.json)", "$(cat run/random/run.json)" ']}' >run/random/run.json
refuses "run/random/run.json is of a build of ${old:1:12}" check
echo '{' >run/random/run.json
refuses "run/random/run.json does not say of which build it is" check
describe run/random/run.json "$head" false
check

# What the search and the league are of.
for file in league.json tune/tune.json runs/states/run.json; do
  describe "results/evaluation/$file" "$old" false
  refuses "results/evaluation/$file is of a build of ${old:1:12}, not of HEAD ${head:1:12}" check
  refuses "measure it again with 'make evaluate', or check out ${old:1:12}." check
  describe "results/evaluation/$file" "$head" false
  check
done

# A run that is refused leaves the reference run as it is.
mkdir results/2026-01-01-01234567
ln -s 2026-01-01-01234567 results/reference
describe run/states/run.json "$old" false
touch run/tables.md run/report.html
mkdir run/figures
touch run/figures/summary.png
echo '"created": "2026-02-02T00:00:00Z"' >run/suite.json
refuses "not of HEAD" results/keep_reference.sh run
[ "$(readlink results/reference)" = 2026-01-01-01234567 ] && [ -d results/2026-01-01-01234567 ] || {
  echo "FAIL: the reference run was touched" >&2
  exit 1
}
# One that is not is kept, with its evaluation.
describe run/states/run.json "$head" false
mkdir run/tables
touch run/states/runs.jsonl run/random/runs.jsonl
echo 'see results/2026-01-01-01234567/report.html' >README.md
echo '{"plans": ["states"]}' >results/evaluation/runs/suite.json
sed -i 's/^{/{"plan": {"methods": [{"method": "a", "parameters": {"b": 1}}]}, /' results/evaluation/runs/states/run.json
cat >results/evaluation/runs/states/runs.jsonl <<'ROW'
{"id": "0", "metrics": {"l2": 0.1234567891234, "perimeter": 3}, "name": "a/b", "output_sha256": "0123456789abcdef", "parameters": {"b": 1}, "time_ns": [5]}
ROW
results/keep_reference.sh run >/dev/null
refuses "cannot be kept" results/keep_league.py nowhere unkept
[ ! -e unkept ] || { echo "FAIL: a folder is left of what could not be kept" >&2; exit 1; }
league=results/reference/league
[ "$(xzcat $league/states/runs.jsonl.xz)" = \
  '{"metrics":{"l2":0.123456789},"name":"a/b","output_sha256":"0123456789ab","parameters":{},"phases_ns":[],"time_ns":[]}' ] &&
  [ -f $league/suite.json ] && ! grep -q parameters $league/states/run.json || {
  echo "FAIL: the league's rows were not kept" >&2
  exit 1
}
if [ "$(readlink results/reference)" != 2026-02-02-01234567 ] || [ -d results/2026-01-01-01234567 ] ||
  [ ! -f results/reference/league.json ] || ! grep -q 2026-02-02-01234567 README.md; then
  echo "FAIL: the run was not kept" >&2
  exit 1
fi

# A run of one plan joins a suite of the same build, once.
# run_of FOLDER PLAN BUILD
run_of() {
  mkdir -p "$1"
  echo "{\"plan\": {\"name\": \"$2\"}, \"environment\": {\"machine_id\": \"0\"}, \"tool\": {\"binary_sha256\": \"$3\"}}" >"$1/run.json"
}
run_of suite/states states a
echo '{"plans": ["states"]}' >suite/suite.json
run_of zoo zoo b
refuses "zoo/report.json cannot be read" results/add_experiment.py suite zoo
echo '{}' >zoo/report.json
refuses "zoo is of another build or machine than the experiment states" results/add_experiment.py suite zoo
run_of zoo zoo a
results/add_experiment.py suite zoo
[ -f suite/zoo/report.json ] && [ "$(tr -d ' \n' <suite/suite.json)" = '{"plans":["states","zoo"]}' ] || {
  echo "FAIL: the run is no experiment of the suite" >&2
  exit 1
}
refuses "has an experiment zoo already" results/add_experiment.py suite zoo
echo "only records of HEAD's build become the reference run"
