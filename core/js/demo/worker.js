// What takes time, beside the page: files are read, hulls are made. For every message there is one answer.
import { concaveHull } from "../src/polylidar.js";
import concaveman from "concaveman";
import { example } from "./examples.js";
import { equal_area } from "./plane.js";
import { FileError, read_points } from "./readers.js";

let points = new Float64Array(); // as read
let plane = points; // where hulls are made
let is_projected = false;
let newest = 0; // of the files and examples: a file that takes longer than the next one is dropped

const work = {
  async read({ file }) {
    const number = ++newest;
    const found = await read_points(new Uint8Array(await file.arrayBuffer()));
    return number === newest ? opened(found) : null;
  },

  async example({ count }) {
    ++newest;
    return opened({ xy: example(count), format: "an example", lonlat: false });
  },

  async hull({ detail, lonlat }) {
    project(lonlat);
    const begin = performance.now();
    const { vertices, ringEnds, polygonEnds, chosenSizes, area } = concaveHull(plane, { detail });
    return { vertices, ringEnds, polygonEnds, chosenSizes, area, milliseconds: performance.now() - begin };
  },

  async concaveman({ xy, lonlat }) {
    points = xy;
    is_projected = !lonlat;
    project(lonlat);
    const numbered = Array.from({ length: plane.length / 2 }, (_, i) => [plane[2 * i], plane[2 * i + 1], i]);
    const begin = performance.now();
    const ring = numbered.length ? concaveman(numbered) : [];
    const milliseconds = performance.now() - begin;
    return { vertices: Uint32Array.from(ring.slice(0, -1), (point) => point[2]), milliseconds };
  },
};

function opened({ xy, format, lonlat }) {
  points = plane = xy;
  is_projected = false;
  return { xy: xy.slice(), format, lonlat };
}

function project(lonlat) {
  if (lonlat !== is_projected) plane = lonlat ? equal_area(points) : points;
  is_projected = lonlat;
}

addEventListener("message", async ({ data: { number, name, given } }) => {
  try {
    postMessage({ number, answer: await work[name](given) });
  } catch (error) {
    const known = error instanceof FileError || error instanceof RangeError;
    postMessage({ number, error: known ? error.message : `something went wrong: ${error.message}` });
  }
});

// The module is compiled while the page is read.
concaveHull(example(2000));
