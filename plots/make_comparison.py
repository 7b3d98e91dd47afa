#!/usr/bin/python3
"""Writes the comparison of two runs or suites: one HTML file that needs no network and opens from disk.

    make_comparison.py A B --compared FILE [--out FILE]

A and B are folders of runs or suites, before and after, or of two machines; --compared is what
`hullbench compare A B --format json` wrote about them; the page is comparison.html if --out does not say otherwise.
Exit codes: 0 ok; 1 a fault of ours, with its traceback; 2 when something cannot be read, the charting library or esbuild is
missing or the file cannot be written; 6 when the runs have nothing in common.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from comparison_data import Comparison, both_charts, charted_metrics, columns, compare, read_compared
from comparison_html import SIGNS, differences_html, only_html, verdict_html
from page import Section, code, colours, data, entrants, method_styles, page, place, write_page
from records import NothingToShow, exit_code_of, load
from report_common import text
from report_data import pack

STYLES = ("report.css", "comparison.css")


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        prog="make_comparison.py", description="Writes the comparison of two runs as one HTML file."
    )
    parser.add_argument("a", type=Path, metavar="A", help="folder of a run or of a suite: before")
    parser.add_argument("b", type=Path, metavar="B", help="the other: after")
    parser.add_argument(
        "--compared", type=Path, required=True, metavar="FILE", help="what 'hullbench compare A B --format json' wrote"
    )
    parser.add_argument(
        "--out", type=Path, default=Path("comparison.html"), metavar="FILE", help="the file to write (comparison.html)"
    )
    options = parser.parse_args(arguments)
    paths = (options.a, options.b, options.compared)
    return exit_code_of("make_comparison.py", lambda: write_page(options.out, make_page(*paths)))


def make_page(a: Path, b: Path, compared: Path) -> str:
    """The whole page. Raises RecordError when something is malformed or missing, NothingToShow without a pair."""
    told = read_compared(compared)
    comparison = compare(load(a), load(b), told, (a.resolve().name, b.resolve().name))
    if not comparison.pairs:
        raise NothingToShow(f"{a} and {b} have no run in common, so there is nothing to compare.")
    report = _report(comparison)
    blocks = [data("report", report), data("charts", pack(both_charts(comparison))), data("rows", pack(columns(comparison)))]
    parts = {**code(STYLES, "comparison.js"), "colours": colours(report["methods"])}
    return page(text(report["title"]), _byline(comparison), _sections(comparison), blocks, parts)


def _sections(comparison: Comparison) -> list[Section]:
    ratios = place("ratios", "The charts and the table of all runs")
    return [
        Section("summary", "Verdict", "Verdict", verdict_html(comparison)),
        Section("differences", "What differs", "What differs between the runs", differences_html(comparison)),
        Section("ratios", "Ratios", "Ratios of times, B ÷ A", ratios),
        Section("results", "Time and error", "Time and error of both", place("charts")),
        Section("runs", "All runs", "All runs in both", place("table")),
        Section("only", "Only in one", "Only in one, and notes", only_html(comparison)),
    ]


def _report(comparison: Comparison) -> dict[str, Any]:
    """What the page's scripts know from the start; puts the methods in the usual order."""
    styles = method_styles([*comparison.a, *comparison.b])
    listed = entrants([*comparison.a, *comparison.b])
    order = [entrant["key"] for entrant in listed]
    comparison.methods.sort(key=lambda one: order.index(one.series.key))
    return {
        "title": "Concave hulls: two runs compared",
        "same_machine": comparison.same_machine,
        "signs": SIGNS,
        "methods": styles,
        "entrants": [one for one in listed if one["key"] in {method.series.key for method in comparison.methods}],
        "changes": [
            {
                **{name: one.told[name] for name in ("ratio", "pairs", "faster", "slower")},
                **dict(zip(("low", "high"), one.interval or (None, None))),
                "key": one.series.key,
                "judged": one.judged,
                "change": comparison.word(one.change),
            }
            for one in comparison.methods
            if one.ratio is not None
        ],
        "experiments": [{"title": one.title} for one in comparison.a],
        "metrics": charted_metrics(comparison),
    }


def _byline(comparison: Comparison) -> str:
    """What A and B are: each by its folder, its time and its commit."""
    said = ""
    for side, name, experiments in (("A", comparison.names[0], comparison.a), ("B", comparison.names[1], comparison.b)):
        report = experiments[0].report
        tool = report["tool"]
        parts = (
            name,
            report["created"][:16].replace("T", " "),
            f"commit {(tool['commit'] or 'unknown')[:9]}" + (" with changes" if tool["dirty"] else ""),
            report["environment"]["cpu"]["model"],
        )
        said += f"<div><b class='side'>{side}</b> {' · '.join(text(part) for part in parts if part)}</div>"
    return said


if __name__ == "__main__":
    sys.exit(main())
