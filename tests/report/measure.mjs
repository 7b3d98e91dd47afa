// How large a report is and how long it takes to open.
//
//   node measure.mjs FILE    prints both; exit status 1 when the file is larger than 5 MiB
//
// Opened five times, each time in a new window: the median time until the page is laid out ("load"), until the charts are
// drawn and until the first pictures of the gallery, with that in view, are painted.
import { statSync } from "node:fs";
import { resolve } from "node:path";
import { launch, open_page } from "./browser.mjs";

const LIMIT = 5 * 2 ** 20;
const OPENINGS = 5;
const file = resolve(process.argv[2]);
const bytes = statSync(file).size;
const browser = await launch();
const taken = { load: [], charts: [], pictures: [] };

for (let k = 0; k < OPENINGS; ++k) {
  const started = performance.now();
  const { page, troubles } = await open_page(browser, file);
  taken.load.push(performance.now() - started);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "charts");
  taken.charts.push(performance.now() - started);
  if (await page.locator("#gallery").isVisible()) {
    await page.locator("#gallery").evaluate((section) => section.scrollIntoView());
    await page.locator(".gallery-card canvas.painted").first().waitFor();
    taken.pictures.push(performance.now() - started);
  }
  if (troubles.length > 0) console.log(troubles.join("\n"));
  await page.context().close();
}
await browser.close();

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
console.log(`${(bytes / 2 ** 20).toFixed(2)} MiB of at most ${LIMIT / 2 ** 20}`);
for (const [what, values] of Object.entries(taken))
  if (values.length > 0) console.log(`${what}: ${(median(values) / 1000).toFixed(2)} s`);
process.exit(bytes > LIMIT ? 1 : 0);
