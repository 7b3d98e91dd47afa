// Makes the outlines of California and Hawaii in datasets/shapes and their part of the manifest there, from the
// cartographic boundaries of the US Census Bureau as the npm package us-atlas carries them.
//
//   cd datasets && npm ci && node make_states.mjs [OUTPUT_FOLDER]
//
// The files are committed: this script is run only to change them. Running it again gives the same bytes. It
// stops with an error, and writes nothing, when an outline is not a valid multipolygon. In the manifest it
// rewrites the set "states" and its shapes, and keeps the rest.

import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { check, fit, twiceArea } from "./outline.mjs";

/// `state`: the FIPS code. `holes`: the circles that the variant with holes gets.
const shapes = [
  {
    name: "ca",
    title: "California",
    state: "06",
    holes: { count: 10, radius: 5, seed: 1 },
    paper: { area: 14697.6, area_with_holes: 13913.5, polygons: 1 },
  },
  {
    name: "hi",
    title: "Hawaii",
    state: "15",
    holes: { count: 10, radius: 2, seed: 1 },
    paper: { area: 1862.2, area_with_holes: 1736.7, polygons: 9 },
  },
];
/// What the manifest calls these outlines.
const set = "states";
/// The larger side of every bounding box, in length units.
const size = 200;
const decimals = 6;
const unitsPerLength = 10 ** decimals;

const require = createRequire(import.meta.url);
const { feature } = load("topojson-client");
const topology = load("us-atlas/states-10m.json");
const sourcePackage = load("us-atlas/package.json");

function load(module) {
  try {
    return require(module);
  } catch (error) {
    if (error.code === "MODULE_NOT_FOUND") {
      fail(`'${module}' is not installed: run 'npm ci' in datasets first`);
    }
    throw error;
  }
}

function fail(message) {
  console.error(`make_states: ${message}`);
  process.exit(1);
}

/// The state's polygons as open rings of [longitude, latitude]; all islands.
function stateOutline({ state, title }) {
  const geometry = topology.objects.states.geometries.find(({ id }) => id === state);
  if (!geometry) fail(`us-atlas has no state ${state} (${title})`);
  const { type, coordinates } = feature(topology, geometry).geometry;
  const polygons = type === "MultiPolygon" ? coordinates : [coordinates];
  if (polygons.some((rings) => rings.length !== 1)) {
    fail(`the outline of ${title} has a hole, which is not expected`);
  }
  return polygons.map(([ring]) => ring.slice(0, -1));
}

function validOutline(shape) {
  const degrees = stateOutline(shape);
  try {
    const outline = fit(degrees, size, unitsPerLength);
    check(outline);
    return outline;
  } catch (error) {
    return fail(`the outline of ${shape.title} is not valid: ${error.message}`);
  }
}

/// One vertex a line: a change in an outline then shows in a diff.
function geojson({ name, title }, outline) {
  const vertex = (v) => `[${v.map((value) => value / unitsPerLength).join(", ")}]`;
  const polygon = (ring) => `[[\n${[...ring, ring[0]].map(vertex).join(",\n")}\n]]`;
  return `{"type": "Feature", "properties": ${JSON.stringify({ name, title })},
"geometry": {"type": "MultiPolygon", "coordinates": [
${outline.map(polygon).join(",\n")}
]}}
`;
}

function boundingBox(outline) {
  const range = (axis) => outline.flat().map((vertex) => vertex[axis] / unitsPerLength);
  return [Math.min(...range(0)), Math.min(...range(1)), Math.max(...range(0)), Math.max(...range(1))];
}

function describe(shape, outline, text) {
  const area = Number(outline.reduce((sum, ring) => sum + twiceArea(ring), 0n)) / 2 / unitsPerLength ** 2;
  return {
    name: shape.name,
    title: shape.title,
    set,
    file: `${shape.name}.geojson`,
    sha256: createHash("sha256").update(text).digest("hex"),
    source: "US Census Bureau, cartographic boundary files, states, edition of 2017, " + "simplified and quantised by us-atlas",
    source_package: {
      name: sourcePackage.name,
      version: sourcePackage.version,
      licence: sourcePackage.license,
      file: "states-10m.json",
    },
    licence: "Public domain (US government work, 17 U.S.C. 105)",
    polygons: outline.length,
    vertices: outline.flat().length,
    area: Number(area.toFixed(decimals)),
    bounding_box: boundingBox(outline),
    holes: shape.holes,
    paper: {
      ...shape.paper,
      note: "The paper used another outline of the same state, so its figures are for comparison only.",
    },
  };
}

function describeSet() {
  return {
    name: set,
    made_by: "datasets/make_states.mjs",
    how_made:
      "Spherical Mercator projection, y up; moved so that the smallest x and y are 0; scaled so " +
      `that the larger side of the bounding box is ${size}; all islands kept; coordinates rounded to ` +
      `${decimals} decimals; shells counter-clockwise.`,
    licences:
      "The outlines are in the public domain and may be used for anything: they come from data of the " +
      "US Census Bureau. The npm package that carries the data (us-atlas, copyright 2013-2019 Michael " +
      "Bostock) is under the ISC licence, which allows the same.",
  };
}

/// `own` in the place of the elements that are; at the end when there are none.
function replaced(elements, isOwn, own) {
  const first = elements.findIndex(isOwn);
  const others = (part) => part.filter((element) => !isOwn(element));
  if (first < 0) return [...elements, ...own];
  return [...elements.slice(0, first), ...own, ...others(elements.slice(first))];
}

/// The manifest at `path`, if there is one, with this script's set and its shapes in their places.
function manifest(path, entries) {
  const before = existsSync(path) ? JSON.parse(readFileSync(path, "utf8")) : {};
  return {
    ...before,
    sets: replaced(before.sets ?? [], ({ name }) => name === set, [describeSet()]),
    shapes: replaced(before.shapes ?? [], (shape) => shape.set === set, entries),
  };
}

const folder = process.argv[2] ?? fileURLToPath(new URL("shapes", import.meta.url));
const made = shapes.map((shape) => {
  const outline = validOutline(shape);
  const text = geojson(shape, outline);
  return { text, entry: describe(shape, outline, text) };
});
mkdirSync(folder, { recursive: true });
made.forEach(({ text, entry }) => writeFileSync(join(folder, entry.file), text));
const manifestPath = join(folder, "manifest.json");
const summary = manifest(
  manifestPath,
  made.map(({ entry }) => entry),
);
writeFileSync(manifestPath, `${JSON.stringify(summary, null, 2)}\n`);
made.forEach(({ entry }) =>
  console.log(`${entry.file}: ${entry.polygons} polygons, ${entry.vertices} vertices, area ${entry.area}`),
);
