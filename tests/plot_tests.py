"""What the tests of plots/ have in common. Whoever imports it can import the programs of plots/, too."""

import contextlib
import html.parser
import io
import sys
import tempfile
import unittest
from collections.abc import Callable
from pathlib import Path

PLOTS = Path(__file__).resolve().parent.parent / "plots"
sys.path.insert(0, str(PLOTS))


def call(main: Callable[[list[str]], int], *arguments: object) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of a program."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main([str(one) for one in arguments])
    return code, out.getvalue(), err.getvalue()


class WithFolder(unittest.TestCase):
    """Each test has a folder of its own."""

    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))


class Elements(html.parser.HTMLParser):
    """Of a page as a browser sees it: (tag, attribute, value), the tags, and the id of each script with its text."""

    def __init__(self, source: str) -> None:
        super().__init__()
        self.source = source
        self.tags: list[str] = []
        self.attributes: list[tuple[str, str, str]] = []
        self.scripts: list[tuple[str | None, str]] = []
        self.inside = False
        self.feed(source)
        self.ids = [value for _, name, value in self.attributes if name == "id"]
        # The only content of a <meta> that names sources.
        self.policy = next(
            value for tag, name, value in self.attributes if (tag, name) == ("meta", "content") and "src" in value
        )

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += [(tag, name, value or "") for name, value in attributes]
        self.inside = tag == "script"
        if self.inside:
            self.scripts.append((dict(attributes).get("id"), ""))

    def handle_endtag(self, tag: str) -> None:
        self.inside = self.inside and tag != "script"

    def handle_data(self, data: str) -> None:
        if self.inside:
            identity, before = self.scripts[-1]
            self.scripts[-1] = identity, before + data
