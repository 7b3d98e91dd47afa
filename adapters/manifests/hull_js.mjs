import hull from "hull.js";
import { serve, spans_area, version_of } from "../process/hullbench_worker.mjs";

serve({
  version: version_of("hull.js", import.meta.url),
  run: (points, { max_edge_length }) => (spans_area(points) ? hull(points, max_edge_length) : []),
  extract: (ring) => (ring.length > 0 ? [[ring]] : []),
});
