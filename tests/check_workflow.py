"""Checks the workflows of GitHub Actions: they parse, run what they promise, and call only targets of the Makefile.

    check_workflow.py FOLDER MAKEFILE

The folder has ci.yml, fuzz.yml, release.yml and site.yml. Exit status 0: fine; 1: found something, which is printed.
"""
import pathlib
import re
import sys

import yaml

CI_NEEDS = {"bench", "test", "test-sanitize", "bench-gate-instructions", "bench-quick"}
RELEASE_NEEDS = {"test", "package", "js"}
RELEASED_PROGRAMS = {"polylidar", "hullbench"}
LEAST_FUZZING = 300  # seconds for each target
ARTEFACTS = {"results/latest/report.json", "results/latest/tables.md"}


def events(workflow):
    # YAML 1.1, which this parser reads, takes the key "on" for true.
    return workflow.get("on", workflow.get(True)) or {}


def steps(workflow):
    """(job's name, job, step) of every step."""
    for name, job in workflow["jobs"].items():
        for step in job["steps"]:
            yield name, job, step


def called(step):
    return set(re.findall(r"\bmake ([a-z-]+)", step.get("run", "")))


def make_faults(workflow, targets, needed):
    found = set()
    for name, _, step in steps(workflow):
        found |= called(step)
        for target in sorted(called(step) - targets):
            yield f"job {name} calls 'make {target}', which the Makefile does not have"
    for target in sorted(needed - found):
        yield f"no job calls 'make {target}'"


def permission_faults(workflow, publishers=()):
    """Nobody but the jobs that publish may do more than read."""
    if workflow.get("permissions") != {"contents": "read"}:
        yield "the workflow may do more than read"
    for name, job in workflow["jobs"].items():
        if name not in publishers and "permissions" in job:
            yield f"job {name} may do more than read"


def ci_faults(workflow, targets):
    yield from make_faults(workflow, targets, CI_NEEDS)
    for event in ("push", "pull_request"):
        if event not in events(workflow):
            yield f"the workflow does not run on {event}"
    kept = set()
    for name, job, step in steps(workflow):
        if "upload-artifact" in step.get("uses", ""):
            kept |= set(step["with"]["path"].split())
        whole = any(other.get("with", {}).get("fetch-depth") == 0 for other in job["steps"])
        if "bench-gate" in step.get("run", "") and not whole:
            yield f"job {name} gates against a base, but fetches no history (fetch-depth: 0)"
    for path in sorted(ARTEFACTS - kept):
        yield f"no job keeps {path}"


def release_faults(workflow, targets):
    yield from make_faults(workflow, targets, RELEASE_NEEDS)
    if set(events(workflow)) != {"push"} or set(events(workflow)["push"]) != {"tags"}:
        yield "the workflow does not run on tags alone"
    runs = [step.get("run", "") for _, _, step in steps(workflow)]
    if not any("check.sh version" in run for run in runs):
        yield "no job checks the version"
    for program in sorted(RELEASED_PROGRAMS):
        if not any(f"{program} hull" in run for run in runs):
            yield f"no job runs the installed {program}"
    if not any("npm pack" in run for run in runs):
        yield "no job packs the npm package"
    publishers = {name for name, _, step in steps(workflow) if "gh release create" in step.get("run", "")}
    if len(publishers) != 1:
        yield f"{len(publishers)} jobs make a release, not one"
    yield from permission_faults(workflow, publishers)
    for name in publishers:
        if set(workflow["jobs"][name].get("needs", [])) != set(workflow["jobs"]) - publishers:
            yield f"job {name} does not wait for all others"
    for name, _, step in steps(workflow):
        if "upload-artifact" in step.get("uses", "") and step["with"].get("if-no-files-found") != "error":
            yield f"job {name} may upload nothing"


def fuzz_faults(workflow, targets):
    yield from make_faults(workflow, targets, {"fuzz"})
    if "schedule" not in events(workflow):
        yield "the workflow does not run by itself"
    yield from permission_faults(workflow)
    seconds = [int(n) for _, _, step in steps(workflow) for n in re.findall(r"make fuzz SECONDS=(\d+)", step.get("run", ""))]
    if not seconds or min(seconds) < LEAST_FUZZING:
        yield f"a target is searched with for less than {LEAST_FUZZING} seconds"


def site_faults(workflow, targets):
    yield from make_faults(workflow, targets, {"site"})
    if "pull_request" in events(workflow):
        yield "a pull request would publish"
    publishers = {name for name, _, step in steps(workflow) if "deploy-pages" in step.get("uses", "")}
    if len(publishers) != 1:
        yield f"{len(publishers)} jobs publish pages, not one"
    yield from permission_faults(workflow, publishers)
    if not any(step.get("with", {}).get("path") == "build/site" for _, _, step in steps(workflow)):
        yield "no job hands build/site on"


def main(folder, makefile):
    targets = set(re.findall(r"^([a-z-]+):.*## ", pathlib.Path(makefile).read_text(encoding="utf-8"), re.MULTILINE))
    status = 0
    checks = {"ci.yml": ci_faults, "fuzz.yml": fuzz_faults, "release.yml": release_faults, "site.yml": site_faults}
    for name, faults in checks.items():
        path = pathlib.Path(folder, name)
        for fault in faults(yaml.safe_load(path.read_text(encoding="utf-8")), targets):
            print(f"error: {path}: {fault}", file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
