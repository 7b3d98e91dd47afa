#!/usr/bin/env python3
"""check_reference.py RUN [EVALUATION]: whether the records of a suite may become the reference run.

They may when all were measured by one build, that of the revision that is checked out, without changes of its own; and
so the search and the league of EVALUATION (results/evaluation), as far as they are there. Numbers that stand beside
the code must be the code's.

Exit codes: 0 they may; 2 they may not, or cannot be read: one sentence on standard error says which and what to do.
"""
import json
import subprocess
import sys
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent


class Refusal(Exception):
    pass


def builds_of(file: Path) -> list[tuple[str | None, bool | None]]:
    """Commit and whether it was changed: of the parts, where a run was merged of some."""
    try:
        record = json.loads(file.read_text())
        return [(part["tool"]["commit"], part["tool"]["dirty"]) for part in record.get("merged") or [record]]
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise Refusal(f"{file} does not say of which build it is; measure it again") from error


def head() -> str:
    asked = ["git", "rev-parse", "HEAD", "--show-prefix"]
    done = subprocess.run(asked, cwd=PROJECT, capture_output=True, text=True)
    # A prefix: the project lies in another one's checkout.
    if done.returncode != 0 or len(done.stdout.split()) != 1:
        raise Refusal("this is no git checkout, so no revision can be named for the records; use a clone")
    return done.stdout.strip()


def check(file: Path, revision: str, again: str) -> None:
    for commit, is_dirty in builds_of(file):
        if commit is None:
            raise Refusal(f"{file} is of a build outside git; measure it again with {again} in a clone")
        if commit != revision:
            raise Refusal(
                f"{file} is of a build of {commit[:12]}, not of HEAD {revision[:12]}; measure it again with {again}, "
                f"or check out {commit[:12]}"
            )
        if is_dirty:
            raise Refusal(
                f"{file} is of a build with changes that are not committed; commit, and measure it again with {again}"
            )


def main(run: Path, evaluation: Path) -> None:
    revision = head()
    experiments = sorted(run.glob("*/run.json"))
    if not experiments:
        raise Refusal(f"{run} has no experiment in it; run 'make bench' first")
    for file in experiments:
        check(file, revision, "'make bench'")
    kept = [evaluation / "league.json", evaluation / "tune" / "tune.json"]
    for file in [file for file in kept if file.exists()] + sorted(evaluation.glob("runs/*/run.json")):
        check(file, revision, "'make evaluate'")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    try:
        main(Path(sys.argv[1]), Path(sys.argv[2]) if len(sys.argv) == 3 else PROJECT / "results" / "evaluation")
    except (Refusal, OSError) as refusal:
        print(f"error: {refusal}.", file=sys.stderr)
        sys.exit(2)
