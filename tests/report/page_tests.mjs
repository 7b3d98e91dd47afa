// What the tests of pages in a browser have in common.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { launch, open_page } from "./browser.mjs";

const { WRITE_INVENTED_REPORT, HULLBENCH, PYTHON = "python3" } = process.env;
const OUTPUT = resolve(process.env.OUTPUT);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const WCAG = { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"] };

/** That of a page with charts. */
export const CHARTS_READY = () => document.documentElement.dataset.ready === "charts";

/** A file or folder of OUTPUT. */
export const output = (...names) => join(OUTPUT, ...names);

export function empty_output() {
  rmSync(OUTPUT, { recursive: true, force: true });
  mkdirSync(OUTPUT, { recursive: true });
}

export const read_json = (...names) => JSON.parse(readFileSync(output(...names), "utf8"));

/** What the program prints; it must end well. */
function run_program(program, words, options = {}) {
  const { status, stdout, stderr } = spawnSync(program, words, { encoding: "utf8", maxBuffer: 1e8, ...options });
  assert.equal(status, 0, `${program} ${words.join(" ")}: ${stdout}${stderr}`);
  return stdout;
}

/** The program, run in OUTPUT. */
export const hullbench = (...words) => run_program(resolve(HULLBENCH), words, { cwd: OUTPUT });

/** Runs one of the programs of plots/. */
export const plot = (name, ...words) =>
  run_program(PYTHON, [fileURLToPath(new URL(`../../plots/${name}`, import.meta.url)), ...words]);

/** Writes the invented run of tests/invented_run.cpp into a folder of OUTPUT; its report. */
export function write_invented_report(folder) {
  mkdirSync(output(folder), { recursive: true });
  run_program(WRITE_INVENTED_REPORT, [output(folder, "report.json")]);
  return read_json(folder, "report.json");
}

/** {open_file, page_test}, with a browser for all tests of a file. Options are those of open_page, `hash` what stands behind
    the file's name, which is one of OUTPUT or a path. page_test makes a test with a page of its own, in which nothing may go
    wrong on the side but what `is_trouble` does not count. */
export function page_tests(defaults = {}, is_trouble = () => true) {
  let browser;
  before(async () => (browser = await launch()));
  after(() => browser?.close());
  const open_file = (name, { hash = "", ...options } = {}) =>
    open_page(browser, resolve(OUTPUT, name) + hash, { ...defaults, ...options });
  const page_test = (name, file, options, body) =>
    test(name, async () => {
      const { page, troubles } = await open_file(file, options);
      await body(page);
      assert.deepEqual(troubles.filter(is_trouble), []);
      await page.context().close();
    });
  return { open_file, page_test };
}

/** The options of a screen such as "390 dark". */
export function screen_options(screen) {
  const [width, theme] = screen.split(" ");
  return { width: Number(width), theme };
}

/** What axe finds, as texts. It runs outside of the page's policy, which forbids scripts of others. */
export async function axe_findings(page, rules = WCAG, keep = () => true) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate((chosen) => window.axe.run(document, chosen), rules);
  const places = (nodes) => nodes.slice(0, 3).map((node) => node.html.slice(0, 120));
  return violations.filter(keep).map(({ id, nodes }) => `${id}: ${places(nodes).join(" | ")}`);
}

/** Nothing is wider than the window, here nor at `other_width`, and axe finds nothing; keeps a screenshot in OUTPUT. */
export async function assert_readable(page, screenshot, other_width) {
  const assert_fits = async () =>
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), page.viewportSize().width);
  await assert_fits();
  await page.screenshot({ path: output(`${screenshot}.png`), fullPage: true });
  assert.deepEqual(await axe_findings(page), []);
  await page.setViewportSize({ width: other_width, height: 900 });
  // Charts are drawn anew when they hear of it.
  await page.evaluate(() => new Promise((done) => setTimeout(() => requestAnimationFrame(done), 300)));
  await assert_fits();
}

export function assert_ascending(values) {
  assert.deepEqual(
    values,
    [...values].sort((a, b) => a - b),
  );
}

/** Whether a text such as "7.83 %" is the value with as many digits as it has, three at least. */
export function assert_shows(text, value, what) {
  const digits = /^-?[0-9]+(?:\.([0-9]+))?/.exec(text.trim());
  assert.ok(digits, `${what}: "${text}" is no number`);
  assert.equal(digits[0], value.toFixed(digits[1]?.length ?? 0), what);
  assert.ok(digits[0].replace(/[-.]/g, "").replace(/^0+/, "").length >= 3, `${what}: "${text}" has too few digits`);
}

/** The runs that rows of a table or cards show. */
export const runs_of = (elements) => elements.evaluateAll((all) => all.map((one) => one.dataset.run));

/** The rows of the table of all runs as objects by column, with the run's name. */
export async function rows_of(page) {
  return page.locator("#runs-table").evaluate((table) => {
    const columns = [...table.tHead.rows[0].cells].map((cell) => cell.dataset.column ?? "");
    return [...table.tBodies[0].rows].map((row) => {
      const cells = [...row.cells].map((cell, index) => [columns[index], cell.innerText.trim()]);
      return { run: row.dataset.run, ...Object.fromEntries(cells) };
    });
  });
}
