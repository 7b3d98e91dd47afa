// Pictures for the invented run of tests/invented_run.cpp, in the format of pictures.jsonl.
//
// California has its outline and results that are made up from it. Hawaii is a square, and every result the same square
// moved to the right by an eighth, so that it is known which pixels are missing and which are too many. With 64,000 points it
// has no truth.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const GRID = 65535;

/** Where the made-up square is, and where its results are, in steps of the grid. */
export const SQUARE = { low: 12288, high: 53248, moved: 5120 };

/** Numbers from 0 up to 1, the same in every run: a Weyl sequence. */
function weyl(seed) {
  let state = seed;
  return () => (state = (state + 0.6180339887498949) % 1);
}

function california() {
  const file = new URL("../../datasets/shapes/ca.geojson", import.meta.url);
  const { coordinates } = JSON.parse(readFileSync(file)).geometry;
  const polygons = coordinates.map((polygon) => polygon.map((ring) => ring.slice(0, -1)));
  const all = polygons.flat(2);
  const low = [0, 1].map((axis) => Math.min(...all.map((vertex) => vertex[axis])));
  const side = Math.max(...[0, 1].map((axis) => Math.max(...all.map((vertex) => vertex[axis])) - low[axis]));
  const snap = (ring) => ring.flatMap(([x, y]) => [x - low[0], y - low[1]].map((value) => Math.round((value / side) * GRID)));
  return polygons.map((polygon) => polygon.map(snap));
}

function square(shift) {
  const { low, high } = SQUARE;
  return [[[low + shift, low, high + shift, low, high + shift, high, low + shift, high]]];
}

/** A hole about the middle of California's largest polygon. */
function with_hole(polygons) {
  const largest = polygons.reduce((a, b) => (b[0].length > a[0].length ? b : a));
  const hole = Array.from({ length: 24 }, (_, k) => [
    Math.round(26000 + 5000 * Math.cos((-2 * Math.PI * k) / 24)),
    Math.round(36000 + 5000 * Math.sin((-2 * Math.PI * k) / 24)),
  ]).flat();
  return polygons.map((polygon) => (polygon === largest ? [...polygon, hole] : polygon));
}

/** Every vertex moved by up to `size` steps. */
function shaken(polygons, size, seed) {
  const random = weyl(seed);
  return polygons.map((polygon) => polygon.map((ring) => ring.map((value) => Math.round(value + size * (2 * random() - 1)))));
}

/** Even-odd test. */
function inside(polygons, x, y) {
  const crossings = (ring) => {
    let odd = false;
    for (let k = 0, j = ring.length - 2; k < ring.length; j = k, k += 2) {
      if (
        ring[k + 1] > y !== ring[j + 1] > y &&
        x < ring[k] + ((y - ring[k + 1]) * (ring[j] - ring[k])) / (ring[j + 1] - ring[k + 1])
      )
        odd = !odd;
    }
    return odd;
  };
  return polygons.some((polygon) => polygon.filter(crossings).length % 2 === 1);
}

function points_in(polygons, count) {
  const points = [];
  for (let k = 0; points.length < 2 * count; ++k) {
    const [x, y] = [0.7548776662466927, 0.5698402909980532].map((step) => Math.round(((k * step) % 1) * GRID));
    if (inside(polygons, x, y)) points.push(x, y);
  }
  return points;
}

function lines_of(report) {
  const cases = new Map();
  for (const run of report.runs) {
    const name = run.name.split("/").slice(1, -1).join("/");
    if (!cases.has(name)) cases.set(name, []);
    cases.get(name).push(run);
  }
  return [...cases].flatMap(([name, runs]) => {
    const hawaii = runs[0].dataset === "hi";
    const outline = california();
    const truth = hawaii ? square(0) : runs[0].holes ? with_hole(outline) : outline;
    const result = (run) =>
      hawaii ? square(SQUARE.moved) : shaken(truth, 9000 * (run.metrics.l2 ?? 0.05), run.method.length / 20);
    return [
      {
        kind: "case",
        case: name,
        dataset_sha256: runs[0].dataset_sha256,
        origin: [0, 0],
        step: 0.01,
        points_total: runs[0].n,
        points: points_in(truth, Math.min(runs[0].n, 4000)),
        ground_truth: hawaii && runs[0].n === 64000 ? [] : truth,
      },
      ...runs
        .filter((run) => run.output_sha256)
        .map((run) => ({
          kind: "result",
          case: name,
          run: run.name,
          id: run.id,
          output_sha256: run.output_sha256,
          l2: run.metrics.l2 ?? null,
          polygons: result(run),
        })),
    ];
  });
}

/** Writes pictures.jsonl into the folder of an invented run. */
export function write_invented_pictures(folder) {
  const report = JSON.parse(readFileSync(join(folder, "report.json")));
  writeFileSync(
    join(folder, "pictures.jsonl"),
    lines_of(report)
      .map((line) => `${JSON.stringify(line)}\n`)
      .join(""),
  );
}
