// How long the package takes, and concaveman and delaunator as multiples of it: medians over interleaved rounds, on one thread.
//
//   bench.mjs PACKAGE [--write README]   prints the table, or puts it between the marks of that file
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { loadavg } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const ROUNDS = 11;
const LEAST_POINTS = 100_000; // in a round
const SIZES = [1_000, 10_000, 100_000, 1_000_000];
const MARKS = ["<!-- bench -->\n", "<!-- /bench -->\n"];

const rivals = createRequire(new URL("../../adapters/manifests/package.json", import.meta.url));
const from_file = (path) => import(pathToFileURL(path));
const installed = async (name) => (await from_file(rivals.resolve(name))).default;
const version = (name) => JSON.parse(readFileSync(join(rivals.resolve.paths("")[0], name, "package.json"))).version;

/** Points in the unit square, with a round hole of a fifth of its area. */
function square_with_a_hole(count) {
  let state = 1;
  const next = () => (state = (state * 48271) % 2147483647) / 2147483647;
  const xy = new Float64Array(2 * count);
  for (let i = 0; i < count;) {
    const [x, y] = [next(), next()];
    if ((x - 0.5) ** 2 + (y - 0.5) ** 2 < 0.2 / Math.PI) continue;
    xy[2 * i] = x;
    xy[2 * i++ + 1] = y;
  }
  return { xy, pairs: Array.from({ length: count }, (_, i) => [xy[2 * i], xy[2 * i + 1]]) };
}

async function methods(folder) {
  const polylidar = await from_file(join(resolve(folder), "polylidar.js"));
  const [concaveman, Delaunator] = [await installed("concaveman"), await installed("delaunator")];
  return {
    "`concaveHull`": ({ xy }) => polylidar.concaveHull(xy).coordinates,
    "`concaveHull`, `maxEdgeLength`": ({ xy }) =>
      polylidar.concaveHull(xy, { maxEdgeLength: 4 / Math.sqrt(xy.length / 2) }).coordinates,
    "`concaveman` of this package": ({ pairs }) => polylidar.concaveman(pairs),
    [`concaveman ${version("concaveman")}`]: ({ pairs }) => concaveman(pairs),
    [`delaunator ${version("delaunator")}, triangles only`]: (points) => {
      points.delaunator ??= new Delaunator(points.xy); // its memory is kept, as that of `concaveHull`
      points.delaunator.update();
    },
  };
}

function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  return (sorted[(sorted.length - 1) >> 1] + sorted[sorted.length >> 1]) / 2;
}

/**
 * Each method's median time in nanoseconds. Before the rounds that count there is one in which code is compiled. A round calls
 * a method as often as makes 100,000 points.
 */
function measure(runs, points) {
  const calls = Math.ceil(LEAST_POINTS / points.pairs.length);
  const times = runs.map(() => []);
  for (let round = -1; round < ROUNDS; round++) {
    for (let k = 0; k < runs.length; k++) {
      const method = (k + round + 1) % runs.length;
      const begin = process.hrtime.bigint();
      for (let call = 0; call < calls; call++) runs[method](points);
      const end = process.hrtime.bigint();
      if (round >= 0) times[method].push(Number(end - begin) / calls);
    }
  }
  return times.map(median);
}

function row(runs, count) {
  const medians = measure(runs, square_with_a_hole(count));
  const ms = medians[0] / 1e6;
  return [
    count.toLocaleString("en"),
    Number(ms.toPrecision(3)),
    ...medians.slice(1).map((time) => (time / medians[0]).toPrecision(2)),
  ];
}

async function table(folder) {
  const named = await methods(folder);
  const before = loadavg()[0];
  const rows = SIZES.map((count) => row(Object.values(named), count));
  const load = Math.max(before, loadavg()[0]);
  const [first, ...others] = Object.keys(named);
  const titles = ["points", `${first}, ms`, ...others.map((name) => `${name}, ×`)];
  const lines = [titles, titles.map(() => "---:"), ...rows];
  return (
    lines.map((cells) => `| ${cells.join(" | ")} |\n`).join("") +
    `\nms: the median time. ×: a median as a multiple of it. Both are over ${ROUNDS} interleaved rounds in Node ` +
    `${process.versions.node}, after one that is not counted. Points are uniform in a square with a round hole. ` +
    `The load average was ${load.toFixed(1)}; this program alone makes it 1.\n`
  );
}

const [folder, write, readme] = process.argv.slice(2);
if (!folder || (write && (write !== "--write" || !readme))) {
  console.error("usage: bench.mjs PACKAGE [--write README]");
  process.exit(2);
}
const text = await table(folder);
if (readme) {
  const [begin, end] = MARKS;
  const whole = readFileSync(readme, "utf8");
  const [before, after] = [whole.indexOf(begin) + begin.length, whole.indexOf(end)];
  if (before < begin.length || after < before) throw new Error(`${readme} has no marks ${MARKS.join(" ")}`);
  writeFileSync(readme, whole.slice(0, before) + "\n" + text + "\n" + whole.slice(after));
}
console.log(text);
