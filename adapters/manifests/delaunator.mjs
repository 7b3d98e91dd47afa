import Delaunator from "delaunator";
import { serve, version_of } from "../process/hullbench_worker.mjs";
import { region_polygons } from "./triangle_regions.mjs";

serve({
  version: version_of("delaunator", import.meta.url),
  // Its memory is kept between runs, as update() is for; the constructor calls it, too.
  load: (points) => new Delaunator(Float64Array.from(points.flat())),
  run(triangulation, { alpha, max_edge_length, max_perimeter }) {
    triangulation.update();
    const polygons = region_polygons(triangulation, { alpha, max_edge_length, max_perimeter });
    return { coords: triangulation.coords, polygons };
  },
  extract({ coords, polygons }) {
    const position = (vertex) => [coords[2 * vertex], coords[2 * vertex + 1]];
    return polygons.map((rings) => rings.map((ring) => ring.map(position)));
  },
});
