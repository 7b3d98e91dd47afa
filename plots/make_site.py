#!/usr/bin/python3
"""Writes the static pages of one or more runs: plain files, for any web server or opened from disk.

    make_site.py RUN... [--out FOLDER] [--listing FILE] [--demo FILE]

RUN is the folder of a run or suite that can be drawn; its name becomes its address, FOLDER/runs/NAME/. The newest one is at the
top of FOLDER, build/site, too. --listing is what `hullbench list --json` wrote: the newest run's pages then have what was not
measured, too. --demo is the page that tries the core, build-js/demo.html. A run's own report.html is kept; where there is none,
it is made. Exit codes: 0 ok; 1 a fault of ours, with its traceback; 2 when a run cannot be read, two have the same name, the
charting library or esbuild is missing or a file cannot be written.
"""

import argparse
import gzip
import json
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path
from urllib.parse import quote

import make_report
from page import PLOTS, byline, code, colours, data, method_styles, page
from records import SCHEMAS, RecordError, exit_code_of, read_json
from report_common import count_of, text
from report_tables import documents
from site_pages import FILE, PAGE, REPORT, TOP, Download, SitePage, pages_of
from site_run import SiteRun, load_run, with_listing

STYLES = (*make_report.STYLES, "site.css")
_LISTING = {"type": "object", "required": ["methods", "datasets"]}

_MENU = {
    "index.html": "Start",
    "methods/index.html": "Methods",
    "datasets/index.html": "Data sets",
    "zoo/index.html": "Zoo",
    "add.html": "Add your method",
    "downloads.html": "Downloads",
}
_SEARCH = """  <div class="search" id="search" role="search" hidden>
    <label for="search-words">Search</label>
    <input type="search" id="search-words" autocomplete="off" aria-controls="search-found">
    <p class="muted" id="search-said" role="status"></p>
    <ul id="search-found"></ul>
  </div>
"""
_RESULTS = {
    "cases.csv": "Every result with an error: method, case, error, time, status, kind of shape, way to sample",
    "league.csv": "The same of the evaluation on the shapes of the world",
    "league.json": "The league of that evaluation (league.schema.json)",
    "tune.json": "The search of every method’s parameter (tune.schema.json)",
    "tune.json.xz": "The search of every method’s parameter (tune.schema.json), compressed",
    "core.json": "The core’s speed from 1,000 to 10 million points, as Google Benchmark writes it",
    "tables/tables.json": "Every table as values (tables.schema.json)",
}


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="make_site.py", description="Writes the static pages of one or more runs.")
    parser.add_argument("runs", nargs="+", type=Path, metavar="RUN", help="folder of a run or of a suite that can be drawn")
    parser.add_argument(
        "--out", type=Path, default=PLOTS.parent / "build" / "site", metavar="FOLDER", help="where to write (build/site)"
    )
    parser.add_argument("--listing", type=Path, metavar="FILE", help="what 'hullbench list --json' wrote")
    parser.add_argument("--demo", type=Path, metavar="FILE", help="the page that tries the core, build-js/demo.html")
    options = parser.parse_args(arguments)
    return exit_code_of("make_site.py", lambda: write(options.out, options.runs, options.listing, options.demo))


def write(out: Path, folders: Sequence[Path], listing: Path | None = None, demo: Path | None = None) -> None:
    """Whole or not at all: the site that was at `out` is replaced when all pages are there. Raises RecordError where something
    else is there."""
    if out.exists() and not _is_empty_or_site(out):
        raise RecordError(f"{out} holds something that is no site, which would be lost; give another folder.")
    unfinished = out.with_name(f"{out.name}.unfinished")
    shutil.rmtree(unfinished, ignore_errors=True)
    try:
        count, runs = _write(unfinished, folders, listing, demo)
        shutil.rmtree(out, ignore_errors=True)
        unfinished.rename(out)
    finally:
        shutil.rmtree(unfinished, ignore_errors=True)
    print(f"wrote {out}: {count_of(count, 'page')} of {count_of(runs, 'run')}")


def _is_empty_or_site(out: Path) -> bool:
    return out.is_dir() and (not any(out.iterdir()) or (out / "runs").is_dir() and (out / "index.html").is_file())


def _write(out: Path, folders: Sequence[Path], listing: Path | None, demo: Path | None) -> tuple[int, int]:
    """How many pages of how many runs."""
    runs = sorted(map(load_run, folders), key=lambda one: (one.created, one.name), reverse=True)
    if len({one.name for one in runs}) < len(runs):
        raise RecordError("two runs have the same name, which is their address; give each once.")
    if listing:
        runs[0] = with_listing(runs[0], read_json(listing, _LISTING))
    own = code(STYLES, "site.js", charts=False)
    menu = {PAGE + address: words for address, words in _MENU.items()} | {REPORT: "Report"}
    if demo:
        out.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(demo, out / "demo.html")
        menu[f"{TOP}demo.html"] = "Try it"
    count = 0
    for run in runs:
        pages = pages_of(run, runs, _files(run, out / "runs" / run.name))
        index = data("pages", [[one.title, one.kind, PAGE + one.address, one.words.lower()] for one in pages])
        parts = {**own, "colours": colours(method_styles(run.experiments)), "contents": "Site", "search": _SEARCH}
        newer = "" if run is runs[0] else f" · <a href='{TOP}index.html'>there is a newer run</a>"
        said = f"{text(run.name)} · {byline(run.experiments)}{newer}"
        for one in pages:
            own_parts = {**parts, "head": f"{text(one.title)} · hullbench", "links": _links(menu, one)}
            made = page(text(one.title), said, one.sections, [index], own_parts)
            for base in (f"runs/{run.name}/", "") if run is runs[0] else (f"runs/{run.name}/",):
                _place(made, out, base, one.address, run.name)
                count += 1
    return count, len(runs)


def _links(menu: dict[str, str], one: SitePage) -> str:
    """The site's own list of pages, with the one that this page is or belongs to."""
    folder = one.address.rpartition("/")[0]
    found = ""
    for address, words in menu.items():
        here = address == PAGE + one.address
        inside = folder and address == f"{PAGE}{folder}/index.html"
        current = " aria-current='page'" if here else " aria-current='true'" if inside else ""
        found += f"<a href='{address}'{current}>{words}</a>\n"
    return found


def _place(made: str, out: Path, base: str, address: str, run: str) -> None:
    """Writes a page, whose links then are relative. `base`: of the run's pages; empty: they are at the top."""
    up = "../" * address.count("/")
    to_files = "" if base else f"runs/{quote(run)}/"
    for mark, way in ((PAGE, up), (FILE, up + to_files), (TOP, up + "../" * base.count("/"))):
        made = made.replace(mark, way)
    path = out / base / address
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(made, encoding="utf-8")


def _files(run: SiteRun, out: Path) -> list[Download]:
    """Copies what can be downloaded, and the report."""
    (out / "files" / "tables").mkdir(parents=True, exist_ok=True)
    (out / "files" / "schemas").mkdir(exist_ok=True)
    found = []

    def keep(address: str, kind: str, what: str, content: bytes) -> None:
        (out / address).write_bytes(content)
        found.append(Download(address, kind, what, len(content)))

    kept = run.folder / "report.html"
    report = kept.read_bytes() if kept.is_file() else make_report.make_page(run.experiments, run.folder).encode()
    keep("report.html", "Results", "The whole report: one file that needs no network", report)
    for name, what in _RESULTS.items():
        if (run.folder / name).is_file():
            keep(f"files/{name}", "Results", what, (run.folder / name).read_bytes())
    for one in run.experiments:
        plain = (one.folder / "report.json").read_bytes()
        what = f"{one.title}: all its runs with a summary (report.schema.json), compressed"
        keep(f"files/report-{one.name}.json.gz", "Records", what, gzip.compress(plain, 9, mtime=0))
    captions = {table["id"]: table["caption"] for one in documents(run.experiments, run.folder) for table in one["tables"]}
    for path in sorted((run.folder / "tables").glob("*.csv")):
        keep(f"files/tables/{path.name}", "Tables", captions.get(path.stem, ""), path.read_bytes())
    for path in sorted(SCHEMAS.glob("*.schema.json")):
        content = path.read_bytes()
        keep(f"files/schemas/{path.name}", "Schemas", json.loads(content).get("title", ""), content)
    return found


if __name__ == "__main__":
    sys.exit(main())
