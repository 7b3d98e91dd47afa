"""make_concept.py HULLBENCH [OUT]: draws the README's picture of what a concave hull is, plots/concept.svg.

The same points three times, with the hull that the program makes of them: with a limit that is too small, with the one
that it chooses, and with one that is too large.
"""
import json
import math
import random
import subprocess
import sys
from pathlib import Path

WIDTH, HEIGHT, GAP = 260, 200, 24
NAMES = ("too small", "chosen from the points", "too large")
LIMITS: tuple[list[str], ...] = (["--max-edge-length", "11"], [], ["--max-edge-length", "62"])


def is_inside(x: float, y: float) -> bool:
    """A horseshoe with a hole: a thick ring, open at its top right, and a bulge at its left."""
    dx, dy = x - 125, y - 100
    radius, angle = math.hypot(dx, dy), math.degrees(math.atan2(dy, dx))
    ring = 42 <= radius <= 88 and not -62 < angle < -14
    bulge = math.hypot(x - 40, y - 150) < 38 and math.hypot(x - 38, y - 152) > 15
    return ring or bulge


def points() -> list[tuple[float, float]]:
    generator = random.Random(7)
    result: list[tuple[float, float]] = []
    while len(result) < 420:
        x, y = generator.uniform(0, WIDTH), generator.uniform(0, HEIGHT)
        if is_inside(x, y):
            result.append((round(x, 1), round(y, 1)))
    return result


def hull(program: str, cloud: list[tuple[float, float]], limit: list[str]) -> str:
    text = "".join(f"{x},{y}\n" for x, y in cloud)
    done = subprocess.run([program, "hull", "-", *limit], input=text, capture_output=True, text=True, check=True)
    polygons = json.loads(done.stdout)["geometry"]["coordinates"]
    return " ".join("M" + " ".join(f"{x:g},{y:g}" for x, y in ring[:-1]) + "Z" for polygon in polygons for ring in polygon)


def main(program: str, picture: Path = Path(__file__).parent / "concept.svg") -> None:
    cloud = points()
    dots = "".join(f'<circle cx="{x:g}" cy="{y:g}" r="1.3"/>' for x, y in cloud)
    width = 3 * WIDTH + 2 * GAP
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {HEIGHT + 26}" width="{width}" font-family="sans-serif" font-size="14">',
        f'<rect width="{width}" height="{HEIGHT + 26}" fill="#ffffff"/>',
        f'<defs><g id="dots" fill="#1b3a4b">{dots}</g></defs>',
    ]
    for index, (name, limit) in enumerate(zip(NAMES, LIMITS)):
        out.append(
            f'<g transform="translate({index * (WIDTH + GAP)} 0)"><path d="{hull(program, cloud, limit)}" fill="#8ecae6" '
            f'fill-rule="evenodd" stroke="#126782" stroke-width="1.2"/><use href="#dots"/>'
            f'<text x="{WIDTH / 2}" y="{HEIGHT + 20}" text-anchor="middle" fill="#333333">{name}</text></g>'
        )
    picture.write_text("\n".join([*out, "</svg>"]) + "\n")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    try:
        main(sys.argv[1], *map(Path, sys.argv[2:]))
    except OSError as error:
        sys.exit(f"error: {error}")
    except subprocess.CalledProcessError as error:
        sys.exit(f"error: {error.stderr.strip()}")
