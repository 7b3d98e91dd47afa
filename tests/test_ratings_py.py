"""The ratings of plots/ratings.py: against examples worked out by hand, and what must not change them: the methods' names and
the order of cases and methods."""

import math
import unittest

import numpy as np

from plot_tests import WithFolder, call  # first, for what is in plots/

import make_ratings
import ratings
from ratings import Case, Results
from records import RecordError, Series, read_json

INF = math.inf
HEAD = ",".join(ratings.COLUMNS) + "\n"


def case(number: int, shape: str = "", kind: str = "simple", sampler: str = "uniform") -> Case:
    return Case(f"c{number}", "1", 1000, shape or f"s{number}", kind, sampler, 1.0)


def results(errors: dict[str, list[float]], cases: list[Case] | None = None, seconds=None) -> Results:
    """Of methods under the protocol auto, unless their name says another."""
    entrants = [Series(*name.split("/")) if "/" in name else Series(name, "auto") for name in errors]
    table = np.array(list(errors.values()), dtype=float)
    cases = cases or [case(i) for i in range(table.shape[1])]
    return Results(entrants, cases, table, np.array(seconds, dtype=float) if seconds else np.full(table.shape, 0.001))


def rated(errors: dict[str, list[float]], **more) -> ratings.Rating:
    return ratings.rate(ratings.division(results(errors, **more), "blind"))


def some_errors(methods: int = 5, cases: int = 40) -> dict[str, list[float]]:
    generator = np.random.default_rng(7)
    return {f"m{i}": list(generator.lognormal(0.3 * i, 0.5, cases)) for i in range(methods)}


class Reading(WithFolder):
    def read(self, text: str) -> Results:
        path = self.folder / "league.csv"
        path.write_text(text, encoding="utf-8")
        return ratings.read(path)

    def test_takes_results_failures_and_runs_that_are_not_there(self) -> None:
        found = self.read(
            HEAD
            + "a/auto,x/n:10,1,0.25,0.5,10,ok,x,holes,noise,0.5\n"
            + "b/default,x/n:10,1,inf,,10,crash,x,holes,noise,0.5\n"
            + "a/auto,y/n:10,2,0.5,,10,ok,y,simple,uniform,0.5\n"
        )
        self.assertEqual(found.entrants, [Series("a", "auto"), Series("b", "default")])
        self.assertEqual(found.cases[0], Case("x/n:10", "1", 10, "x", "holes", "noise", 0.5))
        np.testing.assert_array_equal(found.errors, [[0.25, 0.5], [INF, math.nan]])
        np.testing.assert_array_equal(found.seconds, [[0.5, math.nan], [math.nan, math.nan]])

    def test_says_what_is_no_league(self) -> None:
        wrong = ("a/auto,x,1,much,,10,ok,x,simple,uniform,1\n", "a/auto\n", "a" * 200_000)  # the csv module refuses the last
        for text in ("method,task\na,b\n", *(HEAD + line for line in wrong)):
            with self.subTest(text=text[:99]), self.assertRaisesRegex(RecordError, "league.csv cannot be read"):
                self.read(text)


class Divisions(unittest.TestCase):
    def test_who_knows_more_is_apart_and_the_oracle_in_none(self) -> None:
        both = results({"a/auto": [1], "b/default": [1], "a/paper": [1], "b/tuned": [1], "a/oracle": [1]})
        found = {one.name: [series.protocol for series in one.results.entrants] for one in ratings.divisions(both)}
        self.assertEqual(found, {"blind": ["auto", "default"], "informed": ["paper", "tuned"]})

    def test_only_cases_that_all_have_and_one_solved_and_few_cases_take_none_away(self) -> None:
        found = ratings.division(
            results({"a": [1, 1, INF, 1], "b": [1, INF, INF, math.nan], "c": [1, math.nan, math.nan, math.nan]}), "blind"
        )
        self.assertEqual([one.task for one in found.results.cases], ["c0", "c1"])
        self.assertEqual(found.left_out, [Series("c", "auto")])

    def test_who_leaves_the_others_few_cases_in_common_is_left_out(self) -> None:
        # Each has more than half of the cases, but all of them have only one.
        without = {"a": [], "b": [], "first": [0, 1], "also": [0, 1], "last": [3, 4]}
        errors = {name: [math.nan if i in gone else 1 + len(name) for i in range(5)] for name, gone in without.items()}
        found = ratings.division(results(errors), "blind")
        self.assertEqual([one.task for one in found.results.cases], ["c2", "c3", "c4"])
        self.assertEqual(found.left_out, [Series("last", "auto")])

    def test_cases_that_only_one_method_had_take_nobody_out(self) -> None:
        errors = {"alone": [1.0] * 10, "alone/default": [1.0] * 10, "other": [math.nan] * 8 + [2.0, 2.0]}
        found = ratings.division(results(errors), "blind")
        self.assertEqual([entrant.method for entrant in found.results.entrants], ["alone", "alone", "other"])
        self.assertEqual(len(found.results.cases), 2)

    def test_one_method_is_no_division(self) -> None:
        self.assertEqual(ratings.divisions(results({"a": [1, 2]})), [])


class Ranks(unittest.TestCase):
    def test_failures_are_last_and_the_same_polygons_have_the_same_place(self) -> None:
        errors = np.array([[0.1, INF, 0.0], [0.1 * (1 + 1e-12), 0.5, 0.2], [0.2, INF, 0.1]])
        np.testing.assert_array_equal(ratings.ranks(errors), [[1.5, 2.5, 1], [1.5, 1, 3], [3, 2.5, 2]])

    def test_the_same_results_on_every_case_count_once(self) -> None:
        same, better, once = [0.2, 0.4, np.inf], [0.1, 0.3, 0.5], [0.2, 0.5, 0.6]
        errors = np.array([same, better, [one * (1 + 1e-9) for one in same], once])
        np.testing.assert_array_equal(ratings.twins(errors), [0, 1, 0, 3])
        alone = ratings.ranks(errors[[0, 1, 3]])
        np.testing.assert_array_equal(ratings.ranks(errors), alone[[0, 1, 0, 2]])

    def test_mean_ranks_count_every_stratum_and_in_it_every_shape_the_same(self) -> None:
        # a is first on the three cases of a simple shape, second on the one with holes and on another simple shape.
        cases = [case(i, "s") for i in range(3)] + [case(3, "h", "holes"), case(4, "t")]
        found = rated({"a": [1, 1, 1, 2, 2], "b": [2, 2, 2, 1, 1]}, cases=cases)
        self.assertEqual([one.series.method for one in found.standings], ["b", "a"])
        self.assertAlmostEqual(found.standings[1].rank, 1 / 4 * 1 + 1 / 2 * 2 + 1 / 4 * 2)
        self.assertEqual([(part.name, part.cases) for part in found.kinds], [("simple", 4), ("holes", 1)])
        self.assertEqual(found.kinds[0].ranks, [1.5, 1.5])

    def test_intervals_are_by_shape(self) -> None:
        errors = {"a": [1, 1, 1, 1], "b": [2, 2, 2, 0.5]}
        self.assertIsNone(rated(errors, cases=[case(i, "one") for i in range(4)]).standings[0].rank_interval)
        self.assertEqual(rated(errors, cases=[case(i) for i in range(4)]).standings[0].rank_interval, (1.0, 1.75))
        # The cases of the shape that b wins are in a draw together or not at all: half and half.
        self.assertEqual(
            rated({"a": [1, 1, 2, 2], "b": [2, 2, 1, 1]}, cases=[case(i, "xxyy"[i]) for i in range(4)])
            .standings[0]
            .rank_interval,
            (1.0, 2.0),
        )


class Games(unittest.TestCase):
    def test_the_band_of_practical_ties(self) -> None:
        errors = np.array([[0.1, 0.1, 0.0001, INF, INF, 0.0], [0.1009, 0.102, 0.00019, 0.1, INF, 0.0]])
        won, tied = ratings.outcomes(errors)
        self.assertEqual(won[0, 1].tolist(), [0, 1, 0, 0, 0, 0])
        self.assertEqual(won[1, 0].tolist(), [0, 0, 0, 1, 0, 0])
        self.assertEqual(tied[0, 1].tolist(), [1, 0, 1, 0, 1, 1])

    def test_every_game_is_won_tied_or_lost(self) -> None:
        found = rated(some_errors())
        np.testing.assert_allclose(found.wins + found.wins.T + found.ties, np.ones((5, 5)), rtol=1e-6)

    def test_elo_of_two_is_the_logarithm_of_the_odds(self) -> None:
        # 3 of 4 games and half of the drawn one: odds of 3.5 to 1.5.
        ahead = 400 * math.log10(3.5 / 1.5)
        np.testing.assert_allclose(ratings.elo(np.array([[0, 3.0], [1.0, 0]])), [1000 + ahead / 2, 1000 - ahead / 2], atol=0.01)

    def test_elo_gives_back_the_strengths_that_made_the_games(self) -> None:
        true = np.array([1200.0, 1050.0, 950.0, 800.0])
        expected = 1 / (1 + 10 ** ((true[None, :] - true[:, None]) / 400))
        np.testing.assert_allclose(ratings.elo(1e6 * expected * (1 - np.eye(4))), true, atol=0.1)

    def test_who_always_wins_has_a_finite_rating(self) -> None:
        found = rated({"a": [1.0] * 9, "b": [2.0] * 9})
        self.assertAlmostEqual(found.standings[0].elo - found.standings[1].elo, 400 * math.log10(9.5 / 0.5), delta=0.1)


class Alike(unittest.TestCase):
    def test_wilcoxon_by_hand(self) -> None:
        # All of five differences have one sign: 2 of 32 ways.
        self.assertAlmostEqual(ratings.wilcoxon(np.array([1.0, 2, 3, 4, 5]), np.array([0.5, 1, 1.5, 2, 2.5])), 2 / 32)
        self.assertAlmostEqual(ratings.wilcoxon(np.array([INF, 2, 3, 4, 5]), np.array([0.5, 1, 1.5, 2, 2.5])), 2 / 32)
        self.assertEqual(ratings.wilcoxon(np.array([1.0, INF]), np.array([1.0, INF])), 1.0)

    def test_holm_by_hand(self) -> None:
        np.testing.assert_allclose(ratings.holm([0.01, 0.04, 0.03, 0.005]), [0.03, 0.06, 0.06, 0.02])
        self.assertEqual(ratings.holm([0.6, 0.7]), [1.0, 1.0])

    def test_friedman_by_hand(self) -> None:
        # Four shapes that all put three methods in the same order: chi-square 8 with 2 degrees, exp(-4).
        found = ratings.friedman(results({"a": [1.0] * 4, "b": [2.0] * 4, "c": [3.0] * 4}))
        self.assertAlmostEqual(found, math.exp(-4))
        self.assertIsNone(ratings.friedman(results({"a": [1.0] * 4, "b": [2.0] * 4})))

    def test_the_cases_of_a_shape_are_one_observation(self) -> None:
        one = results({"a": [1, 3, INF], "b": [2, 2, 2]}, [case(0, "s"), case(1, "s"), case(2, "t")])
        np.testing.assert_array_equal(ratings.errors_by_shape(one), [[2, INF], [2, 2]])

    def test_groups_are_the_largest_runs_of_neighbours(self) -> None:
        alike = np.ones((5, 5))
        for i, j in ((0, 2), (0, 3), (0, 4), (1, 3), (1, 4), (2, 4)):
            alike[i, j] = alike[j, i] = 0.01
        self.assertEqual(ratings.groups_alike(alike), [(0, 1), (1, 2), (2, 3), (3, 4)])
        self.assertEqual(ratings.groups_alike(np.ones((3, 3))), [(0, 2)])


class Lead(unittest.TestCase):
    def test_by_how_much_and_how_sure(self) -> None:
        found = rated({"a": [1.0] * 20, "b": [2.0] * 20}).lead
        self.assertAlmostEqual(found.ranks, 1)
        self.assertEqual((found.ratio, found.ratio_interval, found.clear), (0.5, (0.5, 0.5), True))
        self.assertFalse(rated({"a": [1.0, 2.0], "b": [2.0, 1.0]}).lead.clear)
        for shapes, clear in ((5, False), (6, True)):
            self.assertEqual(rated({"a": [1.0] * shapes, "b": [2.0] * shapes}).lead.clear, clear)
        self.assertEqual(rated({"a": [0.0, INF, 1], "b": [0.0, 1, INF]}).lead.ratio, 1.0)


class Invariance(unittest.TestCase):
    def said(self, found: ratings.Rating, names: dict[str, str]) -> list[tuple]:
        return [
            (names[one.series.method], one.rank, one.rank_interval, round(one.elo, 2), one.error, one.failures)
            for one in found.standings
        ]

    def test_other_names_change_nothing_else(self) -> None:
        errors = some_errors()
        names = {name: f"z{9 - i}" for i, name in enumerate(errors)}
        other = rated(dict(reversed([(names[name], values) for name, values in errors.items()])))
        self.assertEqual(self.said(rated(errors), names), self.said(other, {name: name for name in names.values()}))

    def test_the_order_of_cases_changes_nothing(self) -> None:
        errors = some_errors()
        cases = [case(i, kind=("simple", "holes")[i % 2]) for i in range(40)]
        order = np.random.default_rng(3).permutation(40)
        first = rated(errors, cases=cases)
        other = rated({name: [values[i] for i in order] for name, values in errors.items()}, cases=[cases[i] for i in order])
        for one, two in zip(first.standings, other.standings):
            self.assertEqual(one.series, two.series)
            np.testing.assert_allclose([one.rank, *one.rank_interval], [two.rank, *two.rank_interval])
            self.assertAlmostEqual(one.elo, two.elo, delta=0.05)
        np.testing.assert_allclose(first.alike, other.alike)

    def test_a_factor_on_all_errors_of_a_case_changes_no_rank(self) -> None:
        errors = some_errors()
        larger = {name: [value * (1 + i) for i, value in enumerate(values)] for name, values in errors.items()}
        self.assertEqual([one.rank for one in rated(errors).standings], [one.rank for one in rated(larger).standings])


class SolvedAgainstTime(unittest.TestCase):
    def curve(self, errors: dict[str, list[float]], seconds: list[list[float]]) -> dict[str, tuple[list, list]]:
        found = ratings.division(results(errors, seconds=seconds), "blind")
        curves = ratings.solved_against_time(found)
        return {one.method: (x.tolist(), y.tolist()) for one, (x, y) in curves.items()}

    def test_the_best_solves_all_targets_and_others_those_that_they_reach(self) -> None:
        # 10 ** 0.5 times the best error reaches the upper 26 of 51 targets.
        found = self.curve({"a": [0.1, 0.1], "b": [0.1 * 10**0.5, 0.2]}, [[0.004, 0.002], [0.001, 0.003]])
        self.assertEqual(found["a"][0], [2.0, 4.0])  # microseconds a point, of 1000 points
        np.testing.assert_allclose(found["a"][1], [0.5, 1.0])
        np.testing.assert_allclose(found["b"][1], [26 / 51 / 2, (26 + 35) / 51 / 2])

    def test_a_failure_solves_nothing_and_stays_in_the_count(self) -> None:
        found = self.curve({"a": [0.1, INF], "b": [0.2, 0.2]}, [[0.001, math.nan], [0.001, 0.001]])
        np.testing.assert_allclose(found["a"][1], [0.5])

    def test_a_perfect_result_leaves_room_for_others(self) -> None:
        found = self.curve({"a": [0.0], "b": [0.0005]}, [[0.001], [0.001]])
        np.testing.assert_allclose(found["b"][1], [16 / 51])


class Json(WithFolder):
    def test_it_is_as_its_schema_says_with_null_for_what_is_infinite(self) -> None:
        path = self.folder / "league.csv"
        lines = [
            f"{one}/auto,c{k},1,{error},0.1,9,ok,c{k},simple,uniform,1"
            for k in (1, 2, 3)
            for one, error in (("a", 0.1), ("b", "inf"))
        ]
        path.write_text(HEAD + "\n".join(lines) + "\n", encoding="utf-8")
        self.assertEqual(call(make_ratings.main, path)[0], 0)
        (division,) = read_json(path.with_name("ratings.json"), "ratings.schema.json")["divisions"]
        path.write_text(HEAD, encoding="utf-8")
        self.assertEqual((call(make_ratings.main, path)[0], call(make_ratings.main, self.folder)[0]), (6, 2))
        self.assertEqual([one["method"] for one in division["standings"]], ["a", "b"])
        self.assertEqual((division["standings"][1]["l2_median"], division["standings"][1]["failures"]), (None, 3))
        self.assertEqual(division["wins"], [[0, 1], [0, 0]])


if __name__ == "__main__":
    unittest.main()
