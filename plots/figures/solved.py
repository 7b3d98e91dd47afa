"""What part of all pairs of case and error target each method has solved by a time: speed and accuracy in one figure, with
failures (after COCO's runtime profiles)."""

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure

from ratings import KNOWS, TARGET_WORDS, Division, divisions, has_times, solved_against_time
from run import Drawn, Run, Skipped
from style import FULL_WIDTH, curve_options, in_order, marker_options, new_figure, number, panel_letter, series_legend


_COLUMNS = 4


def draw(run: Run) -> Iterator[Drawn]:
    found = [one for one in divisions(run.results(timed=True)) if has_times(one)]
    if not found:
        raise Skipped("no two methods that know as much have timed results of the same case")
    counts = ", ".join(
        f"{len(one.results.cases)} cases of {len({case.shape for case in one.results.cases})} shapes ({one.name})"
        for one in found
    )
    caption = (
        "Solved against time: which part of all pairs of a case and an error target a method has solved within a time for "
        f"a point; {TARGET_WORDS}. Further left is faster, higher is more accurate; where a curve ends is what the method "
        "reaches at all. A failure solves nothing. Times are of equal work, points in memory to valid polygons in memory, "
        f"medians of the repetitions. {counts}; every stratum and in it every shape counts the same."
    )
    yield Drawn("solved", _figure(found), caption)


def _figure(found: list[Division]) -> Figure:
    every = in_order(series for one in found for series in one.results.entrants)
    lines = -(-len(every) // _COLUMNS)
    figure = new_figure(FULL_WIDTH, 72 + 4.5 * lines)
    grid = figure.add_gridspec(2, len(found), height_ratios=[72, 4.5 * lines])
    times = [x for one in found for x, _ in solved_against_time(one).values() if len(x)]
    low, high = min(x[0] for x in times) / 1.3, max(x[-1] for x in times) * 1.3
    for k, division in enumerate(found):
        axes = figure.add_subplot(grid[0, k])
        for series, (x, y) in solved_against_time(division).items():
            steps = np.concatenate([[low], x, [high]]), 100 * np.concatenate([[0], y, y[-1:] if len(y) else [0]])
            axes.step(*steps, where="post", **curve_options(series, every, 1.0))
            if len(x):
                axes.plot(x[-1], 100 * y[-1], linestyle="none", zorder=6, **marker_options(series, 1.1))
        axes.set_xscale("log")
        axes.set_xlim(low, high)
        axes.set_ylim(0, 102)
        axes.xaxis.set_major_formatter(number)
        axes.set_xlabel("Time (µs a point)")
        panel_letter(axes, "ab"[k] if len(found) > 1 else "", f"{division.name}: {KNOWS[division.name]}")
    figure.axes[0].set_ylabel("Solved (% of cases and targets)")
    series_legend(figure.add_subplot(grid[1, :]), every, columns=_COLUMNS)
    return figure
