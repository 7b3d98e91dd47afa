// Concave hulls of points in the plane. polylidar.d.ts says what everything means.
import * as module from "./module.js";

const FLAGS = ["fillSingleTriangles", "cover", "one"];
const OPTIONS = ["detail", "alpha", "maxEdgeLength", "maxPerimeter", ...FLAGS];
// The concavity that the core's default stands for: concaveman's default.
const USUAL_CONCAVITY = 2;
// concaveman takes 0 for "as detailed as can be"; of less than this nothing is left.
const LEAST_CONCAVITY = 2 ** -10;

/** Points of either kind as x0, y0, x1, y1 ... */
function flat(points) {
  if (!ArrayBuffer.isView(points) || points instanceof DataView) return flattened(points);
  if (points.BYTES_PER_ELEMENT === 1) {
    throw new TypeError("points are bytes: make numbers of them, such as new Float64Array(buffer)");
  }
  if (points.length % 2) throw new TypeError("points must be pairs of x and y: the array's length is odd");
  return points;
}

function flattened(points) {
  if (!Array.isArray(points)) throw new TypeError("points must be an array of [x, y], or a typed array of x, y, x, y ...");
  const xy = new Float64Array(2 * points.length);
  for (let i = 0; i < points.length; i++) {
    const point = points[i];
    if (!(point?.length >= 2)) throw new TypeError(`point ${i} is not an array of x and y`);
    const x = point[0];
    const y = point[1];
    // An array of numbers would take null and "" for 0.
    if (typeof x !== "number" || typeof y !== "number") throw new TypeError(`point ${i} is not an array of two numbers`);
    xy[2 * i] = x;
    xy[2 * i + 1] = y;
  }
  return xy;
}

function checked(options) {
  if (typeof options !== "object" || options === null) throw new TypeError("options must be an object, such as { detail: 2 }");
  for (const [name, value] of Object.entries(options)) {
    if (!OPTIONS.includes(name)) throw new TypeError(`there is no option '${name}': there are ${OPTIONS.join(", ")}`);
    const kind = FLAGS.includes(name) ? "boolean" : "number";
    if (value != null && typeof value !== kind) throw new TypeError(`${name} must be a ${kind}, not a ${typeof value}`);
  }
  return options;
}

/** A multipolygon by indices into the points, and as coordinates when it is asked for them. */
class Hull {
  #xy;

  constructor(xy, { vertices, ringEnds, polygonEnds, chosenSizes = null }) {
    this.#xy = xy;
    this.type = "MultiPolygon";
    this.vertices = vertices;
    this.ringEnds = ringEnds;
    this.polygonEnds = polygonEnds;
    this.chosenSizes = chosenSizes;
  }

  get coordinates() {
    let vertex = 0;
    let ring = 0;
    const point = (i) => [this.#xy[2 * i], this.#xy[2 * i + 1]];
    const next_ring = () => {
      const indices = this.vertices.subarray(vertex, this.ringEnds[ring]);
      vertex = this.ringEnds[ring++];
      return Array.from([...indices, indices[0]], point);
    };
    return Array.from(this.polygonEnds, (end) => Array.from({ length: end - ring }, next_ring));
  }

  get area() {
    let total = 0;
    let ring = 0;
    for (const end of this.polygonEnds) {
      total += this.#ring_area(ring++);
      while (ring < end) total -= this.#ring_area(ring++);
    }
    return total;
  }

  /** In the core's order of operations. */
  #ring_area(ring) {
    const begin = ring === 0 ? 0 : this.ringEnds[ring - 1];
    const [x, y] = [(i) => this.#xy[2 * this.vertices[i]], (i) => this.#xy[2 * this.vertices[i] + 1]];
    const twice_area = (scale) => {
      const [x0, y0] = [x(begin) * scale, y(begin) * scale];
      let sum = 0;
      for (let i = begin + 1; i + 1 < this.ringEnds[ring]; i++) {
        const [ax, ay] = [x(i) * scale - x0, y(i) * scale - y0];
        sum += ax * (y(i + 1) * scale - y0) - ay * (x(i + 1) * scale - x0);
      }
      return Math.abs(sum);
    };
    const sum = twice_area(1);
    // Products of large coordinates overflow, though the area itself may not.
    return Number.isFinite(sum) ? sum / 2 : twice_area(2 ** -520) * 2 ** 519 * 2 ** 520;
  }

  toJSON() {
    return { type: this.type, coordinates: this.coordinates };
  }
}

export function concaveHull(points, options = {}) {
  const xy = flat(points);
  return new Hull(xy, module.hull(xy, checked(options)));
}

export function concaveHulls(points, labels, options = {}) {
  const xy = flat(points);
  const { distinct, numbers } = numbered(labels);
  const count = xy.length / 2;
  if (numbers.length !== count) {
    throw new RangeError(`there must be one label a point: there are ${numbers.length} labels and ${count} points`);
  }
  return module.hulls(xy, numbers, checked(options)).map((shape, i) => ({ label: distinct[i], hull: new Hull(xy, shape) }));
}

/** The labels that there are, in ascending order, and each point's by its place among them. */
function numbered(labels) {
  const places = new Map();
  const first_met = Int32Array.from(labels, (label, i) => {
    let place = places.get(label);
    if (place === undefined) {
      if (!["number", "string", "bigint"].includes(typeof label) || Number.isNaN(label)) {
        throw new TypeError(`label ${i} is ${Number.isNaN(label) ? "missing (NaN)" : "neither a number nor a string"}`);
      }
      places.set(label, (place = places.size));
    }
    return place;
  });
  const met = [...places.keys()];
  if (new Set(met.map((label) => typeof label)).size > 1) {
    throw new TypeError("labels must be all numbers, all strings or all bigints, or they have no order");
  }
  const order = met.map((_, i) => i).sort((a, b) => (met[a] < met[b] ? -1 : 1));
  const rank = new Int32Array(met.length);
  order.forEach((place, i) => (rank[place] = i));
  return { distinct: order.map((place) => met[place]), numbers: first_met.map((place) => rank[place]) };
}

export function concaveman(points, concavity = USUAL_CONCAVITY, lengthThreshold = 0) {
  if (ArrayBuffer.isView(points)) {
    throw new TypeError("points must be an array of [x, y], whose members the ring has; concaveHull() takes typed arrays");
  }
  const detail = USUAL_CONCAVITY / Math.max(concavity, LEAST_CONCAVITY);
  const xy = flattened(points);
  const ring =
    detail > 0 ? module.one_ring(xy, detail, Math.abs(lengthThreshold) || 0) : module.hull(xy, { alpha: Infinity }).vertices;
  if (ring.length === 0) return line(points);
  // Clockwise, as concaveman's rings are.
  return Array.from([...ring, ring[0]].reverse(), (i) => points[i]);
}

/** There and back along points that have no area between them; from the last one, as concaveman does. */
function line(points) {
  if (points.length === 0) return [];
  const less = (a, b) => a[0] < b[0] || (a[0] === b[0] && a[1] < b[1]);
  const first = points.reduce((least, point) => (less(point, least) ? point : least));
  const last = points.reduce((most, point) => (less(most, point) ? point : most));
  return [last, first, last];
}

// The package concaveman has no other export.
export default concaveman;
