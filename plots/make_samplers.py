#!/usr/bin/python3
"""make_samplers.py [--hullbench PROGRAM] [--out FILE]: draws California as every sampler gives it, as datasets/samplers.png.

A panel a kind: the outline and 4000 points, as `hullbench points` writes them. It needs Debian's python3-numpy and
python3-matplotlib, and build/hullbench.

Exit codes: 0 drawn; 2 the program is not there or refuses a data set.
"""
import argparse
import io
import json
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  the backend comes first
import numpy as np  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
COUNT = 4000
SAMPLERS = (
    "",
    "poisson:0.7",
    "lattice:0.25",
    "gradient:64",
    "hotspot:64",
    "clusters:16",
    "cascade:3",
    "depthcamera:4",
    "airborne:4",
    "zigzag:4",
    "airborne:4~water:20",
    "rotating:4",
    "tracks:20",
    "quantised:1",
    "outline:3",
    "transcripts:3",
    "boundary:30",
    "gradient:16~outliers:3~noise:0.5",
)


def points_of(program: Path, sampler: str) -> np.ndarray:
    name = "ca~" + sampler if sampler else "ca"
    command = [str(program), "points", name, "--n", str(COUNT), "--format", "npy"]
    result = subprocess.run(command, capture_output=True, check=True)
    return np.load(io.BytesIO(result.stdout))


def draw(program: Path, out: Path) -> None:
    outline = json.loads((ROOT / "datasets" / "shapes" / "ca.geojson").read_text())
    rings = [polygon[0] for polygon in outline["geometry"]["coordinates"]]
    figure, panels = plt.subplots(3, 6, figsize=(16, 9.6), constrained_layout=True)
    for sampler, panel in zip(SAMPLERS, panels.flat):
        points = points_of(program, sampler)
        for ring in rings:
            panel.plot(*np.array(ring).T, color="#c0392b", linewidth=0.5)
        panel.scatter(points[:, 0], points[:, 1], s=0.5, color="black", linewidths=0)
        panel.set_title("~" + sampler if sampler else "uniform", fontsize=8)
        panel.set_aspect("equal")
        panel.axis("off")
    figure.savefig(out, dpi=100, metadata={"Software": None}, pil_kwargs={"optimize": True})


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--hullbench", type=Path, default=ROOT / "build" / "hullbench")
    parser.add_argument("--out", type=Path, default=ROOT / "datasets" / "samplers.png")
    arguments = parser.parse_args()
    try:
        draw(arguments.hullbench, arguments.out)
    except FileNotFoundError as error:
        print(f"error: there is no {error.filename}; 'make build' makes the program.", file=sys.stderr)
        return 2
    except subprocess.CalledProcessError as error:
        print(f"error: {error.stderr.decode(errors='replace').strip()}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
