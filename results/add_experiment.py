#!/usr/bin/env python3
"""add_experiment.py SUITE RUN: makes the finished run of one plan in the folder RUN, such as of the zoo, an experiment of
the finished suite in the folder SUITE, as if that had measured it last.

    build/hullbench run zoo --out results/zoo
    results/add_experiment.py results/latest results/zoo

Both must be of one build and one machine. Exit codes: 0 added; 2 not added, and nothing was changed: one sentence on
standard error says why.
"""
import json
import shutil
import sys
from pathlib import Path
from typing import Any


class Refusal(Exception):
    pass


def read(file: Path, what: str) -> Any:
    try:
        return json.loads(file.read_text())
    except (OSError, ValueError) as error:
        raise Refusal(f"{file} cannot be read, so that is no {what}; let 'hullbench run' finish it") from error


def read_run(folder: Path) -> tuple[str, tuple[str, ...]]:
    """The plan's name, and build and machine."""
    description = read(folder / "run.json", "run")
    try:
        origin = (description["tool"]["binary_sha256"], description["environment"]["machine_id"])
        return description["plan"]["name"], origin
    except (KeyError, TypeError) as error:
        raise Refusal(f"{folder / 'run.json'} does not say of which plan, build and machine it is") from error


def add(suite: Path, run: Path) -> None:
    plans = read(suite / "suite.json", "suite")
    if not isinstance(plans, dict) or not isinstance(plans.get("plans"), list):
        raise Refusal(f"{suite / 'suite.json'} does not name the plans of a suite")
    name, origin = read_run(run)
    read(run / "report.json", "finished run")
    if name in plans["plans"] or (suite / name).exists():
        raise Refusal(f"{suite} has an experiment {name} already")
    for other in plans["plans"]:
        if read_run(suite / other)[1] != origin:
            raise Refusal(f"{run} is of another build or machine than the experiment {other} of {suite}")
    plans["plans"].append(name)
    description, folder = suite / "suite.json.unfinished", suite / f"{name}.unfinished"
    try:
        shutil.copytree(run, folder)
        description.write_text(json.dumps(plans, indent=2) + "\n")
        folder.rename(suite / name)
        description.replace(suite / "suite.json")
    except OSError as error:
        shutil.rmtree(suite / name, ignore_errors=True)
        raise Refusal(f"{run} cannot be copied into {suite}: {error}") from error
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        description.unlink(missing_ok=True)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    try:
        add(Path(sys.argv[1]), Path(sys.argv[2]))
    except Refusal as refusal:
        print(f"error: {refusal}.", file=sys.stderr)
        sys.exit(2)
