#!/usr/bin/python3
"""Puts all figures and tables of a run into one PDF, in a journal's column widths, with captions that say what was measured on
which machine.

    make_paper.py [RUN] [--out FILE]

RUN is the folder of a run or of a suite, results/latest if it is not given; FILE is RUN/paper.pdf, and the LaTeX is left beside
it in FILE's folder paper/, for a manuscript. Exit codes: 0 ok; 1 a fault of ours, with its traceback; 2 when the run cannot be
read, pdflatex is missing or complains, or the file cannot be written; 6 when the run has nothing to be drawn.
"""

import shutil
import subprocess
import sys
import unicodedata
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from make_figures import NAMES, draw_all
from records import Experiment, NothingToShow, RecordError, exit_code_of, load, options_of_run
from report_common import protocol_words, sentence_list
from report_tables import documents
from run import Drawn, Run, read_paper
from style import MILLIMETRE, ONE_COLUMN

PROGRAM = "pdflatex"
# A table with more columns stands on its side.
_MOST_UPRIGHT = 13
_SIGNS = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    **{one: "\\" + one for one in "{}$&#_%"},
    "τ": r"$\tau$",
    "α": r"$\alpha$",
    "χ": r"$\chi$",
    "µ": r"\textmu{}",
    "≤": r"$\leq$",
    "≥": r"$\geq$",
    "×": r"$\times$",
    "÷": r"$\div$",
    "∞": r"$\infty$",
    "±": r"$\pm$",
    "²": r"\textsuperscript{2}",
    "–": "--",
    "—": "---",
    "…": r"\dots{}",
    "’": "'",
    "†": r"\textdagger{}",
    "√": r"$\surd$",
}
_HEAD = r"""\documentclass[10pt,twocolumn]{article}
\usepackage[a4paper,left=15mm,right=15mm,top=18mm,bottom=18mm,columnsep=10mm]{geometry}
\usepackage[T1]{fontenc}
\usepackage{mathptmx,textcomp,booktabs,graphicx,rotating,caption}
\captionsetup{font=footnotesize,labelfont=bf}
\setcounter{topnumber}{4}\setcounter{dbltopnumber}{4}\setcounter{totalnumber}{6}
\renewcommand{\topfraction}{0.95}\renewcommand{\dbltopfraction}{0.95}\renewcommand{\textfraction}{0.02}
\renewcommand{\floatpagefraction}{0.6}\renewcommand{\dblfloatpagefraction}{0.6}
\newsavebox{\fittedbox}
% \fitted{width}{height}{what}: what is larger than its place is made smaller, and nothing else.
\newcommand{\fitted}[3]{\sbox{\fittedbox}{#3}%
\ifdim\wd\fittedbox>#1\sbox{\fittedbox}{\resizebox{#1}{!}{\usebox{\fittedbox}}}\fi
\ifdim\dimexpr\ht\fittedbox+\dp\fittedbox\relax>#2\sbox{\fittedbox}{\resizebox{!}{#2}{\usebox{\fittedbox}}}\fi
\usebox{\fittedbox}}
"""


def main(arguments: Sequence[str] | None = None) -> int:
    parser = options_of_run("make_paper.py", "Puts a run's figures and tables into one PDF.", "paper.pdf")
    options = parser.parse_args(arguments)
    return exit_code_of("make_paper.py", lambda: write(options.run, options.out or options.run / "paper.pdf"))


def write(folder: Path, out: Path) -> None:
    if shutil.which(PROGRAM) is None:
        raise RecordError(f"{PROGRAM} is missing; Debian's texlive-latex-recommended and texlive-fonts-recommended have it.")
    experiments = load(folder)
    place = out.parent / "paper"
    drawn, skipped = draw_all(Run(folder, experiments, read_paper()), list(NAMES), place)
    tables = [table for document in documents(experiments, folder) for table in document["tables"]]
    if not drawn and not tables:
        raise NothingToShow(f"{folder} has neither figures nor tables.")
    (place / "paper.tex").write_text(document(experiments, folder, drawn, tables, skipped), encoding="utf-8")
    _compile(place)
    shutil.copy(place / "paper.pdf", out)
    print(f"wrote {out}: {len(drawn)} figures, {len(tables)} tables")


def document(
    experiments: Sequence[Experiment],
    folder: Path,
    drawn: Sequence[Drawn],
    tables: Sequence[dict[str, Any]],
    skipped: dict[str, str],
) -> str:
    """The whole of paper.tex, which finds its figures beside it."""
    measured = escaped(measured_words(experiments))
    name = escaped(folder.resolve().name)
    parts = [
        _HEAD,
        rf"\title{{Figures and tables of the run {name}}}\author{{}}\date{{}}",
        r"\begin{document}\maketitle\noindent",
    ]
    parts.append(rf"{measured} {escaped(protocols(experiments))}")
    if skipped:
        parts.append(rf"\par\noindent Not in this run: {escaped(sentence_list(list(skipped)))}.")
    parts += [_figure(one, measured) for one in drawn]
    parts += [_table(one, measured) for one in tables]
    return "\n".join([*parts, r"\end{document}", ""])


def measured_words(experiments: Sequence[Experiment]) -> str:
    """How many runs, repeated how often, on which machine, with which program."""
    report = experiments[0].report
    environment, tool = report["environment"], report["tool"]
    counts = sorted({experiment.report["repetitions"] for experiment in experiments})
    times = f"{counts[0]}" if len(counts) == 1 else f"{counts[0]} to {counts[-1]}"
    runs = sum(len(experiment.rows) for experiment in experiments)
    commit = f", commit {tool['commit'][:12]}" if tool["commit"] else ""
    return (
        f"{runs:,} runs of {times} repetition{'' if times == '1' else 's'}, begun {report['created'][:10]}, on {environment['cpu']['model']}, "
        f"{environment['os'] or 'unknown system'}, {environment['compiler']['id']} {environment['compiler']['version']}; "
        f"{tool['name']} {tool['version']}{commit}."
    )


def protocols(experiments: Sequence[Experiment]) -> str:
    told = "; ".join(f"{name}, {words}" for name, words in protocol_words(experiments).items())
    return f"Who chose the parameters: {told}. Intervals are of 95 %."


def escaped(words: str) -> str:
    """As LaTeX's text. Letters that its fonts lack become the nearest plain ones."""

    def one(letter: str) -> str:
        plain = unicodedata.normalize("NFKD", letter).encode("ascii", "ignore").decode()
        return _SIGNS.get(letter) or (letter if letter.isascii() else plain or "?")

    return "".join(map(one, words))


def _figure(one: Drawn, measured: str) -> str:
    """In one column where it was drawn for one."""
    narrow = one.figure.get_figwidth() / MILLIMETRE <= ONE_COLUMN + 1
    star, width = ("", r"\columnwidth") if narrow else ("*", r"\textwidth")
    caption = rf"\caption{{{escaped(one.caption)} {measured}}}\label{{fig:{one.name}}}"
    fitting = rf"\fitted{{{width}}}{{0.8\textheight}}{{\includegraphics{{{one.name}.pdf}}}}"
    return rf"\begin{{figure{star}}}\centering{fitting}{caption}\end{{figure{star}}}"


def tabular(table: dict[str, Any]) -> str:
    """With the rules of booktabs. Marks of notes stand only where a cell has nothing else: the notes are in the Markdown."""
    sides = "".join("l" if column["kind"] == "words" else "r" for column in table["columns"])
    head = [column["title"] for column in table["columns"]]
    body = [[cell["text"] or " ".join(f"[{note}]" for note in cell.get("notes", [])) for cell in row] for row in table["rows"]]
    first, *lines = (" & ".join(map(escaped, cells)) + r" \\" for cells in [head, *body])
    return "\n".join([rf"\begin{{tabular}}{{{sides}}}\toprule", first, r"\midrule", *lines, r"\bottomrule\end{tabular}"])


def _table(table: dict[str, Any], measured: str) -> str:
    """With its remarks in the caption, which a journal wants above it."""
    columns = len(table["columns"])
    upright = columns <= _MOST_UPRIGHT
    kind, width, height = (
        ("table*", r"\textwidth", r"0.8\textheight") if upright else ("sidewaystable*", r"\textheight", r"0.8\textwidth")
    )
    if columns <= 4 and max((len(cell["text"]) for row in table["rows"] for cell in row), default=0) < 20:
        kind, width = "table", r"\columnwidth"
    remarks = " ".join([f"{table['caption']}.", *table["remarks"]])
    caption = rf"\caption{{{escaped(remarks)} {measured}}}\label{{tab:{table['id']}}}"
    return rf"\begin{{{kind}}}\centering\scriptsize{caption}\fitted{{{width}}}{{{height}}}{{{tabular(table)}}}\end{{{kind}}}"


def _compile(place: Path) -> None:
    """Twice, for the labels."""
    command = [PROGRAM, "-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape", "paper.tex"]
    for _ in range(2):
        output = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "encoding": "utf-8", "errors": "replace"}
        made = subprocess.run(command, cwd=place, check=False, **output)
        if made.returncode != 0:
            said = next((line for line in made.stdout.splitlines() if line.startswith("!")), "no reason given")
            raise RecordError(f"{PROGRAM} could not make {place / 'paper.tex'} ({said}); {place / 'paper.log'} has more.")


if __name__ == "__main__":
    sys.exit(main())
