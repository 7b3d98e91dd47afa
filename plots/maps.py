"""Points, polygons and the difference of two multipolygons, drawn in axes.

Areas are painted by the nonzero winding rule, for which a shell must go round the other way than its holes. No overlay
is computed: where a result differs from the ground truth shows by painting one clipped by the other.
"""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from records import Picture
from style import role_color

Place = tuple[float, float]
Polygons = Sequence[Sequence[Sequence[Place]]]  # of rings: the shell, then its holes


def signed_area(ring: Sequence[Place]) -> float:
    """Positive when it goes counter-clockwise."""
    x, y = np.asarray(ring, dtype=float).T
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) / 2)


def area_path(polygons: Polygons) -> Path:
    """One path, shells counter-clockwise and holes clockwise. Rings of fewer than three vertices have no area."""
    vertices: list[Place] = []
    codes: list[int] = []
    for polygon in polygons:
        for index, ring in enumerate(polygon):
            if len(ring) < 3:
                continue
            is_hole = index > 0
            turned = list(ring) if (signed_area(ring) < 0) == is_hole else list(reversed(ring))
            vertices += [*turned, turned[0]]
            codes += [Path.MOVETO, *[Path.LINETO] * (len(ring) - 1), Path.CLOSEPOLY]
    return Path(np.asarray(vertices, dtype=float).reshape(-1, 2), codes)


def paint(axes: Axes, path: Path, color: str, clip: Path | None = None, **options: object) -> PathPatch:
    """An area without outline, cut to `clip`."""
    patch = PathPatch(path, facecolor=color, linewidth=0, **options)
    axes.add_patch(patch)
    if clip is not None:
        patch.set_clip_path(clip, axes.transData)
    return patch


def outline(axes: Axes, path: Path, color: str, width: float, **options: object) -> PathPatch:
    """Rings as lines; `width` in points."""
    patch = PathPatch(path, facecolor="none", edgecolor=color, linewidth=width, joinstyle="round", **options)
    return axes.add_patch(patch)


def difference(axes: Axes, truth: Path, result: Path) -> None:
    """What both have, what only the truth has and what only the result has, in their colours."""
    paint(axes, truth, role_color("omission"), zorder=1)
    if len(result.vertices):
        paint(axes, result, role_color("commission"), zorder=2)
        paint(axes, result, role_color("both"), clip=truth, zorder=3)


def points(axes: Axes, places: Sequence[Place], size: float, color: str | None = None) -> None:
    """`size` in points. As pixels: thousands of small marks are no use as curves."""
    x, y = zip(*places) if places else ((), ())
    axes.plot(
        x,
        y,
        linestyle="none",
        marker=".",
        markersize=size,
        markeredgewidth=0,
        rasterized=True,
        zorder=5,
        color=color or role_color("points"),
    )


def truth_and_points(axes: Axes, picture: Picture, width: float, size: float) -> None:
    """The outline of the ground truth, so wide, over points of that size."""
    outline(axes, area_path(picture.ground_truth()), role_color("ground_truth"), width, zorder=6)
    points(axes, picture.points(), size)
    frame(axes, picture)


def frame(axes: Axes, picture: Picture, margin: float = 0.03) -> None:
    """The box of the points and the ground truth, with a margin in parts of its larger side; no ticks, no grid."""
    places = np.asarray(picture.points() + [place for polygon in picture.ground_truth() for place in polygon[0]])
    low, high = places.min(axis=0), places.max(axis=0)
    gap = margin * float(max(high - low))
    axes.set_xlim(low[0] - gap, high[0] + gap)
    axes.set_ylim(low[1] - gap, high[1] + gap)
    axes.set_aspect("equal")
    axes.axis("off")
