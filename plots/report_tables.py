"""Turns the tables.md of a run into HTML: headings, tables, lists and paragraphs, which is all that it has."""

from __future__ import annotations

import re
from dataclasses import dataclass

from report_common import text

_RULE = re.compile(r"^\|[\s:|-]+\|$")
_REFERENCE = re.compile(r"\[(\d+)\]")


@dataclass
class Section:
    """What stands under one heading of the second level."""

    title: str
    blocks: list[tuple[str, list[str]]]  # (kind, lines); kind: heading, table, list or paragraph


def sections(markdown: str) -> list[Section]:
    """In the file's order. Text before the first such heading is left out: the file has none."""
    found: list[Section] = []
    for line in markdown.splitlines():
        if line.startswith("## "):
            found.append(Section(line[3:].strip(), []))
        elif found:
            _take(found[-1].blocks, line)
    for section in found:
        section.blocks = [(kind, lines) for kind, lines in section.blocks if kind != "gap"]
    return found


def _take(blocks: list[tuple[str, list[str]]], line: str) -> None:
    last = blocks[-1] if blocks else ("gap", [])
    if not line.strip():
        blocks.append(("gap", []))
    elif line.startswith("### "):
        blocks.append(("heading", [line[4:].strip()]))
    elif line.startswith("|"):
        if last[0] != "table":
            blocks.append(("table", []))
        blocks[-1][1].append(line)
    elif line.startswith("- "):
        if last[0] != "list":
            blocks.append(("list", []))
        blocks[-1][1].append(line[2:].strip())
    elif last[0] in ("list", "paragraph"):
        last[1][-1] += " " + line.strip()
    else:
        blocks.append(("paragraph", [line.strip()]))


def to_html(section: Section, identity: str) -> str:
    """The blocks of a section. References such as [3] in its tables lead to the notes that begin so."""
    made, part = [], 0
    for kind, lines in section.blocks:
        if kind == "heading":
            part += 1
            made.append(f"<h3>{text(lines[0])}</h3>")
        elif kind == "table":
            made.append(_table(lines, f"{identity}-{part}"))
        elif kind == "list":
            # The notes of an experiment stand under a heading of their own and belong to all its tables.
            made.append("<ul class='notes'>" + "".join(f"<li>{text(line)}</li>" for line in lines) + "</ul>")
        else:
            made.append("".join(f"<p>{text(line)}</p>" for line in lines))
    return "\n".join(made)


def _cells(line: str) -> list[str]:
    return [cell.replace("\\|", "|").strip() for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]


def _table(lines: list[str], identity: str) -> str:
    rule = next((line for line in lines if _RULE.match(line)), "")
    right = [cell.endswith(":") for cell in _cells(rule)]
    rows = [_cells(line) for line in lines if line != rule]
    head = rows[0] if rows else []

    def cell(tag: str, column: int, content: str, more: str = "") -> str:
        side = " class='number'" if column < len(right) and right[column] else ""
        marked = _REFERENCE.sub(r"<sup>[\1]</sup>", text(content))
        return f"<{tag}{side}{more}>{marked}</{tag}>"

    top = "".join(cell("th", column, content, " scope='col'") for column, content in enumerate(head))
    body = "".join(
        "<tr>"
        + "".join(
            cell("th" if column == 0 else "td", column, content, " scope='row'" if column == 0 else "")
            for column, content in enumerate(row)
        )
        + "</tr>"
        for row in rows[1:]
    )
    return (
        f"<div class='scroll' tabindex='0' role='region' aria-label='Table' id='{text(identity)}'>"
        f"<table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table></div>"
    )
