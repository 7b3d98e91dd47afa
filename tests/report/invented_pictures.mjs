// Pictures for the invented run of tests/invented_run.cpp, in the format of pictures.jsonl.
//
// Every ground truth is the same square, with holes one with a square hole, and every result the truth moved to the right: on
// Hawaii by an eighth, so that it is known which pixels are missing and which are too many, on California by more for a larger
// error. Hawaii with 64,000 points has no truth.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

/** Where the square is, and how far its results on Hawaii are moved, in steps of the grid. */
export const SQUARE = { low: 12288, high: 53248, moved: 5120 };

const HOLE = [26000, 26000, 26000, 40000, 40000, 40000, 40000, 26000];

function square(has_hole, moved = 0) {
  const { low, high } = SQUARE;
  const shell = [low, low, high, low, high, high, low, high];
  const rings = has_hole ? [shell, HOLE] : [shell];
  return [rings.map((ring) => ring.map((value, k) => (k % 2 ? value : value + moved)))];
}

/** Evenly over the square and its hole. */
function points(count) {
  const place = (k, step) => Math.round(SQUARE.low + ((k * step) % 1) * (SQUARE.high - SQUARE.low));
  return Array.from({ length: count }, (_, k) => [place(k, 0.7548776662466927), place(k, 0.5698402909980532)]).flat();
}

function lines_of(report) {
  const cases = new Map();
  for (const run of report.runs) {
    const name = run.name.split("/").slice(1, -1).join("/");
    if (!cases.has(name)) cases.set(name, []);
    cases.get(name).push(run);
  }
  return [...cases].flatMap(([name, runs]) => {
    const { dataset, dataset_sha256, n, holes } = runs[0];
    const hawaii = dataset === "hi";
    const moved = (run) => (hawaii ? SQUARE.moved : Math.round(30000 * run.metrics.l2));
    return [
      {
        kind: "case",
        case: name,
        dataset_sha256,
        origin: [0, 0],
        step: 0.01,
        points_total: n,
        points: points(Math.min(n, 4000)),
        ground_truth: hawaii && n === 64000 ? [] : square(holes),
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
          polygons: square(holes, moved(run)),
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
