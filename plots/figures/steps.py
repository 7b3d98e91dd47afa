"""The time of each step, ours beside the paper's (its Table VI)."""

from collections.abc import Iterator
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from records import Experiment, Row
from run import Drawn, Run, Skipped, failures
from style import FULL_WIDTH, legend_row, method_style, new_figure, number, step_color

_REST = "not told apart"


def draw(run: Run) -> Iterator[Drawn]:
    published = run.paper.get("steps", {})
    measured = measured_steps(run.experiment("steps"), published)
    if not measured:
        raise Skipped("no method of the steps experiment tells its steps")
    rows = run.experiment("steps").rows
    case = next(iter(measured.values()))[1]
    caption = (
        f"Mean time of the steps in milliseconds for {case.n:,} points of {case.dataset.upper()}"
        f"{' with holes' if case.holes else ''}, measured here and as the paper gives it (mean of 30 runs on another machine). "
        "Every method has a time axis of its own. CGAL's edges were made into no polygon in the paper. Polylidar's and SpatiaLite's "
        f"steps are told by calling them one by one, which takes longer than one call. {failures(rows)}"
    )
    yield Drawn("steps", _figure(measured, published, failures(rows)), caption.strip())


def measured_steps(experiment: Experiment, published: dict[str, Any]) -> dict[str, tuple[dict[str, float], Row]]:
    """By method: the mean time of each step in milliseconds, in the paper's steps, and the row that it is from."""
    parts = {part: entry["step"] for entry in published.get("names", []) for part in entry["parts"]}
    found: dict[str, tuple[dict[str, float], Row]] = {}
    for row in sorted(experiment.rows, key=lambda row: method_style(row.method).order):
        steps = mean_steps(row, parts) if row.ok else {}
        if len(steps) > 1 and row.method not in found:
            found[row.method] = (steps, row)
    return found


def mean_steps(row: Row, parts: dict[str, str]) -> dict[str, float]:
    """Milliseconds by step, averaged over the repetitions; what the method does not tell apart as a step of its own."""
    sums: dict[str, float] = {}
    for phases in row.phases_ns:
        told = 0
        for phase, time in phases.items():
            step = parts.get(phase.partition(".")[2])
            if step is not None:
                sums[step] = sums.get(step, 0) + time
                told += time
        sums[_REST] = sums.get(_REST, 0) + phases["run"] + phases["extract"] - told
    if len(sums) == 1:
        return {}
    ordered = [*dict.fromkeys(parts.values()), _REST]
    return {step: sums[step] / len(row.phases_ns) / 1e6 for step in ordered if step in sums}


def _figure(measured: dict[str, tuple[dict[str, float], Row]], published: dict[str, Any], notes: str) -> Figure:
    teller = {told_by: method for method, told_by in published.get("told_by", {}).items()}
    figure = new_figure(FULL_WIDTH, 18 * len(measured) + 8)
    grid = figure.add_gridspec(len(measured) + 1, 1, height_ratios=[18] * len(measured) + [5])
    for k, (method, (steps, _)) in enumerate(measured.items()):
        axes = figure.add_subplot(grid[k])
        paper = published.get("milliseconds", {}).get(teller.get(method, method))
        _panel(axes, method, steps, paper)
    axes.set_xlabel("Time (ms)")
    told = {step for steps, _ in measured.values() for step in steps}
    names = [step for step in [*(one["step"] for one in published.get("names", [])), _REST] if step in told]
    handles = [Patch(facecolor=step_color(name), edgecolor="#777777", linewidth=0.4, label=name) for name in names]
    legend_row(figure.add_subplot(grid[-1]), handles, notes)
    return figure


def _panel(axes: Axes, method: str, steps: dict[str, float], paper: dict[str, float | None] | None) -> None:
    look = method_style(method)
    _bar(axes, 0, steps, sum(steps.values()))
    if paper:
        known = {step: time for step, time in paper.items() if step != "total" and time is not None}
        _bar(axes, 1, known, paper.get("total") or sum(known.values()))
    axes.set_yticks([0, 1] if paper else [0], ["here", "paper"] if paper else ["here"])
    axes.set_ylim(1.6 if paper else 0.8, -0.6 if paper else -0.8)
    axes.set_xlim(0, 1.12 * axes.dataLim.x1)
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)
    axes.xaxis.set_major_formatter(number)
    axes.set_title(look.title, fontsize=7.5, loc="left", pad=3, color=look.color, fontweight="bold" if look.paper else "normal")


def _bar(axes: Axes, y: int, steps: dict[str, float], total: float) -> None:
    left = 0.0
    for step, time in steps.items():
        axes.barh(
            [y], [time], left=[left], height=0.72, color=step_color(step), edgecolor="white", linewidth=0.3, label=f"_{step}"
        )
        left += time
    axes.annotate(f"{total:,.1f} ms", (left, y), xytext=(3, 0), textcoords="offset points", va="center", fontsize=6.5)
