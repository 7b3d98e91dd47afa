#!/usr/bin/python3
"""Writes the ratings of a league as JSON (results/ratings.schema.json), for other pages and programs.

    make_ratings.py CSV [--out FILE]

CSV is what `hullbench league --csv` wrote; FILE is ratings.json beside it. Exit codes: 0 ok; 1 a fault of ours, with its
traceback; 2 when the file cannot be read or written; 6 when no two methods that know as much have a case in common.
"""

import argparse
import json
import math
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ratings import DIVISIONS, KNOWS, TIE_ABSOLUTE, TIE_RELATIVE, Lead, Part, Rating, Standing, divisions, rate, read
from records import NothingToShow, exit_code_of


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="make_ratings.py", description="Writes the ratings of a league as JSON.")
    parser.add_argument("csv", type=Path, metavar="CSV", help="what 'hullbench league --csv' wrote")
    parser.add_argument("--out", type=Path, metavar="FILE", help="the file to write (ratings.json beside CSV)")
    options = parser.parse_args(arguments)
    return exit_code_of("make_ratings.py", lambda: write(options.csv, options.out or options.csv.with_name("ratings.json")))


def write(source: Path, out: Path) -> None:
    rated = [rate(one) for one in divisions(read(source))]
    if not rated:
        raise NothingToShow(f"{source} has no two methods that know as much and have a case in common.")
    out.write_text(json.dumps(ratings_json(rated), indent=1, allow_nan=False) + "\n", encoding="utf-8")
    print(f"wrote {out}")


def ratings_json(rated: Sequence[Rating]) -> dict[str, Any]:
    """As results/ratings.schema.json says; null stands for infinity and for an interval of fewer than two shapes."""
    ties = {"relative": TIE_RELATIVE, "absolute": TIE_ABSOLUTE}
    return {"kind": "ratings", "schema_version": 1, "tie": ties, "divisions": [_division(one) for one in rated]}


def _division(one: Rating) -> dict[str, Any]:
    lead = one.lead
    return {
        "name": one.division.name,
        "knows": KNOWS[one.division.name],
        "protocols": list(DIVISIONS[one.division.name]),
        "cases": len(one.division.results.cases),
        "shapes": one.shapes,
        "left_out": [series._asdict() for series in one.division.left_out],
        "standings": [_standing(standing) for standing in one.standings],
        "lead": {"clear": lead.clear, **_numbers(lead, "ranks", "ranks_interval", "ratio", "ratio_interval")},
        "wins": _number(one.wins.tolist()),
        "ties": _number(one.ties.tolist()),
        "friedman_p": one.friedman,
        "alike_p": one.alike.tolist(),
        "groups": one.groups,
        "kinds": [_part(part) for part in one.kinds],
        "samplers": [_part(part) for part in one.samplers],
    }


def _standing(one: Standing) -> dict[str, Any]:
    return {
        **one.series._asdict(),
        **_numbers(one, "rank", "rank_interval", "elo", "elo_interval"),
        "l2_median": _number(one.error),
        "l2_interval": _number(one.error_interval),
        "failures": one.failures,
    }


def _part(part: Part) -> dict[str, Any]:
    return {"name": part.name, "cases": part.cases, "ranks": _number(part.ranks), "l2_medians": _number(part.errors)}


def _numbers(one: Standing | Lead, *names: str) -> dict[str, Any]:
    return {name: _number(getattr(one, name)) for name in names}


def _number(value: Any) -> Any:
    """Or several, or none: nine digits, as the league keeps them."""
    if isinstance(value, (list, tuple)):
        return [_number(one) for one in value]
    return float(f"{value:.9g}") if value is not None and math.isfinite(value) else None


if __name__ == "__main__":
    sys.exit(main())
