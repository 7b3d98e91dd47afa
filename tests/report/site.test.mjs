// The site in a browser, made from the invented run of tests/invented_run.cpp: one page of each kind.
//
// The environment says where things are: WRITE_INVENTED_REPORT is that program, PYTHON the Python for plots/, OUTPUT the folder
// for the run, the site and its screenshots.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { launch, open_page } from "./browser.mjs";
import { cases_csv } from "./invented_cases.mjs";
import { write_invented_pictures } from "./invented_pictures.mjs";

const { WRITE_INVENTED_REPORT, PYTHON = "python3", OUTPUT } = process.env;
const NAME = "2026-01-02-0123abcd";
const folder = join(OUTPUT, NAME);
const site = join(OUTPUT, "site");
const make_site = fileURLToPath(new URL("../../plots/make_site.py", import.meta.url));
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
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
const READY = () => document.getElementById("search").hidden === false;

let browser;

function run_program(program, ...words) {
  const { status, stdout, stderr } = spawnSync(program, words, { encoding: "utf8" });
  assert.equal(status, 0, `${program} ${words.join(" ")}: ${stdout}${stderr}`);
}

before(async () => {
  rmSync(OUTPUT, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  run_program(WRITE_INVENTED_REPORT, join(folder, "report.json"));
  write_invented_pictures(folder);
  writeFileSync(join(folder, "cases.csv"), cases_csv(JSON.parse(readFileSync(join(folder, "report.json")))));
  run_program(PYTHON, make_site, folder, "--out", site);
  browser = await launch();
});

after(() => browser?.close());

const file_of = (kind) => join(site, `${kind}.html`);

function page_test(name, kind, options, body) {
  test(name, async () => {
    const { page, troubles } = await open_page(browser, file_of(kind), { ready: READY, ...options });
    await body(page);
    assert.deepEqual(troubles, []);
    await page.context().close();
  });
}

for (const kind of KINDS) {
  for (const [width, theme] of [
    [1400, "light"],
    [800, "dark"],
    [390, "light"],
    [390, "dark"],
  ]) {
    page_test(`${kind} is readable and accessible at ${width} pixels, ${theme}`, kind, { width, theme }, async (page) => {
      assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), theme);
      for (const one of await page.locator("details").all()) await one.evaluate((box) => (box.open = true));
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
      await page.screenshot({ path: join(OUTPUT, `${kind.replace("/", "-")}-${width}-${theme}.png`), fullPage: true });
      await page.evaluate(axe);
      const { violations } = await page.evaluate(() =>
        window.axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"] }),
      );
      const told = violations.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map((node) => node.html.slice(0, 120))}`);
      assert.deepEqual(told, []);
    });
  }
}

test("the search finds a page and leads there, by keyboard alone", async () => {
  const { page } = await open_page(browser, file_of("methods/polylidar"), { ready: READY });
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
  "methods/polylidar",
  { javaScriptEnabled: false, ready: null },
  async (page) => {
    assert.equal(await page.locator("#search").isVisible(), false);
    const pictures = readFileSync(file_of("methods/polylidar"), "utf8").match(/data-run=/g).length;
    assert.ok(pictures > 0 && pictures <= 10, `${pictures} pictures`);
    assert.equal(await page.locator(".strip.many li:visible").count(), pictures);
    assert.ok((await page.locator(".contents a:visible").count()) >= 7);
  },
);

test("a picture leads to its case in the report", async () => {
  const { page } = await open_page(browser, file_of("index"), { ready: READY });
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
  for (const kind of KINDS) assert.ok(readFileSync(file_of(kind)).length < 2 ** 20, kind);
});
