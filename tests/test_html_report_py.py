"""The HTML report: what is packed, the summary's numbers beside the records, escaping, and input that is no run."""

import base64
import gzip
import hashlib
import json
import os
import re
import subprocess
import unittest
import unittest.mock

import plot_samples
from plot_tests import Elements, WithFolder, call  # first, for what is in plots/

import make_report
import page
import report_data
from pictures import pack as packed_pictures
from records import load
from report_common import number
from report_data import MetricTable, charts, columns, pack, title_of
from report_html import environment_facts, environment_html, notes_html, parameters_html, summary_html
from report_summary import failure_sentences, headline_sentences, noise_sentence, summarise

EVIL = "</script><script>window.broken=1</script><img src=x onerror='window.broken=1'> {{scripts}} <!-- & \"quoted\""


def run(method="polylidar", dataset="ca", n=2000, holes=False, protocol="paper", status="ok", times=(100, 101, 102), **more):
    """A row; times in microseconds."""
    scores = {"l2": 0.1, "l2_paper": 0.11, **more}
    return plot_samples.run(method, protocol, dataset, n, holes, status, times=[1000 * time for time in times], **scores)


def report(rows, name="states", **more):
    return plot_samples.report(name, {"ca": 0, "star": 100}, rows, **more)


def document(title, identity, notes=()):
    """One of tables.json, with a table."""
    table = {
        "id": identity,
        "caption": f"Caption of {identity}",
        "columns": [{"title": "Method", "kind": "words"}, {"title": "t, ms", "kind": "number", "unit": "ms"}],
        "rows": [[{"text": "CGAL", "notes": [1, 2]}, {"text": "1.36 ±0.01", "value": 1.36, "spread": 0.01}]],
        "remarks": ["A remark."],
    }
    return {"title": title, "tables": [table], "notes": list(notes)}


class Folder(WithFolder):
    """A test with a folder for a run."""

    def setUp(self):
        super().setUp()
        library = self.folder / "library.js"
        library.write_text("/* licence */ window.echarts = {};", encoding="utf-8")
        self.enterContext(unittest.mock.patch.object(page, "LIBRARY", library))

    def load(self, *rows, **more):
        plot_samples.write_report(self.folder, report(list(rows), **more))
        return load(self.folder)

    def write_tables(self, *documents):
        (self.folder / "tables").mkdir()
        tables = {"kind": "tables", "schema_version": 1, "documents": documents}
        (self.folder / "tables" / "tables.json").write_text(json.dumps(tables), encoding="utf-8")

    def summary(self, *rows):
        return summarise(self.load(*rows)[0])

    def standing(self, summary, method, protocol="paper"):
        return next(one for one in summary.standings if one.series == (method, protocol))


class Packing(Folder):
    def test_a_packed_value_is_gzip_in_base64(self):
        value = {"words": ["é", "</script>", ""], "values": [1, 2.5, None]}
        packed = pack(value)
        plain = gzip.decompress(base64.b64decode(packed["data"]))
        self.assertEqual(json.loads(plain), value)
        self.assertEqual(packed["bytes"], len(plain))
        # No time of packing, so that the same records make the same page.
        self.assertEqual(base64.b64decode(packed["data"])[4:8], bytes(4))

    def test_columns_hold_every_row(self):
        rows = [
            run(),
            run("cgal", "star-7", 8000, True, l2=0.123456, times=(1234, 1234, 9999)),
            run("cgal", status="timeout", detail="took 120 s"),
        ]
        packed = columns(self.load(*rows))
        self.assertEqual(packed["count"], 3)
        made = packed["columns"]
        for column in made.values():
            self.assertEqual(len(column["values"]), 3)

        def get(name, row):
            value = made[name]["values"][row]
            return made[name]["words"][value] if "words" in made[name] else value

        for index, row in enumerate(rows):
            member = get("member", index)
            dataset = get("family", index) + ("" if member is None else f"-{member}")
            method, protocol = get("entrant", index).split("/")
            self.assertEqual(f"{method}/{dataset}/{get('sample', index)}/protocol:{protocol}", row["name"])
            self.assertEqual(get("status", index), row["status"])
            self.assertEqual(get("detail", index), row["detail"])
            self.assertEqual(get("n", index), row["n"])
            self.assertEqual(get("holes", index), int(row["holes"]))
        self.assertEqual(made["time"]["values"], [0.101, 1.234, None])
        self.assertEqual(made["time_high"]["values"], [0.102, 9.999, None])
        self.assertEqual(made["metric l2"]["values"], [0.1, 0.12346, None])
        self.assertEqual(made["parameter max_edge_length"]["values"], ["∞", "∞", "∞"])
        self.assertNotIn("name", made)

    def test_a_name_that_is_not_composed_is_kept(self):
        odd = run()
        odd["name"] = "polylidar/ca/n:2000/holes:0/protocol:paper/again"
        made = columns(self.load(odd))["columns"]
        self.assertEqual(made["name"]["words"], [odd["name"]])


class VeryLongExperiments(Folder):
    ROWS = [run(n=n, commission=0.05, skill=0.9) for n in (1000, 2000, 4000)]

    def test_they_have_the_main_metrics_only_and_the_notes_say_so(self):
        experiments = self.load(*self.ROWS)
        self.assertEqual(columns(experiments)["columns"]["metric commission"]["values"], [0.05] * 3)
        self.assertNotIn("this page has these metrics", notes_html(experiments))
        with unittest.mock.patch.object(report_data, "LARGE_RUN", 2):
            made = columns(experiments)["columns"]
            self.assertEqual(made["metric skill"]["values"], [0.9] * 3)
            self.assertEqual(made["metric commission"]["values"], [None] * 3)
            self.assertIn("of its 3 runs this page has these metrics: ", notes_html(experiments))


class TheSize(Folder):
    def test_pictures_have_the_room_that_the_rest_leaves(self):
        experiments = self.load(run())
        rooms = []

        def of_that_size(_, room):
            rooms.append(room)
            return "x" * room

        with unittest.mock.patch.object(make_report, "pack_pictures", of_that_size):
            made = len(make_report.make_page(experiments, self.folder).encode())
            self.assertLess(made, make_report.MOST_BYTES)
            self.assertGreater(made, 0.99 * make_report.MOST_BYTES)
            # Where the rest takes all of it, they have a fifth all the same.
            with unittest.mock.patch.object(make_report, "MOST_BYTES", 100_000):
                make_report.make_page(experiments, self.folder)
        self.assertEqual(rooms[1], 20_000)


class Charts(Folder):
    def test_sizes_make_a_chart_over_n(self):
        rows = [run(n=n, times=(n, n, n)) for n in (2000, 4000, 8000)] + [
            run("cgal", n=n, status="crash", detail="SIGSEGV") for n in (2000, 4000, 8000)
        ]
        (chart,) = charts(self.load(*rows))
        self.assertEqual((chart["kind"], chart["title"], chart["x"]), ("n", "California", [2000, 4000, 8000]))
        self.assertEqual([point["time"][0] for point in chart["series"]["polylidar/paper"]], [2.0, 4.0, 8.0])
        self.assertNotIn("cgal/paper", chart["series"])
        self.assertEqual(len(chart["missing"]["cgal/paper"]), 3)

    def test_few_shapes_make_a_chart_by_shape_and_protocols_stay_apart(self):
        rows = [run(dataset=f"star-{k}", protocol=protocol) for k in (1, 2) for protocol in ("paper", "auto")]
        (chart,) = charts(self.load(*rows))
        self.assertEqual((chart["kind"], chart["x"]), ("shape", ["Star 1", "Star 2"]))
        self.assertEqual(
            {key: len(points) for key, points in chart["series"].items()}, {"polylidar/paper": 2, "polylidar/auto": 2}
        )

    def test_many_shapes_are_classes_of_convexity(self):
        rows = [
            run(dataset=f"star-{k}", times=(k,), l2=k / 1000, ground_truth_convexity=0.7 if k % 2 else 0.65)
            for k in range(1, 101)
        ]
        chart, holes = charts(self.load(*rows, run(dataset="star-1", holes=True, ground_truth_convexity=1)))
        self.assertEqual((holes["title"], holes["x"]), ("Star with holes, by convexity", ["0.9–1.0"]))
        self.assertEqual((chart["kind"], chart["x"]), ("convexity", ["0.6–0.7", "0.7–0.8"]))
        low, high = chart["series"]["polylidar/paper"]
        self.assertEqual((low["count"], high["count"]), (50, 50))
        self.assertEqual(low["time"][0], 0.051)  # of 2, 4 ... 100 microseconds
        self.assertEqual(high["metrics"]["l2"][0], 0.05)
        self.assertNotIn("run", low)

    def test_many_shapes_without_families_make_a_chart_by_shape_even_if_their_names_end_in_numbers(self):
        names = [f"zoo-{word}-{k}" for k, word in enumerate(["line", "point"] * 35)]
        plot_samples.write_report(
            self.folder, plot_samples.report("zoo", dict.fromkeys(names, 0), [run(dataset=name) for name in names])
        )
        experiments = load(self.folder)
        (chart,) = charts(experiments)
        self.assertEqual((chart["kind"], chart["x"][:2], len(chart["x"])), ("shape", ["Zoo-Line-0", "Zoo-Point-1"], 70))
        made = columns(experiments)["columns"]
        self.assertEqual((made["family"]["words"], set(made["member"]["values"])), (names, {None}))

    def test_a_failure_is_infinitely_bad_in_a_class_of_convexity(self):
        def chart_with(failures):
            def star(k, **more):
                return run(dataset=f"star-{k}", times=(k,), l2=k / 1000, hole_f1=0.9, ground_truth_convexity=0.7, **more)

            rows = [star(k) for k in range(1, 101)]
            failed = [star(k, method="cgal", status="timeout" if k <= failures else "ok") for k in range(1, 101)]
            [experiment] = self.load(*rows, *failed)
            experiment.report["metrics"] = [
                {"name": "l2", "better": "lower", "group": "area", "unit": "ratio"},
                {"name": "hole_f1", "better": "higher", "group": "topology", "unit": "ratio"},
            ]
            (chart,) = charts([experiment])
            return chart["series"]["cgal/paper"][0]

        few = chart_with(40)  # the slowest and worst of the others are 41 ... 100
        self.assertEqual(few["count"], 60)
        self.assertEqual(few["time"], [0.0905, None, None])
        self.assertEqual(few["metrics"]["l2"], [0.0905, None, None])
        self.assertEqual(few["metrics"]["hole_f1"], [0.9, None, None])
        most = chart_with(51)
        self.assertIsNone(most["time"])
        self.assertNotIn("l2", most["metrics"])


class TheMetricTable(Folder):
    """The directions are the program's own."""

    def table(self, metrics, *rows):
        [experiment] = self.load(*rows or [run()])
        experiment.report["metrics"] = metrics
        return MetricTable([experiment]), experiment

    def test_every_direction_is_that_of_the_program(self):
        program = os.environ.get("HULLBENCH")
        if not program:
            self.skipTest("HULLBENCH does not name the program")
        metrics = json.loads(subprocess.run([program, "metrics", "--json"], capture_output=True, check=True).stdout)
        table, _ = self.table(metrics)
        self.assertGreater(len(metrics), 40)
        for one in metrics:
            entry = table.entry(one["name"])
            self.assertEqual(entry["better"], None if one["better"] == "none" else one["better"], one["name"])
            self.assertEqual(entry["definition"], one["definition"])
            if one["better"] == "none":
                self.assertEqual(entry["charted"], one["group"] == "size", one["name"])
        for name, percent in (("l2", True), ("area_bias", True), ("iou", False), ("perimeter_ratio", False)):
            self.assertEqual(table.entry(name)["unit"], "%" if percent else "", name)
        for name in ("spacing", "hausdorff_to_truth_x", "symmetric_difference_area", "l2_convex_hull"):
            self.assertFalse(table.entry(name)["charted"], name)

    def test_a_title_is_the_name_in_words(self):
        titles = {"l2": "L2", "iou": "IoU", "boundary_iou": "Boundary IoU", "hole_f1": "Hole F1", "f_score_1h": "F score 1h"}
        self.assertEqual({name: title_of(name) for name in titles}, titles)

    def test_a_place_is_in_no_column(self):
        metrics = [
            {"name": name, "group": "boundary", "better": better} for name, better in (("far_x", "none"), ("far", "lower"))
        ]
        table, experiment = self.table(metrics, run(far_x=3.0, far=2.0))
        self.assertIn("far", table.names(experiment.rows))
        self.assertNotIn("far_x", table.names(experiment.rows))

    def test_without_a_table_nothing_is_better(self):
        table, experiment = self.table([])
        self.assertIsNone(table.entry("l2")["better"])
        self.assertIn("l2", table.charted_names(experiment.rows))


class TheSummary(Folder):
    def test_ratios_are_medians_and_a_crash_of_the_core_speaks_against_it(self):
        rows = []
        for n, other in ((1, 200), (2, 300), (3, 900)):
            rows += [run(n=n, times=(100, 100, 100)), run("cgal", n=n, times=(other, other, other), l2=0.05 * n)]
        rows += [run("cgal", n=4, times=(1, 1, 1)), run(n=4, status="crash", detail="SIGSEGV")]
        summary = self.summary(*rows)
        cgal = self.standing(summary, "cgal")
        self.assertEqual((cgal.time.cases, cgal.time.median, cgal.time.low, cgal.time.high), (4, 2.5, 0, 9))
        self.assertAlmostEqual(cgal.error.median, 0.75)
        self.assertEqual((cgal.error.lower_in, summary.contested), (2, 3))
        self.assertEqual((self.standing(summary, "polylidar").fastest_in, cgal.fastest_in), (3, 0))
        self.assertEqual((self.standing(summary, "polylidar").most_accurate_in, cgal.most_accurate_in), (2, 2))

    def test_a_failure_is_infinitely_slow_and_not_left_out(self):
        rows = []
        for n, other in ((1, 200), (2, 300)):
            rows += [run(n=n, times=(100, 100, 100)), run("cgal", n=n, times=(other, other, other))]
        for n in (3, 4, 5):
            rows += [run(n=n), run("cgal", n=n, status="timeout", detail="slow")]
        rows += [run("pcl", n=1, status="not_installed", detail="no")]
        summary = self.summary(*rows)
        time = self.standing(summary, "cgal").time
        self.assertEqual((time.cases, time.median, time.low), (5, float("inf"), 2))
        self.assertEqual(number(time.median), "∞")
        self.assertIsNone(self.standing(summary, "pcl").time)

    def test_a_ratio_is_taken_round_by_round(self):
        # The machine is three times slower in round 7, for both; by the medians the ratio would be 6.
        core, cgal = run(times=(100, 100, 300)), run("cgal", times=(600, 200, 200))
        core["rounds"], cgal["rounds"] = [5, 6, 7], [7, 5, 6]
        self.assertEqual(self.standing(self.summary(core, cgal), "cgal").time.median, 2)
        del core["rounds"], cgal["rounds"]
        self.assertEqual(self.standing(self.summary(core, cgal), "cgal").time.median, 2)
        cgal["time_ns"] = [200000, 300000, 900000]
        self.assertEqual(self.standing(self.summary(core, cgal), "cgal").time.median, 3)

    def test_the_headline_is_read_from_the_report(self):
        rival = {"method": "cgal", "protocol": "paper", "same_polygons": True, "does_more": "It also sings."}
        rival |= {"cases": 4, "failures": 1, "median": 3.25, "low": 3.0, "high": None, "least": 3.0, "most": None}
        [experiment] = self.load(run(), run("cgal"))
        self.assertEqual(headline_sentences(summarise(experiment)), [])
        core = {"method": "polylidar", "protocol": "paper"}
        experiment.report["summary"]["headline"] = {"reference": core, "rivals": [rival]}
        self.assertEqual(
            " ".join(headline_sentences(summarise(experiment))),
            "Cgal (paper), the same polygons: 3.25 times the time of Polylidar (paper) (95 %: 3.00 to ∞), 4 cases, of which "
            "it failed 1. It also sings.",
        )
        rival["same_polygons"] = False
        self.assertIn("no other method gives the same polygons", headline_sentences(summarise(experiment))[0])

    def test_who_tells_the_steps_of_a_method_is_no_rival(self):
        steps = run("polylidar_steps", times=(300,) * 3)
        self.assertEqual(self.summary(run(), steps).contested, 0)
        self.assertEqual(self.summary(run(), steps, run("cgal", times=(200,) * 3)).contested, 1)

    def test_protocols_of_one_method_alone_are_compared_with_nothing(self):
        summary = self.summary(run(), run(protocol="auto"))
        self.assertEqual((summary.contested, [one.fastest_in for one in summary.standings]), (0, [0, 0]))
        self.assertEqual([one.most_accurate_in for one in summary.standings], [1, 1])

    def test_it_says_when_the_core_loses(self):
        rows = [
            row
            for n in (1, 2, 3)
            for row in (run(n=n), run("quick", n=n, times=(10, 11, 12), l2=0.8), run("exact", n=n, times=(900,) * 3, l2=0.05))
        ]
        summary = self.summary(*rows)
        quick, exact = self.standing(summary, "quick"), self.standing(summary, "exact")
        self.assertEqual((quick.time.lower_in, round(quick.time.median, 3), quick.error.median), (3, 0.109, 8))
        self.assertEqual((exact.error.lower_in, exact.error.median, exact.most_accurate_in), (3, 0.5, 3))
        self.assertEqual([one.fastest_in for one in summary.standings], [0, 3, 0])
        page = summary_html(self.load(*rows), [summary])
        self.assertIn("<td class='number better'>0.109<span class='hidden'> better</span><small>", page)
        self.assertIn("<td class='number better'>0.500<span class='hidden'> better</span><small>", page)

    def test_it_does_not_say_so_when_the_core_wins(self):
        summary = self.summary(run(), run("cgal", times=(200, 201, 202), l2=0.1 * (1 + 1e-12)))
        self.assertEqual(self.standing(summary, "cgal").time.lower_in, 0)
        self.assertNotIn("number better", summary_html(self.load(run()), [summary]))
        # The same shape, written in another order, is as accurate.
        self.assertEqual([one.most_accurate_in for one in summary.standings], [1, 1])

    def test_protocols_are_entrants_of_their_own(self):
        summary = self.summary(
            run(), run("cgal", protocol="paper", times=(200,) * 3), run("cgal", protocol="auto", times=(300,) * 3)
        )
        self.assertEqual(self.standing(summary, "cgal", "paper").time.median, 200 / 101)
        self.assertEqual(self.standing(summary, "cgal", "auto").time.median, 300 / 101)

    def test_failures_are_counted_with_their_reason(self):
        summary = self.summary(
            run(),
            run(n=4000, status="timeout", detail="took 120 s."),
            run("cgal", status="crash", detail="SIGSEGV"),
            run("cgal", n=4000, status="crash", detail="SIGSEGV"),
        )
        self.assertEqual(self.standing(summary, "cgal").failures["crash"], 2)
        self.assertEqual(
            failure_sentences([summary]),
            [
                ("Polylidar (paper)", "timed out in 1 of 2 runs: took 120 s."),
                ("Cgal (paper)", "crashed in 2 of 2 runs: SIGSEGV."),
            ],
        )

    def test_one_method_alone_is_compared_with_nothing(self):
        self.assertEqual(self.summary(run()).contested, 0)
        failed = self.summary(run(status="error", detail="no"))
        self.assertEqual((failed.contested, failed.compared_errors), (0, 0))

    def test_noise_is_what_the_records_say(self):
        [experiment] = self.load(run())
        self.assertIn("The times of States have fewer than 3 repetitions", noise_sentence([experiment]))
        for noisy, words in ((True, "are noisy"), (False, "are steady")):
            experiment.report["summary"]["noise"] = {"rows": 1, "median_spread": 0, "ninth_decile": 0, "noisy": noisy}
            self.assertIn(f"The times of States {words}", noise_sentence([experiment]))

    def test_times_of_several_machines_are_said_to_be_that(self):
        here, elsewhere = run(), run("cgal")
        self.assertNotIn("several machines", summary_html(self.load(here, elsewhere), []))
        elsewhere["machine"] = "feedbeef"
        self.assertIn("The times of States are of several machines", summary_html(self.load(here, elsewhere), []))
        failed = run("cgal", status="error", detail="no")
        failed["machine"] = "feedbeef"
        self.assertNotIn("several machines", summary_html(self.load(here, failed), []))

    def test_who_chose_the_parameters_is_what_the_records_say(self):
        [experiment] = self.load(run(protocol="auto"))
        experiment.report["summary"]["protocols"] = {"auto": "by magic", "paper": "by rules"}
        page = parameters_html([experiment], self.folder)
        self.assertIn("<dt>auto</dt><dd>by magic</dd>", page)
        self.assertNotIn("by rules", page)

    def test_numbers_are_written_with_three_digits(self):
        self.assertEqual(
            [number(value) for value in (0, 1, 0.99999, 13.2, 297.4, 21543, 0.0123, 1.5e-7)],
            ["0", "1.00", "1.00", "13.2", "297", "21500", "0.0123", "1.5e-07"],
        )


class Page(Folder):
    def page(self, *rows, **more):
        return make_report.make_page(self.load(*rows, **more), self.folder)

    def test_says_how_the_kernel_gives_memory(self):
        older = report([run()])
        self.assertEqual(environment_facts(older)["Huge pages"], "asked for by Polylidar alone")
        older["environment"]["huge_pages"] = {"kernel": "madvise", "malloc": "glibc.malloc.hugetlb=1"}
        self.assertEqual(environment_facts(older)["Huge pages"], "kernel: madvise, malloc: glibc.malloc.hugetlb=1")
        self.assertEqual(environment_facts(older)["Address randomisation"], "unknown")
        older["environment"]["aslr"] = 2
        self.assertEqual(environment_facts(older)["Address randomisation"], "on")

    def test_what_only_one_experiment_has_is_said_of_that(self):
        first, second = (self.load(run(), name=name)[0] for name in ("one", "two"))
        second.report["resumed"] = ["2026-01-01T00:00:00Z"]
        self.assertIn("2026-01-01T00:00:00Z <small>Two</small>", environment_html([first, second]))

    def test_says_what_it_was_merged_from(self):
        told = report([run()])
        parts = [{"shard": shard, "created": day} for shard, day in (("1/2", "Monday"), (None, "Tuesday"))]
        self.assertEqual(environment_facts({**told, "merged": parts})["Merged from"], "shard 1/2 of Monday, a run of Tuesday")

    def test_an_undecided_claim_neither_holds_nor_fails(self):
        kinds = {"confirmed": "holds", "undecided": "open", "refuted": "fails", "larger": "fails"}
        claims = [
            {
                **dict.fromkeys(("id", "claim", "where", "paper", "ours", "equal_work", "detail"), word),
                "value": 1,
                "verdict": word,
            }
            for word in kinds
        ]
        told = report([run()])
        told["summary"]["claims"] = claims
        plot_samples.write_report(self.folder, told)
        page = make_report.make_page(load(self.folder), self.folder)
        for word, kind in kinds.items():
            self.assertRegex(page, f"<span class='verdict {kind}'>{word}")

    def test_a_run_without_pictures_shows_those_of_its_kept_report(self):
        experiments = self.load(run())
        pictures = json.loads(json.dumps({**packed_pictures(experiments), "kept": True}))
        (self.folder / "report.html").write_text(page.data("pictures", pictures), encoding="utf-8")
        made = make_report.make_page(experiments, self.folder)
        self.assertEqual(page.kept_data(made, "pictures"), pictures)

    def test_what_thinned_records_lack_is_taken_from_the_kept_report(self):
        kept = {"report": {"experiments": ["kept"], "metrics": ["kept"]}, "charts": "kept charts", "rows": "kept rows"}
        kept["pictures"] = json.loads(json.dumps(packed_pictures(self.load(run()))))
        (self.folder / "report.html").write_text("".join(page.data(*block) for block in kept.items()), encoding="utf-8")
        told = report([run()])
        for is_thinned in (False, True):
            if is_thinned:
                del told["runs"][0]["id"]
            plot_samples.write_report(self.folder, told)
            made = make_report.make_page(load(self.folder), self.folder)
            told_by = {name: page.kept_data(made, name) for name in kept}
            self.assertEqual(told_by["pictures"], kept["pictures"])
            self.assertEqual(told_by["rows"] == "kept rows", is_thinned)
            self.assertEqual(told_by["charts"] == "kept charts", is_thinned)
            self.assertEqual({**told_by["report"], **kept["report"]} == told_by["report"], is_thinned)

    def test_text_of_records_stays_text(self):
        evil = report([run(status="error", detail=EVIL, dataset="star-1"), run("cgal")], notes=[EVIL])
        chosen = {"method": "cgal", "protocol": "paper", "note": EVIL, "parameters": {EVIL: {"rule": EVIL}}}
        evil["plan"].update(name=EVIL, title=EVIL, notes=[EVIL], methods=[chosen])
        evil["environment"].update(os=EVIL, libraries={EVIL: EVIL})
        for part in evil["methods"] + evil["datasets"]:
            part.update(title=EVIL, licence=EVIL)
        claim = dict.fromkeys(("id", "claim", "where", "paper", "ours", "equal_work", "detail"), EVIL)
        evil["summary"]["claims"] = [{**claim, "value": 1, "verdict": "larger"}]
        plot_samples.write_report(self.folder, evil)
        tables = document(EVIL, EVIL, [EVIL])
        tables["tables"][0].update(columns=[{"title": EVIL, "kind": "words"}], rows=[[{"text": EVIL}]], remarks=[EVIL])
        self.write_tables(tables)
        seen = Elements(make_report.make_page(load(self.folder), self.folder))
        calm = Elements(self.page(run()))
        self.assertEqual([identity for identity, _ in seen.scripts], [identity for identity, _ in calm.scripts])
        self.assertNotIn("img", seen.tags)
        self.assertFalse(any("window.broken" in source for identity, source in seen.scripts if identity is None))
        told = dict(seen.scripts)
        self.assertEqual(json.loads(told["report"])["experiments"][0]["title"], EVIL)
        rows = json.loads(gzip.decompress(base64.b64decode(json.loads(told["rows"])["data"])))
        self.assertIn(EVIL, rows["columns"]["detail"]["words"])

    def test_the_policy_allows_the_pages_own_scripts_and_no_network(self):
        seen = Elements(self.page(run()))
        own = [source for identity, source in seen.scripts if identity is None]
        self.assertEqual(len(own), 2)
        allowed = set(re.findall(r"'sha256-([^']+)'", seen.policy))
        self.assertEqual(allowed, {base64.b64encode(hashlib.sha256(source.encode()).digest()).decode() for source in own})
        self.assertTrue(seen.policy.startswith("default-src 'none'; script-src 'sha256-"))
        self.assertNotIn("connect-src", seen.policy)
        self.assertNotIn("unsafe-inline", seen.policy.split("style-src")[0])
        self.assertNotIn("link", seen.tags)

    def test_the_librarys_licence_stays(self):
        self.assertIn("/* licence */", self.page(run()))

    def test_every_mark_of_the_template_is_filled(self):
        self.assertEqual(re.findall(r"\{\{\w+\}\}", self.page(run())), [])

    def test_a_method_without_a_style_gets_one(self):
        told = dict(Elements(self.page(run("brand_new"), run())).scripts)
        self.assertRegex(json.loads(told["report"])["methods"]["brand_new"]["light"], "^#")

    def test_tables_become_html(self):
        self.write_tables(document("States", "states_time", ["[1] a note"]))
        made = self.page(run())
        self.assertIn("<details><summary>States</summary><h3>Caption of states_time</h3>", made)
        self.assertIn("<th scope='col'>Method</th><th class='number' scope='col'>t, ms</th>", made)
        self.assertIn(
            "<tr><th scope='row'>CGAL <sup>[1]</sup> <sup>[2]</sup></th><td class='number'>1.36 ±0.01</td></tr>", made
        )
        self.assertIn("<ul class='notes'><li>A remark.</li></ul>", made)
        self.assertIn("<h3>Notes</h3><ul class='notes'><li>[1] a note</li></ul>", made)

    def test_what_differs_from_the_paper_stands_beside_its_claims(self):
        self.write_tables(document("States", "states_time"), document("Beside the paper", "differences", ["Common."]))
        made = self.page(run())
        self.assertEqual(made.count("<h3>Caption of differences</h3>"), 1)
        self.assertLess(made.index("Caption of differences"), made.index("Caption of states_time"))
        self.assertNotIn("<li>Common.</li>", made)

    def test_the_tables_of_parameters_stand_in_their_section(self):
        self.write_tables(document("Methods and parameters", "parameters"))
        made = self.page(run())
        self.assertEqual(made.count("<h3>Caption of parameters</h3>"), 1)
        self.assertLess(made.index("Who chose them"), made.index("Caption of parameters"))
        self.assertLess(made.index("Caption of parameters"), made.index("What the parameters mean"))

    def test_a_run_without_tables_says_so(self):
        self.assertIn("The run has no tables/tables.json.", self.page(run()))


class TheProgram(Folder):
    def test_it_writes_the_page_beside_the_records(self):
        self.load(run())
        code, out, err = call(make_report.main, self.folder)
        self.assertEqual((code, err), (0, ""))
        self.assertIn("report.html", out)
        self.assertTrue((self.folder / "report.html").read_text(encoding="utf-8").startswith("<!doctype html>"))

    def refused(self, *arguments):
        """What it says, one sentence, when it ends with 2."""
        code, out, err = call(make_report.main, *arguments)
        self.assertEqual((code, out), (2, ""))
        self.assertEqual(err.count("\n"), 1)
        self.assertTrue(err.startswith("make_report.py: "), err)
        return err

    def test_what_is_no_run_is_refused(self):
        self.assertIn("is not a folder", self.refused(self.folder / "nowhere"))
        self.assertIn("has no report.json", self.refused(self.folder))

    def test_broken_records_are_refused(self):
        (self.folder / "report.json").write_text('{"runs": [', encoding="utf-8")
        self.assertIn("cannot be read as JSON", self.refused(self.folder))
        self.load(run())
        self.write_tables()
        (self.folder / "tables" / "tables.json").write_text("[]", encoding="utf-8")
        self.assertIn("'hullbench tables", self.refused(self.folder))
        for part, value in (("seed", 1), ("plan", []), ("summary", {"rows": [{}]}), ("environment", {"cpu": 3})):
            broken = report([run()], **{part: value})
            if part == "seed":
                del broken["runs"]
            plot_samples.write_report(self.folder, broken)
            self.refused(self.folder)

    def test_a_missing_library_or_bundler_is_told_with_its_remedy(self):
        self.load(run())
        with unittest.mock.patch.object(page, "BUNDLER", "no-such-esbuild"):
            self.assertIn("'make deps' installs it", self.refused(self.folder))
        page.LIBRARY = self.folder / "nothing.js"
        self.assertIn("install-npm.sh", self.refused(self.folder))

    def test_a_fault_of_ours_is_not_the_users(self):
        self.load(run())
        with unittest.mock.patch.object(make_report, "charts", side_effect=KeyError("l2")), self.assertRaises(KeyError):
            call(make_report.main, self.folder)

    def test_a_file_that_cannot_be_written_is_told(self):
        self.load(run())
        self.assertIn("cannot be written", self.refused(self.folder, "--out", self.folder / "no" / "report.html"))


if __name__ == "__main__":
    unittest.main()
