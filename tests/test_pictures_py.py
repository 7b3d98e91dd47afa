"""Tests of plots/pictures.py: what is packed is what was recorded, within the grid and the budget."""

import base64
import gzip
import itertools
import json
import random
import struct
import unittest

import plot_samples
from plot_tests import WithFolder  # first, for what is in plots/

from page import data
from pictures import BUDGET_BYTES, GRID, MOST_VERTICES, is_kept, kept_pictures, pack
from records import RecordError, load

STEP = 16  # of the recorded grid in the packed one
# From the leftmost vertex on, towards the lower neighbour.
SQUARE = [16000, 16000, 16000, 48000, 48000, 48000, 48000, 16000]
HOLE = [24000, 24000, 24000, 32000, 32000, 32000]
FAR = [-900000, 0, 65535, 0, 65535, 900000]
# The square, begun elsewhere and turned round.
SAME_SQUARE = [48000, 48000, 16000, 48000, 16000, 16000, 48000, 16000]


def row(case: str, method: str = "polylidar", l2: float | None = 0.1, status: str = "ok") -> dict:
    dataset, n, holes = case.split("/")
    size = 2000 if n == "n:all" else int(n[2:])
    made = plot_samples.run(method, "paper", dataset, size, holes == "holes:1", status, times=[1000], l2=l2)
    return {**made, "name": f"{method}/{case}/protocol:paper"}


def case_line(case: str, points: list[int], truth: list) -> dict:
    return plot_samples.case_line(case, points, truth, len(points) // 2)


def result_line(case: str, polygons: list, method: str = "polylidar") -> dict:
    return plot_samples.result_line(row(case, method), polygons)


def spread_points(count: int) -> list[int]:
    """Points at random that do not coincide in the packed grid."""
    cells = random.Random(1).sample(range(GRID * GRID), count)
    return [STEP * value for cell in cells for value in divmod(cell, GRID)]


def block_of(entry: dict) -> tuple[dict, list[tuple[int, int]], list, list]:
    """Header, points, ground truth and results of a case, read as report/picture.js does."""
    plain = gzip.decompress(base64.b64decode(entry["block"]))
    length = struct.unpack("<I", plain[:4])[0]
    header, position = json.loads(plain[4 : 4 + length]), 4 + length

    def numbers(count: int) -> list[int]:
        nonlocal position
        low, high = plain[position : position + count], plain[position + count : position + 2 * count]
        position += 2 * count
        return [a | b << 8 for a, b in zip(low, high)]

    def polygons(counts: list) -> list:
        steps = [-(code + 1) // 2 if code & 1 else code // 2 for code in numbers(2 * sum(map(sum, counts)))]
        places = zip(itertools.accumulate(steps[::2]), itertools.accumulate(steps[1::2]))
        return [[[value for _ in range(count) for value in next(places)] for count in rings] for rings in counts]

    steps, heights = numbers(header["points"]), numbers(header["points"])
    points = list(zip(itertools.accumulate(steps), heights))
    return header, points, polygons(header["truth"]), [polygons(counts) for counts in header["results"]]


class Pictures(WithFolder):
    def write(self, name: str, rows: list[dict], lines: list[dict]) -> None:
        folder = plot_samples.write_report(self.folder / name, plot_samples.report(name, {"ca": 0, "star": 40}, rows))
        (folder / "pictures.jsonl").write_text(plot_samples.json_lines(lines))

    def packed(self, budget: int = BUDGET_BYTES) -> dict:
        return pack(load(self.folder), budget)

    def test_geometry_comes_through_rounded_to_the_grid(self) -> None:
        case = "ca/n:2000/holes:1"
        points = [16000, 16000, 48000, 16007, 30, 65535]
        self.write("states", [row(case)], [case_line(case, points, [[SQUARE, HOLE]]), result_line(case, [[FAR], [SQUARE]])])
        entry = self.packed()["cases"][0]
        header, packed_points, truth, results = block_of(entry)
        self.assertEqual([[[v // STEP for v in ring] for ring in (SQUARE, HOLE)]], truth)
        self.assertEqual([(2, 4096), (1000, 1000), (3000, 1000)], packed_points)
        self.assertEqual([[v // STEP for v in SQUARE]], results[0][1])
        self.assertEqual([-2 * GRID, 0, GRID, 0, GRID, 3 * GRID], results[0][0][0], "far vertices are cut off")
        self.assertEqual(([10.0, 20.0], 0.5 * STEP), (header["origin"], header["step"]))
        self.assertEqual(("California", 2000, True), (entry["title"], entry["n"], entry["holes"]))

    def test_what_a_report_shows_can_be_read_back(self) -> None:
        case = "ca/n:2000/holes:1"
        lines = [case_line(case, [16000, 16000, 48000, 16007], [[SQUARE, HOLE]]), result_line(case, [[FAR], [SQUARE]])]
        self.write("states", [row(case), row(case, "slow", None, "timeout")], lines)
        entry = self.packed()["cases"][0]
        _, points, truth, (result,) = block_of(entry)
        page = self.folder / "report.html"
        page.write_text(f"<p>{data('report', {})}{data('pictures', {'cases': [entry]})}<script>1</script>", encoding="utf-8")
        (found,) = kept_pictures(page, load(self.folder))
        self.assertEqual(list(found), [case])
        self.assertEqual(found[case].case["points"], [value for point in points for value in point])
        self.assertEqual(found[case].case["ground_truth"], truth)
        self.assertEqual({name: one["polygons"] for name, one in found[case].results.items()}, {row(case)["name"]: result})
        self.assertFalse(is_kept(self.folder, load(self.folder)), "it has its own pictures")
        load(self.folder)[0].pictures_file().unlink()
        self.assertTrue(is_kept(self.folder, load(self.folder)))
        page.write_text("<p>no pictures</p>", encoding="utf-8")
        self.assertFalse(is_kept(self.folder, load(self.folder)))

    def test_needless_vertices_and_vanishing_rings_are_left_out(self) -> None:
        case = "ca/n:2000/holes:0"
        middle = [16000, 16000, 32000, 16000, 48000, 16000, 48000, 48000, 48000, 48000, 16000, 48000]
        tiny = [20000, 20000, 20001, 20000, 20000, 20001]
        self.write("states", [row(case)], [case_line(case, [0, 0], [[SQUARE]]), result_line(case, [[middle, tiny], [tiny]])])
        _, _, _, results = block_of(self.packed()["cases"][0])
        self.assertEqual([[[v // STEP for v in SQUARE]]], results[0])

    def test_runs_have_their_numbers_and_equal_results_are_kept_once(self) -> None:
        case = "ca/n:2000/holes:0"
        rows = [row(case), row(case, "cgal", 0.123456789), row(case, "slow", None, "timeout")]
        lines = [case_line(case, [0, 0], [[SQUARE]]), result_line(case, [[SQUARE]]), result_line(case, [[SAME_SQUARE]], "cgal")]
        self.write("states", rows, lines)
        entry = self.packed()["cases"][0]
        self.assertEqual(
            [
                ["polylidar", "paper", "ok", 0.1, 1000, 0],
                ["cgal", "paper", "ok", 0.123456789, 1000, 0],
                ["slow", "paper", "timeout", None, None, None],
            ],
            entry["runs"],
        )
        self.assertEqual(1, len(block_of(entry)[3]))

    def test_the_worst_case_comes_first_and_a_failure_before_it(self) -> None:
        cases = {f"ca/n:{n}/holes:0": l2 for n, l2 in ((2000, 0.1), (4000, 0.3), (8000, None), (16000, 0.2))}
        rows = [row(case, l2=l2, status="ok" if l2 else "crash") for case, l2 in cases.items()]
        self.write("states", rows, [case_line(case, [0, 0], [[SQUARE]]) for case in cases])
        self.assertEqual([8000, 4000, 16000, 2000], [entry["n"] for entry in self.packed()["cases"]])

    def test_points_are_thinned_before_pictures_are_given_up(self) -> None:
        cases = [f"star-{k}/n:8000/holes:0" for k in range(40)]
        lines = [case_line(case, spread_points(4000), [[SQUARE]]) for case in cases]
        self.write("random", [row(case, l2=0.01 * k) for k, case in enumerate(cases)], lines)
        whole = self.packed()
        size = len(json.dumps(whole, separators=(",", ":")))
        self.assertEqual((4000, 40), (whole["points_limit"], len(whole["cases"])))
        thinned = self.packed(size * 3 // 4)
        self.assertEqual((2000, 40, {}), (thinned["points_limit"], len(thinned["cases"]), thinned["dropped"]))
        self.assertEqual(2000, len(block_of(thinned["cases"][0])[1]))

    def test_of_a_methods_huge_results_only_the_worst_is_kept_when_room_is_short(self) -> None:
        errors = {f"floor-{k}/n:all/holes:0": l2 for k, l2 in enumerate((0.1, 0.3, 0.2))}
        huge = [spread_points(MOST_VERTICES + 1)]
        lines = []
        for case in errors:
            lines += [case_line(case, [0, 0], [[SQUARE]]), result_line(case, [huge]), result_line(case, [[SQUARE]], "cgal")]
        rows = [row(case, method, l2) for case, l2 in errors.items() for method in ("polylidar", "cgal")]
        self.write("rgbd", rows, lines)
        whole = self.packed()
        self.assertEqual((0, 3), (whole["results_left_out"], len(whole["cases"])))
        size = len(json.dumps(whole, separators=(",", ":")))
        packed = self.packed(size // 2)
        self.assertEqual((2, 3, {}), (packed["results_left_out"], len(packed["cases"]), packed["dropped"]))
        kept = [(entry["case"], run[0]) for entry in packed["cases"] for run in entry["runs"] if run[5] is not None]
        self.assertEqual(
            [
                ("floor-1/n:all/holes:0", "polylidar"),
                ("floor-1/n:all/holes:0", "cgal"),
                ("floor-2/n:all/holes:0", "cgal"),
                ("floor-0/n:all/holes:0", "cgal"),
            ],
            kept,
        )

    def test_the_largest_experiment_gives_up_its_most_accurate_cases(self) -> None:
        many = [f"star-{k}/n:8000/holes:0" for k in range(40)]
        few = [f"ca/n:{1000 * k}/holes:0" for k in range(1, 4)]
        for name, cases in (("random", many), ("states", few)):
            lines = [case_line(case, spread_points(4000), [[SQUARE]]) for case in cases]
            self.write(name, [row(case, l2=0.01 * k) for k, case in enumerate(cases)], lines)
        budget = 100_000
        packed = self.packed(budget)
        self.assertLessEqual(len(json.dumps(packed, separators=(",", ":"))), budget)
        kept = {entry["case"] for entry in packed["cases"]}
        self.assertTrue(set(few) <= kept)
        dropped = packed["dropped"]["random"]
        self.assertEqual({"random": dropped}, packed["dropped"])
        self.assertEqual({"random": dropped}, packed["without_picture"])
        self.assertEqual(set(many[dropped:]), kept - set(few))
        self.assertGreater(dropped, 0)

    def test_cases_that_were_measured_without_a_picture_are_counted(self) -> None:
        cases = ["star-1/n:all/holes:0", "star-2/n:all/holes:0", "star-3/n:all/holes:0"]
        self.write("random", [row(case) for case in cases], [case_line(cases[0], [0, 0], [[SQUARE]])])
        packed = self.packed()
        self.assertEqual(({"random": 2}, {}), (packed["without_picture"], packed["dropped"]))
        self.assertEqual(("star-1/n:all/holes:0", "Star 1"), (packed["cases"][0]["case"], packed["cases"][0]["title"]))

    def test_a_case_of_two_experiments_is_shown_once(self) -> None:
        case = "ca/n:64000/holes:1"
        self.write("states", [row(case)], [case_line(case, [0, 0], [[SQUARE]]), result_line(case, [[SQUARE]])])
        self.write(
            "steps", [row(case), row(case, "by_steps")], [case_line(case, [0, 0], [[SQUARE]]), result_line(case, [[FAR]])]
        )
        packed = self.packed()
        self.assertEqual([["states", "steps"]], [entry["experiments"] for entry in packed["cases"]])
        self.assertEqual(["polylidar", "by_steps"], [run[0] for run in packed["cases"][0]["runs"]])
        self.assertEqual([[[[v // STEP for v in SQUARE]]]], block_of(packed["cases"][0])[3])
        self.assertEqual({}, packed["without_picture"])

    def test_what_has_no_picture_is_counted_in_the_same_order_every_time(self) -> None:
        names = ["states", "alphabet", "steps", "random", "rgbd"]
        for name in names:
            self.write(name, [row(f"{name}/n:2000/holes:0")], [])
        self.assertEqual(list(self.packed()["without_picture"]), sorted(names))

    def test_no_pictures_at_all_and_malformed_ones(self) -> None:
        self.write("states", [row("ca/n:2000/holes:0")], [])
        self.assertEqual(([], {"states": 1}), (self.packed()["cases"], self.packed()["without_picture"]))
        (self.folder / "states" / "pictures.jsonl").write_text('{"kind":"case"}\n')
        with self.assertRaisesRegex(RecordError, "pictures.jsonl: line 1"):
            self.packed()


if __name__ == "__main__":
    unittest.main()
