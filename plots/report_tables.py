"""The tables of a run or suite, which the program left as values (results/tables.schema.json), as HTML."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from records import Experiment, RecordError
from report_common import text


def documents(experiments: Sequence[Experiment], folder: Path) -> list[dict[str, Any]]:
    """Tables under a title each, with notes: those of the suite in `folder`, or else of each run."""
    return _read(folder) or [document for experiment in experiments for document in _read(experiment.folder)]


def _read(folder: Path) -> list[dict[str, Any]]:
    path = folder / "tables" / "tables.json"
    try:
        return json.loads(path.read_text(encoding="utf-8"))["documents"] if path.is_file() else []
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise RecordError(
            f"{path} cannot be read ({error}); 'hullbench tables {folder} --write' makes it anew."
        ) from error


def tables_beside(found: Sequence[dict[str, Any]], identity: str) -> list[dict[str, Any]]:
    """The tables under the same title as the one with this id; none when there is none."""
    return [
        table
        for document in found
        if any(one["id"] == identity for one in document["tables"])
        for table in document["tables"]
    ]


def list_html(sentences: Sequence[str]) -> str:
    return "<ul class='notes'>" + "".join(f"<li>{text(one)}</li>" for one in sentences) + "</ul>" if sentences else ""


def table_html(table: dict[str, Any]) -> str:
    """With its caption above it and its remarks below it."""
    sides = [" class='number'" if column["kind"] == "number" else "" for column in table["columns"]]
    head = "".join(
        f"<th{side} scope='col'>{text(column['title'])}</th>" for side, column in zip(sides, table["columns"])
    )
    body = "".join(f"<tr>{_row(sides, row)}</tr>" for row in table["rows"])
    return (
        f"<h3>{text(table['caption'])}</h3>"
        f"<div class='scroll' tabindex='0' role='region' aria-label='Table' id='table-{text(table['id'])}'>"
        f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>{list_html(table['remarks'])}"
    )


def _row(sides: Sequence[str], cells: Sequence[dict[str, Any]]) -> str:
    shown = [
        " ".join([text(cell["text"]), *(f"<sup>[{int(note)}]</sup>" for note in cell.get("notes", []))]).strip()
        for cell in cells
    ]
    return f"<th{sides[0]} scope='row'>{shown[0]}</th>" + "".join(
        f"<td{side}>{one}</td>" for side, one in zip(sides[1:], shown[1:])
    )
