import Delaunator from "delaunator";
import { serve, version_of } from "../process/hullbench_worker.mjs";
import { region_polygons } from "./triangle_regions.mjs";

serve({
  version: version_of("delaunator", import.meta.url),
  load: (points) => Float64Array.from(points.flat()),
  run: (coords, { alpha, max_edge_length, max_perimeter }) => ({
    coords,
    polygons: region_polygons(new Delaunator(coords), { alpha, max_edge_length, max_perimeter }),
  }),
  extract({ coords, polygons }) {
    const position = (vertex) => [coords[2 * vertex], coords[2 * vertex + 1]];
    return polygons.map((rings) => rings.map((ring) => ring.map(position)));
  },
});
