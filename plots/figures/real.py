"""Real points, whose true shape nobody knows: each method's hull of the same points, side by side."""

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hull_grid import hull_grid
from maps import area_path, frame, outline, paint, points
from records import Picture, Row
from run import Drawn, Run, Skipped, failures
from style import role_color


def draw(run: Run) -> Iterator[Drawn]:
    experiment = run.experiment("real")
    drawn = 0
    for case, picture in experiment.pictures().items():
        rows = [row for row in experiment.rows if row.case == case]
        if not picture.case["points"]:
            continue
        yield Drawn(rows[0].dataset.replace("-", "_"), _figure(picture, rows), _caption(experiment, picture, rows))
        drawn += 1
    if not drawn:
        raise Skipped("the run has no pictures of real points")


def _caption(experiment, picture: Picture, rows: list[Row]) -> str:
    total = picture.case["points_total"]
    shown = len(picture.points())
    some = f", {shown:,} of them drawn" if shown < total else ""
    return (
        f"{experiment.dataset_title(rows[0].dataset)}: {total:,} points{some}, and each method's hull of them, with the share "
        "of the points that it covers, and its parts | holes. The true shape is not known, so none of them is said to be "
        f"right. {failures(rows)}"
    ).strip()


def _figure(picture: Picture, rows: list[Row]) -> Figure:
    def first(axes: Axes) -> None:
        points(axes, picture.points(), 1.2)
        frame(axes, picture)

    def panel(axes: Axes, row: Row) -> str:
        result = picture.polygons(row.name)
        if result:
            path = area_path(result)
            paint(axes, path, role_color("both"), zorder=1)
            outline(axes, path, role_color("ground_truth"), 0.35, zorder=6)
        points(axes, picture.points(), 0.5)
        frame(axes, picture)
        return _words(row)

    return hull_grid(picture, rows, _height_over_width(picture), ("Points", first), panel)


def _height_over_width(picture: Picture) -> float:
    """Of the points' box, kept to what fits a panel."""
    low, high = (pick(np.asarray(picture.points()), axis=0) for pick in (np.min, np.max))
    width, height = high - low
    return min(max(height / width if width > 0 else 2.0, 0.4), 2.0)


def _words(row: Row) -> str:
    if not row.ok:
        return row.status.replace("_", " ")
    covered, parts, holes = (row.metric(name) or 0 for name in ("points_covered", "polygons", "holes"))
    return f"{100 * covered:.1f} %, {parts} | {holes}"
