"""Small charts as SVG that needs no script: axes, lines, marks and the names beside them. Colours are the page's custom
properties, so the charts follow its theme."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

from report_common import number, text

_FONT_SIZE = 11.5
# Of a name from its mark, the best first.
_OFFSETS = ((8, 4), (6, -6), (6, 14), (2, -9), (2, 17))
_LINE = 14.0  # between the names under each other
_BESIDE = 2.0  # free on either side of a name
_LEFT, _TOP, _BOTTOM = 42.0, 10.0, 38.0


@dataclass(frozen=True)
class Scale:
    """From values to pixels; `low` and `high` are at the ends."""

    low: float
    high: float
    start: float
    end: float
    log: bool

    def __call__(self, value: float) -> float:
        low, high, at = (math.log10(one) if self.log else one for one in (self.low, self.high, value))
        return self.start + (at - low) / (high - low) * (self.end - self.start)

    def ticks(self) -> list[float]:
        """Decades, with more steps between them where there are few; of a linear scale quarters."""
        if not self.log:
            return [self.low + k * (self.high - self.low) / 4 for k in range(5)]
        first, last = math.floor(math.log10(self.low)), math.ceil(math.log10(self.high))
        span = self.high / self.low
        steps = (1, 1.5, 2, 3, 5, 7) if span < 5 else (1, 2, 5) if span < 100 else (1,)
        found = [step * 10.0**k for k in range(first, last + 1) for step in steps]
        return [one for one in found if self.low * 0.999 <= one <= self.high * 1.001]


@dataclass(frozen=True)
class Chart:
    """A chart's size and scales; `right` is left free for names."""

    width: int
    height: int
    x: Scale
    y: Scale

    @staticmethod
    def of(size: tuple[int, int], right: float, x: tuple[float, float], y: tuple[float, float], log_y: bool) -> Chart:
        width, height = size
        return Chart(width, height, Scale(*x, _LEFT, width - right, True), Scale(*y, height - _BOTTOM, _TOP, log_y))

    def html(self, label: str, x_title: str, y_title: str, body: Sequence[str], name: str) -> str:
        """`label` says in a sentence what is to be seen; `name` is a class."""
        inner = [*self._axes(x_title, y_title), *body]
        return (
            f"<svg class='chart {name}' viewBox='0 0 {self.width} {self.height}' role='img' aria-label='{text(label)}'>"
            f"{''.join(inner)}</svg>"
        )

    def _axes(self, x_title: str, y_title: str) -> list[str]:
        left, right, top, bottom = self.x.start, self.x.end, self.y.end, self.y.start
        made = []
        for value in self.x.ticks():
            x = self.x(value)
            made.append(f"<path class='grid' d='M{x:.1f} {top:.0f}V{bottom:.0f}'/>")
            made.append(f"<text x='{x:.1f}' y='{bottom + 15:.0f}' text-anchor='middle'>{value:g}</text>")
        for value in self.y.ticks():
            y = self.y(value)
            made.append(f"<path class='grid' d='M{left:.0f} {y:.1f}H{right:.0f}'/>")
            made.append(f"<text x='{left - 6:.0f}' y='{y + 4:.1f}' text-anchor='end'>{value:g}</text>")
        made.append(
            f"<text class='title' x='{(left + right) / 2:.0f}' y='{self.height - 5}' text-anchor='middle'>{text(x_title)}</text>"
        )
        middle = f"transform='translate(11 {(top + bottom) / 2:.0f}) rotate(-90)'"
        made.append(f"<text class='title' {middle} text-anchor='middle'>{text(y_title)}</text>")
        return made

    def line(self, points: Sequence[tuple[float, float]], css: str, style: str, title: str) -> str:
        steps = "".join(f"{'L' if k else 'M'}{self.x(x):.1f} {self.y(y):.1f}" for k, (x, y) in enumerate(points))
        return f"<path class='{css}' d='{steps}' style='{style}'><title>{text(title)}</title></path>"

    def mark(self, x: float, y: float, radius: float, style: str, title: str) -> str:
        at = f"cx='{self.x(x):.1f}' cy='{self.y(y):.1f}' r='{radius:g}'"
        return f"<circle class='mark' {at} style='{style}'><title>{text(title)}</title></circle>"


@functools.cache
def width_of(name: str, bold: bool) -> float:
    """Of a name beside a mark, in pixels. That of DejaVu Sans, the widest of the page's fonts."""
    font = FontProperties(family="DejaVu Sans", weight="bold" if bold else "normal", size=_FONT_SIZE)
    return text_to_path.get_text_width_height_descent(name, font, ismath=False)[0]


def apart(places: Sequence[float], low: float, high: float) -> list[float]:
    """Near the places, in their order, a line from each other and inside of the limits."""
    order = sorted(range(len(places)), key=lambda k: places[k])
    found = [0.0] * len(places)
    last = low - _LINE
    for k in order:
        last = found[k] = max(places[k], last + _LINE)
    last = high + _LINE
    for k in reversed(order):
        last = found[k] = min(found[k], last - _LINE)
    return found


def beside(
    places: Sequence[tuple[float, float]],
    widths: Sequence[float],
    taken: Sequence[tuple[float, float]],
    line: Sequence[tuple[float, float]],
    box: tuple[float, float, float, float],
) -> list[tuple[float, float, str] | None]:
    """Where a name of each width may stand, as (x, baseline, text-anchor), without covering another one, a mark in `taken`
    or the line, whose parts go across or down; None: there is no room. `box`: left, top, right, bottom. The first choose
    first."""
    covered = [(x - 4, y - 4, x + 4, y + 4) for x, y in taken]
    for (x1, y1), (x2, y2) in zip(line, line[1:]):
        covered.append((min(x1, x2) - 1, min(y1, y2) - 1, max(x1, x2) + 1, max(y1, y2) + 1))
    found: list[tuple[float, float, str] | None] = []
    for (x, y), width in zip(places, widths):
        choices = [(x + reach, y + up, "start") for reach, up in _OFFSETS]
        choices += [(x - reach, y + up, "end") for reach, up in _OFFSETS]
        chosen = None
        for left, base, anchor in choices:
            start = left if anchor == "start" else left - width
            area = (start - _BESIDE, base - 10, start + width + _BESIDE, base + 2)
            inside = box[0] <= area[0] and area[2] <= box[2] and box[1] <= area[1] and area[3] <= box[3]
            if inside and not any(_overlap(area, other) for other in covered):
                chosen = (left, base, anchor)
                covered.append(area)
                break
        found.append(chosen)
    return found


def _overlap(one: tuple[float, float, float, float], other: tuple[float, float, float, float]) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
