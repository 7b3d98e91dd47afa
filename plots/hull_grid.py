"""Each method's hull of the same points, side by side: the grid that figures of hulls share."""

import math
from collections.abc import Callable, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from records import Picture, Row
from run import failures
from style import FULL_WIDTH, in_order, label, legend_row, method_style, new_figure

_COLUMNS = 6


def hull_grid(
    picture: Picture,
    rows: Sequence[Row],
    height_over_width: float,
    first: tuple[str, Callable[[Axes], None]],
    panel: Callable[[Axes, Row], str],
    key: Sequence[Patch] = (),
) -> Figure:
    """`first`: the title of the first panel and what draws it; `panel` draws a method's and gives the words under its name;
    with a `key`, a row below has it beside what failed."""
    by_series = {row.series: row for row in rows}
    every = in_order(by_series)
    lines = math.ceil((len(every) + 1) / _COLUMNS)
    columns = min(_COLUMNS, math.ceil((len(every) + 1) / lines))
    width = FULL_WIDTH if columns > 4 else 40 * columns
    height = width / columns * 0.95 * height_over_width + 9
    below = 5 if key else 0
    figure = new_figure(width, height * lines + below * 1.2)
    grid = figure.add_gridspec(lines + bool(key), columns, height_ratios=[height] * lines + [below] * bool(key))
    places = figure.add_subplot(grid[0, 0])
    title, draw_first = first
    draw_first(places)
    places.set_title(title, fontsize=6.5, pad=11)
    for k, one in enumerate(every, 1):
        axes = figure.add_subplot(grid[k // columns, k % columns])
        words = panel(axes, by_series[one])
        axes.set_title(label(one, every), size=6.5, weight="bold" if method_style(one.method).paper else "normal", pad=11)
        axes.text(0.5, 1.01, words, transform=axes.transAxes, ha="center", va="bottom", fontsize=6.2)
    if key:
        legend_row(figure.add_subplot(grid[lines, :]), key, failures(rows))
    return figure
