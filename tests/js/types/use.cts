// Everything that the package has, as CommonJS uses it.
import polylidar = require("polylidar");

const { concaveHull, concaveHulls, concaveman, default: same } = polylidar;
const options: polylidar.Options = { detail: 2, alpha: 1, maxEdgeLength: 1, maxPerimeter: 1, fillSingleTriangles: true };
const points: polylidar.Points = [[0, 0], [4, 0], [4, 3]];
const hull: polylidar.Hull = concaveHull(points, options);
const sizes: polylidar.ChosenSizes | null = hull.chosenSizes;
const shell: [number, number][] = hull.toJSON().coordinates[0][0];
const hulls: { label: bigint; hull: polylidar.Hull }[] = concaveHulls(Float64Array.of(0, 0), [1n], {});
const rings: number[][][] = [concaveman([[0, 0]], 2, 0), same([[0, 0]])];
export = { area: hull.area, hulls, rings, shell, sizes, vertices: hull.vertices };
