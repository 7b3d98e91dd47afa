import concaveman from "concaveman";
import { serve, spans_area, version_of } from "../process/hullbench_worker.mjs";

serve({
  version: version_of("concaveman", import.meta.url),
  load: (points) => (spans_area(points) ? points : null),
  run: (points, { concavity, length_threshold }) => points && concaveman(points, concavity, length_threshold),
  extract: (ring) => (ring ? [[ring]] : []),
});
