"""Performance profiles on l2 of the methods of an evaluation, from league.json in the run's folder (Dolan and More,
Benchmarking Optimization Software with Performance Profiles, 2002)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from records import read_json
from run import Drawn, Run, Skipped
from style import FULL_WIDTH, curve_options, in_order, method_style, new_figure, number, panel_letter

# By group: what those of it know.
_GROUPS = {
    "blind": "know the points only",
    "tuned": "tuned on other shapes",
    "informed": "know the true area",
    "oracle": "know the true shape",
}


def draw(run: Run) -> Iterator[Drawn]:
    path = run.file("league.json", maker="'make evaluate' writes it")
    league = read_json(path, "league.schema.json", "; 'hullbench league' writes it")
    profiles = {one["group"]: one for one in league["profiles"] if len(one["curves"]) > 1}
    groups = [group for group in _GROUPS if group in profiles]
    if not groups:
        raise Skipped(f"{path} has no group of two methods")
    figure = _figure(league["taus"], [profiles[group] for group in groups])
    counts = ", ".join(f"{profiles[group]['cases']} cases ({group})" for group in groups)
    caption = (
        "Performance profiles: on which share of the cases a method's L2 error is at most τ times the smallest one among "
        "those that know as much. At τ = 1 the share of cases on which it is the best, further right how seldom it is "
        f"far behind; a failure counts as infinitely bad. {counts}, all of shapes that no parameter was fitted on."
    )
    yield Drawn("profiles", figure, caption)


def _figure(taus: list[float], profiles: list[dict[str, Any]]) -> Figure:
    columns = 2 if len(profiles) > 1 else 1
    lines = -(-len(profiles) // columns)
    figure = new_figure(FULL_WIDTH, 62 * lines)
    panels = figure.subplots(lines, columns, sharex=True, sharey=True, squeeze=False).flat
    for k, (axes, profile) in enumerate(zip(panels, profiles)):
        _panel(axes, taus, profile)
        panel_letter(axes, "abcd"[k] if len(profiles) > 1 else "", f"{profile['group']}: {_GROUPS[profile['group']]}")
        if k % columns == 0:
            axes.set_ylabel("Share of cases (%)")
        if k + columns >= len(profiles):
            axes.set_xlabel("τ: L2 error over the smallest one of the case")
            axes.tick_params(labelbottom=True)
    for axes in list(panels):  # what the grid has too many
        axes.remove()
    return figure


def _panel(axes: Axes, taus: list[float], profile: dict[str, Any]) -> None:
    curves = {(one["method"], one["protocol"]): one["shares"] for one in profile["curves"]}
    for one in in_order(curves):
        look = method_style(one[0])
        axes.plot(
            taus,
            [100 * share for share in curves[one]],
            marker=look.marker,
            markersize=3.2,
            markevery=0.12,
            markerfacecolor=look.color if one[1] == "paper" else "white",
            markeredgewidth=0.8,
            **curve_options(one, curves, 1.1),
        )
    axes.set_xscale("log")
    axes.set_xlim(min(taus), max(taus))
    axes.set_ylim(0, 100)
    axes.set_xticks([tau for tau in (1, 1.5, 2, 3, 5, 10) if min(taus) <= tau <= max(taus)])
    axes.xaxis.set_major_formatter(number)
    axes.xaxis.set_minor_locator(NullLocator())
    axes.legend(loc="lower right", handlelength=2.8)
