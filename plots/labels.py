"""Texts beside markers, so that they cover neither each other nor a marker."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Annotation
from matplotlib.transforms import Bbox

# Where a text may stand, the best first: offset in points and how it is aligned to it.
_PLACES = [
    (dx * reach, dy * reach, horizontal, vertical)
    for reach in (1.0, 1.8, 3.0, 4.5, 6.5)
    for dx, dy, horizontal, vertical in (
        (5, 0, "left", "center"),
        (-5, 0, "right", "center"),
        (0, 5, "center", "bottom"),
        (0, -5, "center", "top"),
        (4, 4, "left", "bottom"),
        (4, -4, "left", "top"),
        (-4, 4, "right", "bottom"),
        (-4, -4, "right", "top"),
    )
]
_MARKER = 4.0  # half a marker's side, in points


def place_labels(
    figure: Figure,
    axes: Axes,
    places: Sequence[tuple[float, float]],
    texts: Sequence[Mapping[str, object]],
    line: Sequence[tuple[float, float]] = (),
) -> list[Annotation]:
    """One text a place (in data coordinates), each with the options of Axes.annotate; a text far from its marker gets a
    thin line to it. Texts keep off a line through the corners `line` too. The layout is fixed first, as it decides on
    what covers what."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    renderer = canvas.get_renderer()
    scale = figure.dpi / 72
    pixels = axes.transData.transform(places)
    markers = [Bbox.from_extents(*(p - _MARKER * scale), *(p + _MARKER * scale)) for p in pixels]
    taken = _along(axes.transData.transform(line), scale) if len(line) > 1 else []
    made = []
    for k, (place, options) in enumerate(zip(places, texts)):
        others = [*taken, *(box for j, box in enumerate(markers) if j != k)]
        note, box = _best(axes, place, options, others, renderer)
        taken.append(box)
        made.append(note)
    return made


def _along(corners: np.ndarray, scale: float) -> list[Bbox]:
    """Small boxes along a line, in pixels."""
    boxes = []
    for a, b in zip(corners[:-1], corners[1:]):
        for part in np.linspace(0, 1, 2 + int(np.hypot(*(b - a)) / (3 * scale))):
            middle = a + part * (b - a)
            boxes.append(Bbox.from_extents(*(middle - scale), *(middle + scale)))
    return boxes


def _best(axes: Axes, place, options, others: Sequence[Bbox], renderer) -> tuple[Annotation, Bbox]:
    """The first of the places where nothing is covered; where there is none, the one where least is."""
    tried = []
    for rank, (dx, dy, horizontal, vertical) in enumerate(_PLACES):
        looks = {key: value for key, value in options.items() if key != "text"}
        note = axes.annotate(
            options["text"],
            place,
            xytext=(dx, dy),
            textcoords="offset points",
            ha=horizontal,
            va=vertical,
            annotation_clip=False,
            zorder=6,
            **looks,
        )
        box = note.get_window_extent(renderer)
        covered = sum(_common(box, other) for other in others) + 4 * _outside(box, axes.bbox)
        tried.append((covered, rank, note, box))
        if covered == 0:
            break
    covered, rank, note, box = min(tried, key=lambda one: one[:2])
    for *_, other, _box in tried:
        if other is not note:
            other.remove()
    dx, dy, *_ = _PLACES[rank]
    if abs(dx) + abs(dy) > 12:
        line = {"arrowstyle": "-", "linewidth": 0.4, "color": options["color"], "shrinkA": 0, "shrinkB": 2}
        axes.annotate("", place, xytext=(dx, dy), textcoords="offset points", arrowprops=line)
    return note, box


def _common(a: Bbox, b: Bbox) -> float:
    width = min(a.x1, b.x1) - max(a.x0, b.x0)
    height = min(a.y1, b.y1) - max(a.y0, b.y0)
    return width * height if width > 0 and height > 0 else 0.0


def _outside(box: Bbox, frame: Bbox) -> float:
    return box.width * box.height - _common(box, frame)
