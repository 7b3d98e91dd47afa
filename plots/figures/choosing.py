"""The cost of choosing: the error that a search for the parameter reaches after so many evaluations, beside what each method
gives without one. From tune.json in the run's folder."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from figures.sensitivity import read_tuning
from report_common import PROTOCOLS
from run import Drawn, Run, Skipped
from style import FULL_WIDTH, in_order, label, legend_below, method_style, new_figure, number

_COLUMNS = 5
_NO_SEARCH = -2.5  # its place on the axis
# By protocol: the marker of what is chosen without a search, left of its first evaluation.
_MARKERS = {"auto": "o", "default": "s", "tuned": "D"}


def draw(run: Run) -> Iterator[Drawn]:
    path, tuning = read_tuning(run)
    methods = {(one["method"], "tuned"): one for one in tuning["methods"] if one.get("search")}
    if not methods:
        raise Skipped(f"{path} says nothing of what a search costs; 'hullbench tune' of this version does")
    cases = max(one["search"][0]["cases"] for one in methods.values())
    yield Drawn(
        "choosing",
        _figure(methods),
        "The cost of choosing: the median L2 error after k evaluations of a search for the best parameter of each case, which "
        f"knows the truth, over {cases} test cases, with 95 % intervals by shape. One evaluation is a blind choice: "
        f"{tuning['budget']['sweep']} positions an octave apart are tried in random order, then "
        f"{tuning['budget']['refinement']} steps of a golden-section search. Left of it, without any search: "
        f"{_chosen_words()}. The further a mark lies above the end of the curve, the more the choice costs. Not drawn: where "
        "most cases fail.",
    )


def _chosen_words() -> str:
    return "; ".join(f"{one['name']}, {one['title']}" for one in PROTOCOLS["protocols"] if one["name"] in _MARKERS)


def _figure(methods: dict[tuple[str, str], dict[str, Any]]) -> Figure:
    every = in_order(methods)
    lines = math.ceil(len(every) / _COLUMNS)
    columns = min(_COLUMNS, len(every))
    figure = new_figure(FULL_WIDTH, 38 * lines + 10)
    grid = figure.add_gridspec(lines + 1, columns, height_ratios=[38] * lines + [6])
    panels: list[Axes] = []
    for k in range(len(every)):
        shared = {"sharex": panels[0], "sharey": panels[0]} if panels else {}
        panels.append(figure.add_subplot(grid[k // columns, k % columns], **shared))
    for axes, series in zip(panels, every):
        _panel(axes, methods[series], method_style(series[0]).color)
        axes.set_title(label(series, every), fontsize=7.5, pad=3)
    first = panels[0]
    first.set_yscale("log")
    first.set_ylim(*_limits(panels))
    first.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    first.yaxis.set_major_formatter(number)
    first.yaxis.set_minor_formatter(NullFormatter())
    first.set_xticks([_NO_SEARCH, 1, 5, 9, 15], ["none", "1", "5", "9", "15"])
    for k, axes in enumerate(panels):
        axes.tick_params(labelleft=k % columns == 0, labelbottom=k + columns >= len(every))
        if k % columns == 0:
            axes.set_ylabel("Median L2 error (%)")
        if k + columns >= len(every):
            axes.set_xlabel("Evaluations")
    handles = {text: handle for axes in panels for handle, text in zip(*axes.get_legend_handles_labels())}
    legend_below(figure.add_subplot(grid[lines, :]), handles.values(), handles.keys(), ncol=max(1, len(handles)))
    return figure


def _limits(panels: list[Axes]) -> tuple[float, float]:
    """Of all curves and marks; a band may go further."""
    values = np.concatenate([line.get_ydata() for axes in panels for line in axes.get_lines()])
    return values.min() / 1.2, values.max() * 1.2


def _panel(axes: Axes, method: dict[str, Any], color: str) -> None:
    search = [one for one in method["search"] if one["l2_median"] is not None]
    x = [one["evaluations"] for one in search]
    axes.plot(x, [100 * one["l2_median"] for one in search], color=color, linewidth=1.4)
    sure = [one for one in search if one["l2_interval"] and None not in one["l2_interval"]]
    ends = [[100 * one["l2_interval"][k] for one in sure] for k in (0, 1)]
    axes.fill_between([one["evaluations"] for one in sure], *ends, color=color, alpha=0.15, linewidth=0)
    for protocol in method["protocols"]:
        marker = _MARKERS.get(protocol["protocol"])
        if marker and protocol["l2_median"] is not None:
            y, look = 100 * protocol["l2_median"], {"color": "#222222", "markerfacecolor": "none", "markersize": 4}
            axes.plot([_NO_SEARCH], [y], marker, label=protocol["protocol"], **look)
