"""Performance profiles on l2 of the methods of an evaluation, from league.json in the run's folder (Dolan and More,
Benchmarking Optimization Software with Performance Profiles, 2002)."""

from collections.abc import Iterator
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from records import read_json
from report_common import PROTOCOLS, method_look
from run import Drawn, Run, Skipped
from style import FULL_WIDTH, in_order, line_options, new_figure, number, panel_letter, series_legend

_LEGEND_COLUMNS = 5
# By group: what its methods have in common.
_GROUPS = {one["name"]: f"methods {one['methods']}" for one in PROTOCOLS["groups"]}


def draw(run: Run) -> Iterator[Drawn]:
    path = run.file("league.json", maker="'make evaluate' writes it")
    league = read_json(path, "league.schema.json", "; 'hullbench league' writes it")
    profiles = {one["group"]: one for one in league["profiles"] if len(one["curves"]) > 1}
    groups = [group for group in _GROUPS if group in profiles and profiles[group]["cases"]]
    if not groups:
        raise Skipped(f"{path} has no group of two methods with a case")
    empty = "; ".join(_GROUPS[group] for group in _GROUPS if group in profiles and group not in groups)
    without = f" Without a case, and so not shown: {empty}." if empty else ""
    gone = [
        f"{method_look(one['method'])['title']} ({one['protocol']})" for group in groups for one in profiles[group]["left_out"]
    ]
    without += f" Left out, with less than half of the cases: {', '.join(gone)}." if gone else ""
    shapes = (
        "all of test shapes, on which no parameter was searched but the oracle's"
        if league["split"]["cases_of"] == "test"
        else "of all shapes, also those on which parameters were searched"
    )
    figure = _figure(league["taus"], [profiles[group] for group in groups])
    counts = "; ".join(f"{_GROUPS[group]}, {profiles[group]['cases']} cases" for group in groups)
    caption = (
        "Performance profiles: on which share of the cases, by weight, a method's L2 error is at most τ times the smallest one among "
        "those that know as much. At τ = 1 the share of cases on which it is the best, further right how seldom it is "
        f"far behind; a failure counts as infinitely bad. {counts[:1].upper()}{counts[1:]}; {shapes}. "
        f"Pale markers: the method's default. Methods with the same polygons lie on one curve.{without}"
    )
    yield Drawn("profiles", figure, caption)


def _figure(taus: list[float], profiles: list[dict[str, Any]]) -> Figure:
    columns = 2 if len(profiles) > 1 else 1
    lines = -(-len(profiles) // columns)
    methods = {(one["method"], "") for profile in profiles for one in profile["curves"]}
    beside = len(profiles) == 3  # the legend is where a fourth panel would be
    heights = [62] * lines + ([] if beside else [4.5 * -(-len(methods) // _LEGEND_COLUMNS)])
    figure = new_figure(FULL_WIDTH, sum(heights))
    grid = figure.add_gridspec(len(heights), columns, height_ratios=heights)
    for k, profile in enumerate(profiles):
        axes = figure.add_subplot(grid[divmod(k, columns)])
        _panel(axes, taus, profile)
        panel_letter(axes, "abcd"[k] if len(profiles) > 1 else "", _GROUPS[profile["group"]])
        if k % columns == 0:
            axes.set_ylabel("Share of cases (%)")
        axes.set_xlabel("τ: L2 error over the smallest one of the case")
    series_legend(figure.add_subplot(grid[-1, 1 if beside else slice(None)]), methods, columns=2 if beside else _LEGEND_COLUMNS)
    return figure


def _panel(axes: Axes, taus: list[float], profile: dict[str, Any]) -> None:
    curves = {(one["method"], one["protocol"]): one["shares"] for one in profile["curves"]}
    for one in in_order(curves):
        axes.plot(taus, [100 * share for share in curves[one]], markevery=0.12, **line_options(one))
    axes.set_xscale("log")
    axes.set_xlim(min(taus), max(taus))
    axes.set_ylim(0, 101)
    axes.set_xticks([tau for tau in (1, 1.5, 2, 3, 5, 10) if min(taus) <= tau <= max(taus)])
    axes.xaxis.set_major_formatter(number)
    axes.xaxis.set_minor_locator(NullLocator())
