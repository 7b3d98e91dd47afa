"""What every page made here is put together from: its template, style sheets, scripts and data.

A page is one file that needs no network. Everything from records is escaped, and no script runs but the page's own.
"""

import base64
import hashlib
import json
import re
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from records import Experiment, RecordError
from report_common import in_order, label, method_look, text

PLOTS = Path(__file__).resolve().parent
PAGE = PLOTS / "report"
LIBRARY = PLOTS / "node_modules" / "echarts" / "dist" / "echarts.common.min.js"
BUNDLER = "esbuild"


@dataclass(frozen=True)
class Section:
    """Of a page."""

    identity: str
    link: str  # its name in the page's list of sections
    title: str
    content: str
    hidden: bool = False  # until a script shows it and its link
    testid: str = ""  # the identity, unless something else is said

    def link_html(self) -> str:
        return f"""<a href="#{self.identity}"{f' id="{self.identity}-link" hidden' if self.hidden else ''}>{self.link}</a>"""

    def html(self) -> str:
        return (
            f'<section id="{self.identity}" data-testid="{self.testid or self.identity}" '
            f'aria-labelledby="{self.identity}-title"{" hidden" if self.hidden else ""}>'
            f'<h2 id="{self.identity}-title">{self.title}</h2>{self.content}</section>'
        )


def place(name: str, without_scripts: str = "") -> str:
    """What a script fills; `without_scripts` says what is missing where scripts do not run."""
    said = f"{without_scripts} need JavaScript; everything else is readable without."
    return (f"<noscript><p>{said}</p></noscript>" if without_scripts else "") + f'<div id="{name}-place"></div>'


def page(title: str, byline: str, sections: Sequence[Section], blocks: Sequence[str], parts: dict[str, str]) -> str:
    """The whole page: `blocks` are its data(), `parts` its code() with its "colours". The parts may also say what the browser
    calls the page ("head"), what stands below the heading ("search") and what leads elsewhere ("links", which are called
    "contents"): the sections of the page, where nothing is said."""
    values = {
        "head": title,
        "search": "",
        "contents": "Sections",
        "links": "\n".join(section.link_html() for section in sections),
        **parts,
        "title": title,
        "byline": byline,
        "first": sections[0].link[:1].lower() + sections[0].link[1:],
        "first_id": sections[0].identity,
        "sections": "\n".join(section.html() for section in sections),
        "data": "\n".join(blocks),
    }
    source = (PAGE / "template.html").read_text(encoding="utf-8")
    # Once: a value that holds such a mark keeps it.
    return re.sub(r"\{\{(\w+)\}\}", lambda found: values[found.group(1)], source)


def byline(experiments: Sequence[Experiment]) -> str:
    """Program, date, number of runs and machine."""
    report = experiments[0].report
    runs = f"{sum(len(experiment.rows) for experiment in experiments):,}".replace(",", "\u202f")
    parts = (
        f"{report['tool']['name']} {report['tool']['version']}",
        report["created"][:10],
        f"{runs} runs",
        report["environment"]["cpu"]["model"],
        report["environment"]["os"] or "unknown system",
    )
    return " · ".join(text(part) for part in parts)


def code(styles: Sequence[str], script: str, charts: bool = True) -> dict[str, str]:
    """The template's values "style", "scripts" (the module of that name with all that it imports, and before it the charting
    library, unless the page has no `charts`) and "policy". Raises RecordError without the library or esbuild."""
    scripts = ([_library()] if charts else []) + [_bundle(script)]
    return {
        "style": "\n".join((PAGE / name).read_text(encoding="utf-8") for name in styles),
        "scripts": "\n".join(f"<script>{source}</script>" for source in scripts),
        "policy": _policy(scripts),
    }


def method_styles(experiments: Sequence[Experiment]) -> dict[str, Any]:
    """Of every method in the run: colours and marker."""
    names = {row.method for experiment in experiments for row in experiment.rows}
    looks = {name: method_look(name) for name in sorted(names.union(*(one.methods for one in experiments)))}
    return {name: {"marker": look["marker"], **look["color"]} for name, look in looks.items()}


def entrants(experiments: Sequence[Experiment]) -> list[dict[str, str]]:
    """Every method under every protocol that it has rows of, in the order in which the page names them."""
    every = in_order(one for experiment in experiments for one in experiment.series())
    return [{"key": one.key, "method": one.method, "protocol": one.protocol, "label": label(experiments, one)} for one in every]


def write_page(out: Path, page: str) -> None:
    """Writes the file and says so. Raises RecordError when it cannot be written."""
    try:
        out.write_text(page, encoding="utf-8")
    except OSError as error:
        raise RecordError(f"{out} cannot be written ({error.strerror}).") from error
    print(f"wrote {out} ({len(page.encode()) / 2**20:.1f} MiB)")


def colours(styles: dict[str, Any]) -> str:
    """A custom property for every method, in both themes."""

    def block(theme: str) -> str:
        return "".join(f"--method-{name}:{style[theme]};" for name, style in styles.items())

    swatches = "".join(f".swatch[data-method='{name}']{{background:var(--method-{name})}}" for name in styles)
    return (
        f":root{{{block('light')}}}:root[data-theme='dark']{{{block('dark')}}}"
        f"@media print{{:root[data-theme='dark']{{{block('light')}}}}}{swatches}"
    )


def data(identity: str, value: Any) -> str:
    """JSON that stays inside its element: "<" is written as an escape, so no text of a record can end the element."""
    written = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    return f"{_opening(identity)}{written}</script>"


def kept_data(page: str, identity: str) -> Any:
    """The value that data() put into the page; None: it has none of that name."""
    _, opening, rest = page.partition(_opening(identity))
    return json.loads(rest.partition("</script>")[0]) if opening else None


def _opening(identity: str) -> str:
    return f'<script type="application/json" id="{identity}">'


def _library() -> str:
    if not LIBRARY.is_file():
        raise RecordError("the charting library is missing; 'cmake/install-npm.sh plots' installs it.")
    return _in_script(LIBRARY.read_text(encoding="utf-8"))


def _bundle(name: str) -> str:
    command = [BUNDLER, name, "--bundle", "--format=iife", "--charset=utf8", "--log-level=warning"]
    try:
        made = subprocess.run(command, cwd=PAGE, stdout=subprocess.PIPE, encoding="utf-8", check=True)
    except FileNotFoundError as error:
        raise RecordError("esbuild, which puts the page's scripts together, is missing; 'make deps' installs it.") from error
    return _in_script(made.stdout)


def _in_script(source: str) -> str:
    """As it may stand inside of a script element, which "</script" ends and "<!--" disturbs, even in a text."""
    return source.replace("</script", "<\\/script").replace("<!--", "<\\!--")


def _policy(scripts: Sequence[str]) -> str:
    """No network at all, and no script but the page's own, by their hashes: markup that came in with a record would do
    nothing. Styles are free, as the charts' labels set their own."""
    hashes = " ".join(f"'sha256-{base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()}'" for script in scripts)
    return (
        f"default-src 'none'; script-src {hashes}; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; "
        "form-action 'none'"
    )
