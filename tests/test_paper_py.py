"""plots/make_paper.py: what stands in the LaTeX, and what is said without LaTeX; the PDF itself where LaTeX is installed."""

import os
import shutil
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import plot_samples
from plot_tests import call  # first, for what is in plots/

import make_paper
from records import load
from run import Drawn
from style import FULL_WIDTH, ONE_COLUMN, new_figure


def table(columns: int) -> dict:
    titles = [{"title": "Method", "kind": "words"}, *[{"title": "%", "kind": "number"}] * (columns - 1)]
    cells = {"columns": titles, "rows": [[{"text": "a_b", "notes": [1]}, *[{"text": "", "notes": [2, 3]}] * (columns - 1)]]}
    return {"id": "t", "caption": "Times of 100 %", "remarks": ["Slow & sure."], **cells}


class Paper(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        plot_samples.write_suite(cls.folder, {"steps": plot_samples.suite()["steps"]})
        cls.experiments = load(cls.folder)

    def run_it(self, **environment: str) -> tuple[int, str]:
        names = mock.patch.object(make_paper, "NAMES", ("steps", "alphabet"))
        with mock.patch.dict(os.environ, environment), names:
            code, _, err = call(make_paper.main, self.folder, "--out", self.folder / "paper.pdf")
        return code, err

    def test_captions_say_what_was_measured_where(self) -> None:
        one = Drawn("steps", new_figure(FULL_WIDTH, 50), "Time of 50 % of <all> steps τ")
        told = make_paper.document(self.experiments, self.folder, [one], [table(2)], {"alphabet": "no letters"})
        report = self.experiments[0].report
        for words in (
            r"Time of 50 \% of \textless{}all\textgreater{} steps $\tau$",
            rf"{len(self.experiments[0].rows)} runs of {report['repetitions']} repetitions",
            make_paper.escaped(report["environment"]["cpu"]["model"]),
            "Intervals are of 95",
            "Not in this run: alphabet.",
            r"Slow \& sure.",
            "\\begin{tabular}{lr}\\toprule\nMethod & \\% \\\\\n\\midrule\na\\_b & [2] [3] \\\\\n\\bottomrule\\end{tabular}",
        ):
            self.assertIn(words, told)
        self.assertEqual(told.count("repetitions, begun"), 3)  # at the beginning, of the figure and of the table

    def test_a_figure_of_one_column_stays_in_it_and_a_wide_table_lies(self) -> None:
        narrow = make_paper._figure(Drawn("f", new_figure(ONE_COLUMN, 50), ""), "")
        self.assertIn(r"\begin{figure}\centering\fitted{\columnwidth}", narrow)
        self.assertIn(r"\begin{figure*}", make_paper._figure(Drawn("f", new_figure(FULL_WIDTH, 50), ""), ""))
        self.assertIn(r"\begin{sidewaystable*}", make_paper._table(table(30), ""))
        self.assertIn(r"\begin{table*}", make_paper._table(table(9), ""))
        self.assertIn(r"\begin{table}", make_paper._table(table(2), ""))

    def test_every_letter_becomes_plain(self) -> None:
        self.assertEqual(make_paper.escaped("a_b é ☃ 3 ≤ ∞"), r"a\_b e ? 3 $\leq$ $\infty$")

    def test_without_latex_it_says_what_is_missing(self) -> None:
        code, said = self.run_it(PATH="/nowhere")
        self.assertEqual((code, len(said.splitlines())), (2, 1))
        self.assertIn("texlive-latex-recommended", said)

    @unittest.skipUnless(shutil.which(make_paper.PROGRAM), "LaTeX is not installed")
    def test_the_pdf_is_made_and_a_fault_in_latex_is_told(self) -> None:
        self.assertEqual(self.run_it(), (0, ""))
        self.assertEqual((self.folder / "paper.pdf").read_bytes()[:5], b"%PDF-")
        with mock.patch.object(make_paper, "_HEAD", r"\documentclass{article}\undefinedcommand"):
            code, said = self.run_it()
        self.assertEqual(code, 2)
        self.assertIn("Undefined control sequence", said)


if __name__ == "__main__":
    unittest.main()
