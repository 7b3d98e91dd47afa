"""What pyproject.toml cannot say: the extension. The version, the sources and the flags are read from CMake's files."""
import pathlib
import re

from pybind11.setup_helpers import ParallelCompile, Pybind11Extension
from setuptools import setup


def words(pattern, file):
    """What the pattern's group is in the file's lines without comments; at least once."""
    text = re.sub(r"(?m)#.*$", "", pathlib.Path(file).read_text(encoding="utf-8"))
    found = re.findall(pattern, text)
    if not found:
        raise SystemExit(f"error: {file} has nothing like {pattern}")
    return found


(version,) = words(r"project\(hullbench VERSION ([0-9.]+)", "CMakeLists.txt")
sources = ["core/" + source for source in words(r"\s(src/\w+\.cpp)", "core/CMakeLists.txt")]
flags = words(r"\s(-f[\w=-]+)", "cmake/HullbenchTargets.cmake")

extension = Pybind11Extension(
    "polylidar_core._core",
    ["core/python/module.cpp", *sources],
    include_dirs=["core/include"],
    define_macros=[("POLYLIDAR_VERSION", f'"{version}"')],
    cxx_std=20,
    extra_compile_args=["-O3", "-DNDEBUG", "-pthread", "-fvisibility-inlines-hidden", *flags],
    extra_link_args=["-pthread"],
)

# POLYLIDAR_JOBS=N compiles with N processes, instead of one a core.
with ParallelCompile("POLYLIDAR_JOBS"):
    setup(
        version=version,
        ext_modules=[extension],
        # Not build/, which is CMake's; and all anew, as setuptools looks at no header, flag or version.
        options={"build": {"build_base": "build-python", "force": True}},
    )
