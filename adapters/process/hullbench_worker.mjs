// The worker's side of hullbench's protocol (PROTOCOL.md) for methods in JavaScript (Node 18 or newer).
//
//   import { serve } from "./hullbench_worker.mjs";
//   serve({
//     version: "1.0",
//     run: (points, { concavity }) => ...,   // points: [[x, y], ...], finite; parameters by name, complete
//   });
//
// `run` returns polygons: [[shell, hole, ...], ...], each ring [[x, y], ...] in either direction, closed or not, or a
// promise of them. A method whose library has types of its own gives two more functions: `load(points)` makes the
// library's type of the points, off the headline time, and `run` gets what it returns; `extract(result)` makes polygons
// of what `run` returned and is timed as "extract". Throw `Unsupported` for what the method cannot do (too few points,
// say).
//
// Start node with --expose-gc (in the manifest's `command`): then garbage is collected before the clock starts.

import { readFileSync, writeFileSync, writeSync } from "node:fs";
import { createInterface } from "node:readline";

export const PROTOCOL = 1;

/** The method cannot do what was asked; it is not broken. */
export class Unsupported extends Error {}

/** The version in the package.json of an installed package. `file`: the method's import.meta.url. */
export function version_of(name, file) {
  return JSON.parse(readFileSync(new URL(`./node_modules/${name}/package.json`, file))).version;
}

/** Whether some three of the points are not on one line, so that a hull with an area exists. */
export function spans_area(points) {
  const [[x, y]] = points.length > 0 ? points : [[0, 0]];
  const second = points.find(([a, b]) => a !== x || b !== y);
  return second !== undefined && points.some(([a, b]) => (second[0] - x) * (b - y) !== (second[1] - y) * (a - x));
}

// What is printed must not get into the protocol: standard output goes to standard error.
process.stdout.write = process.stderr.write.bind(process.stderr);

function reply(message) {
  const bytes = Buffer.from(JSON.stringify(message) + "\n");
  for (let sent = 0; sent < bytes.length; ) sent += writeSync(1, bytes, sent);
}

function fail(kind, message) {
  reply({ error: { kind, message: String(message).replace(/\s+/g, " ").slice(0, 1000) || kind } });
}

async function timed(action) {
  const begin = process.hrtime.bigint();
  let result = action();
  if (result instanceof Promise) result = await result;
  return [result, Number(process.hrtime.bigint() - begin)];
}

function read_points({ points: file, n }) {
  const bytes = readFileSync(file);
  if (bytes.length !== 16 * n) throw new RangeError(`${file} does not hold ${n} points`);
  const points = new Array(n);
  for (let i = 0; i < n; ++i) {
    const point = [bytes.readDoubleLE(16 * i), bytes.readDoubleLE(16 * i + 8)];
    if (!point.every(Number.isFinite)) throw new RangeError(`point ${i} is not finite`);
    points[i] = point;
  }
  return points;
}

function closed(ring) {
  const [first, last] = [ring[0], ring.at(-1)];
  return ring.length === 0 || (first[0] === last[0] && first[1] === last[1]) ? ring : [...ring, first];
}

/** A little-endian WKB MultiPolygon of [[shell, hole, ...], ...]. */
export function polygons_to_wkb(polygons) {
  const rings = polygons.map((polygon) => polygon.map(closed));
  const size = rings.flat().reduce((sum, ring) => sum + 4 + 16 * ring.length, 9 + 9 * rings.length);
  const bytes = Buffer.alloc(size);
  let at = 0;
  const header = (type, count) => {
    at = bytes.writeUInt8(1, at);
    at = bytes.writeUInt32LE(type, at);
    at = bytes.writeUInt32LE(count, at);
  };
  header(6, rings.length);
  for (const polygon of rings) {
    header(3, polygon.length);
    for (const ring of polygon) {
      at = bytes.writeUInt32LE(ring.length, at);
      for (const [x, y] of ring) at = bytes.writeDoubleLE(y, bytes.writeDoubleLE(x, at));
    }
  }
  return bytes;
}

/**
 * Collects what earlier runs left, so that no run pays for another one's garbage; called off the clock. What a run leaves
 * and V8 collects meanwhile is its own time. Only young objects are collected, which takes 0.2 ms, so every run can have
 * it. A whole collection also throws compiled code away: with Node 20 Delaunator then took ten times as long for 2,000
 * points, and concaveman twice as long for 32,000.
 */
function collect_garbage() {
  globalThis.gc?.({ type: "minor" });
}

class Worker {
  constructor({ version, run, load = (points) => points, extract = (result) => result }) {
    Object.assign(this, { version, run_method: run, load_points: load, extract });
  }

  hello() {
    return { protocol: PROTOCOL, version: String(this.version) };
  }

  async load(request) {
    const points = read_points(request);
    const [loaded, nanoseconds] = await timed(() => this.load_points(points));
    this.loaded = loaded;
    return { phases_ns: { load: nanoseconds } };
  }

  async run({ nonce, parameters, result: file }) {
    // JSON has no infinity: a parameter without a limit is null.
    const complete = Object.fromEntries(Object.entries(parameters).map(([key, value]) => [key, value ?? Infinity]));
    collect_garbage();
    const [result, run] = await timed(() => this.run_method(this.loaded, complete));
    const [polygons, extract] = await timed(() => this.extract(result));
    writeFileSync(file, polygons_to_wkb(polygons));
    return { nonce, phases_ns: { run, extract } };
  }
}

/** Answers the harness until it says that it is done. `version`: of the library that runs. */
export async function serve(method) {
  const worker = new Worker(method);
  for await (const line of createInterface({ input: process.stdin })) {
    const request = JSON.parse(line);
    if (request.request === "quit") process.exit(0);
    try {
      reply(await worker[request.request](request));
    } catch (error) {
      if (error instanceof Unsupported) fail("unsupported", error.message);
      else if (error instanceof RangeError && /memory|array length|allocation failed/i.test(error.message)) fail("memory", error.message);
      else if (/call stack|maximum size/i.test(error?.message)) fail("error", error.message);
      else fail(error instanceof RangeError ? "invalid_argument" : "error", error?.message ?? error);
    }
  }
}
