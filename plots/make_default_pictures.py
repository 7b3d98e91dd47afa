"""make_default_pictures.py HULLS [--out FILE]: draws the core's default hull beside the former one, for core/AUTOMATIC.md.

HULLS is what `build/fit_default --pictures HULLS` writes: one shape's points under each way to sample, with both hulls.
"""

import argparse
import sys
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
from matplotlib.axes import Axes  # noqa: E402  the backend comes first
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.patches import PathPatch  # noqa: E402
from matplotlib.path import Path as Outline  # noqa: E402

from records import exit_code_of, read_json  # noqa: E402

CASES_IN_A_ROW = 3
SIDE = 1.25  # inches of a picture


def draw(axes: Axes, points: list[list[float]], rings: list[list[list[float]]], title: str) -> None:
    axes.set_aspect("equal")
    axes.set_title(title, fontsize=5.5, pad=2)
    outline = [Outline([*ring, ring[0]], closed=True) for ring in rings]
    if outline:
        shape = Outline.make_compound_path(*outline)
        axes.add_patch(PathPatch(shape, facecolor="#8ecae6", edgecolor="#126782", linewidth=0.4))
    axes.plot([x for x, _ in points], [y for _, y in points], ",", color="#1b3a4b")


def figure_of(cases: list[dict[str, Any]]) -> Figure:
    rows = -(-len(cases) // CASES_IN_A_ROW)
    figure = Figure(figsize=(2 * CASES_IN_A_ROW * SIDE, rows * 1.12 * SIDE), dpi=130)
    grid = list(figure.subplots(rows, 2 * CASES_IN_A_ROW, squeeze=False).flat)
    for axes in grid:
        axes.set_axis_off()
    places = iter(grid)
    for case in cases:
        for which in ("former", "rule"):
            error = 100 * case[f"{which}_l2"]
            name = f"{case['sampling'].replace('~', ', ')}\nformer" if which == "former" else "\nnow"
            draw(next(places), case["points"], case[which], f"{name} {error:.1f} %")
    figure.subplots_adjust(left=0.005, right=0.995, bottom=0.005, top=0.97, wspace=0.04, hspace=0.22)
    return figure


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("hulls", type=Path)
    parser.add_argument("--out", type=Path, default=Path("core/automatic.png"))
    arguments = parser.parse_args()
    made = "; 'build/fit_default --pictures FILE' writes it"

    def work() -> None:
        figure_of(read_json(arguments.hulls, {"type": "array", "items": {"type": "object"}}, made)).savefig(arguments.out)

    return exit_code_of("make_default_pictures.py", work)


if __name__ == "__main__":
    sys.exit(main())
