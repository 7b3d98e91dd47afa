"""The first screen of the report (plots/front.py, front_charts.py, where.py, strip.py, svg.py): what it says beside the numbers that it is made of."""

import json
import math
import re
import shutil
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import plot_samples
from plot_tests import WithFolder  # first, for what is in plots/
from test_ratings_py import INF, case, rated, results

import front
import front_charts
import ratings
import strip
import svg
import where
from records import RecordError, Row, load


def words(html: str) -> str:
    return re.sub(r"<[^>]+>", "", html)


class Sentence(unittest.TestCase):
    def said(self, errors: dict[str, list[float]], **more) -> str:
        return words(front.lead_sentence(rated(errors, **more), None))

    def test_who_leads_by_how_much_and_how_sure(self) -> None:
        said = self.said({"polylidar": [1.0] * 20, "cgal_delaunay": [2.0] * 20, "convex_hull": [3.0] * 20})
        self.assertIn(
            "Polylidar leads 3 entries of 3 methods that see the points only: mean rank 1.00 (95 %: 1.00 to 1.00)", said
        )
        self.assertIn("over 20 cases of 20 shapes, then CGAL Delaunay with 2.00", said)
        self.assertIn("its error is 0.500 times that one’s (95 %: 0.500 to 0.500)", said)

    def test_a_lead_that_may_be_chance_is_none(self) -> None:
        self.assertIn("is ahead, but not clearly, of", self.said({"a": [1.0, 1.0, 2.0], "b": [2.0, 2.0, 1.0]}))
        self.assertIn("a and b are the first of 2 entries", self.said({"a": [1.0, 2.0], "b": [1.0, 2.0]}))

    def test_where_it_does_not_lead(self) -> None:
        cases = [case(i, sampler=("uniform", "lattice", "noise")[i % 3]) for i in range(9)]
        errors = {"a": [1.0, 1, 3] * 3, "b": [2.0, 2, 2] * 3, "c": [3.0, 3, 4] * 3}
        self.assertIn("It is not the first on noise (b).", self.said(errors, cases=cases))
        better = {**errors, "a": [1.0] * 9}
        self.assertIn("the first on every kind of shape and way to sample", self.said(better, cases=cases))

    def test_a_run_of_one_kind_has_no_exceptions(self) -> None:
        self.assertNotIn("first on", self.said({"a": [1.0] * 3, "b": [2.0] * 3}))


class Folder(WithFolder):
    def make(self, **files: str) -> front.Front:
        for name, content in files.items():
            (self.folder / f"{name}.csv").write_text(content, encoding="utf-8")
        return front.make_front(self.folder)

    def csv(self, *methods: str) -> str:
        head = ",".join(ratings.COLUMNS) + "\n"
        return head + "".join(f"{one},x/n:9,1,0.{k + 1},0.001,9,ok,x,simple,uniform,1\n" for k, one in enumerate(methods))

    def test_without_results_it_says_what_makes_them(self) -> None:
        self.assertIn("hullbench league", front.front_html(self.make(), ""))

    def test_one_method_has_nobody_to_lead(self) -> None:
        self.assertIn("Nobody leads", front.front_html(self.make(cases=self.csv("a/auto")), ""))

    def test_an_evaluation_is_rated_and_the_runs_own_times_are_shown(self) -> None:
        made = self.make(cases=self.csv("a/auto", "b/auto"), league=self.csv("b/auto", "a/auto"))
        self.assertEqual(made.ratings[0].standings[0].series.method, "b")
        self.assertEqual([one.results.entrants[0].method for one in made.timed], ["a"])
        # "a" has its time of other cases.
        evaluated = self.csv("b/auto", "a/auto").replace("x/n:9", "y/n:9")
        said = front.front_html(self.make(cases=self.csv("a/auto", "b/auto"), league=evaluated), "")
        self.assertIn("times are medians in 1 case of this run", said)
        self.assertNotIn(
            "of this run",
            front.front_html(self.make(cases=self.csv("a/auto", "b/auto"), league=self.csv("b/auto", "a/auto")), ""),
        )
        self.assertEqual(where.listed_cases(made), {})
        self.assertIn("an evaluation beside this run", where.where_html(made))

    def test_the_build_of_an_evaluation_is_named(self) -> None:
        league = Path(__file__).parents[1] / "results" / "reference" / "league.json"
        shutil.copy(league, self.folder)
        said = front.front_html(self.make(cases=self.csv("a/auto", "b/auto"), league=self.csv("b/auto", "a/auto")), "")
        self.assertIn(f"the ranks are of build {json.loads(league.read_text())['tool']['commit'][:9]}", said)

    def test_times_of_several_machines_are_not_shown(self) -> None:
        self.make(cases=self.csv("a/auto", "b/auto"))
        self.assertEqual(len(front.make_front(self.folder).timed), 1)
        mixed = front.make_front(self.folder, mixed_times=True)
        self.assertEqual((len(mixed.ratings), mixed.timed), (1, []))

    def test_what_is_no_league_is_told(self) -> None:
        with self.assertRaisesRegex(RecordError, "cases.csv"):
            self.make(cases="{}")


class Charts(unittest.TestCase):
    def test_typical_times_are_medians_in_which_failures_are_infinite(self) -> None:
        errors = {"a": [1.0, 1, 1], "b": [1.0, INF, INF]}
        seconds = [[0.001, 0.002, 0.009], [0.001, math.nan, math.nan]]
        found = ratings.typical_times(ratings.division(results(errors, seconds=seconds), "blind"))
        self.assertEqual(list(found.values()), [2.0, INF])  # microseconds a point, of 1000 points

    def test_the_front_is_who_nobody_beats_in_both(self) -> None:
        self.assertEqual(ratings.pareto([(2, 1), (1, 3), (3, 1), (2, 2), (1, 4)]), [1, 0])

    def test_thinned_curves_keep_their_ends(self) -> None:
        x, y = np.arange(1.0, 5001), np.linspace(0.0001, 1, 5000)
        kept = front_charts._thinned(x, y)
        self.assertLess(len(kept), 600)
        self.assertEqual((kept[0], kept[-1]), ((1.0, y[0]), (5000.0, 1.0)))

    def test_failing_methods_are_named_where_no_mark_can_be(self) -> None:
        one = ratings.division(results({"a": [0.1] * 3, "b": [0.2, INF, INF]}), "blind")
        self.assertIn("Not shown, as most cases fail: b.", front_charts.time_error_figure(one))

    def test_who_never_succeeds_and_who_is_perfect_are_there(self) -> None:
        seconds = [[0.001, 0.001], [math.nan, math.nan], [0.002, 0.002]]
        one = ratings.division(results({"a": [0.0, 0.0], "b": [INF, INF], "c": [0.1, 0.1]}, seconds=seconds), "blind")
        self.assertIn("b</th><td class='number'>0</td>", front_charts.solved_figure(one))
        made = front_charts.time_error_figure(one)
        self.assertIn("Not shown, as most cases fail: b.", made)
        self.assertIn("Errors below 0.01 % are shown as that.", made)

    def test_who_solves_the_most_is_named_however_slow(self) -> None:
        errors = {f"m{k}": [0.2, 0.2] for k in range(front_charts.MOST_NAMED + 2)}
        seconds = [[0.001 * (k + 1)] * 2 for k in range(len(errors))] + [[100.0, 100.0]]
        one = ratings.division(results({**errors, "slow": [0.1, 0.1]}, seconds=seconds), "blind")
        self.assertIn(">slow</text>", front_charts.solved_figure(one))

    def test_a_chart_without_a_mark_is_left_out(self) -> None:
        one = ratings.division(results({"a": [0.1, INF, INF], "b": [INF, 0.2, INF]}), "blind")
        half = ratings.division(results({"a": [0.1, INF, INF, INF], "b": [INF, 0.2, 0.2, 0.2]}), "blind")
        self.assertIn("<svg", front_charts.time_error_figure(half))
        self.assertEqual(len(one.results.cases), 2)
        self.assertNotIn("<svg", front_charts.time_error_figure(one))

    def test_names_keep_off_each_other(self) -> None:
        places = svg.apart([50.0, 50.0, 51.0, 200.0], 0, 200)
        self.assertTrue(all(b - a >= 13.9 for a, b in zip(sorted(places), sorted(places)[1:])))
        self.assertLessEqual(max(places), 200)
        widths = [svg.width_of(name, False) for name in ("CGAL Delaunay", "CGAL (auto)", "third")]
        marks = [(50, 50), (52, 51), (54, 52), (50 + widths[0], 51)]
        found = svg.beside(marks[:3], widths, marks, [], (0, 0, 300, 300))
        placed = [(one, width) for one, width in zip(found, widths) if one]
        self.assertGreater(len(placed), 1)
        areas = []
        for (x, y, anchor), width in placed:
            left = x if anchor == "start" else x - width
            areas.append((left, y - 10, left + width, y + 2))
        for k, (left, top, right, bottom) in enumerate(areas):
            for other in areas[:k]:
                self.assertFalse(left < other[2] and other[0] < right and top < other[3] and other[1] < bottom, areas)
        self.assertEqual(svg.beside([(5, 5)], [40], [], [], (0, 0, 30, 30)), [None])

    def test_capitals_are_wider(self) -> None:
        self.assertGreater(svg.width_of("CGAL", False), 1.5 * svg.width_of("till", False))
        self.assertGreater(svg.width_of("CGAL", True), svg.width_of("CGAL", False))


class League(unittest.TestCase):
    def test_the_same_results_share_a_line(self) -> None:
        found = rated({"a": [1.0, 2], "b": [3.0, INF], "c": [1.0, 2 * (1 + 1e-12)], "d": [4.0, INF]})
        lines = front.lines_of(found)
        self.assertEqual(
            [(line.first, [one.series.method for one in line.members]) for line in lines],
            [(0, ["a", "c"]), (2, ["b"]), (3, ["d"])],
        )

    def test_names_of_records_stay_text(self) -> None:
        found = rated({"<b>": [1.0] * 3, "other": [2.0] * 3})
        whole = front.front_html(front.Front([found], [found.division], True, ""), "") + where.where_html(
            front.Front([found], [], True, "")
        )
        self.assertNotIn("<b>/", whole)
        self.assertNotIn("<b></", whole)


class HeatMap(unittest.TestCase):
    def test_cells_are_medians_and_the_best_is_marked(self) -> None:
        cases = [case(0), case(1, kind="holes"), case(2, kind="holes")]
        found = front.Front([rated({"a": [0.1, 0.2, 0.2], "b": [0.4, 0.1, INF]}, cases=cases)], [], True, "")
        made = where.where_html(found)
        rows = [re.findall(r"<td[^>]*>(.*?)</td>", row) for row in made.split("</table>")[0].split("<tr>")[2:]]
        self.assertEqual(
            [[words(cell) for cell in row] for row in rows],
            [["• the best: 10.0", "• the best: 20.0", "• the best: 15.0"], ["40.0", "∞", "40.0"]],
        )
        self.assertEqual(where.listed_cases(found)["blind/kind/holes"], ["c1", "c2"])
        self.assertIn("data-part='blind/kind/holes'", made)

    def test_who_beats_whom_has_wins_and_ties(self) -> None:
        found = front.Front(
            [rated({"a": [0.1, 0.1, 0.2, 0.2], "b": [0.2, 0.2, 0.1, 0.2], "c": [0.1, 0.1, 0.2, 0.2]})], [], True, ""
        )
        table = where.where_html(found).split("id='wins-blind'")[1]
        self.assertEqual(re.findall(r"<td[^>]*>(.*?)</td>", table), ["", "50<small>25</small>", "25<small>25</small>", ""])


class Strip(WithFolder):
    def test_six_cases_or_what_is_missing(self) -> None:
        plot_samples.write_suite(self.folder)
        informed = next(one for one in front.make_front(self.folder).ratings if one.division.name == "informed")
        experiments = load(self.folder)
        html = strip.strip_html(experiments, informed)
        leader = informed.standings[0].series
        rows = {row.name: row for experiment in experiments for row in experiment.rows if row.series == leader}
        cards = dict((what, run) for run, what in re.findall(r"data-run='([^']+)'.*?<b>([^<]+)</b>", html))
        self.assertLess(rows[cards["Best"]].metric("l2"), rows[cards["Median"]].metric("l2"))
        self.assertLess(rows[cards["Median"]].metric("l2"), rows[cards["Worst"]].metric("l2"))
        self.assertIn("none of these: real points and an input that broke somebody", html)

    def test_of_two_cases_one_is_the_worst(self) -> None:
        one, two = sorted(plot_samples.suite()["states"]["runs"][:2], key=lambda row: row["metrics"]["l2"])
        picture = mock.Mock(case={"ground_truth": ["a shape"]}, results={})
        experiment = mock.Mock()
        experiment.name = "states"
        shown = [strip.Shown(experiment, Row(row, {}), picture) for row in (two, one)]
        chosen = {what: case.row.name if case else None for what, case, _ in strip._chosen(shown, [])}
        self.assertEqual((chosen["Best"], chosen["Median"], chosen["Worst"]), (one["name"], None, two["name"]))

    def test_without_a_leader_there_is_no_strip(self) -> None:
        self.assertEqual(strip.strip_html([], None), "")


if __name__ == "__main__":
    unittest.main()
