import hull from "hull.js";
import { serve, spans_area, version_of } from "../process/hullbench_worker.mjs";

serve({
  version: version_of("hull.js", import.meta.url),
  load: (points) => (spans_area(points) ? points : null),
  run: (points, { max_edge_length }) => points && hull(points, max_edge_length),
  extract: (ring) => (ring ? [[ring]] : []),
});
