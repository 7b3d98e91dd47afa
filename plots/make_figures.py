"""Draws a run's figures: make_figures.py [RUN] [--out FOLDER] [--only NAME].

Each figure becomes SVG, PDF and PNG (200 dpi); figures.md lists them with their captions. Says one line a figure, also
for those that are skipped because the run has not their data.

Exit codes: 0 drawn; 1 a fault of ours, with its traceback; 2 usage, or a record is missing or malformed; 6 the run has the
data of none.
"""

import importlib
import re
import sys
from pathlib import Path

import matplotlib

from records import NothingToShow, exit_code_of, load, options_of_run
from run import Drawn, Run, Skipped, read_paper
from style import RC

# In the order of figures.md.
NAMES = (
    "summary",
    "ratings",
    "solved",
    "states",
    "shapes",
    "hulls",
    "real",
    "alphabet",
    "random_polygons",
    "steps",
    "core",
    "rgbd",
    "examples",
    "profiles",
    "sensitivity",
    "choosing",
)
# Without dates and versions, so that the same run gives the same bytes.
_METADATA = {
    "svg": {"Date": None, "Creator": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
    "png": {"Software": None},
}


def main(arguments: list[str] | None = None) -> int:
    parser = options_of_run("make_figures.py", "Draws a run's figures.", "figures")
    parser.add_argument("--only", choices=NAMES, metavar="NAME", help=f"only this one: {', '.join(NAMES)}")
    options = parser.parse_args(arguments)
    return exit_code_of("make_figures.py", lambda: write(options.run, options.out or options.run / "figures", options.only))


def write(folder: Path, place: Path, only: str | None) -> None:
    """Draws the figures, all or one, and the list of all. Raises NothingToShow when there is none."""
    run = Run(folder, load(folder), read_paper())
    drawn, skipped = draw_all(run, [only] if only else list(NAMES), place)
    if not drawn:
        raise NothingToShow(f"{folder} has the data of no figure that was asked for.")
    if not only:
        (place / "figures.md").write_text(index(drawn, skipped), encoding="utf-8")


def draw_all(run: Run, names: list[str], out: Path) -> tuple[list[Drawn], dict[str, str]]:
    """Draws and saves the figures of these names; what was drawn, and by name why another one was not."""
    drawn: list[Drawn] = []
    skipped: dict[str, str] = {}
    out.mkdir(parents=True, exist_ok=True)
    for name in names:
        module = importlib.import_module(f"figures.{name}")
        with matplotlib.rc_context(RC):
            try:
                for one in module.draw(run):
                    save(one, out)
                    drawn.append(one)
                    print(f"{one.name}: {out / one.name}.svg, .pdf, .png")
            except Skipped as reason:
                skipped[name] = str(reason)
                print(f"{name}: skipped, {reason}")
    return drawn, skipped


def save(one: Drawn, out: Path) -> None:
    one.figure.draw_without_rendering()
    # Laid out once, as it is most of the time. "none" would leave a placeholder, for which every file is drawn twice.
    one.figure.set_layout_engine(None)
    for kind, metadata in _METADATA.items():
        path = out / f"{one.name}.{kind}"
        one.figure.savefig(path, metadata=metadata)
        if kind == "svg":
            path.write_text(renumbered(path.read_text(encoding="utf-8")), encoding="utf-8")


def renumbered(svg: str) -> str:
    """With the names of clip paths counted: matplotlib makes them of addresses in memory, which differ every time."""
    numbers: dict[str, str] = {}
    name = r'(?<=id=")p[0-9a-f]{10}(?=")|(?<=url\(#)p[0-9a-f]{10}(?=\))'
    return re.sub(name, lambda found: numbers.setdefault(found.group(), f"clip{len(numbers)}"), svg)


def index(drawn: list[Drawn], skipped: dict[str, str]) -> str:
    """The text of figures.md."""
    parts = ["# Figures\n"]
    for one in drawn:
        files = ", ".join(f"[{kind.upper()}]({one.name}.{kind})" for kind in _METADATA)
        parts.append(f"## {one.name}\n\n![{one.name}]({one.name}.png)\n\n{one.caption}\n\n{files}\n")
    if skipped:
        lines = "\n".join(f"- {name}: {reason}" for name, reason in skipped.items())
        parts.append(f"## Not drawn\n\n{lines}\n")
    return "\n".join(parts)


if __name__ == "__main__":
    sys.exit(main())
