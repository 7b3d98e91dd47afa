#!/usr/bin/python3
"""Writes the report of a run or suite: one HTML file that needs no network and opens from disk.

    make_report.py [RUN] [--out FILE]

RUN is the folder of a run or of a suite, results/latest if it is not given; FILE is RUN/report.html. Exit codes: 0 ok;
1 a fault of ours, with its traceback; 2 when the run cannot be read, the charting library or esbuild is missing or the
file cannot be written.
"""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from front import Front, front_html, make_front
from page import Section, byline, code, colours, data, entrants, kept_data, method_styles, page, place, write_page
from pictures import is_kept, kept_pictures
from pictures import pack as pack_pictures
from records import Experiment, exit_code_of, load, options_of_run
from report_common import text
from report_data import MetricTable, charts, columns, pack
from report_html import environment_html, notes_html, paper_html, parameters_html, summary_html, tables_html
from report_summary import mixture_sentence, summarise
from strip import strip_html
from where import listed_cases, where_html

# Of a report that can be sent and opened at once. What the rows take of it is not there for pictures, which give way, but
# not below a fifth of it.
MOST_BYTES = 5 * 2**20
# Of the page for what the pictures' section is written into, and for what changes with them.
_RESERVE_BYTES = 2**14

STYLES = ("report.css", "gallery.css", "front.css")


def main(arguments: Sequence[str] | None = None) -> int:
    parser = options_of_run("make_report.py", "Writes the report of a run as one HTML file.", "report.html")
    options = parser.parse_args(arguments)
    out = options.out or options.run / "report.html"
    return exit_code_of("make_report.py", lambda: write_page(out, make_page(load(options.run), options.run)))


def make_page(experiments: Sequence[Experiment], folder: Path) -> str:
    """The whole page. Raises RecordError when the charting library or esbuild is missing."""
    title = "Concave hulls: " + (experiments[0].title if len(experiments) == 1 else "the whole suite")
    front = make_front(folder, bool(mixture_sentence(experiments)))
    kept = folder / "report.html" if is_kept(folder, experiments) else None
    leader = front.ratings[0].standings[0].series.key if front.ratings else None
    report = {**_report(experiments), "leader": leader}
    sections = _sections(experiments, folder, front, kept)
    parts = {**code(STYLES, "main.js"), "colours": colours(report["methods"])}
    if kept is not None and any(experiment.is_thinned for experiment in experiments):
        kept_page = kept.read_text(encoding="utf-8")  # has what the records no longer have
        report |= {name: kept_data(kept_page, "report")[name] for name in ("experiments", "metrics")}
        results = [data(name, kept_data(kept_page, name)) for name in ("charts", "rows")]
    else:
        results = [data("charts", pack(charts(experiments))), data("rows", pack(columns(experiments)))]
    blocks = [data("report", report), data("parts", pack(listed_cases(front))), *results]

    def with_blocks(*more: str) -> str:
        return page(text(title), byline(experiments), sections, [*blocks, *more], parts)

    if kept is not None:
        return with_blocks(data("pictures", kept_data(kept.read_text(encoding="utf-8"), "pictures")))
    room = max(MOST_BYTES - _RESERVE_BYTES - len(with_blocks().encode()), MOST_BYTES // 5)
    return with_blocks(data("pictures", pack_pictures(experiments, room)))


def _sections(experiments: Sequence[Experiment], folder: Path, front: Front, kept: Path | None) -> list[Section]:
    summaries = [summarise(experiment) for experiment in experiments]
    pictures = kept_pictures(kept, experiments) if kept is not None else None
    strip = strip_html(experiments, front.ratings[0] if front.ratings else None, pictures)
    tables = tables_html(experiments, folder) or "<p>The run has no tables/tables.json.</p>"
    by_script = "The charts, the gallery and the table of all runs"
    parameters = parameters_html(experiments, folder)
    return [
        Section("summary", "Summary", "Summary", front_html(front, strip)),
        Section("where", "Who is good at what", "Who is good at what", where_html(front)),
        Section("results", "Charts", "Time and error", place("charts", by_script), testid="charts"),
        Section("gallery", "Gallery", "Gallery", place("gallery"), hidden=True),
        Section("runs", "All runs", "All runs", place("table")),
        Section("experiments", "By experiment", "Experiment by experiment", summary_html(experiments, summaries)),
        Section("paper", "Beside the paper", "Beside the paper", paper_html(experiments, folder)),
        Section("parameters-section", "Parameters", "Parameters", parameters, testid="parameters"),
        Section("environment", "Environment", "Environment and noise", environment_html(experiments)),
        Section("notes", "Notes", "Notes and tables", notes_html(experiments) + tables),
    ]


def _report(experiments: Sequence[Experiment]) -> dict[str, Any]:
    """What the page's scripts know from the start."""
    rows = [row for experiment in experiments for row in experiment.rows]
    metrics = MetricTable(experiments)
    return {
        "methods": method_styles(experiments),
        "entrants": entrants(experiments),
        "experiments": [{"name": one.name, "title": one.title, "seed": str(one.report["seed"])} for one in experiments],
        "metrics": [metrics.entry(name) for name in metrics.names(rows)],
    }


if __name__ == "__main__":
    sys.exit(main())
