import { serve } from "./hullbench_worker.mjs";

const turns_left = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0]);

function half_hull(points) {
  const chain = [];
  for (const point of points) {
    while (chain.length > 1 && !turns_left(chain.at(-2), chain.at(-1), point)) chain.pop();
    chain.push(point);
  }
  return chain.slice(0, -1);
}

/** The convex hull (A. M. Andrew's monotone chain): put the method here. */
function run(points) {
  const ordered = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const distinct = ordered.filter((p, i) => i === 0 || p[0] !== ordered[i - 1][0] || p[1] !== ordered[i - 1][1]);
  const ring = [...half_hull(distinct), ...half_hull(distinct.reverse())];
  return ring.length > 2 ? [[ring]] : [];
}

serve({ version: "0.1", run });
