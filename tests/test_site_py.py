"""The site (plots/make_site.py): its pages and what they say, that every link leads somewhere, that the search knows every page,
and that nothing is asked of a network."""

import gzip
import html
import json
import posixpath
import re
import tempfile
import unittest
from pathlib import Path
from urllib.parse import parse_qs, unquote

import numpy as np

import plot_samples
from plot_tests import PLOTS, Elements, call  # first, for what is in plots/

import make_site
from records import load
from report_common import METHOD_LOOKS, short_name
from site_run import load_run, what_it_is, zoo_cases

NEWER, OLDER = "2026-01-02-0123abcd", "2025-01-02-0123abcd"
ANIMAL = "zoo-geos-754"
EVIL = "<script>window.broken=1</script>"


def words(path: Path) -> str:
    """A page's text."""
    body = path.read_text(encoding="utf-8").split("<main>")[1].split("</main>")[0]
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", " ", body)))


def zoo() -> dict:
    rows = [plot_samples.run(method, "default", ANIMAL, 40) for method in ("polylidar", "convex_hull")]
    return plot_samples.report("zoo", {ANIMAL: 0}, rows)


def tables() -> dict:
    """Of the zoo, as 'hullbench tables' leaves it."""
    titles = ("Data set", "Points", "Polylidar (default)", "Convex hull (default)", "Turf concave (auto)")
    cells = ((ANIMAL, "Circles", "ok", "lost points", "–"), ("ok, of 1", "", "1", "0", "0"))
    table = {
        "id": "zoo_cases",
        "caption": "How each method answers",
        "columns": [{"title": title, "kind": "words"} for title in titles],
        "rows": [[{"text": cell} for cell in row] for row in cells],
        "remarks": [],
    }
    return {"kind": "tables", "schema_version": 1, "documents": [{"title": "Zoo", "tables": [table], "notes": []}]}


def write_run(folder: Path, created: str, kept: str | None = "<!doctype html><title>kept</title>") -> Path:
    """The invented suite with a zoo; its first method is told in full."""
    reports = {**plot_samples.suite(), "zoo": zoo()}
    for report in reports.values():
        report["created"] = created
        report["summary"]["protocols"] = {"paper": "by the paper's rule"}
    method = reports["rgbd"]["methods"][0]
    method["citation"] = "A. Author, A Paper, https://example.org/paper.html; the rule: another"
    number = {"name": "alpha", "unit": "length", "minimum": 0, "maximum": None, "default": 2.5, "description": "Size of it."}
    method["parameters"] = [number]
    entry = {"method": "polylidar", "protocol": "paper", "parameters": {"alpha": {"rule": "r"}}, "note": "By the truth."}
    reports["rgbd"]["plan"]["methods"] = [entry]
    reports["rgbd"]["rules"] = {"r": "sqrt(area / n)"}
    plot_samples.write_suite(folder, reports)
    (folder / "tables").mkdir()
    (folder / "tables" / "tables.json").write_text(json.dumps(tables()), encoding="utf-8")
    (folder / "tables" / "zoo_cases.csv").write_text("Data set\n", encoding="utf-8")
    if kept is not None:
        (folder / "report.html").write_text(kept, encoding="utf-8")
    return folder


def setUpModule() -> None:
    """One site of two runs for all tests."""
    Folder.root = Path(unittest.enterModuleContext(tempfile.TemporaryDirectory()))
    written = ((OLDER, "2025-01-02T03:04:05Z"), (NEWER, "2026-01-02T03:04:05Z"))
    Folder.runs = [write_run(Folder.root / name, created) for name, created in written]
    Folder.demo = Folder.root / "demo.html"
    Folder.demo.write_text("<!doctype html><title>demo</title>", encoding="utf-8")
    Folder.site = Folder.root / "site"
    assert call(make_site.main, *Folder.runs, "--out", Folder.site, "--demo", Folder.demo)[0] == 0
    Folder.pages = {
        path.relative_to(Folder.site).as_posix(): Elements(path.read_text(encoding="utf-8"))
        for path in sorted(Folder.site.rglob("*.html"))
        if path.name not in ("report.html", "demo.html")
    }


class Folder(unittest.TestCase):
    """What setUpModule made."""

    root: Path
    runs: list[Path]
    demo: Path
    site: Path
    pages: dict[str, Elements]

    def call(self, *arguments: object) -> tuple[int, str]:
        """Exit code and standard error of the program."""
        code, _, err = call(make_site.main, *arguments)
        return code, err


class Pages(Folder):
    def test_every_method_data_set_and_zoo_case_has_one(self) -> None:
        run = load_run(self.runs[1])
        wanted = {"index.html", "add.html", "downloads.html", *(f"{one}/index.html" for one in ("methods", "datasets", "zoo"))}
        wanted |= {f"methods/{name}.html" for name in run.methods} | {f"zoo/{name}.html" for name in zoo_cases()}
        wanted |= {f"datasets/{name}.html" for name in run.datasets if name not in zoo_cases()}
        self.assertGreater(len(wanted), 80)
        bases = ("", f"runs/{NEWER}/", f"runs/{OLDER}/")
        self.assertEqual(set(self.pages), {base + address for base in bases for address in wanted})

    def test_the_newest_is_at_the_top_and_the_older_says_so(self) -> None:
        self.assertIn(NEWER, self.pages["index.html"].source.split("<main>")[0])
        self.assertNotIn("a newer run", self.pages["index.html"].source)
        self.assertIn("a newer run", self.pages[f"runs/{OLDER}/methods/polylidar.html"].source)
        listed = re.findall(r"runs/([^/']+)/index.html", self.pages["index.html"].source)
        self.assertEqual(listed, [NEWER, OLDER])

    def test_every_link_leads_somewhere(self) -> None:
        links = 0
        runs = {row.name for experiment in load(self.runs[1]) for row in experiment.rows}
        for address, seen in self.pages.items():
            self.assertEqual(len(seen.ids), len(set(seen.ids)), f"{address} has an id twice")
            inner = [value for _, name, value in seen.attributes if name in ("aria-controls", "aria-labelledby", "for")]
            for value in [*inner, *re.findall(r"url\(#([^)]+)\)", seen.source)]:
                self.assertIn(value, seen.ids, address)
            for _, name, value in seen.attributes:
                if name not in ("href", "src") or value.startswith(("https://", "http://")):
                    continue
                links += 1
                path, _, fragment = value.partition("#")
                target = posixpath.normpath(posixpath.join(posixpath.dirname(address), unquote(path))) if path else address
                self.assertTrue((self.site / target).is_file(), f"{address} leads to {value}")
                asked = parse_qs(fragment)
                if target in self.pages and fragment:
                    self.assertIn(fragment, self.pages[target].ids, f"{address} leads to {value}")
                elif fragment and "run" in asked:
                    self.assertIn(asked["run"][0], runs)
                elif fragment:
                    self.assertEqual(set(asked), {"part", "entrant"}, value)
        self.assertGreater(links, 3000)

    def test_the_search_knows_every_page_of_its_run(self) -> None:
        for base in ("", f"runs/{OLDER}/"):
            mine = {one for one in self.pages if one.startswith(base) and (base or not one.startswith("runs/"))}
            for address in mine:
                folder = posixpath.dirname(address)
                index = json.loads(dict(self.pages[address].scripts)["pages"])
                self.assertEqual({posixpath.normpath(posixpath.join(folder, one[2])) for one in index}, mine, address)
        animal = next(one for one in index if ANIMAL in one[3])
        self.assertEqual(animal[:2], [zoo_cases()[ANIMAL].title, "Zoo"])

    def test_nothing_is_asked_of_a_network(self) -> None:
        for address, seen in self.pages.items():
            self.assertFalse(set(seen.tags) & {"link", "img", "iframe", "form", "object", "embed", "base"}, address)
            self.assertNotIn(("script", "src"), {(tag, name) for tag, name, _ in seen.attributes})
            for tag, name, value in seen.attributes:
                if re.search("https?:", value) and not (tag, name) == ("a", "href"):
                    self.fail(f"{address}: {tag} {name}={value}")
            self.assertNotRegex(seen.source, r"url\(['\"]?https?:|@import")
            self.assertTrue(seen.policy.startswith("default-src 'none'; script-src 'sha256-"), seen.policy)

    def test_no_mark_is_left(self) -> None:
        for address, seen in self.pages.items():
            self.assertNotRegex(seen.source, "[\ue000-\ue0ff]|\\{\\{\\w+\\}\\}", address)

    def test_the_same_runs_make_the_same_bytes(self) -> None:
        again = self.root / "again"
        self.assertEqual(self.call(*reversed(self.runs), "--out", again, "--demo", self.demo), (0, ""))
        files = [path.relative_to(self.site) for path in sorted(self.site.rglob("*")) if path.is_file()]
        self.assertEqual(files, [path.relative_to(again) for path in sorted(again.rglob("*")) if path.is_file()])
        for path in files:
            self.assertEqual((self.site / path).read_bytes(), (again / path).read_bytes(), path)

    def test_the_demo_is_linked_where_it_is(self) -> None:
        self.assertTrue((self.site / "demo.html").is_file())
        self.assertIn("<a href='../../../demo.html'>Try it</a>", self.pages[f"runs/{OLDER}/methods/polylidar.html"].source)
        self.assertEqual(self.call(*self.runs[:1], "--out", self.root / "bare"), (0, ""))
        self.assertNotIn("demo.html", (self.root / "bare" / "index.html").read_text(encoding="utf-8"))


class What(Folder):
    def test_a_method_has_its_citation_parameters_and_places(self) -> None:
        path = self.site / "methods" / "polylidar.html"
        told = words(path)
        self.assertIn("<a href='https://example.org/paper.html'>", self.pages["methods/polylidar.html"].source)
        self.assertIn(f"{what_it_is('polylidar')}.", told)
        for part in ("alpha", "Size of it.", "alpha = sqrt(area / n)", "By the truth.", "by the paper's rule"):
            self.assertIn(part, told)
        informed = next(one for one in load_run(self.runs[1]).front.ratings if one.division.name == "informed")
        ranks = {one.series.method: one.rank for one in informed.standings}
        place = 1 + len({rank for rank in ranks.values() if rank < ranks["polylidar"]})
        self.assertIn(
            f"has place {place} of {len(informed.standings)} among the different results of methods that know something of the truth",
            told,
        )
        self.assertIn("the others have more cases in common without it", words(self.site / "methods" / "convex_hull.html"))
        self.assertIn("This run has no results of it", words(self.site / "methods" / "postgis_legacy.html"))

    def test_a_method_has_up_to_ten_pictures_from_the_best_to_the_worst(self) -> None:
        shown = [value for _, name, value in self.pages["methods/polylidar.html"].attributes if name == "data-run"]
        drawn = {one.row.name: one.row.metric("l2") for one in load_run(self.runs[1]).drawn if one.row.method == "polylidar"}
        own = sorted(error for name, error in drawn.items() if name.endswith("protocol:paper"))
        errors = [drawn[name] for name in shown]
        self.assertEqual((len(errors), errors), (10, sorted(errors)))
        self.assertEqual((errors[0], errors[-1]), (own[0], own[-1]))
        self.assertGreater(len(own), 10)

    def test_a_data_set_shows_what_up_to_ten_methods_make_of_the_same_points(self) -> None:
        shown = [value for _, name, value in self.pages["datasets/ca.html"].attributes if name == "data-run"]
        self.assertEqual(len({name.split("/")[0] for name in shown}), len(shown))
        self.assertEqual(len({name.partition("/")[2].rpartition("/")[0] for name in shown}), 1)
        self.assertGreaterEqual(len(shown), 5)

    def test_a_data_set_says_who_does_best(self) -> None:
        told = words(self.site / "datasets" / "ca.html")
        self.assertIn("States: 6 cases", told)
        self.assertIn("Methods that know something of the truth, 6 cases", told)
        division = load_run(self.runs[1]).divisions("ca")[-1]
        places = np.mean([[1 + sum(column < one) for one in column] for column in division.results.errors.T], axis=0)
        shown = re.findall(r"([\w.]+) (\d\.\d\d) [\d.]+ [\d.]+ 0 ", told.split("something of the truth, 6 cases")[1])
        wanted = {
            short_name(one, division.results.entrants): f"{place:.2f}" for one, place in zip(division.results.entrants, places)
        }
        self.assertEqual(dict(shown), wanted)
        self.assertEqual([place for _, place in shown], sorted(wanted.values()))
        self.assertIn("star-1 to star-399", words(self.site / "datasets" / "star.html"))

    def test_a_zoo_case_tells_what_went_wrong_and_the_answers(self) -> None:
        told = words(self.site / "zoo" / f"{ANIMAL}.html")
        for part in (
            "never ended",
            "Polylidar (default) ok",
            "Convex hull (default) lost points",
            f"hullbench points {ANIMAL}",
        ):
            self.assertIn(part, told)
        self.assertIn("<a href='https://github.com/libgeos/geos/issues/754'>", self.pages[f"zoo/{ANIMAL}.html"].source)
        self.assertIn("This run did not ask the methods.", words(self.site / "zoo" / "zoo-jts-1002.html"))
        self.assertIn("1 of 2", words(self.site / "zoo" / "index.html"))

    def test_adding_a_method_is_the_readmes_checklist(self) -> None:
        readme = (PLOTS.parent / "README.md").read_text(encoding="utf-8").split("### A method")[1].split("###")[0]
        plain = re.sub(r"\]\([^)]+\)", "", readme).replace("- [ ]", "")
        self.assertEqual(
            re.sub(r"[`\[\]\s]+", "", plain), re.sub(r"\s+", "", words(self.site / "add.html").partition("Step by step")[2])
        )
        self.assertEqual(self.pages["add.html"].source.count("<li>"), readme.count("- [ ]"))

    def test_the_readmes_tables_say_the_same(self) -> None:
        adapters, zoo = (
            (PLOTS.parent / name).read_text(encoding="utf-8") for name in ("adapters/README.md", "datasets/zoo/README.md")
        )
        rows = [f"| `{name}` | {look['what']} |" for name, look in METHOD_LOOKS.items()]
        self.assertEqual([row for row in rows if row not in adapters], [])
        self.assertEqual(adapters.count("\n| `"), adapters.split("## The methods")[0].count("\n| `") + len(rows))
        cases = [
            f"| `{one.name}` | {one.title} | {one.fault} | [{one.issue}]({one.address}) | {one.answer} |\n"
            for one in zoo_cases().values()
        ]
        self.assertIn("|---|\n" + "".join(cases) + "<!-- zoo: end -->", zoo)

    def test_downloads_are_the_runs_own_files(self) -> None:
        files = self.site / "runs" / NEWER / "files"
        self.assertEqual((files / "cases.csv").read_bytes(), (self.runs[1] / "cases.csv").read_bytes())
        plain = gzip.decompress((files / "report-states.json.gz").read_bytes())
        self.assertEqual(plain, (self.runs[1] / "states" / "report.json").read_bytes())
        told = words(self.site / "downloads.html")
        for part in ("cases.csv", "tune.json.xz", "zoo_cases.csv How each method answers", "report.schema.json"):
            self.assertIn(part, told)
        self.assertFalse((self.site / "files").exists(), "the files are at the run's own address")

    def test_what_was_not_measured_has_pages_by_the_listing(self) -> None:
        listing = self.root / "listing.json"
        method = {**load(self.runs[0])[0].report["methods"][0], "name": "brand_new", "title": EVIL}
        dataset = {**load(self.runs[0])[0].report["datasets"][0], "name": "wide~", "title": "Wide", "members": 0}
        listing.write_text(json.dumps({"methods": [method], "datasets": [dataset]}), encoding="utf-8")
        code, err = self.call(*self.runs, "--out", self.root / "listed", "--listing", listing)
        self.assertEqual((code, err), (0, ""))
        page = self.root / "listed" / "methods" / "brand_new.html"
        self.assertNotIn(EVIL, page.read_text(encoding="utf-8"), "what a record says stays text")
        self.assertIn("not measured", words(self.root / "listed" / "datasets" / "wide-.html"))
        self.assertFalse((self.root / "listed" / "runs" / OLDER / "methods" / "brand_new.html").exists())

    def test_a_run_without_results_pictures_or_tables_has_a_site(self) -> None:
        report = plot_samples.report("states", {"ca": 0}, [plot_samples.run("polylidar", "paper", "ca", 2000)])
        folder = plot_samples.write_report(self.root / "bare-run", report)
        (folder / "report.html").write_text("kept", encoding="utf-8")
        self.assertEqual(self.call(folder, "--out", self.root / "small"), (0, ""))
        self.assertIn("no results that can be compared", words(self.root / "small" / "datasets" / "ca.html"))


class Faults(Folder):
    def test_what_is_no_run_is_refused(self) -> None:
        code, err = self.call(self.root / "nothing", "--out", self.root / "x")
        self.assertEqual(code, 2)
        self.assertIn("is not a folder", err)

    def test_two_runs_of_one_name_are_refused(self) -> None:
        code, err = self.call(self.runs[0], self.runs[0], "--out", self.root / "x")
        self.assertEqual((code, "the same name" in err), (2, True))

    def test_what_is_no_site_is_not_replaced(self) -> None:
        other = self.root / "home"
        other.mkdir()
        (other / "index.html").write_text("mine", encoding="utf-8")
        code, err = self.call(*self.runs, "--out", other)
        self.assertEqual((code, "is no site, which would be lost" in err), (2, True))
        self.assertEqual([one.name for one in other.iterdir()], ["index.html"])

    def test_two_pages_of_one_file_are_refused(self) -> None:
        listing = self.root / "alike.json"
        dataset = load(self.runs[0])[0].report["datasets"][0]
        alike = [{**dataset, "name": name, "members": 0} for name in ("wide~2", "wide:2")]
        listing.write_text(json.dumps({"methods": [], "datasets": alike}), encoding="utf-8")
        code, err = self.call(self.runs[1], "--out", self.root / "alike", "--listing", listing)
        self.assertEqual((code, "would be one file, datasets/wide-2.html" in err), (2, True))
        self.assertFalse((self.root / "alike").exists(), "nothing is left of a site that was not finished")


if __name__ == "__main__":
    unittest.main()
