// An outline: an array of polygons without holes, each an open ring of [x, y] vertices (the first one is not
// repeated). `fit` gives integer coordinates, so that areas and checks here are exact.

/// Spherical Mercator of longitude and latitude in degrees, in radii of the sphere, y up.
function mercator([longitude, latitude]) {
  const radians = Math.PI / 180;
  return [longitude * radians, Math.log(Math.tan(Math.PI / 4 + (latitude * radians) / 2))];
}

/// Projects `outline`, moves it so that the smallest x and y are 0, scales it so that the larger side of its
/// bounding box is `size`, and turns every ring counter-clockwise. Coordinates become integers: multiples of
/// 1 / unitsPerLength, rounded to the nearest.
export function fit(outline, size, unitsPerLength) {
  const projected = outline.map((ring) => ring.map(mercator));
  const vertices = projected.flat();
  const minimum = [0, 1].map((axis) => Math.min(...vertices.map((vertex) => vertex[axis])));
  const maximum = [0, 1].map((axis) => Math.max(...vertices.map((vertex) => vertex[axis])));
  const scale = size / Math.max(maximum[0] - minimum[0], maximum[1] - minimum[1]);
  return projected.map((ring) => {
    const fitted = ring.map((vertex) =>
      vertex.map((value, axis) => Math.round((value - minimum[axis]) * scale * unitsPerLength)),
    );
    return twiceArea(fitted) < 0n ? fitted.reverse() : fitted;
  });
}

/// Twice the area of an integer ring, exact, positive when it runs counter-clockwise.
export function twiceArea(ring) {
  return ring.reduce((sum, [x, y], i) => {
    const [nextX, nextY] = ring[(i + 1) % ring.length];
    return sum + BigInt(x) * BigInt(nextY) - BigInt(nextX) * BigInt(y);
  }, 0n);
}

/// -1, 0 or 1: the side of the line a -> b on which c lies (1: left), exact for integers.
function side(a, b, c) {
  const cross = BigInt(b[0] - a[0]) * BigInt(c[1] - a[1]) - BigInt(b[1] - a[1]) * BigInt(c[0] - a[0]);
  return cross > 0n ? 1 : cross < 0n ? -1 : 0;
}

function between(a, b, c) {
  return [0, 1].every((axis) => Math.min(a[axis], b[axis]) <= c[axis] && c[axis] <= Math.max(a[axis], b[axis]));
}

/// Whether the closed segments ab and cd have a point in common.
function meet(a, b, c, d) {
  const sides = [side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)];
  if (sides[0] !== sides[1] && sides[2] !== sides[3] && !sides.includes(0)) return true;
  return (
    (sides[0] === 0 && between(a, b, c)) ||
    (sides[1] === 0 && between(a, b, d)) ||
    (sides[2] === 0 && between(c, d, a)) ||
    (sides[3] === 0 && between(c, d, b))
  );
}

/// Whether `point` lies inside `ring` (not asked for points on it).
function inside(ring, point) {
  return (
    ring.filter((a, i) => {
      const b = ring[(i + 1) % ring.length];
      return a[1] <= point[1] !== b[1] <= point[1] && side(a, b, point) === (b[1] > a[1] ? 1 : -1);
    }).length %
      2 ===
    1
  );
}

/// Throws an Error that names the first fault when an integer outline is not a valid multipolygon of disjoint
/// polygons whose rings touch neither themselves nor each other.
export function check(outline) {
  if (outline.length === 0) throw new Error("it has no polygon");
  outline.forEach((ring, i) => {
    if (!ring.flat().every(Number.isSafeInteger)) {
      throw new Error(`polygon ${i} has a coordinate that is not finite`);
    }
    if (new Set(ring.map(String)).size !== ring.length) throw new Error(`polygon ${i} visits a vertex twice`);
    if (ring.length < 3) throw new Error(`polygon ${i} has fewer than 3 vertices`);
    if (twiceArea(ring) <= 0n) throw new Error(`polygon ${i} has no area or runs clockwise`);
  });
  const edges = outline.flatMap((ring, polygon) =>
    ring.map((start, i) => ({ polygon, i, count: ring.length, start, end: ring[(i + 1) % ring.length] })),
  );
  edges.forEach((e, k) =>
    edges.slice(k + 1).forEach((f) => {
      if (clash(e, f)) {
        throw new Error(`edge ${e.i} of polygon ${e.polygon} touches edge ${f.i} of polygon ${f.polygon}`);
      }
    }),
  );
  outline.forEach((outer, i) =>
    outline.forEach((inner, j) => {
      if (i !== j && inside(outer, inner[0])) throw new Error(`polygon ${j} lies inside polygon ${i}`);
    }),
  );
}

/// Whether two edges have more in common than neighbours in a ring may: their shared vertex.
function clash(e, f) {
  const follows = e.polygon === f.polygon && (e.i + 1) % e.count === f.i;
  const precedes = e.polygon === f.polygon && (f.i + 1) % f.count === e.i;
  if (!follows && !precedes) return meet(e.start, e.end, f.start, f.end);
  const [first, second] = follows ? [e, f] : [f, e];
  return (
    side(first.start, first.end, second.end) === 0 &&
    (between(first.start, first.end, second.end) || between(second.start, second.end, first.start))
  );
}
