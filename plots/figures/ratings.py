"""Mean ranks of the methods with their intervals, which of them may be alike, and Elo ratings; and how often each beats each
other. From league.csv in the run's folder, or cases.csv, the run's own."""

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ratings import ELO_MEAN, KNOWS, TIE_WORDS, Rating, rate, divisions
from run import Drawn, Run, Skipped
from style import FULL_WIDTH, label, marker_options, method_style, new_figure, panel_letter


def draw(run: Run) -> Iterator[Drawn]:
    results = run.results()
    found = divisions(results)
    if not found:
        raise Skipped("no two methods that know as much have a case in common")
    for division in found:
        rating = rate(division)
        cases = f"{len(division.results.cases)} cases of {rating.shapes} shapes"
        who = f"Methods that {KNOWS[division.name]}, {cases}"
        p = "" if rating.friedman is None else f"p = {rating.friedman:.2g}" if rating.friedman else "p < 1e-300"
        all_alike = p and f" Friedman's test of all being alike: {p}."
        yield Drawn(
            f"ratings_{division.name}",
            _ratings_figure(rating),
            f"{who}. (a) Mean rank on L2, 1 is the best on every case, with a 95 % interval by bootstrap over shapes; a bar "
            "joins methods that may be alike (Wilcoxon's signed-rank test over shapes with Holm's correction, 5 %)."
            f"{all_alike} (b) Elo ratings by the model of Bradley and Terry, {ELO_MEAN:.0f} is the mean, likewise; {TIE_WORDS} "
            "and count half. A failure is worse than any error.",
        )
        yield Drawn(
            f"wins_{division.name}",
            _wins_figure(rating),
            f"{who}: on which share of the cases, in %, the method of the row beats that of the column; {TIE_WORDS}, and "
            "the small number is their share. Every stratum and in it every shape counts the same.",
        )
        if len(rating.kinds) + len(rating.samplers) > 2:
            yield Drawn(
                f"parts_{division.name}",
                _parts_figure(rating),
                f"{who}: mean rank on L2 by kind of shape and by way to sample the points, in brackets the number of cases. 1 is "
                "the best on every case; the best of a column is in bold.",
            )


def _labels(rating: Rating) -> list[str]:
    every = [one.series for one in rating.standings]
    return [label(one, every) for one in every]


def _ratings_figure(rating: Rating) -> Figure:
    count = len(rating.standings)
    figure = new_figure(FULL_WIDTH, 22 + 4.2 * count)
    ranks, elo = figure.subplots(1, 2, sharey=True, gridspec_kw={"width_ratios": [3, 2]})
    panel_letter(ranks, "a", "mean rank")
    panel_letter(elo, "b", "Elo")
    for i, one in enumerate(rating.standings):
        _mark(ranks, i, one.series, one.rank, one.rank_interval)
        _mark(elo, i, one.series, one.elo, one.elo_interval)
    _groups(ranks, rating)
    ranks.set_yticks(range(count), _labels(rating))
    ranks.set_ylim(count - 0.4, -0.6)
    ranks.set_xlabel("Mean rank, the smaller the better")
    elo.set_xlabel("Elo, the larger the better")
    return figure


def _mark(axes: Axes, place: int, series, value: float, interval: tuple[float, float] | None) -> None:
    if interval:
        axes.plot(interval, [place, place], color=method_style(series[0]).color, linewidth=1.4, solid_capstyle="butt", zorder=3)
    axes.plot([value], [place], linestyle="none", zorder=4, **marker_options(series, 1.1))


def _groups(axes: Axes, rating: Rating) -> None:
    """Bars right of the intervals, those that overlap beside each other."""
    right = max(max(one.rank, (one.rank_interval or (0, one.rank))[1]) for one in rating.standings)
    step = 0.025 * right
    lanes: list[int] = []
    for first, last in rating.groups:
        lane = next((k for k, end in enumerate(lanes) if end < first), len(lanes))
        lanes[lane : lane + 1] = [last]
        x = right + step * (lane + 1.5)
        axes.plot([x, x], [first - 0.25, last + 0.25], color="#444444", linewidth=2.2, solid_capstyle="butt")


def _wins_figure(rating: Rating) -> Figure:
    count = len(rating.standings)
    size = min(FULL_WIDTH, 38 + 7.5 * count)
    figure = new_figure(size, size)
    axes = figure.subplots()
    axes.imshow(np.ma.masked_array(100 * rating.wins, np.eye(count)), cmap="cividis", vmin=0, vmax=100)
    for i, j in np.argwhere(~np.eye(count, dtype=bool)):
        _cell(axes, i, j, 100 * rating.wins[i, j], 100 * rating.ties[i, j])
    names = _labels(rating)
    axes.set_xticks(range(count), names, rotation=90)
    axes.set_yticks(range(count), names)
    axes.grid(False)
    return figure


def _cell(axes: Axes, i: int, j: int, won: float, tied: float) -> None:
    color = "black" if won > 55 else "white"
    axes.text(j, i - 0.15, f"{won:.0f}", ha="center", va="center", fontsize=6.5, color=color)
    if tied >= 0.5:
        axes.text(j, i + 0.28, f"{tied:.0f}", ha="center", va="center", fontsize=4.8, color=color)


def _parts_figure(rating: Rating) -> Figure:
    parts = [*rating.kinds, *rating.samplers]
    count = len(rating.standings)
    figure = new_figure(min(FULL_WIDTH, 50 + 8 * len(parts)), 32 + 4.2 * count)
    axes = figure.subplots()
    ranks = np.array([part.ranks for part in parts]).T
    axes.imshow(ranks, cmap="cividis_r", vmin=1, vmax=count, aspect="auto")
    for (i, j), rank in np.ndenumerate(ranks):
        weight = "bold" if rank <= ranks[:, j].min() + 1e-9 else "normal"
        color = "white" if rank > 0.55 * count else "black"
        axes.text(j, i, f"{rank:.1f}", ha="center", va="center", fontsize=6, color=color, fontweight=weight)
    axes.set_xticks(range(len(parts)), [f"{part.name} ({part.cases})" for part in parts], rotation=60, ha="right")
    axes.set_yticks(range(count), _labels(rating))
    axes.axvline(len(rating.kinds) - 0.5, color="white", linewidth=3)
    axes.grid(False)
    return figure
