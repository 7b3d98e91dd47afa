"""plots/records.py on good and bad folders."""

import json
import lzma
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path
from unittest import mock

import plot_samples
from plot_tests import PLOTS, WithFolder, call  # first, for what is in plots/

import make_figures
from records import RecordError, exit_code_of, load


class Records(WithFolder):
    def setUp(self) -> None:
        super().setUp()
        plot_samples.write_suite(self.folder)

    def test_a_suite_is_read_in_its_order(self) -> None:
        self.assertEqual([one.name for one in load(self.folder)], ["rgbd", "states", "alphabet", "random", "steps"])
        (self.folder / "suite.json").write_text('{"plans": ["steps", "states"]}', encoding="utf-8")
        self.assertEqual([one.name for one in load(self.folder)], ["steps", "states", "alphabet", "random", "rgbd"])

    def test_a_single_run_is_read(self) -> None:
        (states,) = load(self.folder / "states")
        self.assertEqual(states.title, "States")
        self.assertEqual(len(states.rows), len(plot_samples.suite()["states"]["runs"]))

    def test_a_row_has_the_numbers_of_the_report(self) -> None:
        (states,) = load(self.folder / "states")
        raw = plot_samples.run("polylidar", "paper", "ca", 4000, True)
        row = next(row for row in states.rows if row.name == raw["name"])
        self.assertEqual((row.median_ns, row.interval()), (raw["time_ns"][1], (raw["time_ns"][0], raw["time_ns"][2])))
        self.assertEqual(row.metric("l2"), raw["metrics"]["l2"])
        self.assertEqual(row.case, "ca/n:4000/holes:1")
        self.assertEqual(row.series, ("polylidar", "paper"))
        floor = load(self.folder / "rgbd")[0].rows[0]
        self.assertEqual((floor.case, floor.n), ("floor-1/n:all/holes:0", 901))

    def test_only_a_row_that_is_ok_has_a_metric(self) -> None:
        document = plot_samples.suite()["steps"]
        document["runs"][0].update(status="invalid_output", detail="it crosses itself")
        self._write("steps/report.json", json.dumps(document))
        row = load(self.folder / "steps")[0].rows[0]
        self.assertIn("l2", row.metrics)
        self.assertIsNone(row.metric("l2"))

    def test_pictures_are_in_the_data_sets_unit(self) -> None:
        (states,) = load(self.folder / "states")
        picture = states.picture("ca/n:8000/holes:1")
        self.assertEqual(picture.ground_truth()[0][0], [(10.0, 20.0), (510.0, 20.0), (510.0, 520.0), (10.0, 520.0)])
        self.assertEqual(picture.points()[1], (10 + 0.5 * 37, 20 + 0.5 * 91))
        self.assertIsNone(picture.polygons("nobody/ca/n:8000/holes:1/protocol:paper"))
        self.assertIsNone(states.picture("ca/n:2000/holes:1"))

    def test_compressed_pictures_are_read_too(self) -> None:
        (alphabet,) = load(self.folder / "alphabet")
        self.assertEqual(alphabet.picture_cases(), [f"letter_{letter}/n:2000/holes:0" for letter in plot_samples.LETTERS])

    def test_a_later_line_replaces_an_earlier_one(self) -> None:
        path = self.folder / "steps" / "pictures.jsonl"
        last = json.loads(path.read_text(encoding="utf-8").splitlines()[-1])
        last["polygons"] = [[[0, 0, 2, 0, 2, 2]]]
        with path.open("a", encoding="utf-8") as out:
            out.write(json.dumps(last, separators=(",", ":")) + "\n")
        picture = load(self.folder / "steps")[0].picture(last["case"])
        self.assertEqual(picture.polygons(last["run"]), [[[(10.0, 20.0), (11.0, 20.0), (11.0, 21.0)]]])

    def test_what_is_wrong_is_said(self) -> None:
        report = plot_samples.suite()["states"]
        cases = {
            "report.json": [
                "{",
                "[]",
                json.dumps({**report, "runs": 3}),
                json.dumps({**report, "schema_version": 9}),
                json.dumps({key: value for key, value in report.items() if key != "methods"}),
                json.dumps({**report, "runs": [{"id": "x"}]}),
                json.dumps({**report, "seed": float("nan")}),
                json.dumps({**report, "runs": report["runs"][1:]}),
                "\xff",
            ],
            "pictures.jsonl": ['{"kind": "result"}\n', "{\n", "[]\n", '{"kind": "other"}\n'],
            "../suite.json": ["{", '{"plans": 3}', "[]"],
        }
        for name, texts in cases.items():
            good = (self.folder / "states" / name).read_bytes()
            for text in texts:
                with self.subTest(name=name, text=text[:40]):
                    self._write(f"states/{name}", text, "latin-1")
                    with self.assertRaises(RecordError) as caught:
                        for one in load(self.folder):
                            list(one.picture_lines())
                    self.assertIn(Path(name).name, str(caught.exception))
                    self.assertNotIn("\n", str(caught.exception))
            (self.folder / "states" / name).write_bytes(good)
        (self.folder / "alphabet" / "pictures.jsonl.xz").write_bytes(b"not xz")
        with self.assertRaises(RecordError):
            load(self.folder / "alphabet")[0].picture_cases()

    def test_a_folder_without_records_is_an_error(self) -> None:
        empty = self.folder / "empty"
        empty.mkdir()
        for folder in (empty, empty / "missing"):
            with self.assertRaises(RecordError):
                load(folder)

    def test_a_kept_reference_run_is_drawn(self) -> None:
        """As 'make figures RUN=results/reference' does: its records are compressed and without identities."""
        if "HULLBENCH" not in os.environ:
            self.skipTest("HULLBENCH does not name the program")
        kept, run, drawn = (PLOTS.parent / "results" / "reference" / "random", self.folder / "kept", self.folder / "drawn")
        run.mkdir()
        shutil.copy(kept / "run.json", run)
        with lzma.open(kept / "runs.jsonl.xz") as lines:
            some = [line for line, _ in zip(lines, range(60))]
        self.assertNotIn("id", json.loads(some[-1]))
        (run / "runs.jsonl.xz").write_bytes(lzma.compress(b"".join(some)))
        subprocess.run([os.environ["HULLBENCH"], "report", run, "--out", drawn], check=True, stdout=subprocess.DEVNULL)
        (experiment,) = load(drawn)
        self.assertTrue(all(row.median_ns for row in experiment.rows if row.ok))
        self.assertEqual(call(make_figures.main, drawn, "--only", "random_polygons")[0], 0)
        self.assertTrue((drawn / "figures" / "random_polygons.png").is_file())

    def test_a_fault_of_ours_is_not_the_users(self) -> None:
        for fault in (KeyError("l2"), TypeError("no number"), AttributeError("x")):
            with self.assertRaises(type(fault)):
                exit_code_of("program", mock.Mock(side_effect=fault))

    def test_the_program_says_so_in_one_sentence(self) -> None:
        self._write("states/report.json", "{")
        command = [sys.executable, "-B", PLOTS / "make_figures.py", self.folder]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stdout, "")
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)

    def _write(self, name: str, text: str, encoding: str = "utf-8") -> None:
        (self.folder / name).write_text(text, encoding=encoding)


if __name__ == "__main__":
    unittest.main()
