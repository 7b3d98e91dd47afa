"""The HTML that all pages are made of. What is handed in is HTML, unless it is said to be words."""

from collections.abc import Iterable, Mapping, Sequence

from report_common import text

Columns = Mapping[str, str]  # of a table, by their titles in words: the classes of their cells, such as "number", or none


def table(columns: Columns, rows: Iterable[Sequence[object]] | str, attributes: str = "", caption: str = "") -> str:
    """`caption` is words; the rows are their cells, or lines by row_of()."""
    heads = "".join(f"<th scope='col'{_class(css, 'number')}>{text(title)}</th>" for title, css in columns.items())
    body = rows if isinstance(rows, str) else "".join(row_of(columns, row) for row in rows)
    body = body if body.startswith("<tbody") else f"<tbody>{body}</tbody>"
    above = f"<caption>{text(caption)}</caption>" if caption else ""
    return f"<table{attributes}>{above}<thead><tr>{heads}</tr></thead>{body}</table>"


def table_of(
    label: str, columns: Columns, rows: Iterable[Sequence[object]] | str, attributes: str = "", caption: str = ""
) -> str:
    """As table(), in a place of that name where it can be scrolled."""
    return scroll(label, table(columns, rows, attributes, caption))


def row_of(columns: Columns, cells: Sequence[object], attributes: str = "") -> str:
    """A line of a table: its heading, then the cells, of which one that is a whole <td> stays as it is."""
    first, *rest = map(str, cells)
    _, *classes = columns.values()
    made = (one if one.startswith("<td") else f"<td{_class(css)}>{one}</td>" for css, one in zip(classes, rest, strict=True))
    return f"<tr{attributes}><th scope='row'>{first}</th>{''.join(made)}</tr>"


def _class(css: str, begins: str = "") -> str:
    return f" class='{css}'" if css and css.startswith(begins) else ""


def scroll(label: str, wide: str, attributes: str = "") -> str:
    return f"<div class='scroll' tabindex='0' role='region' aria-label='{text(label)}'{attributes}>{wide}</div>"


def details(words: str, inner: str, attributes: str = "") -> str:
    """Behind a click."""
    return f"<details{attributes}><summary>{text(words)}</summary>{inner}</details>"


def list_of(words: Iterable[object], attributes: str = "") -> str:
    """Empty without any."""
    items = "".join(f"<li>{text(one)}</li>" for one in words)
    return f"<ul{attributes}>{items}</ul>" if items else ""


def notes_of(words: Iterable[object]) -> str:
    return list_of(words, " class='notes'")


def facts_of(facts: Mapping[str, str], identity: str = "") -> str:
    """Names in words, and what is to be said of them."""
    rows = "".join(f"<div><dt>{text(name)}</dt><dd>{told}</dd></div>" for name, told in facts.items())
    named = f" id='{identity}'" if identity else ""
    return f"<dl{named}>{rows}</dl>"


def finding(identity: str, title: str, body: str, css: str = "finding") -> str:
    return f"<div class='{css}' id='{identity}'><h3>{text(title)}</h3>{body}</div>"


def named(method: str, name: str) -> str:
    """A name behind the method's colour."""
    return f"<span class='swatch' data-method='{text(method)}'></span>{name}"


def link_to_method(words: str, method: str, pages: Mapping[str, str]) -> str:
    """The name; where the method has a page, a link to it."""
    return f"<a href='{text(pages[method])}'>{text(words)}</a>" if method in pages else text(words)
