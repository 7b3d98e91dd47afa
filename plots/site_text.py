"""What the site takes from the project's own texts, so that nothing is said twice: tables and checklists of its READMEs."""

from __future__ import annotations

import itertools
import re

from page import PLOTS
from records import RecordError
from report_common import text

ROOT = PLOTS.parent
_LINK = re.compile(r"\[([^\]]+)\]\(([^)\s]+)\)")
_ADDRESS = re.compile(r"https?://[^\s,<>\"']*[^\s,;.)<>\"']")


def table_rows(name: str, first: str) -> list[list[str]]:
    """The cells, in Markdown, of the table whose first column is called so. Raises RecordError when there is none."""
    lines = (ROOT / name).read_text(encoding="utf-8").splitlines()
    starts = [place for place, line in enumerate(lines) if line.startswith("|") and _cells(line)[0] == first]
    if not starts:
        raise RecordError(f"{ROOT / name} has no table whose first column is called {first}.")
    return [_cells(line) for line in itertools.takewhile(lambda line: line.startswith("|"), lines[starts[0] + 2 :])]


def _cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def part_of(name: str, heading: str) -> str:
    """What stands under the heading, such as "### A method", in Markdown. Raises RecordError when there is none."""
    whole = (ROOT / name).read_text(encoding="utf-8")
    found = re.search(rf"^{re.escape(heading)}\n(.*?)(?=^#|\Z)", whole, re.DOTALL | re.MULTILINE)
    if found is None:
        raise RecordError(f"{ROOT / name} has no heading {heading!r}.")
    return found.group(1)


def names_in(markdown: str) -> list[str]:
    """`one`, `another`"""
    return re.findall(r"`([^`]+)`", markdown)


def inline(markdown: str) -> str:
    """As HTML. A link into the repository stays a text."""
    made = re.sub(r"`([^`]+)`", r"<code>\1</code>", text(markdown))
    return _LINK.sub(lambda one: f"<a href='{one[2]}'>{one[1]}</a>" if one[2].startswith("https:") else one[1], made)


def blocks(markdown: str) -> str:
    """Paragraphs and checklists, whose boxes are steps."""
    made = ""
    for block in re.split(r"\n{2,}", markdown.strip("\n")):
        if block.startswith("- "):
            items = re.split(r"^- (?:\[ \] )?", block, flags=re.MULTILINE)[1:]
            made += "<ol class='steps'>" + "".join(f"<li>{inline(' '.join(item.split()))}</li>" for item in items) + "</ol>"
        else:
            made += f"<p>{inline(' '.join(block.split()))}</p>"
    return made


def linked(words: str) -> str:
    """A record's text as HTML, in which addresses are links."""
    made, end = "", 0
    for one in _ADDRESS.finditer(words):
        made += f"{text(words[end : one.start()])}<a href='{text(one[0])}'>{text(one[0])}</a>"
        end = one.end()
    return made + text(words[end:]) or "–"
