"""One picture of the whole: Polylidar's hull over the points, and every method's time against its error. Wide, for the
head of the README."""

from collections.abc import Iterator, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from figures.shapes import shape_picture
from figures.states import growing_shapes
from labels import place_labels
from maps import area_path, frame, outline, paint, points
from ratings import pareto
from records import Picture, Row
from run import FILLED, Drawn, Run, Skipped, failures
from style import FULL_WIDTH, footnote, in_order, marker_options, method_style, new_figure, number, panel_letter

_METHOD = "polylidar"
_NEAR = 1.5  # times and errors of one method that differ by less than this factor share a label
_POINTS = 8000  # the most that all methods are measured with in a quick run


def draw(run: Run) -> Iterator[Drawn]:
    shapes = growing_shapes(run, 1)
    if not shapes:
        raise Skipped("the run has no shape other than letters, floors and random polygons")
    dataset = "ca" if "ca" in shapes else next(iter(shapes))
    rows = compared_rows([row for row in shapes[dataset].rows if row.dataset == dataset])
    scored = [row for row in rows if row.median_ns and row.metric("l2") is not None]
    if not scored:
        raise Skipped(f"no method has a result for {dataset}")
    picture = shape_picture(run, shapes[dataset], dataset, rows[0].n)
    own = _own_result(shapes[dataset].rows, picture)
    title = shapes[dataset].datasets[dataset]["title"]
    holes = " with holes" if rows[0].holes else ""
    left = (
        f"Left: {title}{holes}, {picture.case['points_total']:,} points (at most 4,000 of them drawn) and Polylidar's result. "
        if own is not None
        else ""
    )
    caption = (
        f"{left}{'Right: m' if own is not None else 'M'}edian time and L² error of every method for {rows[0].n:,} points of {title}{holes}; "
        f"down and to the left is better, and no method is both faster and more accurate than those on the line. {FILLED} "
        f"Results of one method that lie together share a label. {failures(rows)}"
    )
    yield Drawn("summary", _figure(rows, scored, picture, own), caption.strip())


def compared_rows(rows: Sequence[Row]) -> list[Row]:
    """Those of one case: with holes if there is one, and of the numbers of points up to 8000 that of most results."""
    holes = any(row.holes for row in rows)
    rows = [row for row in rows if row.holes == holes]
    results = {n: sum(row.ok for row in rows if row.n == n) for n in {row.n for row in rows}}
    n = max(results, key=lambda n: (n <= _POINTS, results[n], n))
    return [row for row in rows if row.n == n]


def front(rows: Sequence[Row]) -> list[Row]:
    """By rising time: the rows to which none is both at least as fast and as accurate."""
    return [rows[i] for i in pareto([(row.median_ns, row.metrics["l2"]) for row in rows])]


def neighbours(rows: Sequence[Row]) -> list[list[Row]]:
    """The rows in the order of the methods, those of one method together where each is near the next in time and error:
    one label is enough for them."""
    groups: list[list[Row]] = []
    place = {one: k for k, one in enumerate(in_order(row.series for row in rows))}
    for row in sorted(rows, key=lambda row: (place[row.series], row.metrics["l2"])):
        near = [group for group in groups if group[0].method == row.method and any(_is_near(row, other) for other in group)]
        (near[0].append if near else groups.append)(row if near else [row])
    return groups


def _is_near(row: Row, other: Row) -> bool:
    return all(max(both) <= _NEAR * min(both) for both in zip(_place(row), _place(other)))


def _place(row: Row) -> tuple[float, float]:
    """Milliseconds and percent."""
    return row.median_ns / 1e6, 100 * row.metrics["l2"]


def _own_result(rows: Sequence[Row], picture: Picture | None) -> list | None:
    own = [row for row in rows if picture and row.method == _METHOD and row.case == picture.name and row.ok]
    return picture.polygons(own[0].name) if own else None


def _figure(rows: list[Row], scored: list[Row], picture: Picture | None, own: list | None) -> Figure:
    figure = new_figure(FULL_WIDTH, 86)
    axes = figure.add_subplot()
    if own is not None:
        figure.clear()
        grid = figure.add_gridspec(1, 2, width_ratios=(1, 1.75))
        _hull(figure.add_subplot(grid[0, 0]), picture, own)
        axes = figure.add_subplot(grid[0, 1])
    _pareto(axes, scored)
    panel_letter(axes, "b" if own is not None else "", f"time and error, {rows[0].n:,} points")
    footnote(figure, failures(rows))
    groups = sorted(neighbours(scored), key=lambda group: -max(map(_place, group))[1])  # from above: fewest lines to labels
    place_labels(
        figure,
        axes,
        [max(map(_place, group)) for group in groups],
        [_label_options(group, groups) for group in groups],
        [_place(row) for row in scored],
        _corners(front(scored)),
    )
    return figure


def _hull(axes: Axes, picture: Picture, own: list) -> None:
    color = method_style(_METHOD).color
    path = area_path(own)
    paint(axes, path, color, alpha=0.16, zorder=2)
    points(axes, picture.points(), 1.3)
    outline(axes, path, color, 1.1, zorder=6)
    frame(axes, picture)
    axes.set_anchor("N")  # its title beside the other one
    panel_letter(axes, "a", f"Polylidar's hull of {picture.case['points_total']:,} points")


def _pareto(axes: Axes, rows: list[Row]) -> None:
    best = front(rows)
    axes.plot(*zip(*_corners(best)), color="#c4c4c4", linewidth=1.2, zorder=1, label="_front")
    for row in sorted(rows, key=lambda row: -method_style(row.method).order):
        scale = 1.7 if method_style(row.method).paper else 1.35
        time, error = _place(row)
        axes.plot([time], [error], linestyle="none", zorder=3, **marker_options(row.series, scale))
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(number)
        axis.set_minor_formatter(NullFormatter())
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.margins(0.1, 0.13)
    axes.set_xlabel("Time (ms)")
    axes.set_ylabel("L² error (%)")


def _corners(best: list[Row]) -> list[tuple[float, float]]:
    """Of the line of the best, which goes down where the next one begins."""
    places = [_place(row) for row in best]
    return [corner for (_, last), (x, y) in zip([places[0], *places], places) for corner in ((x, last), (x, y))]


def _label_options(group: list[Row], groups: list[list[Row]]) -> dict[str, object]:
    look = method_style(group[0].method)
    protocols = [", ".join(row.series.protocol for row in other) for other in groups if other[0].method == group[0].method]
    own = ", ".join(row.series.protocol for row in group)
    alone = {*protocols} <= {own, "default"}  # but for its default, which is told
    return {
        "text": look.title if alone else f"{look.title} ({own})",
        "color": look.color,
        "fontweight": "bold" if look.paper else "normal",
        "fontsize": 7.5 if look.paper else 6.8,
    }
