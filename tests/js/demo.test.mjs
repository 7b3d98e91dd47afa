// The demo page in Chromium, opened from the disk: PAGE is its file, PACKAGE the npm package's folder, OUTPUT a folder for
// the files that are opened and for screenshots.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { before } from "node:test";
import { pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import { example } from "../../core/js/demo/examples.js";
import { equal_area } from "../../core/js/demo/plane.js";
import { axe_findings, empty_output, output, page_tests } from "../report/page_tests.mjs";
import { las, pairs } from "./point_files.mjs";

const { PAGE, PACKAGE } = process.env;
const from_file = (path) => import(pathToFileURL(path));
const { concaveHull } = await from_file(join(PACKAGE, "polylidar.js"));
const methods = createRequire(new URL("../../adapters/manifests/package.json", import.meta.url));
const { default: concaveman } = await from_file(methods.resolve("concaveman"));
const DONE = () => document.body.dataset.state === "done";
const EXAMPLE = 20_000;

// The page may ask for its worker.
const { page_test: test_of_file } = page_tests({ ready: DONE }, (trouble) => !trouble.startsWith("request: blob:null/"));
const page_test = (name, options, body) => test_of_file(name, PAGE, options, body);
before(empty_output);

function file(name, content) {
  writeFileSync(output(name), content);
  return output(name);
}

const csv = (points) => "x,y\n" + points.map(([x, y]) => `${x},${y}\n`).join("");
const text = (page, id) => page.locator(`#${id}`).textContent();
const measure = new Intl.NumberFormat("en", { maximumSignificantDigits: 4 });
const count = new Intl.NumberFormat("en");

/** After something was done on the page: waits for its hull. */
async function settled(page) {
  await page.waitForTimeout(50);
  await page.waitForFunction(() => document.body.dataset.state !== "busy");
}

/** The page says of the hull of `xy` what the package gives. */
async function assert_shown(page, xy, options = {}, area_of = (hull) => measure.format(hull.area)) {
  const hull = concaveHull(xy, options);
  const parts = hull.polygonEnds.length;
  assert.equal(await text(page, "error"), "");
  assert.equal(await text(page, "points"), count.format(xy.length / 2));
  assert.equal(await text(page, "parts"), count.format(parts));
  assert.equal(await text(page, "holes"), count.format(hull.ringEnds.length - parts));
  assert.equal(await text(page, "vertices"), count.format(hull.vertices.length));
  assert.equal(await text(page, "area"), area_of(hull));
  assert.match(await text(page, "time"), /^[\d.]+ m?s$/);
}

/** What the download button gives. */
async function downloaded(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#download").click()]);
  return { name: download.suggestedFilename(), feature: JSON.parse(readFileSync(await download.path(), "utf8")) };
}

/** How many pixels of the canvas have the colour of that name in the style sheet. */
function pixels_of(page, name) {
  return page.evaluate((name) => {
    const canvas = document.getElementById("picture");
    const [, ...colour] = /#(..)(..)(..)/.exec(getComputedStyle(canvas).getPropertyValue(name)).map((c) => parseInt(c, 16));
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let found = 0;
    for (let i = 0; i < data.length; i += 4)
      found += data[i + 3] === 255 && colour.every((c, k) => Math.abs(data[i + k] - c) < 3);
    return found;
  }, name);
}

page_test("it begins with an example and its hull", {}, async (page) => {
  const xy = example(EXAMPLE);
  await assert_shown(page, xy);
  assert.equal(await text(page, "parts"), "4", "the land, its lake's island and two more");
  assert.equal(await text(page, "holes"), "1");
  await page.waitForTimeout(200);
  assert.ok((await pixels_of(page, "--hull")) > 2000, "the outline is drawn");
});

page_test("a LAS file is read, and its hull can be downloaded", { acceptDownloads: true }, async (page) => {
  const points = pairs(example(3000)).map(([x, y]) => [
    500000 + Math.round(100 * x) / 100,
    4000000 + Math.round(100 * y) / 100,
  ]);
  await page.locator("#file").setInputFiles(file("tile.las", las(points)));
  await settled(page);
  // As the file says it: an integer times its scale plus its offset.
  const offset = [500000, 4000000];
  const xy = Float64Array.from(points.flat(), (value, i) => Math.round((value - offset[i % 2]) / 0.01) * 0.01 + offset[i % 2]);
  await assert_shown(page, xy);
  assert.equal(await text(page, "source"), "tile.las (LAS 1.2)");
  const { name, feature } = await downloaded(page);
  assert.equal(name, "tile.hull.geojson");
  assert.equal(feature.properties.points, 3000);
  assert.deepEqual(feature.geometry, concaveHull(xy).toJSON());
});

page_test("a file can be dropped", {}, async (page) => {
  const points = pairs(example(500));
  const bytes = [...gzipSync(csv(points))];
  const dropped = await page.evaluateHandle((bytes) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([Uint8Array.from(bytes)], "points.csv.gz"));
    return transfer;
  }, bytes);
  await page.dispatchEvent("body", "dragenter", { dataTransfer: dropped });
  assert.ok(await page.locator(".drop").isVisible());
  await page.dispatchEvent("body", "drop", { dataTransfer: dropped });
  await settled(page);
  assert.ok(!(await page.locator(".drop").isVisible()));
  await assert_shown(page, Float64Array.from(points.flat()));
});

page_test("the slider changes the detail, by the keyboard too", {}, async (page) => {
  await page.locator("#detail").focus();
  for (let i = 0; i < 4; i++) await page.keyboard.press("ArrowRight");
  await settled(page);
  assert.equal(await text(page, "detail-value"), "2");
  await assert_shown(page, example(EXAMPLE), { detail: 2 });
  await page.keyboard.press("Home");
  await settled(page);
  await assert_shown(page, example(EXAMPLE), { detail: 1 / 8 });
});

page_test("everything can be reached by the keyboard", {}, async (page) => {
  const reached = [];
  for (let i = 0; i < 12; i++) {
    await page.keyboard.press("Tab");
    reached.push(await page.evaluate(() => document.activeElement.id || document.activeElement.dataset.example));
  }
  const expected = [
    "file",
    "20000",
    "1000000",
    "picture",
    "larger",
    "smaller",
    "fit",
    "detail",
    "download",
    "lonlat",
    "compare",
  ];
  assert.deepEqual(reached.slice(0, expected.length), expected);
});

page_test("the picture is enlarged, and shows all again", {}, async (page) => {
  const drawn = async () => {
    await page.waitForTimeout(200);
    return page.evaluate(() => document.getElementById("picture").toDataURL());
  };
  const whole = await drawn();
  await page.locator("#larger").click();
  assert.notEqual(await drawn(), whole);
  await page.locator("#smaller").click();
  assert.equal(await drawn(), whole);
  await page.locator("#larger").click();
  await page.locator("#fit").click();
  assert.equal(await drawn(), whole);
});

page_test("longitudes and latitudes are measured on an equal-area map", {}, async (page) => {
  const degrees = pairs(example(2000)).map(([x, y]) => [x / 100, 55 + y / 100]);
  const geojson = JSON.stringify({ type: "MultiPoint", coordinates: degrees });
  await page.locator("#file").setInputFiles(file("degrees.geojson", geojson));
  await settled(page);
  const xy = Float64Array.from(degrees.flat());
  assert.ok(await page.locator("#lonlat").isChecked());
  await assert_shown(page, equal_area(xy), {}, (hull) => `${measure.format(hull.area / 1e6)} km²`);
  await page.locator("#lonlat").uncheck();
  await settled(page);
  await assert_shown(page, xy);
});

page_test("concaveman's ring is shown beside the hull", {}, async (page) => {
  await page.locator("#compare").check();
  await page.waitForFunction(() => /s$/.test(document.getElementById("rival-time").textContent));
  const ring = concaveman(pairs(example(EXAMPLE)));
  const area = ring.slice(1).reduce((sum, [x, y], i) => sum + ring[i][0] * y - x * ring[i][1], 0) / 2;
  assert.equal(await text(page, "rival-area"), measure.format(Math.abs(area)));
  await page.waitForTimeout(200);
  assert.ok((await pixels_of(page, "--rival")) > 500, "the ring is drawn");
  await page.locator("#compare").uncheck();
  assert.ok(!(await page.locator("#rival").isVisible()));
});

page_test("what cannot be read is said in one sentence, and the page goes on", {}, async (page) => {
  const bad = {
    "packed.laz": [las([[500000, 4000000]], { format: 128 }), /^packed\.laz: the points are compressed \(LAZ\).*\.$/],
    "empty.csv": ["", /^empty\.csv: the file is empty\.$/],
    "words.csv": ["1,2\nthree,4\n", /^words\.csv: line 2: 'three' is not a finite number\.$/],
  };
  for (const [name, [content, sentence]] of Object.entries(bad)) {
    await page.locator("#file").setInputFiles(file(name, content));
    await settled(page);
    assert.match(await text(page, "error"), sentence);
    assert.ok(await page.locator("#error").isVisible());
  }
  await page.locator("#file").setInputFiles(file("range.csv", "0,0\n1e-300,1\n1e300,2\n"));
  await settled(page);
  assert.match(await text(page, "error"), /^range\.csv: coordinates span more than/);
  await page.locator("#file").setInputFiles(file("line.csv", "0,0\n1,1\n2,2\n"));
  await settled(page);
  assert.match(await text(page, "status"), /^3 points: no shape/);
  assert.ok(await page.locator("#download").isDisabled());
  await page.locator("[data-example='20000']").click();
  await settled(page);
  await assert_shown(page, example(EXAMPLE));
});

page_test("a million points, and the page does not freeze meanwhile", {}, async (page) => {
  await page.evaluate(() => {
    globalThis.ticks = 0;
    setInterval(() => (globalThis.ticks += document.body.dataset.state === "busy"), 1);
  });
  await page.locator("[data-example='1000000']").click();
  await settled(page);
  assert.equal(await text(page, "points"), "1,000,000");
  assert.equal(await text(page, "parts"), "4");
  assert.ok((await page.evaluate(() => ticks)) > 10, "the page had no turn while the hull was made");
  console.log(`the hull of 1,000,000 points took ${await text(page, "time")} in Chromium`);
});

for (const theme of ["light", "dark"]) {
  for (const width of [1400, 390]) {
    page_test(`it is readable at ${width} pixels, ${theme}`, { width, height: 850, theme }, async (page) => {
      await page.locator("#compare").check();
      await page.waitForFunction(() => /s$/.test(document.getElementById("rival-time").textContent));
      await page.locator("#file").setInputFiles(file("bad.csv", "1,2\nthree,4\n"));
      await settled(page);
      await page.waitForTimeout(200);
      await page.screenshot({ path: output(`page-${width}-${theme}.png`), fullPage: true });
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "it is wider than the window");
      assert.deepEqual(await axe_findings(page, {}), []);
    });
  }
}
