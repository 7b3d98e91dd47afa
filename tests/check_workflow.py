"""Checks the workflow of GitHub Actions: it parses, runs what it promises, and calls only targets of the Makefile.

    check_workflow.py WORKFLOW MAKEFILE

Exit status 0: fine; 1: found something, which is printed.
"""
import re
import sys

import yaml

NEEDED = {"bench", "test", "test-sanitize", "bench-gate-instructions", "bench-quick"}
ARTEFACTS = {"results/latest/report.json", "results/latest/tables.md"}


def faults(workflow, targets):
    # YAML 1.1, which this parser reads, takes the key "on" for true.
    events = workflow.get("on", workflow.get(True)) or {}
    for event in ("push", "pull_request"):
        if event not in events:
            yield f"the workflow does not run on {event}"
    called, kept = set(), set()
    for name, job in workflow["jobs"].items():
        for step in job["steps"]:
            made = set(re.findall(r"\bmake ([a-z-]+)", step.get("run", "")))
            called |= made
            for target in sorted(made - targets):
                yield f"job {name} calls 'make {target}', which the Makefile does not have"
            if "upload-artifact" in step.get("uses", ""):
                kept |= set(step["with"]["path"].split())
        gates = any("bench-gate" in step.get("run", "") for step in job["steps"])
        whole = any(step.get("with", {}).get("fetch-depth") == 0 for step in job["steps"])
        if gates and not whole:
            yield f"job {name} gates against a base, but fetches no history (fetch-depth: 0)"
    for target in sorted(NEEDED - called):
        yield f"no job calls 'make {target}'"
    for path in sorted(ARTEFACTS - kept):
        yield f"no job keeps {path}"


def main(workflow_path, makefile_path):
    with open(makefile_path, encoding="utf-8") as file:
        targets = set(re.findall(r"^([a-z-]+):.*## ", file.read(), re.MULTILINE))
    with open(workflow_path, encoding="utf-8") as file:
        found = list(faults(yaml.safe_load(file), targets))
    for fault in found:
        print(f"error: {workflow_path}: {fault}", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
