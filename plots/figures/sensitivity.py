"""How much a method's error depends on its parameter: the sensitivity curves of tune.json in the run's folder."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from records import read_json
from run import Drawn, Run, Skipped
from style import FULL_WIDTH, curve_options, in_order, label, legend_below, method_style, new_figure, number, panel_letter

_LEGEND_COLUMNS = 3
_WORST = 10.0  # of the error's axis, in errors of the oracle


def draw(run: Run) -> Iterator[Drawn]:
    path, tuning = read_tuning(run)
    methods = [one for one in tuning["methods"] if one["tuned"] and len(one["curve"]) > 1]
    if not methods:
        raise Skipped(f"{path} has no method with a parameter to search")
    figure = _figure(methods)
    cases = max(point["cases"] for one in methods for point in one["curve"])
    caption = (
        "Sensitivity: L2 error against the method's parameter, as a multiple of the least error that the method has on the case "
        f"at any of these values; medians over up to {cases} training cases, without those where every value fails; the bands of the paper's methods hold the middle half. (a) parameters that "
        "are lengths, in spacings h (the square root of the area of the points' convex hull over their number), one axis "
        "for all of them; (b) any parameter, in octaves from the one that is best on the training shapes. The wider the "
        "valley, the less the choice matters; the octaves beside the names are the tolerance, the width in which the error "
        f"stays within 10 % of its best (median over the test cases). What is above {_WORST:g} or fails is not shown."
    )
    yield Drawn("sensitivity", figure, caption)


def read_tuning(run: Run) -> tuple[Path, dict[str, Any]]:
    """The file of the search and what is in it. Raises Skipped without one."""
    path = run.file("tune.json", "tune.json.xz", maker="'make evaluate' writes it")
    return path, read_json(path, "tune.schema.json", "; 'hullbench tune' writes it")


def _figure(methods: list[dict[str, Any]]) -> Figure:
    lengths = [one for one in methods if one["axis"]["kind"] == "spacings"]
    panels = ([(lengths, False)] if lengths else []) + [(methods, True)]
    below = 4.5 * -(-len(methods) // _LEGEND_COLUMNS)
    figure = new_figure(FULL_WIDTH, 74 + below)
    grid = figure.add_gridspec(2, len(panels), height_ratios=[74, below])
    for k, (shown, octaves) in enumerate(panels):
        axes = figure.add_subplot(grid[0, k])
        _panel(axes, shown, octaves)
        letter = "ab"[k] if len(panels) > 1 else ""
        panel_letter(axes, letter, "any parameter" if octaves else "lengths, in spacings")
        axes.set_xlabel("Parameter over the tuned one" if octaves else "Parameter (spacings h)")
    figure.axes[0].set_ylabel("L2 error over the method's best")
    handles, titles = figure.axes[-1].get_legend_handles_labels()
    legend_below(figure.add_subplot(grid[1, :]), handles, titles, ncol=_LEGEND_COLUMNS, handlelength=2.8, columnspacing=1.6)
    return figure


def _panel(axes: Axes, methods: list[dict[str, Any]], octaves: bool) -> None:
    by_series = {(one["method"], "tuned"): one for one in methods}
    for series in in_order(by_series):
        one = by_series[series]
        look = method_style(series[0])
        unit = one["tuned"]["position"] if octaves else 1
        curve = [point for point in one["curve"] if (point["relative"]["median"] or 2 * _WORST) <= _WORST]
        x = [point["position"] / unit for point in curve]
        tolerance = one["tolerance_octaves"]
        title = label(series, by_series) + (f", {tolerance['median']:.1f} octaves" if tolerance else "")
        middle = [point["relative"]["median"] for point in curve]
        marker = {"marker": look.marker, "markersize": 3, "markerfacecolor": "white", "markeredgewidth": 0.8}
        axes.plot(x, middle, **{**curve_options(series, by_series, 1.1), **marker, "label": title})
        low = [point["relative"]["q1"] for point in curve]
        high = [min(point["relative"]["q3"] or _WORST, _WORST) for point in curve]
        if not octaves and look.paper:
            axes.fill_between(x, low, high, color=look.color, alpha=0.1, linewidth=0)
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    axes.set_ylim(0.97, _WORST)
    axes.set_yticks([1, 1.5, 2, 3, 5, 10])
    axes.yaxis.set_major_formatter(number)
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.xaxis.set_major_formatter(number)
    if octaves:
        axes.set_xlim(1 / 8, 8)
