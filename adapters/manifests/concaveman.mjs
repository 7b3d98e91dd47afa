import concaveman from "concaveman";
import { serve, spans_area, version_of } from "../process/hullbench_worker.mjs";

serve({
  version: version_of("concaveman", import.meta.url),
  run: (points, { concavity, length_threshold }) =>
    spans_area(points) ? concaveman(points, concavity, length_threshold) : [],
  extract: (ring) => (ring.length > 0 ? [[ring]] : []),
});
