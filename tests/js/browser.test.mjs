// The npm package in Chromium: PACKAGE is its folder; native_hulls.mjs says what else the environment names.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launch } from "../report/browser.mjs";
import { assert_same, native_cases } from "./native_hulls.mjs";

let browser;
let page;

before(async () => {
  browser = await launch();
  page = await browser.newPage();
  await page.evaluate(
    async (source) => {
      globalThis.polylidar = await import(URL.createObjectURL(new Blob([source], { type: "text/javascript" })));
      globalThis.doubles = (base64) => new Float64Array(Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)).buffer);
      globalThis.plain = ({ vertices, ringEnds, polygonEnds, chosenSizes, area }) => ({
        vertices: [...vertices],
        ringEnds: [...ringEnds],
        polygonEnds: [...polygonEnds],
        chosenSizes,
        area,
      });
    },
    readFileSync(join(process.env.PACKAGE, "polylidar.js"), "utf8"),
  );
});

after(() => browser?.close());

test("hulls are those of the native core, index by index", async () => {
  let compared = 0;
  for (const { name, points, hulls, labels, options, labelled } of native_cases()) {
    const base64 = Buffer.from(points.buffer).toString("base64");
    if (hulls) {
      const made = await page.evaluate(
        ({ points, options }) => options.map((each) => plain(polylidar.concaveHull(doubles(points), each))),
        { points: base64, options: hulls.map((each) => each.options) },
      );
      made.forEach((hull, i) => assert_same(hull, hulls[i], `${name} ${JSON.stringify(hulls[i].options)}`));
      compared += made.length;
    } else {
      const made = await page.evaluate(
        ({ points, labels, options }) =>
          polylidar.concaveHulls(doubles(points), labels, options).map(({ label, hull }) => [label, plain(hull)]),
        { points: base64, labels, options },
      );
      assert.equal(made.length, labelled.length, name);
      made.forEach(([label, hull], i) => {
        assert.equal(label, labelled[i].label);
        assert_same(hull, labelled[i], `${name}, label ${label}`);
      });
      compared += made.length;
    }
  }
  assert.ok(compared > 300, `only ${compared} hulls were compared`);
});

test("an error has the core's sentence", async () => {
  const said = await page.evaluate(() => {
    try {
      polylidar.concaveHull([
        [0, 0],
        [0, NaN],
      ]);
    } catch (error) {
      return `${error.name}: ${error.message}`;
    }
  });
  assert.equal(said, "RangeError: point 1 is not finite");
});
