#!/usr/bin/python3
"""Writes the comparison of two runs or suites: one HTML file that needs no network and opens from disk.

    make_comparison.py A B --compared FILE [--out FILE]

A and B are folders of runs or suites, before and after, or of two machines; --compared is what
`hullbench compare A B --format json` wrote about them; the page is comparison.html if --out does not say otherwise.
Exit codes: 0 ok; 2 when something cannot be read, the charting library is missing or the file cannot be written; 6 when
the runs have nothing in common.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from comparison_data import Comparison, both_charts, charted_metrics, columns, compare, read_compared
from comparison_html import SIGNS, differences_html, only_html, verdict_html
from page import code, colours, data, fill, method_styles
from records import EXIT_CONFIGURATION, EXIT_NOTHING, RecordError, load
from report_common import text
from report_data import pack

# In the order in which they are put together; each may use those before it.
SCRIPTS = (
    "data.js",
    "format.js",
    "theme.js",
    "markers.js",
    "chart_options.js",
    "charts.js",
    "table.js",
    "comparison_options.js",
    "comparison_toggles.js",
    "comparison_forest.js",
    "comparison_charts.js",
    "comparison_table.js",
    "comparison.js",
)
STYLES = ("report.css", "comparison.css")


class NothingShared(Exception):
    """The two runs have no run in common."""


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
    try:
        page = make_page(options.a, options.b, options.compared)
        options.out.write_text(page, encoding="utf-8")
    except RecordError as error:
        print(f"make_comparison.py: {error}", file=sys.stderr)
        return EXIT_CONFIGURATION
    except NothingShared as error:
        print(f"make_comparison.py: {error}", file=sys.stderr)
        return EXIT_NOTHING
    except OSError as error:
        print(f"make_comparison.py: {options.out} cannot be written ({error.strerror}).", file=sys.stderr)
        return EXIT_CONFIGURATION
    print(f"wrote {options.out} ({len(page.encode()) / 2**20:.1f} MiB)")
    return 0


def make_page(a: Path, b: Path, compared: Path) -> str:
    """The whole page. Raises RecordError when something is malformed or missing, NothingShared without a pair."""
    told = read_compared(compared)
    runs = load(a), load(b)
    try:
        comparison = compare(*runs, told, (a.resolve().name, b.resolve().name))
        if not comparison.pairs:
            raise NothingShared(f"{a} and {b} have no run in common, so there is nothing to compare.")
        return fill("comparison.html", _template_values(comparison))
    except (KeyError, TypeError, AttributeError, ValueError) as error:
        raise RecordError(
            f"the records in {a} or {b} are not as results/report.schema.json says "
            f"({type(error).__name__}: {error}); 'hullbench validate' tells where."
        ) from error


def _template_values(comparison: Comparison) -> dict[str, str]:
    report = _report(comparison)
    return {
        **code(STYLES, SCRIPTS),
        "title": text(report["title"]),
        "byline": _byline(comparison),
        "colours": colours(report["methods"]),
        "verdict": verdict_html(comparison),
        "differences": differences_html(comparison),
        "only": only_html(comparison),
        "report": data("report", report),
        "charts": data("charts", pack(both_charts(comparison))),
        "rows": data("rows", pack(columns(comparison))),
    }


def _report(comparison: Comparison) -> dict[str, Any]:
    """What the page's scripts know from the start; puts the methods in the usual order."""
    styles = method_styles([*comparison.a, *comparison.b])
    comparison.methods.sort(
        key=lambda one: (styles[one.entrant.method]["order"], one.entrant.protocol != "paper", one.entrant.protocol)
    )
    return {
        "title": "Concave hulls: two runs compared",
        "names": comparison.names,
        "same_machine": comparison.same_machine,
        "signs": SIGNS,
        "methods": styles,
        "entrants": [
            {"key": one.entrant.key, "method": one.entrant.method, "protocol": one.entrant.protocol, "label": one.label}
            for one in comparison.methods
        ],
        "changes": [
            {
                "key": one.entrant.key,
                "ratio": one.ratio,
                "low": one.low,
                "high": one.high,
                "pairs": one.pairs,
                "judged": one.judged,
                "faster": one.faster,
                "slower": one.slower,
                "change": comparison.word(one.change),
            }
            for one in comparison.methods
            if one.ratio is not None
        ],
        "experiments": [{"name": one.name, "title": one.title, "options": ""} for one in comparison.a],
        "metrics": charted_metrics(comparison),
        "rows": len(comparison.pairs),
    }


def _byline(comparison: Comparison) -> str:
    """What A and B are: each by its folder, its time and its commit."""
    said = ""
    for side, name, experiments in (("A", comparison.names[0], comparison.a), ("B", comparison.names[1], comparison.b)):
        report = experiments[0].report
        tool, cpu = report.get("tool", {}), report["environment"].get("cpu", {})
        parts = (
            name,
            str(report.get("created", ""))[:16].replace("T", " "),
            f"commit {str(tool.get('commit') or 'unknown')[:9]}" + (" with changes" if tool.get("dirty") else ""),
            cpu.get("model", "unknown processor"),
        )
        said += f"<div><b class='side'>{side}</b> {' · '.join(text(part) for part in parts if part)}</div>"
    return said



if __name__ == "__main__":
    sys.exit(main())
