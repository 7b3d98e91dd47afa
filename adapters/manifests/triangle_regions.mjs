// Polylidar's rule on a Delaunay triangulation as Delaunator lays it out: triangles within the limits, their regions
// connected over edges, a polygon a region.
//
// Half-edge e leaves vertex triangles[e], belongs to triangle t = e / 3 rounded down, whose half-edges are 3t, 3t + 1
// and 3t + 2 in their order round it, and has its triangle on the same side as every other one. halfedges[e] is its
// twin in the triangle beyond, kNone outside of the convex hull. Vertex v lies at (coords[2v], coords[2v + 1]).

import { orient2d } from "robust-predicates";

const kNone = -1;
/** As the region of a triangle: it is beyond a limit, or within and in no region yet. */
const kDropped = -1;
const kWaiting = -2;

const triangle_of = (e) => (e / 3) | 0; // e < 2^31
const next = (e) => (e % 3 === 2 ? e - 2 : e + 1);
const previous = (e) => (e % 3 === 0 ? e + 2 : e - 1);

/**
 * Whether a perimeter is within a finite limit, by its squared edges. A perimeter is two to three times the longest edge,
 * which decides for nearly all triangles without a root.
 */
function is_perimeter_within(limit, ab, bc, ca, longest) {
  const squared = limit * limit;
  if (9 * longest <= squared) return true;
  if (4 * longest > squared) return false;
  return Math.sqrt(ab) + Math.sqrt(bc) + Math.sqrt(ca) <= limit;
}

/**
 * Whether a triangle is within the limits, all inclusive; one that is infinite is not tested. The circumradius,
 * |ab| |bc| |ca| / (2 cross) with cross twice the area, is compared squared and without division, so that a triangle
 * that is flat up to rounding counts as infinitely large.
 */
function filter_for(coords, { alpha, max_edge_length, max_perimeter }) {
  const squared_distance = (a, b) => {
    const dx = coords[2 * a] - coords[2 * b];
    const dy = coords[2 * a + 1] - coords[2 * b + 1];
    return dx * dx + dy * dy;
  };
  const doubled_area = (a, b, c) =>
    (coords[2 * b] - coords[2 * a]) * (coords[2 * c + 1] - coords[2 * a + 1]) -
    (coords[2 * b + 1] - coords[2 * a + 1]) * (coords[2 * c] - coords[2 * a]);
  return (a, b, c) => {
    const ab = squared_distance(a, b);
    const bc = squared_distance(b, c);
    const ca = squared_distance(c, a);
    const longest = Math.max(ab, bc, ca);
    if (longest > max_edge_length * max_edge_length) return false;
    if (max_perimeter !== Infinity && !is_perimeter_within(max_perimeter, ab, bc, ca, longest)) return false;
    return alpha === Infinity || ab * bc * ca <= 4 * alpha * alpha * doubled_area(a, b, c) ** 2;
  };
}

/** Of each triangle its region, 0, 1, ..., or kDropped. */
function label_regions({ triangles, halfedges }, is_within) {
  const regions = new Int32Array(triangles.length / 3);
  for (let t = 0; t < regions.length; ++t) {
    regions[t] = is_within(triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]) ? kWaiting : kDropped;
  }
  let count = 0;
  const open = new Int32Array(regions.length); // in the region, but their neighbours not yet
  let open_count = 0;
  for (let first = 0; first < regions.length; ++first) {
    if (regions[first] !== kWaiting) continue;
    regions[first] = count;
    open[open_count++] = first;
    while (open_count > 0) {
      const t = open[--open_count];
      for (let e = 3 * t; e < 3 * t + 3; ++e) {
        const neighbour = halfedges[e] === kNone ? kNone : triangle_of(halfedges[e]);
        if (neighbour === kNone || regions[neighbour] !== kWaiting) continue;
        regions[neighbour] = count;
        open[open_count++] = neighbour;
      }
    }
    ++count;
  }
  return { regions, count };
}

/** From half-edge e to the one that leaves its end along e's other side, or the next one of the convex hull there. */
function crossing({ triangles, halfedges }) {
  const on_hull = new Map(); // vertex of the convex hull -> the half-edge that leaves it there
  for (let e = 0; e < halfedges.length; ++e) if (halfedges[e] === kNone) on_hull.set(triangles[e], e);
  return (e) => (halfedges[e] === kNone ? on_hull.get(triangles[next(e)]) : halfedges[e]);
}

/**
 * The rings of all regions: [{region, ring}], ring as vertices. The boundary half-edge that follows another one is the
 * first of the region that is met when turning at its end through triangles that are not in the region, and round the
 * outside of the convex hull. So each ring runs round one connected part of what is not in the region: a hole that
 * touches another hole or the shell at a vertex is a ring of its own, and no ring meets a vertex twice.
 */
function trace_rings({ triangles, halfedges }, regions) {
  const across = crossing({ triangles, halfedges });
  const following = (e) => {
    const region = regions[triangle_of(e)];
    let leaving = across(e);
    while (regions[triangle_of(leaving)] !== region) leaving = across(previous(leaving));
    return leaving;
  };
  const is_traced = new Uint8Array(halfedges.length);
  const rings = [];
  for (let first = 0; first < halfedges.length; ++first) {
    const region = regions[triangle_of(first)];
    if (region === kDropped || is_traced[first]) continue;
    const twin = halfedges[first];
    if (twin !== kNone && regions[triangle_of(twin)] === region) continue;
    const ring = [];
    for (let e = first; !is_traced[e]; e = following(e)) {
      is_traced[e] = 1;
      ring.push(triangles[e]);
    }
    rings.push({ region, ring });
  }
  return rings;
}

/** Whether a simple ring turns as Delaunator's triangles do, exactly: by its turn at its leftmost, lowest vertex. */
function turns_like_triangles(coords, ring) {
  const x = (i) => coords[2 * ring[i]];
  const y = (i) => coords[2 * ring[i] + 1];
  let least = 0;
  for (let i = 1; i < ring.length; ++i) {
    if (x(i) < x(least) || (x(i) === x(least) && y(i) < y(least))) least = i;
  }
  const before = (least + ring.length - 1) % ring.length;
  const after = (least + 1) % ring.length;
  return orient2d(x(before), y(before), x(least), y(least), x(after), y(after)) > 0;
}

/** The regions as polygons: [[shell, hole, ...], ...], each ring an array of vertices. */
export function region_polygons(triangulation, limits) {
  const { coords } = triangulation;
  const { regions, count } = label_regions(triangulation, filter_for(coords, limits));
  const polygons = Array.from({ length: count }, () => []);
  for (const { region, ring } of trace_rings(triangulation, regions)) {
    if (turns_like_triangles(coords, ring)) polygons[region].unshift(ring);
    else polygons[region].push(ring);
  }
  return polygons;
}
