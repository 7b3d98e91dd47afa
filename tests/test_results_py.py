"""The scripts of results/ that read records: what they keep and count."""

import json
import subprocess
import sys
import unittest
from pathlib import Path
from typing import Any

import plot_samples
from plot_tests import WithFolder  # first, for what is in plots/

from records import SCHEMAS
from report_summary import SAME_ERROR


def thinned(*rows: dict[str, Any]) -> list[dict[str, Any]]:
    lines = "".join(json.dumps(row) + "\n" for row in rows)
    made = subprocess.run(
        [sys.executable, SCHEMAS / "thin_records.py"], input=lines, capture_output=True, text=True, check=True
    )
    return [json.loads(line) for line in made.stdout.splitlines()]


class ThinRecords(unittest.TestCase):
    def test_what_tells_the_same_polygons_stays_as_it_is(self) -> None:
        counts = {"polygons": 1, "holes": 2, "vertices": 1234567, "area": 13900.123456789012}
        whole = plot_samples.run("polylidar", "paper", "ca", 2000, l2=0.123456789, iou=0.9)
        whole["metrics"].update(counts)
        row, _ = thinned(whole, plot_samples.run("cgal_delaunay", "auto", "ca", 2000))
        self.assertEqual({name: row["metrics"].get(name) for name in counts}, counts)
        self.assertEqual(row["metrics"]["l2"], 0.12346)
        self.assertNotIn("iou", row["metrics"])

    def test_one_method_keeps_nothing_to_tell_the_same_polygons_by(self) -> None:
        whole = plot_samples.run(
            "polylidar", "paper", "ca", 2000, l2=0.1, l2_convex_hull=0.4, area=13900.123456789012, vertices=12
        )
        row, _ = thinned(whole, plot_samples.run("polylidar", "default", "ca", 2000))
        self.assertEqual({"area", "vertices", "l2", "l2_convex_hull"} & row["metrics"].keys(), {"l2", "l2_convex_hull"})

    def test_the_convex_hull_is_not_worse_than_itself(self) -> None:
        for error in (0.123456789, 0.123454321):
            [row] = thinned(plot_samples.run("convex_hull", "default", "ca", 2000, l2=error, l2_convex_hull=error))
            self.assertLessEqual(row["metrics"]["l2"], row["metrics"]["l2_convex_hull"] * (1 + SAME_ERROR))


class MedianErrors(WithFolder):
    def printed(self, *rows: dict[str, Any]) -> list[str]:
        records: Path = self.folder / "runs.jsonl"
        records.write_text("".join(json.dumps(row) + "\n" for row in rows), encoding="utf-8")
        command = [sys.executable, SCHEMAS / "median_errors.py", records]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()

    def test_a_failure_is_an_error_of_all_and_what_was_not_tried_is_none(self) -> None:
        rows = [
            plot_samples.run("good", "auto", "ca", 2000, l2=0.25),
            plot_samples.run("good", "auto", "ca", 4000, status="crash"),
            plot_samples.run("missing", "auto", "ca", 2000, status="not_installed"),
        ]
        self.assertEqual(self.printed(*rows), [" 62.5  62.5  good (auto)"])


if __name__ == "__main__":
    unittest.main()
