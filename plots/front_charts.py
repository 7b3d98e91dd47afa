"""The two charts of the first screen: cases and error targets solved against time, and time against error."""

import math
from collections.abc import Sequence

import numpy as np

import svg
from markup import table
from ratings import LEAST_TARGET, TARGET_WORDS, Division, pareto, solved_against_time, typical_errors, typical_times
from records import Series
from report_common import count_of, method_look, number, sentence_list, short_name, text

WIDE, NARROW = (590, 350), (356, 300)
# Named in a chart; the others are thin and grey.
MOST_NAMED = 7


def charts_html(timed: Division | None) -> str:
    if timed is None:
        return "<p class='muted'>The run has no times of these methods that belong together, so there is no chart of speed.</p>"
    return f"<div class='charts wide'>{solved_figure(timed)}{time_error_figure(timed)}</div>"


def _figure(identity: str, title: str, note: str, charts: Sequence[str], values: str) -> str:
    return (
        f"<figure class='plot' id='{identity}'><figcaption>{text(title)}</figcaption>{''.join(charts)}"
        f"<p class='muted'>{text(note)}</p><details class='values'><summary>Values</summary>{values}</details></figure>"
    )


def color_of(series: Series) -> str:
    return f"var(--method-{text(series.method)},var(--muted))"


def _dashes(series: Series) -> str:
    dashes = method_look(series.method)["line"]
    return f";stroke-dasharray:{','.join(f'{2 * one:g}' for one in dashes)}" if dashes else ""


def solved_figure(division: Division) -> str:
    curves = solved_against_time(division)
    every = list(curves)
    times = [one[0] for one in curves.values() if len(one[0])]
    low, high = min(one[0] for one in times) / 1.2, max(one[-1] for one in times) * 1.2
    timed = [one for one in every if len(curves[one][0])]
    highest = max(timed, key=lambda one: curves[one][1][-1])
    named = sorted(timed, key=lambda one: (one != highest, -_area(curves[one], low, high)))[:MOST_NAMED]
    charts = [
        _solved_chart(curves, named, (low, high), size, css) for size, css in ((WIDE, "wide-only"), (NARROW, "narrow-only"))
    ]
    count = len(division.results.cases)
    note = f"{TARGET_WORDS[:1].upper()}{TARGET_WORDS[1:]}; {count_of(count, 'case')}. Left is faster, higher more accurate. A failure solves nothing."
    reached = {one: y[-1] if len(y) else 0 for one, (_, y) in curves.items()}
    rows = [[text(short_name(one, every)), number(100 * reached[one])] for one in sorted(every, key=lambda one: -reached[one])]
    values = table({"Method": "", "Solved in the end, %": "number"}, rows)
    return _figure(f"solved-{division.name}", "Cases and error targets solved in time", note, charts, values)


def _area(curve: tuple[np.ndarray, np.ndarray], low: float, high: float) -> float:
    """Below the curve, over the logarithm of time: who is fast and accurate has much of it."""
    x, y = curve
    return float(np.sum(np.diff(np.log([*x, high])) * y) / math.log(high / low))


def _solved_chart(curves, named: Sequence[Series], ends: tuple[float, float], size: tuple[int, int], css: str) -> str:
    every = list(curves)
    right = 12 + max(svg.width_of(short_name(one, every), True) for one in named)
    chart = svg.Chart.of(size, right, ends, (0, 100), False)
    body = []
    for one in [*(other for other in every if other not in named), *reversed(named)]:
        x, y = curves[one]
        corners = [(ends[0], 0.0)]
        for at, share in _thinned(x, y):
            corners += [(at, corners[-1][1]), (at, 100 * share)]
        corners.append((ends[1], corners[-1][1]))
        style = f"stroke:{color_of(one)}{_dashes(one)}" if one in named else ""
        body.append(chart.line(corners, "curve" if one in named else "curve other", style, short_name(one, every)))
    tops = [chart.y(100 * curves[one][1][-1]) for one in named]
    for one, top, place in zip(named, tops, svg.apart(tops, chart.y.end + 2, chart.y.start - 2)):
        x = chart.x.end
        body.append(f"<path class='leader' d='M{x:.0f} {top:.1f}L{x + 8:.0f} {place:.1f}' style='stroke:{color_of(one)}'/>")
        body.append(f"<text class='name' x='{x + 10:.0f}' y='{place + 4:.1f}'>{text(short_name(one, every))}</text>")
    best = max(named, key=lambda one: curves[one][1][-1])
    label = f"In the end {short_name(best, every)} has solved the most, {number(100 * curves[best][1][-1])} % of all pairs of case and error target."
    return chart.html(label, "µs a point", "Solved, %", body, css)


def _thinned(x: np.ndarray, y: np.ndarray, step: float = 0.002) -> list[tuple[float, float]]:
    """The curve's corners, those that nobody would see left out."""
    kept: list[tuple[float, float]] = []
    for at, share in zip(x.tolist(), y.tolist()):
        if not kept or share - kept[-1][1] >= step or share == y[-1]:
            if not kept or share > kept[-1][1]:
                kept.append((at, share))
    return kept


def time_error_figure(division: Division) -> str:
    times, errors = typical_times(division), typical_errors(division)
    every = list(times)
    errors = {one: max(error, LEAST_TARGET) for one, error in errors.items()}  # the axis has no 0
    shown = [one for one in every if math.isfinite(times[one]) and math.isfinite(errors[one])]
    front = pareto([(times[one], errors[one]) for one in shown])
    missing = [short_name(one, every) for one in every if one not in shown]
    note = "Medians over the same cases. The line is the front: nobody is faster and more accurate at once. Filled: parameters by the paper’s rules; hollow: by others."
    note += " Errors below 0.01 % are shown as that." if min(errors.values()) <= LEAST_TARGET else ""
    note += f" Not shown, as most cases fail: {sentence_list(missing)}." if missing else ""
    charts = shown and [
        _time_error_chart(times, errors, shown, front, size, css)
        for size, css in ((WIDE, "wide-only"), (NARROW, "narrow-only"))
    ]
    rows = [
        [text(short_name(one, every)), number(times[one]), number(100 * errors[one])]
        for one in sorted(every, key=lambda one: errors[one])
    ]
    values = table({"Method": "", "µs a point": "number", "L2 error, %": "number"}, rows)
    return _figure(f"time-error-{division.name}", "Time and error", note, charts, values)


def _time_error_chart(times, errors, shown: Sequence[Series], front: Sequence[int], size: tuple[int, int], css: str) -> str:
    every = list(times)
    x, y = [times[one] for one in shown], [100 * errors[one] for one in shown]
    chart = svg.Chart.of(size, 14, (min(x) / 1.5, max(x) * 1.8), (min(y) / 1.4, max(y) * 1.4), True)
    on_front = [shown[i] for i in front]
    corners = [(x[front[0]], chart.y.high)]
    for i in front:
        corners += [(x[i], corners[-1][1]), (x[i], y[i])]
    corners.append((chart.x.high, corners[-1][1]))
    body = [chart.line(corners, "front", "", "The front")]
    places = [(chart.x(a), chart.y(b)) for a, b in zip(x, y)]
    order = sorted(range(len(shown)), key=lambda i: (shown[i] not in on_front, errors[shown[i]]))
    names = [short_name(shown[i], every) for i in order]
    box = (chart.x.start, chart.y.end - 6, chart.width - 2.0, chart.y.start)
    line = [(chart.x(a), chart.y(b)) for a, b in corners]
    widths = [svg.width_of(name, shown[i] in on_front) for i, name in zip(order, names)]
    found = svg.beside([places[i] for i in order], widths, places, line, box)
    for i, name, at in zip(order, names, found):
        one = shown[i]
        fill = color_of(one) if one.protocol == "paper" else "var(--panel)"
        title = f"{name}: {number(x[i])} µs a point, {number(y[i])} %"
        body.append(chart.mark(x[i], y[i], 5 if one in on_front else 3.5, f"stroke:{color_of(one)};fill:{fill}", title))
        if at:
            css_name = "name" if one in on_front else "name quiet"
            body.append(f"<text class='{css_name}' x='{at[0]:.1f}' y='{at[1]:.1f}' text-anchor='{at[2]}'>{text(name)}</text>")
    label = f"On the front, from the fastest on: {sentence_list([short_name(one, every) for one in on_front])}."
    return chart.html(label, "µs a point", "Median L2 error, %", body, css)
