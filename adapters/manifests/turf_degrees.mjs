// Turf's lengths are those of arcs on a sphere. Points in a plane are handed to it as longitudes and latitudes within
// half a degree of (0, 0), where arcs and chords of the plane differ by less than 4 parts in 10^5.

/** {points, scale: degrees a unit of `planar`, back: from a position in degrees to the point it stands for}. */
export function to_degrees(planar) {
  const xs = planar.map(([x]) => x);
  const ys = planar.map(([, y]) => y);
  const lowest = (values) => values.reduce((a, b) => Math.min(a, b), Infinity);
  const highest = (values) => values.reduce((a, b) => Math.max(a, b), -Infinity);
  const extent = Math.max(highest(xs) - lowest(xs), highest(ys) - lowest(ys));
  // A power of two, so that nothing is lost in multiplying.
  const scale = extent > 0 ? 2 ** -Math.ceil(Math.log2(extent)) : 1;
  const centre = [(lowest(xs) + highest(xs)) / 2, (lowest(ys) + highest(ys)) / 2];
  const points = planar.map(([x, y]) => [(x - centre[0]) * scale, (y - centre[1]) * scale]);
  const origin = new Map(points.map((position, index) => [position.join(), planar[index]]));
  return { points, scale, back: (position) => origin.get(position.join()) };
}
