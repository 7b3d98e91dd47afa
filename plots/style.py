"""The look of every figure: sizes, colours, markers and lines, and how a series is called.

Colours, markers, lines, short titles and the order of the methods are in methods.json, which the HTML report reads too:
a method looks the same everywhere. The colours of the paper's methods are those of Okabe and Ito, which people with any
kind of colour blindness can tell apart; the others have markers and dashes of their own, as that many colours cannot be
told apart by anybody. A filled marker says that the parameters follow the paper, a pale one that they are the method's
default, an open one neither.
"""

import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import matplotlib

matplotlib.use("Agg")
from matplotlib.artist import Artist  # noqa: E402  the backend comes first
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.colors import to_rgb  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.legend import Legend  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

from records import Series  # noqa: E402
from report_common import LOOKS, in_order, method_look  # noqa: E402
from report_common import short_name as label  # noqa: E402  what figures call a series

MILLIMETRE = 1 / 25.4  # in inches, matplotlib's unit
ONE_COLUMN = 85  # widths of a printed column and of a page, in millimetres
FULL_WIDTH = 180

_MARKERS = {
    "circle": "o",
    "square": "s",
    "triangle": "^",
    "diamond": "D",
    "triangle-down": "v",
    "pentagon": "p",
    "hexagon": "h",
    "star": "*",
    "plus": "P",
    "cross": "X",
    "thin-diamond": "d",
    "triangle-left": "<",
    "triangle-right": ">",
    "octagon": "8",
    "bar": "|",
    "star-four": (4, 1, 0),
    "star-three": (3, 1, 0),
    "star-six": (6, 1, 0),
    "hexagon-flat": "H",
}
# In points, where the usual 3.6 looks too small or, on top of CGAL's marker, too large.
_SIZES = {"o": 3.2, "s": 4.2, "*": 5.2, "P": 4.2, "X": 4.2, "d": 4.4, "|": 5.0}

RC = {
    "font.family": "DejaVu Sans",
    "font.size": 7.5,
    "axes.labelsize": 7.5,
    "axes.titlesize": 8,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.5,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
    "legend.fontsize": 7,
    "legend.frameon": False,
    "mathtext.default": "regular",
    "figure.dpi": 100,
    "savefig.dpi": 200,
    "pdf.fonttype": 42,
    "svg.fonttype": "path",
    "svg.hashsalt": "hullbench",
}


@dataclass(frozen=True)
class MethodStyle:
    """How a method looks. Widths in points, dashes in line widths."""

    title: str
    order: int
    paper: bool  # whether the paper compares it
    color: str
    marker: str | tuple[int, int, int]
    dashes: tuple[float, ...]
    width: float

    @property
    def line(self) -> str | tuple[float, tuple[float, ...]]:
        return (0, self.dashes) if self.dashes else "-"


def method_style(method: str) -> MethodStyle:
    look = method_look(method)
    return MethodStyle(
        look["title"],
        look["order"],
        look["paper"],
        look["color"]["light"],
        _MARKERS[look["marker"]],
        tuple(look["line"]),
        look.get("width", 1.5 if look["paper"] else 0.8),
    )


def role_color(role: str) -> str:
    """Of what is no method: ground_truth, points, both, omission, commission, hole, paper_value."""
    return LOOKS["roles"][role]


def step_color(step: str) -> str:
    return LOOKS["steps"].get(step, LOOKS["steps"]["other"])


def marker_options(one: Series, scale: float = 1) -> dict[str, object]:
    """Of a series' markers, as keywords of plot; `scale` times the usual size. The label says which series it is and,
    as it begins with an underscore, does not show in legends."""
    look = method_style(one[0])
    size = _SIZES.get(look.marker, 3.6) * scale
    return {
        "label": "_" + "/".join(one),
        "marker": look.marker,
        "markersize": size,
        "markerfacecolor": {"paper": look.color, "default": _pale(look.color)}.get(one[1], "white"),
        "markeredgecolor": look.color,
        "markeredgewidth": 0.8,
    }


def _pale(color: str) -> list[float]:
    return [1 - 0.45 * (1 - part) for part in to_rgb(color)]


def line_options(one: Series) -> dict[str, object]:
    """Of a series' line with markers, as keywords of plot. The paper's methods lie above the others, Polylidar on top:
    CGAL's line, which has the same error, is wider, and so both are seen."""
    look = method_style(one[0])
    return {
        "color": look.color,
        "linewidth": look.width,
        "linestyle": look.line,
        "zorder": 4 + 1 / look.order if look.paper else 3,
        **marker_options(one),
    }


def curve_options(one: Series, among: Iterable[Series], least: float) -> dict[str, object]:
    """Of one of many curves, `least` points wide, as keywords of plot."""
    look = method_style(one[0])
    return {
        "color": look.color,
        "linestyle": look.line,
        "linewidth": max(look.width, least),
        "zorder": 4 + 1 / look.order,
        "label": label(one, among),
    }


def series_legend(axes: Axes, series: Iterable[Series], missing: Iterable[Series] = (), columns: int = 5) -> None:
    """One legend for a whole figure, in axes of its own; the paper's methods in bold, those without data grey."""
    absent = set(missing)
    every = in_order([*series, *absent])
    titles = [label(one, every) + (" (none)" if one in absent else "") for one in every]
    handles = [Line2D([], [], **{**line_options(one), "label": title}) for one, title in zip(every, titles)]
    legend = legend_below(axes, handles, titles, handlelength=3, ncol=columns, columnspacing=1.4)
    for one, text in zip(every, legend.get_texts()):
        if method_style(one[0]).paper:
            text.set_fontweight("bold")
        if one in absent:
            text.set_color("#888888")


def legend_below(axes: Axes, handles: Iterable[Artist], titles: Iterable[str], **look: object) -> Legend:
    """In axes of its own. It may be wider than they are, and does not make the panels narrower."""
    axes.axis("off")
    legend = axes.legend(handles, titles, loc="center", borderaxespad=0, **look)
    legend.set_in_layout(False)
    return legend


def new_figure(width_mm: float, height_mm: float) -> Figure:
    """An empty figure of this printed size."""
    return Figure(figsize=(width_mm * MILLIMETRE, height_mm * MILLIMETRE), layout="constrained")


def legend_row(axes: Axes, handles: Sequence[Artist], text: str = "") -> None:
    """A legend in one line at the right of axes of its own, and at their left a note in lines that end before it."""
    axes.axis("off")
    axes.legend(handles=handles, loc="center right", ncol=len(handles), fontsize=6.5, handlelength=1.6, borderaxespad=0)
    axes.text(0, 0.5, textwrap.fill(text, 75), transform=axes.transAxes, va="center", fontsize=6.5, color="#444444")


def footnote(figure: Figure, text: str) -> None:
    """Small text under the figure, in lines as wide as it; nothing when there is none."""
    if text:
        characters = int(figure.get_figwidth() / MILLIMETRE / 1.25)  # of 6.5 points, on average 1.25 mm wide
        figure.supxlabel(textwrap.fill(text, characters), x=0.01, ha="left", fontsize=6.5, color="#444444")


def panel_letter(axes: Axes, letter: str, text: str) -> None:
    """The panel's letter, if it is not the only one, and what it shows, above its left edge."""
    axes.set_title(f"({letter}) {text}" if letter else text, loc="left", fontsize=8, pad=4)


def number(value: float, _position: object = None) -> str:
    """A tick's text: 0.5, 20, 1,000,000."""
    return f"{value:,.10g}"
