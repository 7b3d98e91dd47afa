// What the types do not allow: each line that says so must be an error, and no other.
import concaveman, { concaveHull, concaveHulls } from "polylidar";

const hull = concaveHull([[0, 0]]);
concaveHull("points"); // wrong: no points
concaveHull([1, 2, 3]); // wrong: neither pairs nor a typed array
concaveHull(); // wrong: points are missing
concaveHull([[0, 0]], { aplha: 1 }); // wrong: no such option
concaveHull([[0, 0]], { alpha: "1" }); // wrong: no number
concaveHulls([[0, 0]]); // wrong: labels are missing
concaveHulls([[0, 0]], [{}]); // wrong: neither a number nor a word
concaveman(Float64Array.of(0, 0)); // wrong: concaveman takes pairs only
hull.chosenSizes.median; // wrong: it may be null
hull.area = 1; // wrong: it cannot be set
