// The page of `hullbench choose` in a browser, of real methods on California with noise.
//
// The environment says where things are: HULLBENCH is that program, OUTPUT the folder for the points, the page and its
// screenshots.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launch, open_page } from "./browser.mjs";

const { HULLBENCH, OUTPUT } = process.env;
const FILE = join(OUTPUT, "points.csv.choice.html");
const METHODS = ["polylidar", "cgal_alpha_shape", "cgal_delaunay", "geos_concave_hull", "chi_shape", "knn_hull", "convex_hull"];
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

let browser;

function hullbench(...words) {
  const { status, stdout, stderr } = spawnSync(HULLBENCH, words, { cwd: OUTPUT, encoding: "utf8" });
  assert.equal(status, 0, `${words.join(" ")}: ${stderr}`);
  return stdout;
}

before(async () => {
  rmSync(OUTPUT, { recursive: true, force: true });
  mkdirSync(OUTPUT, { recursive: true });
  hullbench("points", "ca~noise:0.5", "--n", "5000", "--holes", "--out", "points.csv");
  hullbench("choose", "points.csv", "--draws", "1", ...METHODS.flatMap((method) => ["--only", method]));
  browser = await launch();
});
after(() => browser?.close());

for (const [width, theme] of [
  [1400, "light"],
  [1400, "dark"],
  [800, "light"],
  [390, "light"],
  [390, "dark"],
]) {
  test(`is readable and accessible at ${width} pixels, ${theme}`, async () => {
    const { page, troubles } = await open_page(browser, FILE, { width, theme });
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
    const cards = page.locator(".card");
    assert.ok((await cards.count()) > METHODS.length);
    // What getBBox() gives has no properties of its own, so nothing of it would arrive here.
    const pictures = await page.locator(".card svg").evaluateAll((all) => {
      const size = ({ width, height }) => ({ width, height });
      return all.map((svg) => [size(svg.getBoundingClientRect()), size(svg.querySelector(".hull").getBBox())]);
    });
    assert.equal(pictures.length, await cards.count());
    for (const [box, hull] of pictures) {
      assert.ok(box.width >= Math.min(width - 80, 250) && box.height >= 250, `${box.width} x ${box.height}`);
      assert.ok(hull.width > 500 && hull.height > 500, "the hull fills its frame");
    }
    await page.screenshot({ path: join(OUTPUT, `choice-${width}-${theme}.png`), fullPage: true });
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() =>
      window.axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"] }),
    );
    assert.deepEqual(
      violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 120)}`),
      [],
    );
    assert.deepEqual(troubles, []);
    await page.context().close();
  });
}

test("a picture grows when it is chosen, without scripts", async () => {
  const { page, troubles } = await open_page(browser, FILE, { width: 1400, javaScriptEnabled: false });
  const card = page.locator(".card").nth(1);
  const { width } = await card.boundingBox();
  await card.locator("svg").click();
  assert.ok((await card.boundingBox()).width > 2 * width);
  await page.screenshot({ path: join(OUTPUT, "choice-grown.png") });
  await card.locator(".smaller").click();
  assert.equal((await card.boundingBox()).width, width);
  assert.deepEqual(troubles, []);
  await page.context().close();
});

test("the page is small", () => assert.ok(statSync(FILE).size < 2 * 2 ** 20));
