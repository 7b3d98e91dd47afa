// The WebAssembly module (../glue.cpp): its instance, what is written into its memory and what is read from it.
import bytes from "polylidar.wasm";

const VERTICES = 0;
const RING_ENDS = 1;
const POLYGON_ENDS = 2;
const HULL_ENDS = 3;

// Newer C++ libraries say why before they abort: there is nothing to write it to.
const BAD_FILE = 8; // WASI's "badf"
const NO_FILES = Object.fromEntries(["fd_write", "fd_seek", "fd_close"].map((name) => [name, () => BAD_FILE]));

let compiled; // on the first call: to import this costs next to nothing
let instance; // none at first, and after an error, which leaves the C++ objects half made

function exports_of_instance() {
  if (!instance) {
    compiled ??= new WebAssembly.Module(bytes);
    instance = new WebAssembly.Instance(compiled, { polylidar: { fail }, wasi_snapshot_preview1: NO_FILES });
    instance.exports._initialize();
  }
  return instance.exports;
}

/** What C++ calls in place of unwinding its stack. */
function fail(address, size) {
  throw new RangeError(new TextDecoder().decode(new Uint8Array(instance.exports.memory.buffer, address >>> 0, size)));
}

/** work(exports), with a new module next time when it throws. */
function guarded(work) {
  try {
    return work(exports_of_instance());
  } catch (error) {
    instance = undefined;
    throw error;
  }
}

/** One array of the result, which the next call overwrites. */
function array(exports, which) {
  return new Uint32Array(exports.memory.buffer, exports.result_array(which) >>> 0, exports.result_length(which));
}

function write_points(exports, xy) {
  const address = exports.reserve_points(xy.length / 2) >>> 0;
  new Float64Array(exports.memory.buffer, address, xy.length).set(xy);
}

/** Options as the arguments of the functions that extract. */
function words(options) {
  const limits = [options.alpha, options.maxEdgeLength, options.maxPerimeter, options.fillSingleTriangles];
  const wanted = (options.cover ? 16 : 0) | (options.one ? 32 : 0);
  const given = limits.reduce((bits, value, i) => (value == null ? bits : bits | (1 << i)), wanted);
  return [given, options.detail ?? 1, ...limits.slice(0, 3).map((value) => value ?? 0), limits[3] ? 1 : 0];
}

/** Part h of the result as three arrays of its own. */
function part(exports, h) {
  const begin_and_end = (ends, first, last) => [first === 0 ? 0 : ends[first - 1], last === 0 ? 0 : ends[last - 1]];
  const polygons = begin_and_end(array(exports, HULL_ENDS), h, h + 1);
  const rings = begin_and_end(array(exports, POLYGON_ENDS), ...polygons);
  const vertices = begin_and_end(array(exports, RING_ENDS), ...rings);
  return {
    vertices: array(exports, VERTICES).slice(...vertices),
    ringEnds: array(exports, RING_ENDS)
      .slice(...rings)
      .map((end) => end - vertices[0]),
    polygonEnds: array(exports, POLYGON_ENDS)
      .slice(...polygons)
      .map((end) => end - rings[0]),
  };
}

/** The hull of points x0, y0, x1, y1 ..., by indices, with the sizes that were chosen or null. */
export function hull(xy, options) {
  return guarded((exports) => {
    write_points(exports, xy);
    exports.concave_hull(...words(options));
    const [least, median, most] = [0, 1, 2].map(exports.chosen_size);
    return { ...part(exports, 0), chosenSizes: Number.isNaN(most) ? null : { least, median, most } };
  });
}

/** The hulls of the points whose labels are 0, 1 ..., all of which there are. */
export function hulls(xy, labels, options) {
  return guarded((exports) => {
    write_points(exports, xy);
    const address = exports.reserve_labels(labels.length) >>> 0;
    new Int32Array(exports.memory.buffer, address, labels.length).set(labels);
    exports.concave_hulls(...words(options));
    return Array.from({ length: exports.result_length(HULL_ENDS) }, (_, h) => part(exports, h));
  });
}

/** One ring round all points, by indices, without the first one again at the end; empty where they have no area. */
export function one_ring(xy, detail, length_threshold) {
  return guarded((exports) => {
    write_points(exports, xy);
    exports.one_ring(detail, length_threshold);
    return array(exports, VERTICES).slice();
  });
}
