"""Error against convexity on random polygons, in the paper's classes (its Table V), and by kind of polygon."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from records import Row, member_of
from run import Drawn, Run, Skipped, failures
from style import FULL_WIDTH, footnote, in_order, label, method_style, new_figure, panel_letter, role_color

_STARS = "star-"
_PAPER_MARKER = {"marker": "D", "markersize": 3.6, "markerfacecolor": "white"}
_BIN = 0.025  # of convexity
_LEAST = 20  # runs in a bin, for its 5 and 95 % to mean anything


def draw(run: Run) -> Iterator[Drawn]:
    rows = run.experiment("random").rows
    scored = [row for row in rows if row.metric("l2_paper") is not None and row.metric("ground_truth_convexity")]
    if not scored:
        raise Skipped("the random experiment has no errors")
    series = in_order(row.series for row in scored)[0]
    chosen = [row for row in scored if row.series == series]
    stars = [row for row in chosen if row.dataset.startswith(_STARS)]
    classes = run.paper.get("convexity_classes", {}).get("rows", [])
    name = label(series, [row.series for row in scored])
    caption = (
        f"Error of {name} on {len(chosen):,} random polygons of {chosen[0].n:,} points. (a) Star-shaped polygons as in the "
        f"paper ({len(stars):,}) against the convexity of the ground truth: every run, the median, and from the 5 % to the "
        "95 % quantile in bins of "
        f"{_BIN}; dotted: the paper's classes; diamonds: the paper's mean with its standard deviation, the small bar its "
        "maximum, at the median convexity of our runs of the class. (b) The same by kind of polygon: quartiles, 5 and 95 % "
        "and median. The error is the paper's: the area of the symmetric difference over that of the result. "
        f"{failures(rows)}"
    )
    yield Drawn("random_polygons", _figure(chosen, stars, classes, failures(rows)), caption.strip())


def _values(rows: list[Row]) -> tuple[np.ndarray, np.ndarray]:
    """Convexity and error in percent."""
    return (
        np.array([row.metric("ground_truth_convexity") for row in rows], dtype=float),
        np.array([100 * row.metric("l2_paper") for row in rows], dtype=float),
    )


def _figure(chosen: list[Row], stars: list[Row], classes: list[dict[str, Any]], notes: str) -> Figure:
    figure = new_figure(FULL_WIDTH, 76 if notes else 70)
    grid = figure.add_gridspec(1, 2, width_ratios=(1.7, 1))
    _convexity_panel(figure.add_subplot(grid[0, 0]), stars or chosen, classes)
    _kinds_panel(figure.add_subplot(grid[0, 1]), chosen)
    footnote(figure, notes)
    return figure


def _convexity_panel(axes: Axes, rows: list[Row], classes: list[dict[str, Any]]) -> None:
    color = method_style(rows[0].method).color
    convexity, error = _values(rows)
    dots = {"linestyle": "none", "marker": ".", "markersize": 0.9, "markeredgewidth": 0, "rasterized": True}
    axes.plot(convexity, error, color=color, alpha=0.35, zorder=2, label="_runs", **dots)
    middle, quantiles = binned(convexity, error)
    if len(middle):
        axes.fill_between(middle, quantiles[0], quantiles[2], color=color, alpha=0.25, linewidth=0, zorder=3)
        axes.plot(middle, quantiles[1], color=color, linewidth=1.6, zorder=4, label="_median")
    _classes(axes, convexity, classes)
    axes.set_xlabel("Convexity of the ground truth (area over that of its convex hull)")
    axes.set_ylabel("Error (%)")
    axes.set_ylim(0, 1.1 * axes.get_ylim()[1])
    axes.legend(handles=_key(color), loc="lower left", fontsize=6.5, handlelength=1.6)
    panel_letter(axes, "a", "star-shaped polygons" if rows[0].dataset.startswith(_STARS) else "all polygons")


def _key(color: str) -> list[Artist]:
    paper = role_color("paper_value")
    return [
        Line2D([], [], color=color, linewidth=1.6, label="median"),
        Patch(facecolor=color, alpha=0.3, label="5 to 95 %"),
        Line2D([], [], color=paper, linewidth=0.9, label="the paper: mean ± std", **_PAPER_MARKER),
        Line2D([], [], color=paper, linestyle="none", marker="_", markersize=6, label="the paper: maximum"),
    ]


def binned(convexity: np.ndarray, error: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The middles of the bins that have enough runs, and the 5, 50 and 95 % quantiles of the error in them."""
    index = np.floor(convexity / _BIN + 1e-9).astype(int)  # 0.55 / 0.025 must not fall below 22
    full = [k for k in np.unique(index) if np.count_nonzero(index == k) >= _LEAST]
    quantiles = [np.quantile(error[index == k], (0.05, 0.5, 0.95)) for k in full]
    return (np.array(full) + 0.5) * _BIN, np.array(quantiles).reshape(-1, 3).T


def _classes(axes: Axes, convexity: np.ndarray, classes: list[dict[str, Any]]) -> None:
    upper = np.inf
    for one in sorted(classes, key=lambda entry: -entry["at_least"]):
        inside = convexity[(convexity >= one["at_least"]) & (convexity < upper)]
        upper = one["at_least"]
        if upper > 0:
            axes.axvline(upper, color="#777777", linewidth=0.7, linestyle=(0, (1, 1.5)), zorder=1)
        if not len(inside):
            continue
        x = float(np.median(inside))
        mean, deviation, most = one["l2_percent"]
        color = role_color("paper_value")
        axes.errorbar([x], [mean], yerr=[deviation], color=color, elinewidth=0.9, capsize=2, zorder=6, **_PAPER_MARKER)
        axes.plot([x], [most], marker="_", markersize=6, color=color, zorder=6)
        axes.text(x, 0.985, one["title"].split()[0], transform=axes.get_xaxis_transform(), ha="center", va="top", fontsize=6.5)


def _kinds_panel(axes: Axes, rows: list[Row]) -> None:
    kinds = list(dict.fromkeys(member_of(row.dataset)[0] for row in rows))
    color = method_style(rows[0].method).color
    boxes = [_values([row for row in rows if member_of(row.dataset)[0] == one])[1] for one in kinds]
    axes.boxplot(
        boxes,
        vert=False,
        whis=(5, 95),
        showfliers=False,
        widths=0.6,
        patch_artist=True,
        boxprops={"facecolor": color, "alpha": 0.35, "linewidth": 0},
        medianprops={"color": color, "linewidth": 1.6},
        whiskerprops={"color": color, "linewidth": 0.8},
        capprops={"color": color, "linewidth": 0.8},
    )
    axes.set_yticks(range(1, len(kinds) + 1), [f"{one} ({len(box):,})" for one, box in zip(kinds, boxes)])
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.set_xlim(left=0)
    axes.set_xlabel("Error (%)")
    panel_letter(axes, "b", "by kind")
