"""The error of each letter and method, with the paper's where it gives one (the paper's Table IV)."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from records import Row, Series
from run import Drawn, Run, Skipped, failures
from style import FULL_WIDTH, in_order, label, legend_row, method_style, new_figure, role_color

_PREFIX = "letter_"
_COLUMNS = 3
_WHOLE = 0.9  # the share of the bars that is not cut off
_LETTERS = 26  # of which the paper's means are
_PAPER_MARKER = {"marker": "D", "markersize": 2.6, "markerfacecolor": "white", "markeredgewidth": 0.7}


def draw(run: Run) -> Iterator[Drawn]:
    rows = [row for row in run.experiment("alphabet").rows if row.dataset.startswith(_PREFIX)]
    if not any(row.metric("l2_paper") is not None for row in rows):
        raise Skipped("the alphabet experiment has no errors")
    published = paper_errors(run.paper)
    caption = (
        "Error of each capital letter in percent, one panel a method, all on the same axis; the line and the number are "
        "the mean over the letters. The error is the paper's here: the area of the symmetric difference over the area of "
        "the result. Diamonds are the paper's values where the data that came with it have them, the dashed line is its "
        f"mean; its letters are of another Garamond. Bars that reach the upper edge are longer. ×: no result. {failures(rows)}"
    )
    yield Drawn("alphabet", _figure(rows, published), caption.strip())


def paper_errors(paper: dict[str, Any]) -> dict[str, dict[str, float]]:
    """By method, then by letter ("" for the mean of all): the paper's error in percent."""
    errors: dict[str, dict[str, float]] = {}
    for collection in paper.get("collections", []):
        if _PREFIX not in collection["dataset_prefixes"]:
            continue
        for method, values in collection["methods"].items():
            errors.setdefault(method, {})[""] = values["l2_percent"][0]
        for dataset, by_method in collection.get("by_shape", {}).items():
            for method, value in by_method.items():
                if value is not None:
                    errors.setdefault(method, {})[dataset.removeprefix(_PREFIX)] = value
    return errors


def _figure(rows: list[Row], published: dict[str, dict[str, float]]) -> Figure:
    every = in_order(row.series for row in rows)
    letters = sorted({row.dataset.removeprefix(_PREFIX) for row in rows})
    lines = math.ceil(len(every) / _COLUMNS)
    figure = new_figure(FULL_WIDTH, 18 * lines + 10)
    grid = figure.add_gridspec(lines + 1, _COLUMNS, height_ratios=[18] * lines + [6])
    paper = {
        method: {key: value for key, value in values.items() if key or len(letters) == _LETTERS}
        for method, values in published.items()
    }  # a mean of all letters says nothing beside one of a few
    top = np.quantile([100 * row.metric("l2_paper") for row in rows if row.metric("l2_paper") is not None], _WHOLE)
    for k, one in enumerate(every):
        # Down the first column, then down the next.
        axes = figure.add_subplot(grid[k % lines, k // lines])
        of_one = [row for row in rows if row.series == one]
        _panel(axes, one, of_one, letters, paper.get(one[0], {}), label(one, every))
        axes.set_ylim(0, top)
        axes.yaxis.set_major_locator(MaxNLocator(4))
        last = k % lines == lines - 1 or k == len(every) - 1
        axes.set_xticks(range(len(letters)), [letter.upper() for letter in letters] if last else [], fontsize=5)
    figure.supylabel("Error (%)", fontsize=7.5)
    black = role_color("paper_value")
    legend_row(
        figure.add_subplot(grid[lines, :]),
        [
            Line2D([], [], linestyle="none", color=black, label="the paper's value", **_PAPER_MARKER),
            Line2D([], [], linestyle=(0, (3, 2)), linewidth=0.8, color=black, label="the paper's mean"),
        ],
        failures(rows),
    )
    return figure


def _panel(axes: Axes, one: Series, rows: list[Row], letters: list[str], paper: dict[str, float], name: str) -> None:
    look = method_style(one[0])
    errors = {row.dataset.removeprefix(_PREFIX): row.metric("l2_paper") for row in rows}
    known = {letter: 100 * error for letter, error in errors.items() if error is not None}
    axes.bar([letters.index(letter) for letter in known], list(known.values()), width=0.72, color=look.color, zorder=2)
    title = name
    if known and len(known) < len(letters):
        title += f"  no mean, {len(letters) - len(known)} without a result"  # of what succeeded it would flatter
    elif known:
        mean = sum(known.values()) / len(known)
        axes.axhline(mean, color=look.color, linewidth=0.9, zorder=3)
        title += f"  {mean:.1f} %"
    else:
        words = {"ha": "center", "va": "center", "fontsize": 7, "color": "#888888"}
        axes.text(0.5, 0.14, rows[0].status.replace("_", " "), transform=axes.transAxes, **words)
    if (mean := paper.get("")) is not None:
        axes.axhline(mean, color=role_color("paper_value"), linewidth=0.8, linestyle=(0, (3, 2)), zorder=4)
        title += f"  (paper {mean:.1f} %)"
    places = [(letters.index(letter), value) for letter, value in paper.items() if letter in letters]
    if places:
        axes.plot(*zip(*places), linestyle="none", color=role_color("paper_value"), zorder=5, **_PAPER_MARKER)
    axes.set_title(title, fontsize=6.5, loc="left", pad=3, fontweight="bold" if look.paper else "normal")
    axes.set_xlim(-0.7, len(letters) - 0.3)
    axes.grid(axis="x", visible=False)
    axes.tick_params(axis="x", length=0)
    for row in rows:
        if known and errors[row.dataset.removeprefix(_PREFIX)] is None:
            axes.text(letters.index(row.dataset.removeprefix(_PREFIX)), 0, "×", ha="center", va="bottom", fontsize=7)
