"""The page core/python/EXAMPLES.md: its blocks run one after the other and print what the page says.

    test_python_examples.py            run by ctest with the module in PYTHONPATH
    test_python_examples.py FOLDER     runs them in that folder, where the pictures stay: core/python, when they change
"""
import contextlib
import io
import os
import pathlib
import re
import sys
import tempfile
import unittest

PAGE = pathlib.Path(__file__).resolve().parent.parent / "core" / "python" / "EXAMPLES.md"


def blocks():
    """(line, code, what it prints) of every block of Python; a block of text after it is its output."""
    text = PAGE.read_text(encoding="utf-8")
    for found in re.finditer(r"^```python\n(.*?)^```\n(?:\n```text\n(.*?)^```\n)?", text, re.MULTILINE | re.DOTALL):
        yield text.count("\n", 0, found.start()) + 1, found[1], found[2] or ""


def printed(code, names, line):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile("\n" * line + code, str(PAGE), "exec"), names)
    return out.getvalue()


class Examples(unittest.TestCase):
    maxDiff = None

    def test_every_block_prints_what_the_page_says(self):
        names, count = {}, 0
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                for line, code, expected in blocks():
                    with self.subTest(line=line):
                        self.assertEqual(printed(code, names, line), expected)
                    count += 1
            finally:
                os.chdir(before)
            pictures = re.findall(r"\]\((\w+\.png)\)", PAGE.read_text(encoding="utf-8"))
            self.assertGreater(len(pictures), 0)
            for picture in pictures:
                self.assertTrue(pathlib.Path(folder, picture).exists(), f"no block draws {picture}")
                self.assertTrue((PAGE.parent / picture).exists(), f"{picture} is not beside the page")
        self.assertEqual(count, PAGE.read_text(encoding="utf-8").count("```python"))
        self.assertGreater(count, 5)


if __name__ == "__main__":
    os.environ.setdefault("MPLBACKEND", "Agg")
    if len(sys.argv) > 1:
        os.chdir(sys.argv[1])
        known = {}
        for line, code, _ in blocks():
            sys.stdout.write(printed(code, known, line))
    else:
        unittest.main()
