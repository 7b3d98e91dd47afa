// The page of `hullbench choose` in a browser, of real methods on California with noise.
//
// The environment says where things are: HULLBENCH is that program, OUTPUT the folder for the points, the page and its
// screenshots.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { before, test } from "node:test";
import { assert_readable, empty_output, hullbench, output, page_tests, screen_options } from "./page_tests.mjs";

const FILE = "points.csv.choice.html";
const METHODS = ["polylidar", "cgal_alpha_shape", "cgal_delaunay", "geos_concave_hull", "chi_shape", "knn_hull", "convex_hull"];
const { page_test } = page_tests();

before(() => {
  empty_output();
  hullbench("points", "ca~noise:0.5", "--n", "5000", "--holes", "--out", "points.csv");
  hullbench("choose", "points.csv", "--draws", "1", ...METHODS.flatMap((method) => ["--only", method]));
});

for (const screen of ["1400 light", "390 dark"]) {
  page_test(`is readable and accessible at ${screen}`, FILE, screen_options(screen), async (page) => {
    const cards = page.locator(".card");
    assert.ok((await cards.count()) > METHODS.length);
    // What getBBox() gives has no properties of its own, so nothing of it would arrive here.
    const pictures = await page.locator(".card svg").evaluateAll((all) => {
      const size = ({ width, height }) => ({ width, height });
      return all.map((svg) => [size(svg.getBoundingClientRect()), size(svg.querySelector(".hull").getBBox())]);
    });
    assert.equal(pictures.length, await cards.count());
    for (const [box, hull] of pictures) {
      assert.ok(
        box.width >= Math.min(page.viewportSize().width - 80, 250) && box.height >= 250,
        `${box.width} x ${box.height}`,
      );
      assert.ok(hull.width > 500 && hull.height > 500, "the hull fills its frame");
    }
    await assert_readable(page, `choice-${screen.replace(" ", "-")}`, 800);
  });
}

const without_scripts = { width: 1400, javaScriptEnabled: false };
page_test("a picture grows when it is chosen, without scripts", FILE, without_scripts, async (page) => {
  const card = page.locator(".card").nth(1);
  const { width } = await card.boundingBox();
  await card.locator("svg").click();
  assert.ok((await card.boundingBox()).width > 2 * width);
  await page.screenshot({ path: output("choice-grown.png") });
  await card.locator(".smaller").click();
  assert.equal((await card.boundingBox()).width, width);
});

test("the page is small", () => assert.ok(statSync(output(FILE)).size < 2 * 2 ** 20));
