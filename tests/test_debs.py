"""The Debian packages: made by CPack of what is built, unpacked into a folder and used there.

Run by ctest, which says in the environment what there is to be: HULLBENCH_BUILD, HULLBENCH_PACKAGES and the like.
"""
import gzip
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = pathlib.Path(os.environ["HULLBENCH_BUILD"])
VERSION = os.environ["HULLBENCH_VERSION"]
PACKAGES = os.environ["HULLBENCH_PACKAGES"].split()
PROGRAMS = {"hullbench": "hullbench", "polylidar-tools": "polylidar"}


def run(*command, **options):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    if result.returncode != 0:
        raise AssertionError(f"{command}: {result.stdout}{result.stderr}")
    return result.stdout


def make_debs(folder, components=""):
    """What the targets "debs" and "deb_PACKAGE" run, into another folder; its words."""
    return run(
        *(os.environ["CMAKE"], f"-DCPACK={os.environ['CPACK']}", f"-DCONFIG={BUILD / 'CPackConfig.cmake'}"),
        *(f"-DFOLDER={folder}", f"-DCOMPONENTS={components}", "-P", ROOT / "packaging" / "make_debs.cmake"),
    )


class Debs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        cls.said = make_debs(cls.folder / "packages")
        cls.debs = {deb.name.split("_")[0]: deb for deb in (cls.folder / "packages").glob("*.deb")}
        for name, deb in cls.debs.items():
            run("dpkg-deb", "-x", deb, cls.folder / name)

    def field(self, package, name):
        return run("dpkg-deb", "-f", self.debs[package], name).strip()

    def program(self, package):
        return self.folder / package / "usr" / "bin" / PROGRAMS[package]

    def programs(self):
        return [package for package in PACKAGES if package in PROGRAMS]

    def test_every_package_is_there_with_the_version_and_a_maintainer(self):
        self.assertEqual(set(self.debs), set(PACKAGES))
        self.assertIn("hullbench", PACKAGES)
        for package in PACKAGES:
            self.assertEqual(self.field(package, "Version"), VERSION + "-1")
            self.assertRegex(self.field(package, "Maintainer"), r"^.+ <.+@.+>$")

    def test_making_them_says_where_they_are_and_nothing_else(self):
        self.assertEqual(self.said.splitlines(), [f"-- {deb}" for deb in sorted(self.debs.values())])

    @unittest.skipUnless("polylidar-tools" in PACKAGES, "this build does not have the program polylidar")
    def test_a_package_can_be_made_alone(self):
        (self.folder / "alone").mkdir()
        (self.folder / "alone" / "old.deb").touch()
        make_debs(self.folder / "alone", "tool;polylidar-tools_documents")
        (deb,) = (self.folder / "alone").glob("*.deb")
        self.assertEqual(deb.name, self.debs["polylidar-tools"].name)
        run("dpkg-deb", "-x", deb, self.folder / "alone" / "files")
        files = [
            sorted(path.relative_to(top) for path in top.rglob("*"))
            for top in (self.folder / "alone" / "files", self.folder / "polylidar-tools")
        ]
        self.assertEqual(*files)

    def test_lintian_has_no_error_to_report(self):
        # Its tags of the level "error" and worse end it with another status than 0.
        run("lintian", "--allow-root", "--fail-on", "error", *self.debs.values())

    def test_what_links_libraries_depends_on_them(self):
        self.assertRegex(self.field("hullbench", "Depends"), r"libc6 .*libgeos.*libspatialite")
        if "python3-polylidar" in PACKAGES:
            self.assertRegex(self.field("python3-polylidar", "Depends"), r"python3 \(<< 3\.\d+~\), python3-numpy, libc6")

    def test_every_package_has_its_licence_and_what_is_new_and_no_file_of_another(self):
        seen = {}
        for package in PACKAGES:
            documents = self.folder / package / "usr" / "share" / "doc" / package
            self.assertIn("Permission is hereby granted", (documents / "copyright").read_text())
            self.assertIn(f"## {VERSION}", gzip.decompress((documents / "changelog.gz").read_bytes()).decode())
            debian = gzip.decompress((documents / "changelog.Debian.gz").read_bytes()).decode()
            self.assertTrue(debian.startswith(f"{package} ({VERSION}-1) "), debian)
            for path in (self.folder / package).rglob("*"):
                if path.is_file():
                    name = path.relative_to(self.folder / package)
                    self.assertNotIn(name, seen, f"{package} and {seen.get(name)} have the same file")
                    seen[name] = package
        for package, text in (("hullbench", "University of Cincinnati"), ("python3-polylidar", "Wenzel Jakob")):
            if package in PACKAGES:
                self.assertIn(text, (self.folder / package / "usr/share/doc" / package / "copyright").read_text())
        # CGAL's licence is that of the whole program.
        self.assertIn("GPL-3", (self.folder / "hullbench/usr/share/doc/hullbench/copyright").read_text())

    def test_a_program_is_built_with_the_library(self):
        build = self.folder / "lattice"
        run(
            *(os.environ["CMAKE"], "-S", ROOT / "tests" / "package", "-B", build, "-DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF"),
            *(f"-DCMAKE_PREFIX_PATH={self.folder}/libpolylidar-dev/usr", f"-DCMAKE_CXX_COMPILER={os.environ['CXX']}"),
        )
        run(os.environ["CMAKE"], "--build", build)
        self.assertEqual(run(build / "lattice"), "shell of 40 vertices, hole of 12 vertices\narea 86\n")

    @unittest.skipUnless("python3-polylidar" in PACKAGES, "this build does not have the Python module")
    def test_the_python_module_is_where_debian_looks_for_it(self):
        folder = self.folder / "python3-polylidar/usr/lib/python3/dist-packages"
        said = run(
            *(os.environ["POLYLIDAR_PYTHON"], "-B", "-c"),
            "import polylidar_core as p; print(p.__version__, p.__file__, p.concave_hull([(0, 0), (2, 0), (0, 2)]).area)",
            env={**os.environ, "PYTHONPATH": str(folder)},
        )
        self.assertEqual(said, f"{VERSION} {folder}/polylidar_core/__init__.py 2.0\n")

    def test_programs_say_their_version_and_make_a_hull(self):
        points = self.folder / "points.csv"
        points.write_text("x,y\n0,0\n2,0\n0,2\n")
        for package in self.programs():
            self.assertIn(VERSION, run(self.program(package), "--version"))
            hull = run(self.program(package), "hull", points, "--alpha", "9", "--format", "wkt")
            self.assertRegex(hull, r"POLYGON ?\(\(")

    def test_hullbench_loads_the_methods_installed_beside_it(self):
        modules = sorted((self.folder / "hullbench/usr/lib/hullbench").iterdir())
        self.assertIn("libhullbench_module_spatialite.so", [path.name for path in modules])
        said = self.folder / "loaded"
        run(self.program("hullbench"), "list", env={**os.environ, "LD_DEBUG": "files", "LD_DEBUG_OUTPUT": str(said)})
        loaded = re.findall(r"calling init: (.*)", "".join(path.read_text() for path in self.folder.glob("loaded.*")))
        self.assertEqual([path for path in modules if str(path) not in loaded], [])

    def test_hullbench_reads_what_is_installed_beside_it(self):
        data = self.folder / "hullbench/usr/share/hullbench"
        # A plan that is in no clone.
        plan = (data / "benchmarks/plans/alphabet.json").read_text()
        (data / "benchmarks/plans/installed.json").write_text(plan.replace('"alphabet"', '"installed"', 1))
        home = {**os.environ, "HOME": str(self.folder)}
        hullbench = self.program("hullbench")
        runs = run(hullbench, "run", "installed", "--filter", "^polylidar/", "--dry-run", env=home, cwd=self.folder)
        self.assertIn("polylidar/letter_a", runs)
        letter = data / "datasets/shapes/letter_a.geojson"
        run(hullbench, "points", "letter_a", "--n", "10", "--out", self.folder / "a.csv", env=home)
        letter.unlink()
        with self.assertRaisesRegex(AssertionError, str(letter)):
            run(hullbench, "points", "letter_a", "--n", "10", "--out", self.folder / "b.csv", env=home)
        run(hullbench, "adapter", "new", "mine", "--lang", "python", "--out", self.folder / "mine", env=home)
        self.assertTrue((self.folder / "mine" / "mine.json").exists())

    def manual_pages(self):
        for package in self.programs():
            yield from sorted((self.folder / package / "usr/share/man/man1").glob("*.1.gz"))

    def test_every_subcommand_has_a_man_page_that_man_formats_without_a_word(self):
        pages = {page.name for page in self.manual_pages()}
        for package in self.programs():
            # CLI11's versions differ in capitals and indentation.
            listed = re.search(r"(?ims)^subcommands:\s*\n(.*?)\n\n", run(self.program(package), "--help"))[1]
            commands = [line.split()[0] for line in listed.splitlines() if line.strip()]
            self.assertIn("hull", commands)
            for command in commands:
                self.assertIn(f"{PROGRAMS[package]}-{command}.1.gz", pages)
        for page in self.manual_pages():
            shown = subprocess.run(
                ["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", str(page)],
                env={**os.environ, "MANROFFSEQ": "", "LC_ALL": "C.UTF-8"},
                capture_output=True,
                check=True,
            )
            self.assertEqual(shown.stderr, b"", page.name)

    def test_a_man_page_has_every_option_of_the_help(self):
        page = self.folder / "hullbench/usr/share/man/man1/hullbench-run.1.gz"
        text = run("man", "-l", page, env={**os.environ, "LC_ALL": "C.UTF-8", "MANPAGER": "cat", "MANWIDTH": "500"})
        help_text = run(self.program("hullbench"), "run", "--help")
        options = [word for word in help_text.split() if word.startswith("--")]
        self.assertGreater(len(options), 10)
        for option in options:
            self.assertIn(option, text)
        self.assertNotIn("--write-manual", run("man", "-l", page.parent / "hullbench.1.gz"))

    def test_completion_is_where_debian_s_shells_look_for_it(self):
        for package in self.programs():
            share = self.folder / package / "usr/share"
            bash = share / "bash-completion/completions" / PROGRAMS[package]
            zsh = share / "zsh/vendor-completions" / f"_{PROGRAMS[package]}"
            self.assertIn(f"complete -o default -F _{PROGRAMS[package]}", bash.read_text())
            self.assertTrue(zsh.read_text().startswith(f"#compdef {PROGRAMS[package]}\n"))
            self.assertEqual([path.name for path in (share / "zsh").iterdir()], ["vendor-completions"])

    def completed(self, *words):
        script = self.folder / "hullbench/usr/share/bash-completion/completions/hullbench"
        return run(
            *(
                "bash",
                "--norc",
                "-c",
                'source "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _hullbench; echo "${COMPREPLY[*]}"',
            ),
            *(script, *words),
        ).split()

    def test_bash_completes_subcommands_options_and_words(self):
        self.assertIn("adapter", self.completed("hullbench", ""))
        self.assertEqual(self.completed("hullbench", "rea"), ["readme"])
        self.assertEqual(self.completed("hullbench", "run", "--rep"), ["--repetitions"])
        self.assertEqual(self.completed("hullbench", "adapter", ""), ["new", "test", "-h", "--help"])
        self.assertEqual(self.completed("hullbench", "adapter", "new", "--lang", ""), ["cpp", "python", "js"])
        self.assertEqual(self.completed("hullbench", "hull", "a.csv", "--format", "w"), ["wkt", "wkb"])
        # Nothing of its own, where bash then completes names of files.
        self.assertEqual(self.completed("hullbench", "run", "--out", ""), [])


if __name__ == "__main__":
    unittest.main()
