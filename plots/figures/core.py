"""The core's time a point against the number of points, beside CGAL and GEOS, from core.json in the run's folder: what
Google Benchmark writes of build/core_benchmarks ('make figures-core')."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from statistics import median

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from records import read_json
from run import Drawn, Run, Skipped
from style import FULL_WIDTH, method_style, new_figure, number, panel_letter

_UNITS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
# By benchmark: whose colour and marker, whole hull or triangulation only, dashes, and what it is called.
_WHOLE, _TRIANGULATION = "concave hull", "triangulation"
_FUNCTIONS = {
    "concave_hull": ("polylidar", _WHOLE, (), "Polylidar"),
    "concave_hull_2_threads": ("polylidar", _WHOLE, (3, 1.5), "Polylidar, 2 threads"),
    "cgal_alpha_shape": ("cgal_alpha_shape", _WHOLE, (), "CGAL alpha shape"),
    "geos_concave_hull_with_holes": ("geos_concave_hull", _WHOLE, (), "GEOS concave hull with holes"),
    "triangulation": ("polylidar", _TRIANGULATION, (), "Polylidar"),
    "cgal_delaunay": ("cgal_alpha_shape", _TRIANGULATION, (), "CGAL"),
    "geos_delaunay": ("geos_concave_hull", _TRIANGULATION, (), "GEOS"),
}
# Of what Google Benchmark writes, what is read here.
_ENTRY = {
    "type": "object",
    "required": ["run_name"],
    "properties": {"run_name": {"type": "string"}},
    "if": {"properties": {"run_name": {"pattern": f"^({'|'.join(_FUNCTIONS)})/uniform/"}, "error_occurred": {"enum": [False]}}},
    "then": {
        "required": ["real_time", "time_unit"],
        "properties": {
            "run_name": {"pattern": "^[^/]+/uniform/[1-9][0-9]*$"},
            "real_time": {"type": "number"},
            "time_unit": {"enum": list(_UNITS)},
        },
    },
}
_SCHEMA = {"type": "object", "required": ["benchmarks"], "properties": {"benchmarks": {"type": "array", "items": _ENTRY}}}


@dataclass
class Times:
    """Of one function on one number of points, in nanoseconds: every repetition's time of one call."""

    n: int
    calls: list[float] = field(default_factory=list)

    @property
    def a_point(self) -> float:
        return median(self.calls) / self.n


def draw(run: Run) -> Iterator[Drawn]:
    path = run.file("core.json", maker="'make figures-core' writes it")
    curves = read(read_json(path, _SCHEMA, "; 'make figures-core' writes it"))
    if not curves:
        raise Skipped(f"{path} has none of the functions that are shown")
    caption = (
        "Time a point against the number of points, uniformly distributed in a square, on logarithmic axes: the whole "
        "concave hull (a) and its triangulation alone (b), in one process. Lines join medians of the repetitions, bars "
        "reach from the fastest to the slowest. A function without a point at a number was not asked for it."
    )
    yield Drawn("core", _figure(curves), caption)


def read(document: dict) -> dict[str, list[Times]]:
    """By function: its times, by rising number of points. Aggregates and benchmarks that failed are passed over."""
    found: dict[tuple[str, int], Times] = {}
    for entry in document["benchmarks"]:
        name, _, rest = entry["run_name"].partition("/")
        point_set, _, n = rest.partition("/")
        wanted = name in _FUNCTIONS and point_set == "uniform" and entry.get("run_type") != "aggregate"
        if wanted and not entry.get("error_occurred"):
            times = found.setdefault((name, int(n)), Times(int(n)))
            times.calls.append(entry["real_time"] * _UNITS[entry["time_unit"]])
    curves: dict[str, list[Times]] = {}
    for name, n in sorted(found, key=lambda key: (list(_FUNCTIONS).index(key[0]), key[1])):
        curves.setdefault(name, []).append(found[name, n])
    return curves


def _figure(curves: dict[str, list[Times]]) -> Figure:
    figure = new_figure(FULL_WIDTH, 76)
    panels = figure.subplots(1, 2, sharey=True)
    for axes, what, letter in zip(panels, (_WHOLE, _TRIANGULATION), "ab"):
        for name, times in curves.items():
            if _FUNCTIONS[name][1] == what:
                _curve(axes, name, times)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter(number)
        axes.yaxis.set_minor_formatter(NullFormatter())
        axes.set_xlabel("Number of points")
        panel_letter(axes, letter, what)
        axes.legend(loc="upper left", handlelength=2.6)
    low, high = panels[0].get_ylim()
    panels[0].set_ylim(low, high * (high / low) ** 0.4)  # room for the legends
    panels[0].set_ylabel("Time a point (ns)")
    return figure


def _curve(axes: Axes, name: str, times: list[Times]) -> None:
    method, _, dashes, title = _FUNCTIONS[name]
    look = method_style(method)
    middle = [one.a_point for one in times]
    below = [one.a_point - min(one.calls) / one.n for one in times]
    above = [max(one.calls) / one.n - one.a_point for one in times]
    line = {"linewidth": 1.3, "linestyle": (0, dashes) if dashes else "-", "marker": look.marker, "markersize": 3.6}
    numbers = [one.n for one in times]
    axes.errorbar(numbers, middle, yerr=[below, above], label=title, color=look.color, elinewidth=0.7, capsize=1.5, **line)
