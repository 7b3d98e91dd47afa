"""The state shapes, with their holes if they have some, and points sampled from them (the paper's Figure 8, first column)."""

from collections.abc import Iterator

from matplotlib.axes import Axes

from figures.states import growing_shapes
from maps import area_path, paint, truth_and_points
from records import Experiment, Picture
from run import Drawn, Run, Skipped
from style import FULL_WIDTH, new_figure, panel_letter, role_color

_POINTS = 2000  # about as many as can be told apart at this size


def draw(run: Run) -> Iterator[Drawn]:
    found = {dataset: shape_picture(run, experiment, dataset) for dataset, experiment in growing_shapes(run, 1).items()}
    pictures = {dataset: picture for dataset, picture in found.items() if picture}
    if not pictures:
        raise Skipped("the run has no pictures of a single shape with a truth")
    figure = new_figure(FULL_WIDTH, 82)
    grid = figure.add_gridspec(1, len(pictures), width_ratios=[1 / height_over_width(one) for one in pictures.values()])
    for k, (dataset, picture) in enumerate(pictures.items()):
        axes = figure.add_subplot(grid[0, k])
        _shape(axes, picture)
        axes.set_anchor("N")
        panel_letter(axes, chr(ord("a") + k), f"{dataset.upper()}, {picture.case['points_total']:,} points")
    caption = "The ground truth of the shapes, holes in orange, and the points that were sampled from it."
    yield Drawn("shapes", figure, caption)


def shape_picture(run: Run, experiment: Experiment, dataset: str, n: int = _POINTS) -> Picture | None:
    """The case of the data set, with holes if there is one, whose number of points is nearest to `n`, of those that
    have pictures."""
    rows = sorted(
        (row for row in experiment.rows if row.dataset == dataset), key=lambda row: (not row.holes, abs(row.n - n), row.n)
    )
    for case in dict.fromkeys(row.case for row in rows):
        if (picture := run.picture(experiment, case)) is not None:
            return picture
    return None


def height_over_width(picture: Picture) -> float:
    """Of the ground truth's box."""
    places = [place for polygon in picture.ground_truth() for place in polygon[0]]
    width, height = (max(p[k] for p in places) - min(p[k] for p in places) for k in (0, 1))
    return height / width


def _shape(axes: Axes, picture: Picture) -> None:
    truth = picture.ground_truth()
    paint(axes, area_path([[polygon[0]] for polygon in truth]), role_color("hole"), zorder=1)
    paint(axes, area_path(truth), role_color("both"), zorder=2)
    truth_and_points(axes, picture, 0.6, 1.6)
