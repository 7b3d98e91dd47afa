"""The tables of a run or suite, which the program left as values (results/tables.schema.json), as HTML."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from markup import notes_of, scroll
from records import Experiment, read_json
from report_common import text


def documents(experiments: Sequence[Experiment], folder: Path) -> list[dict[str, Any]]:
    """Tables under a title each, with notes: those of the suite in `folder`, or else of each run."""
    return _read(folder) or [document for experiment in experiments for document in _read(experiment.folder)]


def _read(folder: Path) -> list[dict[str, Any]]:
    path = folder / "tables" / "tables.json"
    remedy = f"; 'hullbench tables {folder} --write' makes it anew"
    return read_json(path, "tables.schema.json", remedy)["documents"] if path.is_file() else []


def tables_called(found: Sequence[dict[str, Any]], identity: str) -> list[dict[str, Any]]:
    """Those with this id."""
    return [table for document in found for table in document["tables"] if table["id"] == identity]


def table_html(table: dict[str, Any]) -> str:
    """With its caption above it and its remarks below it."""
    sides = [" class='number'" if column["kind"] == "number" else "" for column in table["columns"]]
    head = "".join(f"<th{side} scope='col'>{text(column['title'])}</th>" for side, column in zip(sides, table["columns"]))
    body = "".join(f"<tr>{_row(sides, row)}</tr>" for row in table["rows"])
    shown = f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
    remarks = notes_of(table["remarks"])
    identity = f" id='table-{text(table['id'])}'"
    return f"<h3>{text(table['caption'])}</h3>{scroll(table['caption'], shown, identity)}{remarks}"


def _row(sides: Sequence[str], cells: Sequence[dict[str, Any]]) -> str:
    shown = [
        " ".join([text(cell["text"]), *(f"<sup>[{int(note)}]</sup>" for note in cell.get("notes", []))]).strip()
        for cell in cells
    ]
    return f"<th{sides[0]} scope='row'>{shown[0]}</th>" + "".join(
        f"<td{side}>{one}</td>" for side, one in zip(sides[1:], shown[1:])
    )
