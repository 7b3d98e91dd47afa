/** Points: a typed array of x, y, x, y ..., used as it is, or an array of [x, y], of which more coordinates are not read. */
export type Points =
  | Float64Array
  | Float32Array
  | Int32Array
  | Uint32Array
  | Int16Array
  | Uint16Array
  | ReadonlyArray<ArrayLike<number>>;

/** What shape to extract. Where none of the three limits is given, one is chosen from the points, place by place. null: not given. */
export interface Options {
  /** How much of the outline is kept where the limit is chosen; > 0. 2 finds holes and notches of half the width. Default: 1. */
  detail?: number | null;
  /** Largest circumradius of a kept triangle, in the unit of the points; >= 0. */
  alpha?: number | null;
  /** Longest edge of a kept triangle, in the unit of the points; >= 0. */
  maxEdgeLength?: number | null;
  /** Largest perimeter of a kept triangle, in the unit of the points; >= 0. */
  maxPerimeter?: number | null;
  /**
   * Whether a triangle beyond a limit is kept all the same when its three neighbours are within. Default: true where the
   * limit is chosen, false where one is given.
   */
  fillSingleTriangles?: boolean | null;
  /** Widen the limit, just enough to leave no point outside. One far outlier makes the shape coarse. Default: false. */
  cover?: boolean | null;
  /**
   * Widen the limit, just enough to join all parts that it gave before. A part that only the wider limit adds, and that
   * lies apart, is dropped. This and `cover` take longer: in the native core some 5 times as long for 2,000 points, and
   * 15 times for 100,000. Default: false.
   */
  one?: boolean | null;
}

/** The limit that was chosen, the size of a triangle as a length, where the points are densest, usual and sparsest. */
export interface ChosenSizes {
  least: number;
  median: number;
  most: number;
}

/**
 * Polygons, each of which is valid in the OGC's sense. Shells run counter-clockwise, holes clockwise. It is a GeoJSON
 * geometry, and JSON.stringify() writes it as one; to send or copy it, take toJSON(). It reads a typed array of points
 * again each time: do not change that while you use the hull.
 */
export interface Hull {
  readonly type: "MultiPolygon";
  /** polygons > rings, the shell first > points, the first one again at the end > x and y. Made anew each time, of the points that were given. */
  readonly coordinates: [number, number][][][];
  /** Indices into the points, ring after ring; the first one of a ring is not repeated. */
  readonly vertices: Uint32Array;
  /** Ring r is vertices[ringEnds[r - 1]] up to, not including, vertices[ringEnds[r]]; the first one starts at 0. */
  readonly ringEnds: Uint32Array;
  /** Polygon p is ring polygonEnds[p - 1], its shell, and those after it up to, not including, ring polygonEnds[p]. */
  readonly polygonEnds: Uint32Array;
  /** The limit that was chosen; null where one was given, where there is no triangle, and for concaveHulls(). */
  readonly chosenSizes: ChosenSizes | null;
  /** In the squared unit of the points. Computed each time, of the points that were given. */
  readonly area: number;
  toJSON(): { type: "MultiPolygon"; coordinates: [number, number][][][] };
}

/**
 * The concave hull of points, in any order; they may repeat. Fewer than 3 distinct points, points all on a line, or no
 * triangle kept: no polygon. Throws a RangeError where a coordinate is not finite, an option has no meaning or the memory
 * does not suffice, and a TypeError where the arguments are of another kind.
 */
export function concaveHull(points: Points, options?: Options): Hull;

/**
 * A hull for every label, a number, string or bigint for each point, all of one kind, by ascending label. Each is that of
 * its points alone, with indices into all points. Throws as concaveHull, a RangeError where there are not as many labels as
 * points, and a TypeError where a label is missing (NaN) or of another kind.
 */
export function concaveHulls<Label extends number | string | bigint>(
  points: Points,
  labels: Iterable<Label> | ArrayLike<Label>,
  options?: Options,
): { label: Label; hull: Hull }[];

/**
 * One ring round all points, with the signature and the kind of result of the npm package concaveman: the members of
 * `points` themselves, clockwise where y points up, the first one again at the end. Points all on a line: there and back.
 *
 * The ring is the shell of the hull with detail 2 / concavity. Where that has several parts, or leaves a point outside,
 * the detail is lowered, by a factor of 2^(1/2) as often as needed, until one part has all points. So one far outlier makes
 * the ring coarse; concaveHull() leaves it out instead.
 * @param concavity 1 is detailed, Infinity gives the convex hull. Default: 2.
 * @param lengthThreshold edges below this length are not dug into. Up to twice the median of the chosen sizes it changes
 * nothing, as narrower gaps are filled anyway; above, it is the maxEdgeLength of the hull, raised by a factor of 2^(1/2) as
 * often as needed. Default: 0.
 */
export function concaveman<Point extends ArrayLike<number>>(
  points: readonly Point[],
  concavity?: number,
  lengthThreshold?: number,
): Point[];

/** concaveman() is the default export, as it is of the package concaveman. */
export default concaveman;
