"""plots/make_figures.py: the figures show the record's own numbers, and every run gives the same bytes."""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import unittest
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from unittest import mock

import matplotlib.colors
import plot_samples
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.text import Text
from plot_tests import PLOTS, call  # first, for what is in plots/

import make_figures
import maps
import ratings
from figures import alphabet, choosing, core, examples, hulls, profiles, random_polygons
from figures import ratings as ratings_figure
from figures import real, rgbd, sensitivity, shapes, solved, states, steps, summary
from labels import place_labels
from records import Row, load
from run import Drawn, Run, Skipped, read_paper
from style import in_order, method_style

LOOKS = json.loads((PLOTS / "methods.json").read_text(encoding="utf-8"))


def lines_by_label(axes: Axes) -> dict[str, Line2D]:
    return {line.get_label(): line for line in axes.get_lines()}


def texts(figure: Figure) -> str:
    return "\n".join(artist.get_text() for artist in figure.findobj(Text))


def setUpModule() -> None:
    """One suite for all tests; none of them changes it."""
    WithSuite.base = Path(unittest.enterModuleContext(tempfile.TemporaryDirectory()))
    WithSuite.folder = plot_samples.write_suite(WithSuite.base / "suite")
    WithSuite.run_ = Run(WithSuite.folder, load(WithSuite.folder), read_paper())


class WithSuite(unittest.TestCase):
    base: Path
    folder: Path
    run_: Run
    drawn: dict[str, dict[str, Drawn]] = {}

    def rows(self, experiment: str) -> list[dict[str, Any]]:
        return plot_samples.suite()[experiment]["runs"]

    def draw(self, module: Any) -> dict[str, Drawn]:
        """What the module draws of the suite, drawn once for all tests."""
        if module.__name__ not in self.drawn:
            with matplotlib.rc_context(make_figures.RC):
                self.drawn[module.__name__] = {one.name: one for one in module.draw(self.run_)}
        return self.drawn[module.__name__]


class Data(WithSuite):
    def test_states_show_medians_errors_and_intervals(self) -> None:
        drawn = self.draw(states)
        self.assertEqual(list(drawn), ["states_ca", "states_hi"])
        for dataset in ("ca", "hi"):
            panels = drawn[f"states_{dataset}"].figure.axes[:4]
            for k, axes in enumerate(panels):
                holes, quantity = bool(k % 2), ("time", "time", "l2", "l2")[k]
                self.assertEqual((axes.get_xscale(), axes.get_yscale()), ("log", "log"))
                lines = lines_by_label(axes)
                for method, protocol in plot_samples.SERIES:
                    line = lines[f"_{method}/{protocol}"]
                    self.assertEqual(list(line.get_xdata()), list(plot_samples.SIZES))
                    expected = [self._value(method, protocol, dataset, n, holes, quantity) for n in plot_samples.SIZES]
                    self.assertEqual(list(line.get_ydata()), expected)

    def test_the_band_is_the_interval(self) -> None:
        axes = self.draw(states)["states_hi"].figure.axes[0]
        color = matplotlib.colors.to_rgb(method_style("polylidar").color)
        (band,) = [one for one in axes.collections if tuple(one.get_facecolor()[0][:3]) == color]
        vertices = {(round(x), y) for x, y in band.get_paths()[0].vertices}
        for n in plot_samples.SIZES:
            row = plot_samples.summary_row(plot_samples.run("polylidar", "paper", "hi", n, False))
            self.assertIn((n, row["time"]["median_low_ns"] / 1e6), vertices)
            self.assertIn((n, row["time"]["median_high_ns"] / 1e6), vertices)

    def test_the_inset_shows_the_same_times_on_linear_axes(self) -> None:
        axes = self.draw(states)["states_ca"].figure.axes[0]
        (inset,) = axes.child_axes
        self.assertEqual((inset.get_xscale(), inset.get_yscale()), ("linear", "linear"))
        whole = lines_by_label(axes)
        for name, line in lines_by_label(inset).items():
            self.assertEqual(list(line.get_ydata()), list(whole[name].get_ydata()))
            self.assertEqual([1000 * n for n in line.get_xdata()], list(whole[name].get_xdata()))

    def test_alphabet_bars_are_the_papers_error(self) -> None:
        figure = self.draw(alphabet)["alphabet"].figure
        by_title = {axes.get_title(loc="left").split("  ")[0]: axes for axes in figure.axes}
        bars = by_title["Polylidar"].patches
        expected = [
            100 * plot_samples.run("polylidar", "paper", f"letter_{one}", 2000)["metrics"]["l2_paper"]
            for one in plot_samples.LETTERS
        ]
        self.assertEqual([bar.get_height() for bar in bars], expected)
        published = read_paper()["collections"][1]["by_shape"]
        diamonds = by_title["Polylidar"].get_lines()[-1]
        self.assertEqual(list(diamonds.get_ydata()), [published[f"letter_{one}"]["polylidar"] for one in plot_samples.LETTERS])
        self.assertIn("not installed", texts(figure))

    def test_random_polygons_are_all_there(self) -> None:
        axes = self.draw(random_polygons)["random_polygons"].figure.axes[0]
        stars = [row["metrics"] for row in self.rows("random") if row["dataset"].startswith("star-")]
        cloud = lines_by_label(axes)["_runs"]
        self.assertEqual(list(cloud.get_xdata()), [one["ground_truth_convexity"] for one in stars])
        self.assertEqual(list(cloud.get_ydata()), [100 * one["l2_paper"] for one in stars])
        median = lines_by_label(axes)["_median"]
        self.assertGreater(len(median.get_xdata()), 3)
        for x, y in zip(median.get_xdata(), median.get_ydata()):
            inside = [100 * one["l2_paper"] for one in stars if abs(one["ground_truth_convexity"] - x) < 0.0125]
            self.assertAlmostEqual(y, statistics.median(inside), places=12)

    def test_steps_are_means_of_the_repetitions(self) -> None:
        measured = steps.measured_steps(self.run_.experiment("steps"), self.run_.paper["steps"])
        row = plot_samples.run("polylidar_steps", "paper", "ca", 64000, True)
        found, _ = measured["polylidar_steps"]
        self.assertAlmostEqual(found["triangulation"], statistics.mean(p["run.triangulation"] for p in row["phases_ns"]) / 1e6)
        self.assertAlmostEqual(sum(found.values()), statistics.mean(p["run"] + p["extract"] for p in row["phases_ns"]) / 1e6)
        axes = self.draw(steps)["steps"].figure.axes[0]
        ours = [bar.get_width() for bar in axes.patches if bar.get_y() < 0.5]
        paper = [bar.get_width() for bar in axes.patches if bar.get_y() > 0.5]
        for widths, times in ((ours, list(found.values())), (paper, [36.0, 4.4, 1.0])):
            self.assertEqual(len(widths), len(times))
            for width, time in zip(widths, times):
                self.assertAlmostEqual(width, time, places=9)  # matplotlib keeps a bar's edges

    def test_core_is_nanoseconds_a_point(self) -> None:
        curves = core.read(plot_samples.core())
        self.assertEqual(
            {name: [one.n for one in times] for name, times in curves.items()},
            dict.fromkeys(("concave_hull", "cgal_alpha_shape", "triangulation"), [1000, 100_000]),
        )
        self.assertAlmostEqual(curves["concave_hull"][1].a_point, 100.0)
        axes = self.draw(core)["core"].figure.axes[0]
        first = axes.containers[0].lines[0]
        self.assertEqual(list(first.get_ydata()), [one.a_point for one in curves["concave_hull"]])

    def test_profiles_are_those_of_the_league(self) -> None:
        drawn = self.draw(profiles)["profiles"]
        *panels, below = drawn.figure.axes
        groups = [one for group in ("blind", "informed") for one in plot_samples.league()["profiles"] if one["group"] == group]
        who = ["methods that see the points only", "methods that know the ground truth's area"]
        self.assertEqual([axes.get_title(loc="left")[4:] for axes in panels], who)
        for axes, group in zip(panels, groups):
            shares = {tuple(line.get_ydata()) for line in axes.get_lines()}
            self.assertEqual(shares, {tuple(100 * share for share in one["shares"]) for one in group["curves"]})
            self.assertEqual({tuple(line.get_xdata()) for line in axes.get_lines()}, {(1, 2, 10)})
        self.assertEqual([text.get_text() for text in below.get_legend().get_texts()], ["Polylidar", "SpatiaLite", "GEOS"])
        self.assertIn("Without a case, and so not shown: methods with the best value for each instance.", drawn.caption)

    def test_sensitivity_is_that_of_the_search(self) -> None:
        lengths, octaves, below = self.draw(sensitivity)["sensitivity"].figure.axes

        def curves(axes: Axes) -> list[tuple[list[float], list[float]]]:
            return [(list(line.get_xdata()), list(line.get_ydata())) for line in axes.get_lines()]

        # An error above the axis is left out, and so is a failure.
        self.assertEqual(curves(lengths), [([1, 2, 4], [3, 1.1, 2])])
        self.assertEqual(curves(octaves), [([0.5, 1, 2], [3, 1.1, 2]), ([0.5, 1, 2], [2, 1.2, 1.5])])
        self.assertEqual(
            [text.get_text() for text in below.get_legend().get_texts()], ["Polylidar, 1.2 octaves", "SpatiaLite, 1.2 octaves"]
        )

    def test_ratings_are_those_of_the_results(self) -> None:
        drawn = self.draw(ratings_figure)
        self.assertEqual(list(drawn), [f"{one}_{who}" for who in ("blind", "informed") for one in ("ratings", "wins", "parts")])
        (informed,) = [one for one in ratings.divisions(self.run_.results()) if one.name == "informed"]
        rating = ratings.rate(informed)
        ranks, elo = drawn["ratings_informed"].figure.axes
        for axes, values in ((ranks, "rank"), (elo, "elo")):
            marks = [line.get_xdata()[0] for line in axes.get_lines() if line.get_linestyle() == "None"]
            self.assertEqual(marks, [getattr(one, values) for one in rating.standings])
            bars = [tuple(line.get_xdata()) for line in axes.get_lines() if line.get_linestyle() != "None"]
            self.assertLessEqual({getattr(one, f"{values}_interval") for one in rating.standings}, set(bars))
        shown = drawn["wins_informed"].figure.axes[0].get_images()[0].get_array()
        self.assertTrue((shown == 100 * rating.wins).all())
        parts = drawn["parts_informed"].figure.axes[0].get_images()[0].get_array()
        self.assertEqual(parts.T.tolist(), [part.ranks for part in [*rating.kinds, *rating.samplers]])
        for words in (f"{len(informed.results.cases)} cases of", "at most 1 % of the smaller one", "Holm"):
            self.assertIn(words, drawn["ratings_informed"].caption)

    def test_solved_against_time_is_that_of_the_results(self) -> None:
        one = self.draw(solved)["solved"]
        found = ratings.divisions(self.run_.results(timed=True))
        for axes, division in zip(one.figure.axes, found):
            marks = [line for line in axes.get_lines() if len(line.get_xdata()) == 1]
            ends = {line.get_label(): (line.get_xdata()[0], line.get_ydata()[0]) for line in marks}
            curves = ratings.solved_against_time(division)
            self.assertEqual(ends, {f"_{series.key}": (x[-1], 100 * y[-1]) for series, (x, y) in curves.items()})
        self.assertIn("51 targets a case", one.caption)

    def test_the_cost_of_choosing_is_that_of_the_search(self) -> None:
        figure = self.draw(choosing)["choosing"].figure
        self.assertEqual([axes.get_title() for axes in figure.axes], ["Polylidar", "SpatiaLite", ""])
        for axes in figure.axes[:2]:
            curve, *chosen = axes.get_lines()
            self.assertEqual((list(curve.get_xdata()), list(curve.get_ydata())), ([2, 3], [50, 25]))  # 1: most cases fail
            self.assertEqual(
                [(line.get_label(), list(line.get_ydata())) for line in chosen], [("default", [75]), ("tuned", [75])]
            )

    def test_summary_shows_every_result_of_one_case(self) -> None:
        figure = self.draw(summary)["summary"].figure
        lines = lines_by_label(figure.axes[1])
        rows = [row for row in self.rows("states") if (row["dataset"], row["n"], row["holes"]) == ("ca", 4000, True)]
        ok = [row for row in rows if row["status"] == "ok"]
        self.assertEqual(set(lines) - {"_front"}, {f"_{row['method']}/{row['protocol']}" for row in ok})
        for row in ok:
            line = lines[f"_{row['method']}/{row['protocol']}"]
            self.assertEqual(line.get_xdata(), [sorted(row["time_ns"])[1] / 1e6])
            self.assertEqual(line.get_ydata(), [100 * row["metrics"]["l2"]])

    def test_near_results_of_one_method_share_a_label(self) -> None:
        def row(method: str, protocol: str, time: int, l2: float) -> Row:
            return Row(plot_samples.run(method, protocol, "ca", 1, True, "ok", l2=l2), {"time": {"median_ns": time}})

        near = [row("geos", "auto", 100, 0.1), row("geos", "paper", 110, 0.1), row("geos", "tuned", 110, 0.14)]
        far = [row("geos", "default", 100, 0.3), row("pcl", "paper", 100, 0.1)]
        groups = summary.neighbours([*near, *far])
        self.assertEqual(len(groups), 3)
        self.assertIn({one.series.key for one in near}, [{one.series.key for one in group} for group in groups])
        labels = [summary._label_options(group, groups)["text"] for group in groups]
        self.assertEqual(sorted(labels), ["geos", "geos (default)", "pcl"])

    def test_labels_cover_neither_each_other_nor_a_marker(self) -> None:
        figure = Figure(figsize=(4, 3), dpi=100)
        axes = figure.add_subplot()
        places = [(x, y) for x in (0.4, 0.5, 0.6) for y in (0.4, 0.5, 0.6)]
        axes.plot(*zip(*places), linestyle="none", marker="o", markersize=4)
        place_labels(figure, axes, places, [{"text": f"method {k}", "color": "black", "fontsize": 7} for k in range(9)], places)
        boxes = [note.get_window_extent() for note in axes.texts if note.get_text()]
        self.assertEqual(len(boxes), len(places))
        for k, box in enumerate(boxes):
            self.assertFalse(any(box.overlaps(other) for other in boxes[:k]))
            self.assertFalse(any(box.contains(*place) for place in axes.transData.transform(places)))

    def test_nothing_is_better_than_the_front(self) -> None:
        rows = [row for row in self.run_.experiment("states").rows if row.ok and row.case == "ca/n:8000/holes:1"]
        best = summary.front(rows)
        for row in rows:
            beaten = any(b.median_ns <= row.median_ns and b.metrics["l2"] <= row.metrics["l2"] for b in best if b is not row)
            self.assertEqual(row in best, not beaten)

    def test_pictures_show_every_series(self) -> None:
        figure = self.draw(hulls)["hulls_ca"].figure
        self.assertEqual(list(self.draw(hulls)), ["hulls_ca", "hulls_hi"])
        shown = texts(figure)
        for words in ("Polylidar", "GEOS (auto)", "GEOS (paper)", "somebodys_hull", "not installed", "4,000"):
            self.assertIn(words, shown + self.draw(hulls)["hulls_ca"].caption)
        picture = self.run_.experiment("states").picture("ca/n:8000/holes:1")
        for holes, words in ((False, "of CA. Grey"), (True, "of CA with holes. Grey")):
            self.assertIn(words, hulls._caption(picture, [Row(plot_samples.run("polylidar", "paper", "ca", 8000, holes), {})]))
        for module, names in ((shapes, ["shapes"]), (rgbd, ["rgbd"]), (examples, ["convex_and_concave", "convexity"])):
            self.assertEqual(list(self.draw(module)), names)

    def test_a_figure_of_one_method_is_of_one_protocol(self) -> None:
        runs = [("paper", 1), ("auto", 1), ("paper", 2), ("auto", 2), ("auto", 3)]
        rows = [Row(plot_samples.run("polylidar", protocol, f"floor-{k}", 900), {}) for protocol, k in runs]
        experiment = mock.Mock(rows=rows)
        experiment.picture_cases.return_value = [row.case for row in rows]
        scenes = rgbd._scenes(mock.Mock(), experiment)
        self.assertEqual([row.name for row, _ in scenes], [rows[0].name, rows[2].name])

    def test_real_points_have_a_panel_a_method_and_no_truth(self) -> None:
        rows = [plot_samples.run(*series, "real-trees", 700) for series in plot_samples.SERIES]
        for row in rows:
            row["metrics"].update({"points_covered": 0.985, "polygons": 3, "holes": 2, "l2": None})
        rows += [plot_samples.run("hull_js", "auto", "real-trees", 700, status="timeout")]
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place) / "suite"
            plot_samples.write_suite(folder, {"real": plot_samples.report("real", {"real-trees": 0}, rows)})
            path = folder / "real" / "pictures.jsonl"
            lines = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
            lines[0]["ground_truth"] = []
            path.write_text("".join(json.dumps(line) + "\n" for line in lines), encoding="utf-8")
            run = Run(folder, load(folder), read_paper())
            drawn = list(real.draw(run))
            for module in (hulls, shapes, states):
                with self.assertRaises(Skipped, msg=module.__name__):
                    list(module.draw(run))
        self.assertEqual([one.name for one in drawn], ["real_trees"])
        self.assertEqual(len(drawn[0].figure.axes), 1 + len(rows))
        shown = texts(drawn[0].figure)
        for words in ("Points", "98.5 %, 3 | 2", "timeout", "GEOS (auto)"):
            self.assertIn(words, shown)
        for words in ("700 points", "200 of them drawn", "not known", "hull.js (1 timeout)"):
            self.assertIn(words, drawn[0].caption)

    def test_rings_are_turned_for_the_winding_rule(self) -> None:
        clockwise = [(0.0, 0.0), (0.0, 4.0), (4.0, 4.0), (4.0, 0.0)]
        hole = [(1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 3.0)]
        path = maps.area_path([[clockwise, hole, [(9.0, 9.0)]]])
        self.assertEqual(len(path.vertices), 10)
        self.assertGreater(maps.signed_area([tuple(p) for p in path.vertices[:4]]), 0)
        self.assertLess(maps.signed_area([tuple(p) for p in path.vertices[5:9]]), 0)

    def _value(self, method: str, protocol: str, dataset: str, n: int, holes: bool, quantity: str) -> float:
        row = plot_samples.run(method, protocol, dataset, n, holes)
        return sorted(row["time_ns"])[1] / 1e6 if quantity == "time" else 100 * row["metrics"]["l2"]


class Honesty(WithSuite):
    def test_what_is_missing_or_failed_is_said(self) -> None:
        for module in (states, hulls, summary):
            one = next(iter(self.draw(module).values()))
            for text in (texts(one.figure), one.caption):
                self.assertIn("Not installed: PostGIS ≤ 3.2", text, one.name)
        one = self.draw(states)["states_ca"]
        self.assertIn("hull.js (1 timeout)", texts(one.figure))
        legend = texts(one.figure)
        for words in ("PostGIS ≤ 3.2 (none)", "hull.js", "GEOS (auto)", "GEOS (paper)", "somebodys_hull"):
            self.assertIn(words, legend)

    def test_a_figure_without_data_is_skipped_with_a_reason(self) -> None:
        code, out, _ = call(make_figures.main, self.folder / "steps", "--out", self.base / "only_steps")
        self.assertEqual(code, 0)
        for name in ("alphabet", "random_polygons", "rgbd", "core"):
            self.assertRegex(out, rf"(?m)^{name}: skipped, .+$")
        listed = (self.base / "only_steps" / "figures.md").read_text(encoding="utf-8")
        self.assertIn("- alphabet: the run has no experiment called alphabet", listed)

    def test_a_run_in_which_all_failed_gives_nothing(self) -> None:
        reports = {"steps": plot_samples.suite()["steps"]}
        for row in reports["steps"]["runs"]:
            row.update(status="crash", detail="signal", **plot_samples.FAILED)
        for row in reports["steps"]["summary"]["rows"]:
            row.update(status="crash", time=None)
        folder = plot_samples.write_suite(self.base / "failed", reports)
        for name in ("core.json", "league.json", "cases.csv", "tune.json.xz"):
            (folder / name).unlink()
        code, _, err = call(make_figures.main, folder)
        self.assertEqual(code, 6)
        self.assertEqual(len(err.splitlines()), 1)

    def test_a_broken_league_or_tuning_is_an_error(self) -> None:
        folder = plot_samples.write_suite(self.base / "broken_league", {"steps": plot_samples.suite()["steps"]})
        for name, figure in (
            ("league.json", "profiles"),
            ("league.csv", "ratings"),
            ("tune.json", "sensitivity"),
            ("tune.json.xz", "choosing"),
        ):
            for text in ("{", "{}", "[]", '{"profiles": [{}], "methods": [{}]}'):
                (folder / name).write_text(text, encoding="utf-8")
                code, _, err = call(make_figures.main, folder, "--only", figure)
                self.assertEqual((code, len(err.splitlines())), (2, 1), err)
            (folder / name).unlink()
        code, out, _ = call(make_figures.main, folder, "--only", "profiles")
        self.assertEqual(code, 6)
        self.assertIn("profiles: skipped", out)

    def test_a_broken_core_json_is_an_error(self) -> None:
        folder = plot_samples.write_suite(self.base / "broken", {"steps": plot_samples.suite()["steps"]})
        for text in ("{", "{}", '{"benchmarks": [{"run_name": "concave_hull/uniform/x"}]}', "[]"):
            (folder / "core.json").write_text(text, encoding="utf-8")
            code, _, err = call(make_figures.main, folder, "--only", "core")
            self.assertEqual((code, len(err.splitlines())), (2, 1), err)


class Style(WithSuite):
    def test_a_method_has_its_color_everywhere(self) -> None:
        seen = 0
        for module in (states, summary):
            for one in self.draw(module).values():
                for method, line in self._series_lines(one.figure):
                    color = matplotlib.colors.to_hex(line.get_markeredgecolor())
                    self.assertEqual(color, method_style(method).color)
                    if method in LOOKS["methods"]:
                        self.assertEqual(color, LOOKS["methods"][method]["color"]["light"])
                        seen += 1
        self.assertGreater(seen, 20)

    def test_no_two_methods_look_the_same(self) -> None:
        looks = [(look["color"]["light"], look["marker"], tuple(look["line"])) for look in LOOKS["methods"].values()]
        self.assertEqual(len(looks), len(set(looks)))
        apart = {name: look for name, look in LOOKS["methods"].items() if not name.endswith("_steps")}
        for key in ("light", "dark"):
            self.assertEqual(len({look["color"][key] for look in apart.values()}), len(apart))
        self.assertEqual(len({look["marker"] for look in apart.values()}), len(apart))
        self.assertEqual(len({look["order"] for look in LOOKS["methods"].values()}), len(LOOKS["methods"]))

    def test_every_planned_method_has_a_look(self) -> None:
        plans = [plan for plan in sorted((PLOTS.parent / "benchmarks" / "plans").glob("*.json")) if ".schema." not in plan.name]
        self.assertTrue(plans)
        for plan in plans:
            for entry in json.loads(plan.read_text(encoding="utf-8")).get("methods", []):
                self.assertIn(entry["method"], LOOKS["methods"], plan.name)

    def test_the_papers_methods_come_first(self) -> None:
        geos = [("geos_concave_hull", "auto"), ("geos_concave_hull", "paper")]
        series = in_order([("zebra", "paper"), *geos, *[("polylidar", "paper")] * 2])
        self.assertEqual([one[0] for one in series], ["polylidar", "geos_concave_hull", "geos_concave_hull", "zebra"])
        self.assertEqual(series[1][1], "paper")

    def _series_lines(self, figure: Figure) -> Iterator[tuple[str, Line2D]]:
        for line in figure.findobj(Line2D):
            label = line.get_label()
            if label.startswith("_") and label.count("/") == 1:
                yield label[1:].split("/")[0], line


class Fit(unittest.TestCase):
    def test_with_every_method_nothing_is_cut_off_or_collapses(self) -> None:
        methods = [method for method in LOOKS["methods"] if not method.endswith("_steps")]
        series = [(method, protocol) for method in methods for protocol in ("auto", "default")]  # more than a plan has
        shape = [plot_samples.run(*one, "ca", n, True) for one in series for n in (2000, 4000)]
        letters = [plot_samples.run(*one, f"letter_{letter}", 2000) for one in series for letter in "ab"]
        reports = {
            "states": plot_samples.report("states", {"ca": 0}, shape),
            "alphabet": plot_samples.report("alphabet", {"letter_a": 0, "letter_b": 0}, letters),
        }
        folder = plot_samples.write_suite(Path(self.enterContext(tempfile.TemporaryDirectory())) / "suite", reports)
        league, tuning = plot_samples.league(), plot_samples.tune()
        for profile in league["profiles"]:
            profile["curves"] = [{"method": one, "protocol": two, "shares": [0.1, 0.5, 0.9]} for one, two in series]
        tuning["methods"] = [{**tuning["methods"][0], "method": method} for method in methods]
        (folder / "league.json").write_text(json.dumps(league), encoding="utf-8")
        (folder / "tune.json").write_text(json.dumps(tuning), encoding="utf-8")
        run = Run(folder, load(folder), read_paper())
        with matplotlib.rc_context(make_figures.RC), warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)  # of matplotlib: that panels collapse
            for module in (alphabet, choosing, hulls, profiles, ratings_figure, sensitivity, solved, states, summary):
                for one in module.draw(run):
                    self.assert_fits(one)

    def assert_fits(self, one: Drawn) -> None:
        figure = one.figure
        figure.draw_without_rendering()
        boxes = [figure.get_tightbbox().transformed(figure.dpi_scale_trans)]
        boxes += [legend.get_window_extent() for legend in figure.findobj(Legend)]
        for box in boxes:
            outside = (-box.x0, -box.y0, box.x1 - figure.bbox.x1, box.y1 - figure.bbox.y1)
            self.assertLess(max(outside), 1, f"{one.name}: {outside} pixels")


class Files(WithSuite):
    def test_another_process_writes_the_same_files_byte_for_byte(self) -> None:
        out, again = self.base / "figures", self.base / "figures_again"
        command = [sys.executable, "-B", "-W", "error::UserWarning", PLOTS / "make_figures.py", self.folder, "--out", out]
        environment = {**os.environ, "PYTHONHASHSEED": "1"}
        result = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        again.mkdir()
        for module in (states, hulls, ratings_figure, rgbd, summary):
            with matplotlib.rc_context(make_figures.RC):
                for one in self.draw(module).values():
                    make_figures.save(one, again)
        made, made_again = ({path.name: path.read_bytes() for path in folder.iterdir()} for folder in (out, again))
        self.assertLess(set(made_again), set(made))
        self.assertEqual([name for name in made_again if made[name] != made_again[name]], [])
        names = (
            "alphabet choosing convex_and_concave convexity core hulls_ca hulls_hi parts_blind parts_informed "
            "profiles random_polygons ratings_blind ratings_informed rgbd sensitivity shapes solved states_ca "
            "states_hi steps summary wins_blind wins_informed"
        ).split()
        self.assertEqual(set(made), {"figures.md", *(f"{name}.{kind}" for name in names for kind in ("svg", "pdf", "png"))})
        listed = made["figures.md"].decode()
        for name in names:
            self.assertIn(f"![{name}]({name}.png)", listed)
            self.assertTrue(made[f"{name}.png"].startswith(b"\x89PNG"))
            self.assertTrue(made[f"{name}.pdf"].startswith(b"%PDF"))
            self.assertIn(b"<svg", made[f"{name}.svg"][:1000])


if __name__ == "__main__":
    unittest.main()
