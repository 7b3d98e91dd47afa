// Everything that the package has, as an ES module uses it.
import concaveman, { concaveHull, concaveHulls, concaveman as same } from "polylidar";
import type { ChosenSizes, Hull, Options, Points } from "polylidar";

const pairs: Points = [[0, 0], [4, 0], [4, 3]];
const arrays: Points[] = [pairs, Float64Array.of(0, 0, 4, 0, 4, 3), new Float32Array(6), new Int32Array(6), new Uint16Array(6)];
const options: Options = { detail: 2, alpha: 1, maxEdgeLength: 1, maxPerimeter: 1, fillSingleTriangles: true };
const none: Options = { detail: null, alpha: null, maxEdgeLength: null, maxPerimeter: null, fillSingleTriangles: null, cover: null };
const hull: Hull = concaveHull(pairs, options);
const [x, y]: [number, number] = hull.coordinates[0][0][0];
const indices: Uint32Array[] = [hull.vertices, hull.ringEnds, hull.polygonEnds];
const sizes: ChosenSizes | null = hull.chosenSizes;
const numbers: number[] = [hull.area, x, y, sizes?.least ?? 0, sizes?.median ?? 0, sizes?.most ?? 0];
const type: "MultiPolygon" = hull.toJSON().type === hull.type ? hull.type : "MultiPolygon";
const words: { label: string; hull: Hull }[] = concaveHulls(pairs, ["a", "a", "b"]);
const labels: { label: number }[] = concaveHulls(arrays[1], new Int32Array(3), { detail: 1 });
const places = [{ 0: 1, 1: 2, length: 2, name: "here" }];
const ring: { name: string }[] = concaveman(places, 2, 0);
export { indices, labels, none, numbers, ring, same, type, words };
