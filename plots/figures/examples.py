"""Why a concave hull (the paper's Figure 1), and the most and the least convex random polygon (its Figure 11)."""

from collections.abc import Iterator

from matplotlib.figure import Figure

from maps import area_path, frame, outline, paint, points
from records import Experiment, Picture, Row
from run import Drawn, Run, Skipped
from style import FULL_WIDTH, method_style, new_figure, panel_letter

_LETTER = "letter_a"


def draw(run: Run) -> Iterator[Drawn]:
    drawn = [one for one in (_convex_and_concave(run), _convexity(run)) if one is not None]
    if not drawn:
        raise Skipped("the run has no pictures of a letter or of random polygons")
    yield from drawn


def _result(run: Run, experiment: Experiment, row: Row) -> tuple[Picture, list] | None:
    picture = run.picture(experiment, row.case)
    polygons = picture.polygons(row.name) if picture else None
    return None if polygons is None else (picture, polygons)


def _convex_and_concave(run: Run) -> Drawn | None:
    if not run.has("alphabet"):
        return None
    experiment = run.experiment("alphabet")
    # Of the first protocol that the method has rows of.
    rows = {row.method: row for row in reversed(experiment.rows) if row.dataset == _LETTER and row.ok}
    found = {method: _result(run, experiment, rows[method]) for method in ("convex_hull", "polylidar") if method in rows}
    if len(found) < 2 or None in found.values():
        return None
    panels = [(method_style(method).title, method, *result) for method, result in found.items()]
    caption = "The convex hull of the points of a letter A, and Polylidar's concave hull with its hole."
    return Drawn("convex_and_concave", _figure(panels), caption)


def _convexity(run: Run) -> Drawn | None:
    if not run.has("random"):
        return None
    experiment = run.experiment("random")
    own = [row for row in experiment.rows if row.method == "polylidar" and row.ok]
    rows = {row.name: row for row in own if row.series == own[0].series}
    kept = [rows[line["run"]] for line in experiment.picture_lines() if line["kind"] == "result" and line["run"] in rows]
    if len(kept) < 2:
        return None
    ranked = sorted(kept, key=lambda row: (row.metrics["ground_truth_convexity"], row.name))
    panels = []
    for row in (ranked[-1], ranked[0]):
        title = f"{row.dataset}, convexity {100 * row.metrics['ground_truth_convexity']:.1f} %"
        panels.append((title, row.method, *_result(run, experiment, row)))
    caption = (
        "The most and the least convex of the random polygons that pictures were kept of (the worst results of each "
        "method), with Polylidar's result: points, result (filled) and ground truth (line)."
    )
    return Drawn("convexity", _figure(panels, truth=True), caption)


def _figure(panels: list[tuple[str, str, Picture, list]], truth: bool = False) -> Figure:
    figure = new_figure(0.75 * FULL_WIDTH, 66)
    for k, (title, method, picture, polygons) in enumerate(panels):
        axes = figure.add_subplot(1, len(panels), k + 1)
        color = method_style(method).color
        path = area_path(polygons)
        paint(axes, path, color, alpha=0.18, zorder=2)
        outline(axes, path, color, 1.2, zorder=4)
        if truth:
            outline(axes, area_path(picture.ground_truth()), "#222222", 0.5, zorder=6)
        points(axes, picture.points(), 1.2)
        frame(axes, picture)
        panel_letter(axes, "ab"[k], title)
    return figure
