// The site in a browser, made from the invented run of tests/invented_run.cpp: one page of each kind.
//
// The environment says where things are: WRITE_INVENTED_REPORT is that program, PYTHON the Python for plots/, OUTPUT the folder
// for the run, the site and its screenshots.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { before, test } from "node:test";
import { cases_csv } from "./invented_cases.mjs";
import { write_invented_pictures } from "./invented_pictures.mjs";
import {
  assert_readable,
  empty_output,
  output,
  page_tests,
  plot,
  screen_options,
  write_invented_report,
} from "./page_tests.mjs";

const NAME = "2026-01-02-0123abcd";
const KINDS = [
  "index",
  "methods/index",
  "methods/polylidar",
  "datasets/index",
  "datasets/hi",
  "zoo/index",
  "zoo/zoo-geos-754",
  "add",
  "downloads",
];
const { open_file, page_test } = page_tests({ ready: () => document.getElementById("search").hidden === false });

before(() => {
  empty_output();
  const report = write_invented_report(NAME);
  write_invented_pictures(output(NAME));
  writeFileSync(output(NAME, "cases.csv"), cases_csv(report));
  plot("make_site.py", output(NAME), "--out", output("site"));
});

const page_of = (kind) => join("site", `${kind}.html`);

for (const kind of KINDS) {
  for (const screen of ["1400 light", "390 dark"]) {
    const options = screen_options(screen);
    page_test(`${kind} is readable and accessible at ${screen}`, page_of(kind), options, async (page) => {
      assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), options.theme);
      for (const one of await page.locator("details").all()) await one.evaluate((box) => (box.open = true));
      await assert_readable(page, `${kind} ${screen}`.replace(/[/ ]/g, "-"), 800);
    });
  }
}

test("the search finds a page and leads there, by keyboard alone", async () => {
  const { page } = await open_file(page_of("methods/polylidar"));
  const active = () => page.evaluate(() => document.activeElement.id || document.activeElement.innerText);
  for (let k = 0; k < 6 && (await active()) !== "search-words"; ++k) await page.keyboard.press("Tab");
  assert.equal(await active(), "search-words");
  await page.keyboard.type("geos 754");
  assert.equal(await page.locator("#search-said").innerText(), "1 page");
  await page.keyboard.press("Escape");
  assert.equal(await page.locator("#search-found a").count(), 0);
  await page.keyboard.type("ZOO");
  assert.match(await page.locator("#search-said").innerText(), /^7\d pages, of which 12 are shown$/);
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowDown");
  const chosen = await page.evaluate(() => document.activeElement.href);
  assert.equal(
    chosen,
    await page
      .locator("#search-found a")
      .nth(1)
      .evaluate((one) => one.href),
  );
  await Promise.all([page.waitForURL(chosen), page.keyboard.press("Enter")]);
  assert.equal(await page.locator("#search").isVisible(), true);
  await page.context().close();
});

page_test(
  "without scripts all is there but the search",
  page_of("methods/polylidar"),
  { javaScriptEnabled: false, ready: null },
  async (page) => {
    assert.equal(await page.locator("#search").isVisible(), false);
    const pictures = readFileSync(output(page_of("methods/polylidar")), "utf8").match(/data-run=/g).length;
    assert.ok(pictures > 0 && pictures <= 10, `${pictures} pictures`);
    assert.equal(await page.locator(".strip.many li:visible").count(), pictures);
    assert.ok((await page.locator(".contents a:visible").count()) >= 7);
  },
);

test("a picture leads to its case in the report", async () => {
  const { page } = await open_file(page_of("index"));
  const card = page.locator("#strip a").first();
  const run = await card.getAttribute("data-run");
  await card.focus();
  await page.keyboard.press("Enter");
  await page.waitForURL(/report\.html/);
  await page.locator('dialog[open][data-ready="true"]').waitFor();
  assert.equal(await page.locator("dialog tr.chosen").getAttribute("data-run"), run);
  await page.context().close();
});

test("its pages are small", () => {
  for (const kind of KINDS) assert.ok(readFileSync(output(page_of(kind))).length < 2 ** 20, kind);
});
