"""Texts beside markers, so that they cover neither each other nor a marker."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
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
    markers: Sequence[tuple[float, float]],
    line: Sequence[tuple[float, float]] = (),
) -> None:
    """One text a place, each with the options of Axes.annotate; a text far from its place gets a thin line to it. Texts and
    these lines keep off the markers and off a line through the corners `line`, and the first texts choose first. All in
    data coordinates. The layout is fixed first, as it decides on what covers what."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    renderer = canvas.get_renderer()
    scale = figure.dpi / 72
    to_pixels = axes.transData.transform
    taken = [Bbox.from_extents(*(p - _MARKER * scale), *(p + _MARKER * scale)) for p in to_pixels(markers)]
    taken += _along(to_pixels(line), scale) if len(line) > 1 else []
    for place, options in zip(places, texts):
        taken += _put(axes, place, options, taken, renderer)


def _along(corners: np.ndarray, scale: float) -> list[Bbox]:
    """Small boxes along a line, in pixels."""
    boxes = []
    for a, b in zip(corners[:-1], corners[1:]):
        for part in np.linspace(0, 1, 2 + int(np.hypot(*(b - a)) / (3 * scale))):
            middle = a + part * (b - a)
            boxes.append(Bbox.from_extents(*(middle - scale), *(middle + scale)))
    return boxes


def _put(axes: Axes, place, options: Mapping[str, object], taken: Sequence[Bbox], renderer) -> list[Bbox]:
    """Writes the text at the first of the places where nothing is covered; where there is none, at the one where least
    is. What it covers itself, in pixels."""
    scale = axes.figure.dpi / 72
    anchor = axes.transData.transform(place)
    note = axes.annotate(xy=place, xytext=(0, 0), textcoords="offset points", annotation_clip=False, zorder=6, **options)

    def boxes_at(offset: tuple[float, float, str, str]) -> list[Bbox]:
        dx, dy, horizontal, vertical = offset
        note.set(position=(dx, dy), ha=horizontal, va=vertical)
        box = note.get_window_extent(renderer)
        if not _needs_line(offset):
            return [box]
        line = _along(np.array([anchor, anchor + scale * np.array([dx, dy])]), scale)
        return [box, *(part for part in line if np.hypot(*(part.p0 + scale - anchor)) > 2 * _MARKER * scale)]

    def covered(offset: tuple[float, float, str, str]) -> float:
        boxes = boxes_at(offset)
        return sum(_common(box, other) for box in boxes for other in taken) + 4 * _outside(boxes[0], axes.bbox)

    tried = []
    for offset in _PLACES:
        tried.append((covered(offset), offset))
        if tried[-1][0] == 0:
            break
    _, best = min(tried, key=lambda one: one[0])
    boxes = boxes_at(best)
    if _needs_line(best):
        look = {"arrowstyle": "-", "linewidth": 0.4, "color": options["color"], "shrinkA": 0, "shrinkB": 2}
        axes.annotate("", place, xytext=best[:2], textcoords="offset points", arrowprops=look)
    return boxes


def _needs_line(offset: tuple[float, float, str, str]) -> bool:
    return abs(offset[0]) + abs(offset[1]) > 12


def _common(a: Bbox, b: Bbox) -> float:
    width = min(a.x1, b.x1) - max(a.x0, b.x0)
    height = min(a.y1, b.y1) - max(a.y0, b.y0)
    return width * height if width > 0 and height > 0 else 0.0


def _outside(box: Bbox, frame: Bbox) -> float:
    return box.width * box.height - _common(box, frame)
