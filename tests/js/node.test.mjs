// The npm package in Node: PACKAGE is its folder; native_hulls.mjs says what else the environment names.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { assert_same, native_cases, plain } from "./native_hulls.mjs";
import { pairs } from "./point_files.mjs";

const { PACKAGE } = process.env;
const polylidar = await import(pathToFileURL(join(PACKAGE, "polylidar.js")));
const { concaveHull, concaveHulls, concaveman } = polylidar;

// concaveman itself, where the other methods are installed.
const installed = new URL("../../adapters/manifests/node_modules/concaveman/index.js", import.meta.url);
const rival = existsSync(installed) ? (await import(installed)).default : undefined;
const beside_concaveman = { skip: !rival && "concaveman is not installed: cmake/install-npm.sh adapters/manifests" };

let cases;
before(() => (cases = native_cases()));

/** `count` points in a square, the same ones each time. */
function square(count, side = 1, x0 = 0) {
  let state = 1;
  const next = () => (state = (state * 48271) % 2147483647) / 2147483647;
  return Array.from({ length: count }, () => [x0 + side * next(), side * next()]);
}

/** Whether a point is inside a closed ring or on it. */
function holds(ring, [x, y]) {
  let inside = false;
  for (let i = 1; i < ring.length; i++) {
    const [[ax, ay], [bx, by]] = [ring[i - 1], ring[i]];
    if ((ax === x && ay === y) || (bx === x && by === y)) return true;
    if (ay > y !== by > y && x < ax + ((bx - ax) * (y - ay)) / (by - ay)) inside = !inside;
  }
  return inside;
}

test("hulls are those of the native core, index by index", () => {
  let compared = 0;
  for (const { name, points, hulls } of cases.filter((each) => each.hulls)) {
    for (const { options, ...expected } of hulls) {
      assert_same(plain(concaveHull(points, options)), expected, `${name} ${JSON.stringify(options)}`);
      compared += expected.vertices.length > 0;
    }
  }
  assert.ok(compared > 200, `only ${compared} hulls are not empty`);
});

test("hulls by labels are those of the native core", () => {
  const labelled = cases.filter((each) => each.labelled);
  assert.equal(labelled.length, 2);
  for (const { name, points, labels, options, labelled: expected } of labelled) {
    const hulls = concaveHulls(points, labels, options);
    assert.deepEqual(
      hulls.map(({ label }) => label),
      expected.map(({ label }) => label),
    );
    hulls.forEach(({ hull }, i) => assert_same(plain(hull), expected[i], `${name}, label ${expected[i].label}`));
  }
});

test("labels may be words, and come in ascending order", () => {
  const points = [...square(50), ...square(50, 1, 5), ...square(50, 1, 9)];
  const labels = points.map(([x]) => (x < 2 ? "pear" : x < 7 ? "apple" : "fig"));
  const hulls = concaveHulls(points, labels);
  assert.deepEqual(
    hulls.map(({ label }) => label),
    ["apple", "fig", "pear"],
  );
  assert.ok([...hulls[2].hull.vertices].every((i) => labels[i] === "pear"));
  assert.deepEqual(concaveHulls([], []), []);
});

test("a hull is a GeoJSON geometry", () => {
  const ring = [];
  for (let x = 0; x < 20; x++) for (let y = 0; y < 20; y++) if (x < 5 || x > 14 || y < 5 || y > 14) ring.push([x, y]);
  const hull = concaveHull(ring, { maxEdgeLength: 1.5 });
  const { type, coordinates } = JSON.parse(JSON.stringify(hull));
  assert.equal(type, "MultiPolygon");
  assert.equal(coordinates.length, 1);
  assert.equal(coordinates[0].length, 2, "a shell and a hole");
  for (const closed of coordinates[0]) assert.deepEqual(closed[0], closed.at(-1));
  assert.deepEqual(
    coordinates[0][0].slice(0, -1),
    [...hull.vertices.subarray(0, hull.ringEnds[0])].map((i) => ring[i]),
  );
  assert.equal(hull.area, 19 * 19 - 11 * 11 + 4 * 0.5); // the hole's corners are cut
  const far = 2 ** 515; // the products of its coordinates are no doubles
  assert.equal(concaveHull(pairs([0, 0, far, far, far, far + 2 ** 485])).area, 2 ** 999);
});

test("points may be of any numeric type", () => {
  const points = square(300, 1000).map(([x, y]) => [Math.round(x), Math.round(y), 7]);
  const flat = points.flatMap(([x, y]) => [x, y]);
  const expected = plain(concaveHull(points));
  assert.ok(expected.vertices.length > 3);
  for (const type of [Float64Array, Float32Array, Int32Array, Uint16Array]) {
    assert.deepEqual(plain(concaveHull(type.from(flat))), expected, type.name);
  }
});

test("no points, too few and those on a line have no hull", () => {
  for (const points of [[], [[1, 2]], pairs([0, 0, 3, 4, 3, 4]), pairs([0, 0, 1, 1, 2, 2, 3, 3])]) {
    const hull = concaveHull(points);
    assert.deepEqual(hull.coordinates, []);
    assert.equal(hull.area, 0);
    assert.equal(hull.chosenSizes, null);
  }
});

test("it covers all points and joins all parts on demand", () => {
  const points = [];
  for (const left of [0, 4]) for (let x = 0; x < 3; x++) for (let y = 0; y < 3; y++) points.push([left + x, y]);
  points.push([1, 9]);
  const plain = concaveHull(points, { alpha: 0.8 });
  const covering = concaveHull(points, { alpha: 0.8, cover: true });
  const one = concaveHull(points, { alpha: 0.8, one: true });
  assert.deepEqual(
    [plain, one].map((hull) => hull.polygonEnds.length),
    [2, 1],
  );
  assert.deepEqual([plain.area, one.area], [8, 12]);
  assert.ok(covering.vertices.includes(points.length - 1));
  assert.ok(covering.area > one.area);
  const by_label = concaveHulls(
    points,
    points.map(([x]) => (x < 3 ? "a" : "b")),
    { alpha: 0.8, cover: true },
  );
  assert.ok(by_label[0].hull.vertices.includes(points.length - 1));
  assert.equal(by_label[1].hull.area, 4);
});

test("errors say what the core says, and leave the module in order", () => {
  const points = square(100);
  const expected = plain(concaveHull(points));
  const errors = [
    [() => concaveHull([...points, [Infinity, 0]]), RangeError, "point 100 is not finite"],
    [() => concaveHull(pairs([0, 0, 1, 0, NaN, 1])), RangeError, "point 2 is not finite"],
    [() => concaveHull(pairs([0, 0, 1, 0, undefined, 1])), TypeError, "point 2 is not an array of two numbers"],
    [
      () =>
        concaveHull([
          [1, 0],
          [null, 1],
        ]),
      TypeError,
      "point 1 is not an array of two numbers",
    ],
    [() => concaveHull([[1, ""]]), TypeError, "point 0 is not an array of two numbers"],
    [() => concaveHull(["12", "34", "71"]), TypeError, "point 0 is not an array of two numbers"],
    [() => concaveHull(Buffer.from(Float64Array.from(points.flat()).buffer)), TypeError, /^points are bytes/],
    [() => concaveHull(points, { detail: 0 }), RangeError, "detail must be positive and finite"],
    [() => concaveHull(points, { alpha: -1 }), RangeError, "alpha must be zero or more"],
    [() => concaveHull(points, { alpha: "" }), TypeError, "alpha must be a number, not a string"],
    [() => concaveHull(points, { detail: true }), TypeError, "detail must be a number, not a boolean"],
    [() => concaveHull(points, { cover: "false" }), TypeError, "cover must be a boolean, not a string"],
    [
      () =>
        concaveHulls(
          points,
          points.map(() => 1),
          { one: 1 },
        ),
      TypeError,
      "one must be a boolean, not a number",
    ],
    [() => concaveHull(points, { maxPerimeter: NaN }), RangeError, "max_perimeter must be zero or more"],
    [() => concaveHulls(points, [1, 2]), RangeError, "there must be one label a point: there are 2 labels and 100 points"],
    [() => concaveHull(pairs([0, 0, 1e-300, 1, 1e300, 2])), RangeError, /^coordinates span more than a factor of/],
    [() => concaveHull(points, 2), TypeError, /^options must be an object, such as \{ detail: 2 \}/],
    [() => concaveHull(points, null), TypeError, /^options must be an object/],
    [() => concaveHull(points, { aplha: 1 }), TypeError, /^there is no option 'aplha': there are detail, alpha/],
    [() => concaveHull(new Float64Array(5)), TypeError, /length is odd/],
    [() => concaveHull("points"), TypeError, /^points must be an array/],
    [() => concaveHull([[0, 0], null]), TypeError, "point 1 is not an array of x and y"],
    [() => concaveHulls([[0, 0]], [{}]), TypeError, "label 0 is neither a number nor a string"],
  ];
  for (const [call, type, message] of errors) {
    assert.throws(call, (error) => {
      assert.ok(error instanceof type, `${error.name}: ${error.message}`);
      assert.match(error.message, message instanceof RegExp ? message : new RegExp(`^${message}$`));
      return true;
    });
    assert.deepEqual(plain(concaveHull(points)), expected);
  }
});

const assert_it_still_works = () => assert.equal(concaveHull(pairs([0, 0, 1, 0, 0, 1])).area, 0.5);

test("any number of errors leaves no trace", () => {
  const points = pairs([0, 0, NaN, 1]);
  for (let i = 0; i < 3000; i++) assert.throws(() => concaveHull(points), /^RangeError: point 1 is not finite$/);
  assert_it_still_works();
});

test("memory that does not suffice is an error like any other", () => {
  assert.throws(() => concaveHull(new Float64Array(2 ** 26 + 2)), {
    name: "RangeError",
    message: /^there is not enough memory/,
  });
  assert_it_still_works();
});

test("CommonJS gives the same", () => {
  const required = createRequire(import.meta.url)(join(PACKAGE, "polylidar.cjs"));
  assert.deepEqual(Object.keys(required).sort(), Object.keys(polylidar).sort());
  const points = square(200);
  assert.deepEqual(plain(required.concaveHull(points)), plain(concaveHull(points)));
});

test("the default export is concaveman's", () => {
  assert.equal(polylidar.default, concaveman);
  const required = createRequire(import.meta.url)(join(PACKAGE, "polylidar.cjs"));
  assert.equal(required.default, required.concaveman);
});

test("links in the package's README lead to files in the package", () => {
  const { files } = JSON.parse(readFileSync(join(PACKAGE, "package.json"), "utf8"));
  const readme = readFileSync(join(PACKAGE, "README.md"), "utf8");
  const links = [...readme.matchAll(/\]\(([^)]+)\)/g)].map(([, link]) => link).filter((link) => !link.startsWith("https://"));
  assert.ok(links.length > 0);
  for (const link of links) assert.ok(files.includes(link) && existsSync(join(PACKAGE, link)), link);
  assert.match(readme, /\n## How fast it is\n/);
  assert.doesNotMatch(readme, /CMakeLists\.txt/, "the map of the files of the clone");
});

test("concaveman's ring is closed, of the points themselves and has all points inside", () => {
  const sets = {
    "one square": square(1000),
    "two squares far apart": [...square(300), ...square(300, 1, 4)],
    "a square and an outlier": [...square(300), [3, 3]],
    "a letter L": square(1500).filter(([x, y]) => x < 0.3 || y < 0.3),
    "a dense square in a sparse one": [...square(200, 1), ...square(2000, 0.1)],
  };
  for (const [name, points] of Object.entries(sets)) {
    const given = structuredClone(points);
    const areas = [0.5, 1, 2, 4, Infinity].map((concavity) => {
      const ring = concaveman(points, concavity);
      assert.equal(ring[0], ring.at(-1), `${name}: the ring is closed`);
      assert.ok(
        ring.every((point) => points.includes(point)),
        `${name}: members of the array`,
      );
      assert.equal(new Set(ring).size, ring.length - 1, `${name}: each point once`);
      assert.ok(
        points.every((point) => holds(ring, point)),
        `${name}, concavity ${concavity}: a point is outside`,
      );
      assert.ok(area_of(ring) < 0, `${name}, concavity ${concavity}: clockwise`);
      return area_of(ring.reverse());
    });
    for (let i = 1; i < areas.length; i++) assert.ok(areas[i] >= areas[i - 1], `${name}: ${areas}`);
    assert.equal(areas.at(-1), concaveHull(points, { alpha: Infinity }).area, `${name}: the convex hull`);
    assert.deepEqual(points, given, `${name}: the points are left as they were`);
  }
  assert.ok(-area_of(concaveman(sets["a letter L"])) < 0.6, "the notch of the L is found");
});

test("concaveman's ring is the hull's shell where one part has all points, holes or not", () => {
  const points = square(3000).filter(([x, y]) => Math.hypot(x - 0.4, y - 0.4) > 0.2 && (x < 0.8 || y < 0.6));
  const hull = concaveHull(points);
  assert.equal(hull.polygonEnds.length, 1);
  assert.equal(hull.ringEnds.length, 2);
  assert.deepEqual(concaveman(points), hull.coordinates[0][0].reverse());
});

test("the ring runs as concaveman's does, and its points on a line too", beside_concaveman, () => {
  const sets = [3, 4, 5, 10, 100, 1000].map((count) => square(count));
  sets.push(square(1500).filter(([x, y]) => x < 0.3 || y < 0.3));
  sets.push(square(500).map(([x, y]) => [-100 * x - 5, -7 * y]));
  for (const points of sets) {
    for (const concavity of [0, 1, 2, Infinity]) {
      const theirs = area_of(rival(structuredClone(points), concavity));
      assert.equal(Math.sign(area_of(concaveman(points, concavity))), Math.sign(theirs));
      assert.equal(Math.sign(theirs), -1);
    }
  }
  for (const line of [pairs([2, 2, 0, 0, 1, 1]), pairs([0, 0, 0, 5, 0, 2]), [[1, 2]]]) {
    assert.deepEqual(concaveman(line), rival(structuredClone(line)));
  }
});

test("concaveman's lengthThreshold and its default arguments", () => {
  const points = square(3000).filter(([x, y]) => x < 0.3 || y < 0.3);
  assert.deepEqual(concaveman(points), concaveman(points, 2, 0));
  const { median } = concaveHull(points, { detail: 2 }).chosenSizes;
  const lengths = [0, 2 * median, 0.2, 5].map((threshold) => concaveman(points, 1, threshold).length);
  assert.deepEqual(concaveman(points, 1, 2 * median), concaveman(points, 1));
  for (let i = 1; i < lengths.length; i++) assert.ok(lengths[i] <= lengths[i - 1], `${lengths}`);
  for (const threshold of [5, Infinity]) assert.deepEqual(concaveman(points, 1, threshold), concaveman(points, Infinity));
});

/** 30,000 points of a star with seven bays, 900 units wide, denser to the right where `is_even` is false; and its area. */
function star(is_even) {
  const inside = ([x, y]) => Math.hypot(x - 500, y - 500) < 350 + 130 * Math.cos(7 * Math.atan2(y - 500, x - 500));
  const points = square(300_000, 1000).filter((p, i) => inside(p) && (is_even || (i % 100) / 100 < 0.05 + (p[0] / 1000) ** 2));
  return { points: points.slice(0, 30_000), area: Math.PI * (350 ** 2 + 130 ** 2 / 2) };
}

test("concaveman's lengthThreshold fills what is narrower and nothing else", () => {
  for (const is_even of [true, false]) {
    const { points, area } = star(is_even);
    assert.equal(points.length, 30_000);
    for (const [threshold, most] of [
      [0, 1.01],
      [20, 1.01],
      [50, 1.02],
      [100, 1.08],
      [200, 1.26],
    ]) {
      const filled = -area_of(concaveman(points, 2, threshold)) / area;
      assert.ok(filled > most - 0.04 && filled < most, `${is_even}, lengthThreshold ${threshold}: ${filled}`);
    }
  }
});

test("lengthThreshold fills what it fills with concaveman", beside_concaveman, () => {
  for (const is_even of [true, false]) {
    const { points, area } = star(is_even);
    for (const threshold of [50, 100, 200]) {
      const [ours, theirs] = [concaveman, rival].map((method) => -area_of(method(points, 2, threshold)) / area);
      assert.ok(Math.abs(ours - theirs) < 0.03, `${is_even}, lengthThreshold ${threshold}: ${ours}, ${theirs}`);
    }
  }
});

test("concaveman's ring of points without an area", () => {
  assert.deepEqual(concaveman([]), []);
  assert.deepEqual(concaveman([[1, 2]]), pairs([1, 2, 1, 2, 1, 2]));
  assert.deepEqual(concaveman(pairs([2, 2, 0, 0, 1, 1])), pairs([2, 2, 0, 0, 2, 2]));
  assert.throws(() => concaveman(new Float64Array(6)), /^TypeError: points must be an array of \[x, y\], whose members/);
});

function area_of(ring) {
  let sum = 0;
  for (let i = 1; i < ring.length; i++) {
    const [[ax, ay], [bx, by]] = [ring[i - 1], ring[i]];
    sum += (ax - ring[0][0]) * (by - ring[0][1]) - (bx - ring[0][0]) * (ay - ring[0][1]);
  }
  return sum / 2;
}
