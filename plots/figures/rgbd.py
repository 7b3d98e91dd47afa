"""Floors seen by a depth camera: the points with their ground truth, and Polylidar's result (the paper's Figure 9)."""

from collections.abc import Iterator

from matplotlib.figure import Figure

from figures.hulls import difference_key, draw_result
from maps import truth_and_points
from records import Experiment, Picture, Row
from run import Drawn, Run, Skipped
from style import FULL_WIDTH, legend_row, new_figure, panel_letter

_METHOD = "polylidar"


def draw(run: Run) -> Iterator[Drawn]:
    experiment = run.experiment("rgbd")
    scenes = _scenes(run, experiment)
    if not scenes:
        raise Skipped("the run has no pictures of a floor with Polylidar's result")
    floors = " and ".join(row.dataset for row, _ in scenes)
    caption = (
        f"Floors of the RGBD experiment ({floors}), in metres as if seen from above: left the points (at most 4,000 of "
        "them) and the outline of the ground truth, right Polylidar's result: grey right, blue missing, orange "
        "too much."
    )
    yield Drawn("rgbd", _figure(scenes), caption)


def _scenes(run: Run, experiment: Experiment) -> list[tuple[Row, Picture]]:
    """The first and the last floor that have a picture: seen from straight above and at an angle in the plan's own."""
    kept = set(experiment.picture_cases())
    rows = [row for row in experiment.rows if row.method == _METHOD and row.ok and row.case in kept]
    rows = [row for row in rows if row.series == rows[0].series]
    chosen = list({row.case: row for row in (rows[:1] + rows[-1:])}.values())
    pairs = [(row, run.picture(experiment, row.case)) for row in chosen]
    return [(row, picture) for row, picture in pairs if picture and picture.polygons(row.name) is not None]


def _figure(scenes: list[tuple[Row, Picture]]) -> Figure:
    figure = new_figure(FULL_WIDTH, 62 * len(scenes) + 8)
    grid = figure.add_gridspec(len(scenes) + 1, 2, height_ratios=[62] * len(scenes) + [5])
    for k, (row, picture) in enumerate(scenes):
        left, right = (figure.add_subplot(grid[k, column]) for column in range(2))
        truth_and_points(left, picture, 0.7, 1.3)
        panel_letter(left, "ac"[k], f"{row.dataset}, {row.n:,} points")
        draw_result(right, picture, picture.polygons(row.name))
        panel_letter(right, "bd"[k], f"Polylidar, L² error {100 * row.metrics['l2']:.1f} %")
    legend_row(figure.add_subplot(grid[-1, :]), difference_key())
    return figure
