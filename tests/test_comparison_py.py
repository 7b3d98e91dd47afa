"""plots/make_comparison.py: what it makes of the program's comparison and of two runs, and what it refuses."""

import copy
import json
import re
import statistics
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

import plot_samples
from plot_tests import WithFolder, call  # first, for what is in plots/

import make_comparison
from comparison_data import both_charts, columns, compare, read_compared
from comparison_html import differences_html, headline, verdict_html
from records import load

METHODS = ("polylidar", "cgal_alpha_shape")
SIZES = (2000, 4000)


def report(name: str = "states", scale: float = 1.0) -> dict[str, Any]:
    """Two methods, California at two sizes."""
    rows = [plot_samples.run(method, "paper", "ca", n, scale=scale) for method in METHODS for n in SIZES]
    return plot_samples.report(name, {"ca": 0}, rows)


def line(a: dict[str, Any], b: dict[str, Any], change: str = "not told apart") -> dict[str, Any]:
    """The program's line about a pair; with an interval of 10 % round the ratio."""

    def median(row: dict[str, Any]) -> float | None:
        return float(statistics.median(row["time_ns"])) if row["status"] == "ok" else None

    ratio = median(b) / median(a) if median(a) and median(b) else None
    judged = ratio is not None and change != "not judged"
    return {
        "name": a["name"],
        "status_a": a["status"],
        "status_b": b["status"],
        "median_a_ns": median(a),
        "median_b_ns": median(b),
        "ratio": ratio,
        "ratio_low": ratio * 0.9 if judged else None,
        "ratio_high": ratio * 1.1 if judged else None,
        "p_value": 0.01 if judged else None,
        "adjusted_p_value": 0.04 if judged else None,
        "change": change,
        "l2_a": a["metrics"].get("l2"),
        "l2_b": b["metrics"].get("l2"),
        "same_points": True,
        "same_parameters": True,
        "same_version": True,
    }


def told(pairs: list[dict[str, Any]], **more: Any) -> dict[str, Any]:
    about = {"protocol": "paper", "pairs": 2, "ratio": 1.3, "ratio_low": 1.2, "ratio_high": 1.4, "faster": 0, "slower": 1}
    methods = [{"method": name, **about} for name in dict.fromkeys(pair["name"].split("/")[0] for pair in pairs)]
    return {"a": "A", "b": "B", "methods": methods, "pairs": pairs, "only_a": [], "only_b": [], "notes": ["a note"], **more}


class Comparisons(WithFolder):
    def setUp(self) -> None:
        super().setUp()
        self.a, self.b = report(), report(scale=1.3)

    def write(self, name: str, *reports: dict[str, Any]) -> Path:
        """A run's folder, or a suite's with several reports."""
        for one in reports:
            folder = self.folder / name / (one["plan"]["name"] if len(reports) > 1 else "")
            one["summary"]["rows"] = plot_samples.judged(one["runs"])
            plot_samples.write_report(folder, one)
        return self.folder / name

    def write_told(self, value: Any) -> Path:
        (self.folder / "compared.json").write_text(value if isinstance(value, str) else json.dumps(value), encoding="utf-8")
        return self.folder / "compared.json"

    def lines(self, *changes: str) -> list[dict[str, Any]]:
        changes = changes or ("not told apart",) * len(self.a["runs"])
        return [line(a, b, change) for a, b, change in zip(self.a["runs"], self.b["runs"], changes, strict=True)]

    def compared(self, value: dict[str, Any] | None = None) -> Any:
        a, b = self.write("a", self.a), self.write("b", self.b)
        return compare(load(a), load(b), read_compared(self.write_told(value or told(self.lines()))), ("a", "b"))

    def program(self, value: Any) -> tuple[int, str, str]:
        """Exit code, page and what was said."""
        out = self.folder / "page.html"
        a, b = self.write("a", self.a), self.write("b", self.b)
        code, *said = call(make_comparison.main, a, b, "--compared", self.write_told(value), "--out", out)
        return code, out.read_text(encoding="utf-8") if out.is_file() else "", "".join(said)

    # The pairs and their numbers.

    def test_the_columns_have_the_numbers_of_program_and_records(self) -> None:
        self.b["runs"][1]["metrics"]["l2"] *= 1.5
        made = columns(self.compared(told(self.lines("slower", "faster", "not told apart", "not judged"))))
        self.assertEqual(made["count"], 4)
        get = {name: column["values"] for name, column in made["columns"].items()}
        words = made["columns"]["status"]["words"]
        self.assertEqual([words[value] for value in get["status"]], ["slower", "faster", "not told apart", "not judged"])
        for index, (a, b) in enumerate(zip(self.a["runs"], self.b["runs"], strict=True)):
            self.assertAlmostEqual(get["time_a"][index] * 1e6 / statistics.median(a["time_ns"]), 1, delta=1e-4)  # five digits
            self.assertAlmostEqual(get["time_b"][index] * 1e6 / statistics.median(b["time_ns"]), 1, delta=1e-4)
        self.assertAlmostEqual(get["error_change"][1] / (self.a["runs"][1]["metrics"]["l2"] / 2), 1, delta=1e-4)
        self.assertEqual(get["error_change"][0], 0)
        self.assertEqual((get["ratio_low"][3], get["adjusted_p_value"][3]), (None, None))

    def test_an_error_that_differs_by_rounding_only_is_the_same(self) -> None:
        self.b["runs"][0]["metrics"]["l2"] *= 1 + 1e-13
        self.assertEqual([pair.error_change for pair in self.compared().pairs], [0, 0, 0, 0])

    def test_kept_records_are_equal_to_their_digits(self) -> None:
        for row in self.a["runs"]:
            row["metrics"]["l2"] = float(f"{row['metrics']['l2']:.5g}")
            row["output_sha256"] = row["output_sha256"][:12]
        self.b["runs"][1]["metrics"]["l2"] *= 1.001
        self.b["runs"][2]["output_sha256"] = "f" * 64
        pairs = self.compared().pairs
        for pair in pairs:
            del pair.a.raw["id"]
        self.assertEqual([bool(pair.error_change) for pair in pairs], [False, True, False, False])
        self.assertEqual([pair.other_result for pair in pairs], [False, False, True, False])

    def test_why_a_side_failed_is_told_once_when_it_is_the_same(self) -> None:
        failed = {"status": "timeout", "detail": "after 60 s", **plot_samples.FAILED}
        self.a["runs"][0].update(failed)
        self.b["runs"][0].update(failed)
        self.b["runs"][1].update(failed)
        made = columns(self.compared(told(self.lines("fails in both", "now fails", "faster", "slower"))))
        self.assertEqual(made["columns"]["detail"]["words"], ["B: timeout, after 60 s", "both: timeout, after 60 s", ""])

    def test_status_changes_are_first(self) -> None:
        for place in (1, 2):
            worse = (self.b if place == 2 else self.a)["runs"][place]
            worse.update(status="timeout", detail="after 60 s", **plot_samples.FAILED)
        comparison = self.compared(told(self.lines("slower", "now works", "now fails", "faster")))
        self.assertEqual([pair.change for pair in comparison.pairs], ["now fails", "now works", "slower", "faster"])
        page = verdict_html(comparison)
        self.assertIn("✕\u00a0cgal_alpha_shape/<wbr>ca/<wbr>n:2000", page)
        self.assertIn("now timed out (after 60 s)", page)
        self.assertIn("now works; before: timed out (after 60 s)", page)

    def test_the_rows_of_a_name_in_two_experiments_are_told_apart(self) -> None:
        others = report("others", 7.0), report("others", 9.0)
        a, b = self.write("a", others[0], self.a), self.write("b", self.b, others[1])
        lines = self.lines() + [line(*rows) for rows in zip(others[0]["runs"], others[1]["runs"], strict=True)]
        found = compare(load(a), load(b), told(lines), ("a", "b"))
        self.assertEqual([pair.experiment.name for pair in found.pairs], ["states"] * 4 + ["others"] * 4)
        for pair, (own, other) in zip(
            found.pairs, [*zip(self.a["runs"], self.b["runs"]), *zip(others[0]["runs"], others[1]["runs"])], strict=True
        ):
            self.assertEqual((pair.a.raw["time_ns"], pair.b.raw["time_ns"]), (own["time_ns"], other["time_ns"]))

    def test_failures_of_a_name_in_two_experiments_stay_in_theirs(self) -> None:
        others = report("others"), report("others")
        for one in (self.a, self.b, *others):
            one["runs"] = [one["runs"][0] | {"status": "timeout", "detail": one["plan"]["name"], **plot_samples.FAILED}]
        a, b = self.write("a", self.a, others[0]), self.write("b", others[1], self.b)
        (b / "suite.json").write_text('{"plans": ["others", "states"]}', encoding="utf-8")
        found = compare(load(a), load(b), told([line(self.a["runs"][0], self.b["runs"][0], "fails in both")] * 2), ("a", "b"))
        self.assertEqual([(pair.a.detail, pair.b.detail) for pair in found.pairs], [("others",) * 2, ("states",) * 2])

    def test_runs_of_experiments_of_other_names_are_paired(self) -> None:
        self.b["plan"]["name"] = "renamed"
        self.assertEqual(len(self.compared().pairs), 4)

    def test_the_charts_have_both_sides_on_one_axis(self) -> None:
        self.b["runs"] = [row for row in self.b["runs"] if row["n"] == 4000]
        pairs = [line(a, b) for a in self.a["runs"] for b in self.b["runs"] if a["name"] == b["name"]]
        for size in (4000, 1000):
            for method in METHODS:
                row = plot_samples.run(method, "paper", "ca", size, scale=1.3)
                self.b["runs"] = [one for one in self.b["runs"] if one["name"] != row["name"]] + [row]
        (chart,) = both_charts(self.compared(told(pairs)))
        self.assertEqual(chart["x"], [1000, 2000, 4000])
        key = "polylidar/paper"
        self.assertEqual([chart["x"][point["x"]] for point in chart["a"][key]], [2000, 4000])
        self.assertEqual([chart["x"][point["x"]] for point in chart["b"][key]], [1000, 4000])

    def test_classes_of_convexity_that_only_one_side_has_are_in_their_place(self) -> None:
        chart = {"id": "chart-0", "experiment": 0, "title": "Star", "kind": "convexity", "axis": "", "series": {}}
        b, a = ([{**chart, "x": x}] for x in (["0.5–0.6", "0.8–0.9"], ["0.8–0.9"]))
        with mock.patch("comparison_data.charts", side_effect=[b, a]):
            (both,) = both_charts(self.compared())
        self.assertEqual(both["x"], ["0.5–0.6", "0.8–0.9"])

    # The verdict.

    def test_methods_are_judged_by_whether_the_interval_leaves_out_1(self) -> None:
        value = told(self.lines("slower", "not told apart", "faster", "not told apart"))
        value["methods"][1].update(ratio=0.98, ratio_low=0.9, ratio_high=1.0, faster=1, slower=0)
        slower, apart = self.compared(value).methods
        self.assertEqual((slower.change, slower.judged, apart.change), ("slower", 2, "not told apart"))
        page = verdict_html(self.compared(value))
        self.assertRegex(
            page,
            r"id='verdict-slower'><h3>▲ Slower in B</h3><ul><li><b>Polylidar \(paper\):</b> 1\.30 times the time of A "
            r"\(95 %: 1\.20 to 1\.40\), median of 2 runs; 1 slower and 0 faster of 2 judged\.",
        )
        self.assertIn("class='finding empty' id='verdict-faster'", page)
        self.assertIn("Two runs of the very same program differ", page)
        self.assertIn("is not “equal”", page)

    def test_a_method_of_one_shape_is_not_judged(self) -> None:
        value = told(self.lines())
        value["methods"][0].update(ratio_low=None, ratio_high=None)
        self.assertEqual(self.compared(value).methods[0].change, "not judged")
        self.assertIn("not judged: a single shape", verdict_html(self.compared(value)))

    def test_times_of_two_machines_are_no_verdict(self) -> None:
        self.b["environment"]["machine_id"] = "feedbeef"
        comparison = self.compared(told(self.lines("slower", "slower", "faster", "not told apart")))
        page = verdict_html(comparison)
        self.assertIn("The machines differ (A: 0123abcd; B: feedbeef).", page)
        self.assertNotRegex(page, r"class='change (slower|faster)'")
        self.assertNotIn("verdict-slower", page)
        self.assertIn("class='change higher-time'", page)
        self.assertIn("in 3 of 4 runs judged they differ", headline(comparison))
        self.assertEqual(columns(comparison)["columns"]["status"]["words"], ["higher time", "lower time", "not told apart"])

    def test_a_run_beside_itself_is_said_to_be_that(self) -> None:
        self.assertNotIn("same measurements", headline(self.compared()))
        self.b = copy.deepcopy(self.a)
        self.assertIn("A and B are the same measurements", headline(self.compared()))

    def test_errors_that_changed_are_named_with_their_numbers(self) -> None:
        self.a["runs"][2]["metrics"]["l2"], self.b["runs"][2]["metrics"]["l2"] = 0.05, 0.06
        comparison = self.compared()
        self.assertIn("The error changed in 1 run: 1 larger, 0 smaller.", headline(comparison))
        self.assertIn("L2 larger, 5.00 % in A, 6.00 % in B (+1.00 percentage points).", verdict_html(comparison))

    def test_other_points_and_parameters_are_warned_of(self) -> None:
        lines = self.lines()
        lines[0].update(same_points=False, same_parameters=False)
        page = verdict_html(self.compared(told(lines)))
        self.assertIn("1 of 4 runs had other points in B", page)
        self.assertIn("1 of 4 runs had other parameters in B", page)

    def test_what_differs_is_marked_and_what_does_not_is_not(self) -> None:
        self.a["environment"] |= {"kernel": "6.1", "os": "Debian 12"}
        self.b["environment"] |= {"kernel": "6.12", "os": "Debian 12"}
        differing, same = differences_html(self.compared()).split("<details", 1)
        self.assertRegex(
            differing,
            r"≠<span class='hidden'> differs</span></span> System</th><td[^>]*>Debian 12; 6\.1</td><td[^>]*>Debian 12; 6\.12</td>",
        )
        self.assertNotIn("Machine</th>", differing)
        self.assertIn("Machine</th>", same)
        self.assertNotIn("≠", same)

    # The page and its refusals.

    def test_the_page_is_one_file_and_nothing_in_it_ends_an_element(self) -> None:
        evil = "</script><img src=x onerror=alert(1)>"
        self.a["methods"][0]["title"] = self.b["methods"][0]["title"] = evil
        self.a["runs"][0].update(status="error", detail=evil, **plot_samples.FAILED)
        code, page, said = self.program(told(self.lines("now works", *["not told apart"] * 3), notes=[evil], only_b=[evil]))
        self.assertEqual(code, 0, said)
        records = "".join(re.findall(r'<script type="application/json".*?</script>', page, flags=re.S))
        plain = re.sub(r"<script.*?</script>", "", page, flags=re.S)
        self.assertEqual(page.count("</script"), 5)  # the library, the page's own and three of data
        for part, what in ((records, "<img"), (plain, "<img"), (plain, "{{"), (plain, "http:"), (plain, "https:")):
            self.assertFalse(what in part, what)
        self.assertLess(len(page.encode()), 5 * 2**20)

    def test_a_comparison_of_other_runs_is_refused(self) -> None:
        for change in ({"median_a_ns": 1.0}, {"status_b": "timeout"}, {"name": "polylidar/hi/n:2000/holes:0/protocol:paper"}):
            lines = self.lines()
            lines[1].update(change)
            code, _, said = self.program(told(lines))
            self.assertEqual(code, 2, change)
            self.assertIn("the comparison is not of these two runs", said)

    def test_malformed_comparisons_are_refused_in_one_sentence(self) -> None:
        good = told(self.lines())
        broken = [("", "as JSON"), ("[]", "'object'"), ("{}", "'a' is a required"), (good | {"pairs": {}}, "$.pairs")]
        changes = {"change": "sideways", "ratio": "1", "ratio_low": True, "same_points": 1}
        for key, value in changes.items():
            pairs = copy.deepcopy(good["pairs"])
            pairs[2][key] = value
            broken.append((good | {"pairs": pairs}, f"$.pairs[2].{key}"))
        broken += [(good | {"methods": [{}]}, "$.methods[0]"), (good | {"only_a": [1]}, "$.only_a[0]")]
        broken.append((json.dumps(good | {"a": float("nan")}), "as JSON (NaN"))
        for value, reason in broken:
            code, page, said = self.program(value)
            self.assertEqual((code, page), (2, ""), reason)
            self.assertIn(reason, said)
            self.assertEqual(said.count("\n"), 1, said)
            self.assertNotIn("Traceback", said)

    def test_missing_files_are_refused(self) -> None:
        a, compared = self.write("a", self.a), self.write_told(told(self.lines()))
        for arguments, reason in (
            ([a, self.folder / "none", "--compared", compared], "is not a folder"),
            ([a, a, "--compared", self.folder / "none.json"], "hullbench compare A B --format json"),
        ):
            code, _, said = call(make_comparison.main, *arguments)
            self.assertEqual(code, 2)
            self.assertIn(reason, said)

    def test_malformed_records_are_refused(self) -> None:
        self.a["environment"]["load_average"] = 3
        code, _, said = self.program(told(self.lines()))
        self.assertEqual(code, 2)
        self.assertIn("not as results/report.schema.json: $.environment.load_average: 3 is not", said)

    def test_runs_with_nothing_in_common_give_6(self) -> None:
        code, page, said = self.program(told([], only_a=[row["name"] for row in self.a["runs"]]))
        self.assertEqual((code, page), (6, ""))
        self.assertIn("no run in common", said)

    def test_a_missing_library_is_said(self) -> None:
        with mock.patch("page.LIBRARY", self.folder / "none.js"):
            code, _, said = self.program(told(self.lines()))
        self.assertEqual(code, 2)
        self.assertIn("install-npm.sh", said)


if __name__ == "__main__":
    unittest.main()
