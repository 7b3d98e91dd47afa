"""The package's type hints, by mypy: the package and what a program may do pass, and each misuse is an error.

Run by ctest, with the package in PYTHONPATH.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAMS = pathlib.Path(__file__).resolve().parent / "python_types"


CACHE = tempfile.TemporaryDirectory()  # what one run of mypy learnt of NumPy serves the next


def tearDownModule():
    CACHE.cleanup()


def lines_with_errors(*what):
    """Their numbers, and all that mypy says."""
    result = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--config-file", os.devnull, "--cache-dir", CACHE.name, *what],
        env={**os.environ, "MYPYPATH": os.environ["PYTHONPATH"]},
        capture_output=True,
        text=True,
        check=False,
    )
    found = re.findall(r"^[^:\n]+:(\d+): error: ", result.stdout, re.MULTILINE)
    if result.returncode != (1 if found else 0):
        raise AssertionError(result.stdout + result.stderr)
    return sorted({int(line) for line in found}), result.stdout


class Types(unittest.TestCase):
    def test_the_package_itself_passes(self):
        # Shapely and GeoPandas come without types.
        lines, said = lines_with_errors("--ignore-missing-imports", "--package", "polylidar_core")
        self.assertEqual(lines, [], said)

    def test_a_right_program_passes(self):
        lines, said = lines_with_errors("--follow-imports=silent", PROGRAMS / "use.py")
        self.assertEqual(lines, [], said)

    def test_each_misuse_is_an_error(self):
        text = (PROGRAMS / "misuse.py").read_text(encoding="utf-8").splitlines()
        wrong = [number for number, line in enumerate(text, 1) if "# wrong:" in line]
        self.assertGreater(len(wrong), 5)
        lines, said = lines_with_errors("--follow-imports=silent", PROGRAMS / "misuse.py")
        self.assertEqual(lines, wrong, said)


if __name__ == "__main__":
    unittest.main()
