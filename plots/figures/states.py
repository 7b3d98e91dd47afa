"""Time and error against the number of points, for each shape that was measured with several numbers (the paper's
Figure 8, second and third column)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, MaxNLocator, NullFormatter, NullLocator

from records import Experiment, Row, Series
from run import FILLED, Drawn, Run, Skipped, failures, missing_series
from style import FULL_WIDTH, footnote, in_order, line_options, method_style, new_figure, number, panel_letter, series_legend

_INSET = (0.08, 0.62, 0.40, 0.34)  # left, bottom, width and height in parts of the panel
_LEGEND_COLUMNS = 4
_FAST = 10  # times the fastest method's time: what the inset shows, CGAL besides as in the paper


def draw(run: Run) -> Iterator[Drawn]:
    shapes = growing_shapes(run)
    if not shapes:
        raise Skipped("no shape was measured with two numbers of points or more")
    for dataset, experiment in shapes.items():
        rows = [row for row in experiment.rows if row.dataset == dataset]
        yield Drawn(f"states_{dataset}", _figure(rows), _caption(experiment, dataset, rows))


def growing_shapes(run: Run, least: int = 2) -> dict[str, Experiment]:
    """By single shape with a truth, letters aside: the experiment that has most numbers of points of it, at least `least`."""
    most: dict[str, tuple[int, Experiment]] = {}
    for experiment in run.experiments:
        if experiment.plan.get("accepted"):  # asks how a run ends, not how near it comes to a shape
            continue
        for name, dataset in experiment.datasets.items():
            rows = [row for row in experiment.rows if row.dataset == name]
            sizes = len({row.n for row in rows})
            single = not dataset.get("members") and not name.startswith("letter_") and any(row.metric("l2") for row in rows)
            if single and sizes >= least and sizes > most.get(name, (0, experiment))[0]:
                most[name] = (sizes, experiment)
    return {name: experiment for name, (_, experiment) in most.items()}


def _caption(experiment: Experiment, dataset: str, rows: Sequence[Row]) -> str:
    title = experiment.datasets[dataset]["title"]
    return (
        f"{title}: time (top) and error (bottom) against the number of points, without and with holes in the ground "
        "truth. Lines join medians of the repetitions (run and extract, points in memory to polygons in memory); bands "
        "are 95 % bootstrap intervals of the median. The error is the area of the symmetric difference over the area "
        "of the ground truth. The insets show the fastest methods on linear axes (ms against thousands of points). "
        f"{FILLED} {failures(rows)}"
    ).strip()


def _figure(rows: Sequence[Row]) -> Figure:
    columns = sorted({row.holes for row in rows})
    legend_lines = -(-len({row.series for row in rows}) // _LEGEND_COLUMNS)
    figure = new_figure(FULL_WIDTH, 140 + 4.5 * legend_lines)
    grid = figure.add_gridspec(3, len(columns), height_ratios=(68, 60, 4.5 * legend_lines))
    panels = [[figure.add_subplot(grid[line, k]) for k in range(len(columns))] for line in range(2)]
    for k, holes in enumerate(columns):
        here = [row for row in rows if row.holes == holes]
        words = "with holes" if holes else "without holes"
        _time_panel(panels[0][k], here, "abcd"[k], words)
        _error_panel(panels[1][k], here, "abcd"[len(columns) + k], words)
    for line, text in enumerate(("Time (ms)", "L² error (%)")):
        panels[line][0].set_ylabel(text)
        _share_limits(panels[line])
    _ticks_of_times(panels[0], rows)
    missing = missing_series(rows)
    series_legend(figure.add_subplot(grid[2, :]), [row.series for row in rows if row.ok], missing, _LEGEND_COLUMNS)
    footnote(figure, failures(rows))
    return figure


def _time_panel(axes: Axes, rows: Sequence[Row], letter: str, words: str) -> None:
    times = {one: _curve(rows, one, "time") for one in in_order(row.series for row in rows if row.ok)}
    _plot(axes, times)
    _log_axes(axes, rows)
    panel_letter(axes, letter, f"time, {words}")
    fast = _fast(times)
    if len(fast) > 1:
        _make_room(axes, times)
        inset = axes.inset_axes(_INSET)
        _plot(inset, {one: [(n / 1000, *values) for n, *values in times[one]] for one in fast})
        inset.text(0.04, 0.97, "ms", transform=inset.transAxes, va="top", fontsize=6)
        inset.set_xlim(left=0)
        inset.set_ylim(bottom=0)
        inset.xaxis.set_major_locator(MaxNLocator(4, integer=True))
        inset.yaxis.set_major_locator(MaxNLocator(4))
        inset.tick_params(labelsize=6, pad=1.5, length=2)
        inset.set_facecolor("white")


def _make_room(axes: Axes, times: dict[Series, list[Point]]) -> None:
    """Raises the upper limit until no curve runs under the inset."""
    left, right = axes.get_xlim()
    end = left * (right / left) ** (_INSET[0] + _INSET[2] + 0.03)  # where the inset ends
    highest = []
    for points in times.values():
        x, y = np.log([p[0] for p in points]), np.log([max(p[1], p[3] or 0) for p in points])
        inside = [value for place, value in zip(x, y) if place <= np.log(end)]
        highest += [*inside, float(np.interp(np.log(end), x, y))]
    low, high = np.log(axes.get_ylim())
    bottom_of_inset = _INSET[1] - 0.08  # with its tick labels
    axes.set_ylim(top=float(np.exp(max(high, low + (max(highest) - low) / bottom_of_inset))))


def _error_panel(axes: Axes, rows: Sequence[Row], letter: str, words: str) -> None:
    errors = {one: _curve(rows, one, "l2") for one in in_order(row.series for row in rows if row.ok)}
    _plot(axes, errors)
    _log_axes(axes, rows)
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.set_xlabel("Number of points (thousands)")
    panel_letter(axes, letter, f"error, {words}")


Point = tuple[float, float, "float | None", "float | None"]  # n, value, lower and upper end


def _curve(rows: Sequence[Row], one: Series, quantity: str) -> list[Point]:
    """A series' values by number of points: "time" in milliseconds with its interval, or "l2" in percent."""
    points: list[Point] = []
    for row in sorted((row for row in rows if row.series == one and row.ok), key=lambda row: row.n):
        if quantity == "time" and row.median_ns is not None:
            low, high = (end / 1e6 for end in row.interval()) if row.interval() else (None, None)
            points.append((row.n, row.median_ns / 1e6, low, high))
        elif quantity == "l2" and (error := row.metric("l2")) is not None:
            points.append((row.n, 100 * error, None, None))
    return points


def _plot(axes: Axes, curves: dict[Series, list[Point]]) -> None:
    for one, points in curves.items():
        if not points:
            continue
        axes.plot([p[0] for p in points], [p[1] for p in points], **line_options(one))
        known = [p for p in points if p[2] is not None and p[3] is not None]
        if len(known) > 1:
            look = method_style(one[0])
            n, _, low, high = zip(*known)
            axes.fill_between(n, low, high, color=look.color, alpha=0.22 if look.paper else 0.12, linewidth=0, zorder=2)


def _log_axes(axes: Axes, rows: Sequence[Row]) -> None:
    sizes = sorted({row.n for row in rows})
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.xaxis.set_major_locator(FixedLocator(sizes))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda n, _: f"{n / 1000:g}"))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(number))
    axes.yaxis.set_minor_formatter(NullFormatter())
    if len(sizes) > 1:
        axes.set_xlim(sizes[0] / 1.15, sizes[-1] * 1.15)


def _share_limits(panels: Sequence[Axes]) -> None:
    limits = [axes.get_ylim() for axes in panels]
    for axes in panels:
        axes.set_ylim(min(low for low, _ in limits), max(high for _, high in limits))


def _ticks_of_times(panels: Sequence[Axes], rows: Sequence[Row]) -> None:
    """Only powers of ten that there are times near: not beside the insets."""
    times = [row.median_ns / 1e6 for row in rows if row.ok and row.median_ns]
    if not times:
        return
    powers = range(math.floor(math.log10(min(times))), math.ceil(math.log10(max(times))) + 1)
    for axes in panels:
        axes.yaxis.set_major_locator(FixedLocator([10.0**power for power in powers]))
        axes.yaxis.set_minor_locator(FixedLocator([k * 10.0**power for power in powers[:-1] for k in range(2, 10)]))
        axes.set_ylim(axes.get_ylim())


def _fast(times: dict[Series, list[Point]]) -> list[Series]:
    """The methods near the fastest at the largest number of points that most series have; the paper's two fast ones
    when there is but one."""
    sizes = [point[0] for points in times.values() for point in points]
    if not sizes:
        return []
    n = max(set(sizes), key=lambda size: (sizes.count(size), size))
    ranked = sorted((point[1], one) for one, points in times.items() for point in points if point[0] == n)
    fast = [one for time, one in ranked if time <= _FAST * ranked[0][0]][:5]
    return fast if len(fast) > 1 else [one for _, one in ranked if one in fast or one[0] == "cgal_alpha_shape"]
