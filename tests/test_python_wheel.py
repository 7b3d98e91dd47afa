"""The wheel and the sdist: built as a user builds them, installed into an environment of their own, and used there.

Run by ctest. HULLBENCH_BUILD is CMake's build folder, whose module and flags they are compared with.
"""
import hashlib
import importlib.metadata
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = pathlib.Path(os.environ["HULLBENCH_BUILD"])
# What a clone has that matters here. Builds leave files beside the sources, so they work on a copy.
NEEDED = ("pyproject.toml", "setup.py", "MANIFEST.in", "LICENSE", "LICENSE-THIRD-PARTY", "CMakeLists.txt", "cmake", "core")
PIP = (sys.executable, "-m", "pip", "--disable-pip-version-check")


def run(*command, **options):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    if result.returncode != 0:
        raise AssertionError(f"{command}: {result.stdout}{result.stderr}")
    return result.stdout + result.stderr


def flags_that_matter(command):
    """What changes the code that comes out, of a compiler's command line: of every flag the last one."""
    matter = {}
    for word in shlex.split(command):
        if re.match(r"-(O|std=|f(?!diagnostics))", word):
            matter[re.match(r"-(O|std|f[A-Za-z-]+)", word)[0]] = word
    return set(matter.values())


def state_of_the_build():
    """A hash of all that a wheel is made of: the sources, the tools and their options."""
    state = hashlib.sha256()
    for path in sorted(path for name in NEEDED for path in (ROOT / name, *(ROOT / name).rglob("*")) if path.is_file()):
        content = path.read_bytes()
        state.update(f"{path.relative_to(ROOT)} {len(content)}\0".encode() + content)
    versions = [f"{name} {importlib.metadata.version(name)}" for name in ("pip", "setuptools", "wheel", "pybind11")]
    compilers = [run(*shlex.split(os.environ[name]), "--version") for name in ("CC", "CXX")]
    flags = [os.environ.get(name, "") for name in ("CC", "CXX", "CFLAGS", "CXXFLAGS")]
    state.update(repr((sys.version, versions, compilers, flags)).encode())
    return state.hexdigest()[:16]


def build(folder):
    """An sdist, a wheel made of it, and log.txt, what was said meanwhile."""
    clone = folder / "clone"
    clone.mkdir(parents=True)
    for name in NEEDED:
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, clone / name)
    # The hook that pip and build call.
    run(sys.executable, "-c", f"from setuptools import build_meta as b; b.build_sdist({str(folder)!r})", cwd=clone)
    (sdist,) = folder.glob("*.tar.gz")
    # Of the sdist, so that whatever is missing in it is noticed.
    log = run(*PIP, "wheel", "-v", "--no-index", "--no-deps", "--no-build-isolation", "-w", folder, sdist)
    (folder / "log.txt").write_text(log)
    shutil.rmtree(clone)


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = pathlib.Path(cls.temporary.name)
        # Compiling takes a minute, so a wheel of the same state is used again.
        made = BUILD / "tests" / "wheel" / state_of_the_build()
        if not made.is_dir():
            shutil.rmtree(made.parent, ignore_errors=True)
            unfinished = made.with_suffix(".unfinished")
            build(unfinished)
            unfinished.rename(made)
        cls.log = (made / "log.txt").read_text()
        (cls.sdist,) = made.glob("*.tar.gz")
        (cls.wheel,) = made.glob("*.whl")
        run(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", cls.folder / "venv")
        cls.python = cls.folder / "venv" / "bin" / "python"
        run(cls.python, *PIP[1:], "install", "--no-index", cls.wheel)

    def in_environment(self, *words, **more):
        # Debian 13's pyproj, which GeoPandas needs, does not look for PROJ's data beyond the environment.
        known = {"PYTHONPATH": str(ROOT / "tests"), "PROJ_DATA": str(pathlib.Path(sys.base_prefix, "share", "proj"))}
        return run(self.python, "-B", *words, env={**os.environ, **known, **more}, cwd=self.folder)

    def test_the_module_is_the_installed_one_and_passes_its_tests(self):
        where = self.in_environment("-c", "import polylidar_core; print(polylidar_core.__file__)")
        self.assertTrue(where.startswith(str(self.folder / "venv")), where)
        said = self.in_environment("-m", "unittest", "test_python_module")
        self.assertRegex(said, r"Ran [1-9]\d+ tests")

    def test_results_are_those_of_the_module_that_cmake_builds(self):
        program = """
import hashlib, numpy, polylidar_core
print(polylidar_core.__version__)
for seed in range(5):
    points = numpy.random.default_rng(seed).normal(size=(20_000, 2))
    for limits in ({}, {"alpha": 0.05}, {"max_edge_length": 0.1, "threads": 2}):
        shape = polylidar_core.concave_hull(points, **limits)
        print(shape, hashlib.sha256(repr(shape.__geo_interface__).encode()).hexdigest())
"""
        theirs = run(sys.executable, "-B", "-c", program, env={**os.environ, "PYTHONPATH": str(BUILD / "python")})
        self.assertEqual(self.in_environment("-c", program), theirs)
        self.assertEqual(len(theirs.splitlines()), 16)

    def test_the_core_is_compiled_with_the_flags_of_cmake(self):
        sources = (ROOT / "core" / "src").glob("*.cpp")
        commands = {entry["file"]: entry["command"] for entry in json.loads((BUILD / "compile_commands.json").read_text())}
        for source in sources:
            name = f"core/src/{source.name}"
            (ours,) = (line for line in self.log.splitlines() if f"-c {name} -o" in line)
            # Python's own flags stand before ours, and may be more.
            self.assertLessEqual(flags_that_matter(commands[str(source)]), flags_that_matter(ours), name)
        self.assertIn("-ffp-contract=off", flags_that_matter(ours))

    def test_the_wheel_has_the_package_the_licence_and_nothing_else(self):
        with zipfile.ZipFile(self.wheel) as archive:
            names = archive.namelist()
            metadata = archive.read(next(name for name in names if name.endswith("/METADATA"))).decode()
        package = {name.split("/")[1] for name in names if name.startswith("polylidar_core/")}
        kept = {path.name for path in (ROOT / "core/python/polylidar_core").iterdir() if path.is_file()}
        self.assertEqual({name for name in package if not name.endswith(".so")}, kept)
        self.assertEqual(len(package - kept), 1)
        for licence in ("LICENSE", "LICENSE-THIRD-PARTY"):
            self.assertTrue(any(name.endswith(licence) for name in names), names)
        self.assertEqual({name.split("/")[0].split("-")[0] for name in names}, {"polylidar_core"})
        self.assertRegex(metadata, r"(?m)^Requires-Dist: numpy ?\(?>=1.20\)?$")
        self.assertIsNone(re.search(r"(?m)^Requires-Dist: (?!numpy ?\(?>=1.20\)?$)(?!.*extra ==)", metadata))

    def test_the_sdist_has_the_core_and_nothing_of_the_harness(self):
        with tarfile.open(self.sdist) as archive:
            names = {name.partition("/")[2] for name in archive.getnames()}
        for folder in ("core/src", "core/include/polylidar"):
            for path in (ROOT / folder).iterdir():
                self.assertIn(f"{folder}/{path.name}", names)
        tops = {name.split("/")[0] for name in names if name}
        self.assertEqual(tops - {"PKG-INFO", "setup.cfg", "polylidar_core.egg-info"}, set(NEEDED))


if __name__ == "__main__":
    unittest.main()
