"""Each method's hull of the same points, side by side, with its difference from the ground truth (the paper's
Figure 10)."""

from collections.abc import Iterator

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from figures.shapes import height_over_width, shape_picture
from figures.states import growing_shapes
from hull_grid import hull_grid
from maps import Polygons, area_path, difference, frame, outline, truth_and_points
from records import Picture, Row
from run import Drawn, Run, Skipped, failures
from style import role_color

_POINTS = 4000  # as in the paper


def draw(run: Run) -> Iterator[Drawn]:
    drawn = 0
    for dataset, experiment in growing_shapes(run, 1).items():
        picture = shape_picture(run, experiment, dataset, _POINTS)
        if picture is None:
            continue
        rows = [row for row in experiment.rows if row.case == picture.name]
        yield Drawn(f"hulls_{dataset}", _figure(picture, rows), _caption(picture, rows))
        drawn += 1
    if not drawn:
        raise Skipped("the run has no pictures of a single shape with a truth")


def _caption(picture: Picture, rows: list[Row]) -> str:
    total = picture.case["points_total"]
    return (
        f"Hulls of the same {total:,} points of {rows[0].dataset.upper()}{' with holes' if rows[0].holes else ''}. Grey: "
        "right; blue: missing from the hull; orange: in the hull but not in the ground truth, whose outline is the thin "
        f"line. In percent the L² error: the difference's area over that of the ground truth. {failures(rows)}"
    ).strip()


def _figure(picture: Picture, rows: list[Row]) -> Figure:
    def panel(axes: Axes, row: Row) -> str:
        draw_result(axes, picture, picture.polygons(row.name))
        error = row.metric("l2")
        return f"{100 * error:.1f} %" if error is not None else row.status.replace("_", " ")

    first = ("Points and truth", lambda axes: truth_and_points(axes, picture, 0.5, 0.9))
    return hull_grid(picture, rows, min(1.3, height_over_width(picture)), first, panel, difference_key())


def difference_key() -> list[Patch]:
    words = {"both": "right", "omission": "missing", "commission": "too much"}
    return [Patch(facecolor=role_color(role), label=text) for role, text in words.items()]


def draw_result(axes: Axes, picture: Picture, result: Polygons | None) -> None:
    """The difference between a result and the ground truth; without a result only the ground truth's outline."""
    truth = area_path(picture.ground_truth())
    if result is not None:
        difference(axes, truth, area_path(result))
    outline(axes, truth, role_color("ground_truth"), 0.35, zorder=6)
    frame(axes, picture)
