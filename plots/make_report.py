#!/usr/bin/python3
"""Writes the report of a run or suite: one HTML file that needs no network and opens from disk.

    make_report.py [RUN] [--out FILE]

RUN is the folder of a run or of a suite, results/latest if it is not given; FILE is RUN/report.html. Exit codes: 0 ok;
2 when the run cannot be read, the charting library is missing or the file cannot be written.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from page import PLOTS, code, colours, data, fill, method_styles
from pictures import pack as pack_pictures
from records import EXIT_CONFIGURATION, Experiment, RecordError, load
from report_common import PROTOCOLS, entrants_of, label, text
from report_data import MetricTable, charts, columns, pack
from report_html import environment_html, notes_html, paper_html, parameters_html, summary_html, tables_html
from report_summary import measure_noise, summarise

# Of a report that can be sent and opened at once. What the rows take of it is not there for pictures, which give way, but
# not below a fifth of it.
MOST_BYTES = 5 * 2**20
# Of the page for what the pictures' section is written into, and for what changes with them.
_RESERVE_BYTES = 2**14

# In the order in which they are put together; each may use those before it.
SCRIPTS = (
    "data.js",
    "format.js",
    "theme.js",
    "markers.js",
    "picture.js",
    "gallery.js",
    "case_dialog.js",
    "chart_options.js",
    "pareto.js",
    "label_places.js",
    "charts.js",
    "table.js",
    "main.js",
)
STYLES = ("report.css", "gallery.css")


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="make_report.py", description="Writes the report of a run as one HTML file.")
    parser.add_argument(
        "run",
        nargs="?",
        default=PLOTS.parent / "results" / "latest",
        type=Path,
        metavar="RUN",
        help="folder of a run or of a suite (results/latest)",
    )
    parser.add_argument("--out", type=Path, metavar="FILE", help="the file to write (RUN/report.html)")
    options = parser.parse_args(arguments)
    out = options.out or options.run / "report.html"
    try:
        page = make_page(load(options.run), options.run)
        out.write_text(page, encoding="utf-8")
    except RecordError as error:
        print(f"make_report.py: {error}", file=sys.stderr)
        return EXIT_CONFIGURATION
    except OSError as error:
        print(f"make_report.py: {out} cannot be written ({error.strerror}).", file=sys.stderr)
        return EXIT_CONFIGURATION
    print(f"wrote {out} ({len(page.encode()) / 2**20:.1f} MiB)")
    return 0


def make_page(experiments: Sequence[Experiment], folder: Path) -> str:
    """The whole page. Raises RecordError when the records are malformed or the charting library is missing."""
    try:
        values = _template_values(experiments, folder)
        others = len(fill("template.html", {**values, "pictures": ""}).encode())
        room = max(MOST_BYTES - _RESERVE_BYTES - others, MOST_BYTES // 5)
        return fill("template.html", {**values, "pictures": data("pictures", pack_pictures(experiments, room))})
    except (KeyError, TypeError, AttributeError, ValueError) as error:
        raise RecordError(
            f"the records in {folder} are not as results/report.schema.json says "
            f"({type(error).__name__}: {error}); 'hullbench validate' tells where."
        ) from error


def _template_values(experiments: Sequence[Experiment], folder: Path) -> dict[str, str]:
    """All but the pictures."""
    summaries = [summarise(experiment) for experiment in experiments]
    noise = measure_noise(experiments)
    title = "Concave hulls: " + (experiments[0].title if len(experiments) == 1 else "the whole suite")
    report = _report(experiments, folder, title)
    return {
        **code(STYLES, SCRIPTS),
        "title": text(title),
        "byline": _byline(experiments),
        "colours": colours(report["methods"]),
        "summary": summary_html(summaries, noise),
        "paper": paper_html(experiments, folder),
        "parameters": parameters_html(experiments, folder),
        "environment": environment_html(experiments),
        "notes": notes_html(experiments),
        "tables": tables_html(experiments, folder) or "<p>The run has no tables/tables.json.</p>",
        "report": data("report", report),
        "charts": data("charts", pack(charts(experiments))),
        "rows": data("rows", pack(columns(experiments))),
    }


def _report(experiments: Sequence[Experiment], folder: Path, title: str) -> dict[str, Any]:
    """What the page's scripts know from the start."""
    styles = method_styles(experiments)
    entrants = {entrant: None for experiment in experiments for entrant in entrants_of(experiment)}
    order = sorted(
        entrants, key=lambda entrant: (styles[entrant.method]["order"], entrant.protocol != "paper", entrant.protocol)
    )
    rows = [row for experiment in experiments for row in experiment.rows]
    metrics = MetricTable(experiments)
    return {
        "title": title,
        "run": folder.resolve().name,
        "methods": styles,
        "protocols": PROTOCOLS,
        "entrants": [
            {
                "key": entrant.key,
                "method": entrant.method,
                "protocol": entrant.protocol,
                "label": label(experiments, entrant),
            }
            for entrant in order
        ],
        "experiments": [
            {
                "name": experiment.name,
                "title": experiment.title,
                "paper": experiment.plan.get("paper", ""),
                "rows": len(experiment.rows),
                "options": _options(experiment),
            }
            for experiment in experiments
        ],
        "metrics": [metrics.entry(name) for name in metrics.names(rows)],
        "rows": len(rows),
    }


def _options(experiment: Experiment) -> str:
    """What 'hullbench run' needs beside the plan's name for the same points: the seed, where it is not the usual 1."""
    seed = experiment.report.get("seed", 1)
    return "" if seed == 1 else f" --seed {int(seed)}"



def _byline(experiments: Sequence[Experiment]) -> str:
    environment, tool = experiments[0].report["environment"], experiments[0].report.get("tool", {})
    runs = f"{sum(len(experiment.rows) for experiment in experiments):,}".replace(",", "\u202f")
    parts = (
        f"{tool.get('name', 'hullbench')} {tool.get('version', '')}",
        experiments[0].report.get("created", "")[:10],
        f"{runs} runs",
        environment.get("cpu", {}).get("model", "unknown processor"),
        environment.get("os") or "unknown system",
    )
    return " · ".join(text(part) for part in parts)









if __name__ == "__main__":
    sys.exit(main())
