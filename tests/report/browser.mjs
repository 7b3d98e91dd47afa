// A page of the report in Debian's Chromium without windows, or in another Chromium, watched: whatever it writes to the console and asks the network for is kept.
import { spawnSync } from "node:child_process";
import { chromium } from "playwright-core";

const NAMES = ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"];

/** The path of the system's browser. Throws when there is none. */
function browser_path() {
  for (const name of NAMES) {
    const found = spawnSync("sh", ["-c", `command -v ${name}`], { encoding: "utf8" }).stdout.trim();
    if (found) return found;
  }
  throw new Error(`no browser found (${NAMES.join(", ")}): 'make deps' installs Chromium on Debian.`);
}

/** Starts the browser. As root its sandbox does not work, and a bare system has no shared memory of a useful size. */
export function launch() {
  const root = process.getuid?.() === 0;
  return chromium.launch({
    executablePath: browser_path(),
    args: ["--disable-dev-shm-usage", ...(root ? ["--no-sandbox"] : [])],
  });
}

/** Opens a file, behind whose name a # may stand, without network. Gives the page, and `troubles`: what it said on the console and every request but for
    the file itself, as texts. */
export async function open_page(browser, file, { width = 1280, height = 900, theme = "light", ready, ...more } = {}) {
  const context = await browser.newContext({
    viewport: { width, height },
    colorScheme: theme,
    offline: true,
    reducedMotion: "reduce",
    ...more,
  });
  context.setDefaultTimeout(120_000);
  const page = await context.newPage();
  const troubles = [];
  const url = `file://${file}`;
  page.on(
    "console",
    (message) => ["error", "warning"].includes(message.type()) && troubles.push(`${message.type()}: ${message.text()}`),
  );
  page.on("pageerror", (error) => troubles.push(`exception: ${error.message}`));
  page.on(
    "request",
    (request) => request.url().split("#")[0] !== url.split("#")[0] && troubles.push(`request: ${request.url().slice(0, 100)}`),
  );
  await page.goto(url);
  if (ready) await page.waitForFunction(ready);
  return { page, troubles };
}
