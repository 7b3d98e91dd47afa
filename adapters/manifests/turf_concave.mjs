import { concave } from "@turf/concave";
import { featureCollection, point } from "@turf/helpers";
import { serve, version_of } from "../process/hullbench_worker.mjs";
import { to_degrees } from "./turf_degrees.mjs";

serve({
  version: version_of("@turf/concave", import.meta.url),
  load(points) {
    const degrees = to_degrees(points);
    return { degrees, features: featureCollection(degrees.points.map((position) => point(position))) };
  },
  run: ({ degrees, features }, { max_edge_length }) => ({
    degrees,
    shape: concave(features, { maxEdge: max_edge_length * degrees.scale, units: "degrees" })?.geometry,
  }),
  extract({ degrees, shape }) {
    if (!shape) return [];
    const polygons = shape.type === "Polygon" ? [shape.coordinates] : shape.coordinates;
    return polygons.map((rings) => rings.map((ring) => ring.map(degrees.back)));
  },
});
