// Puts the page into one file: assemble.mjs SCRIPT OUTPUT.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";

const [script_file, output] = process.argv.slice(2);
const here = (name) => readFileSync(new URL(name, import.meta.url), "utf8");
const script = readFileSync(script_file, "utf8");
const hash = createHash("sha256").update(script).digest("base64");

// No request leaves the page; its worker, which is made of a text in it, may compile the module.
const policy =
  `default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-${hash}' 'wasm-unsafe-eval' blob:; worker-src blob:; ` +
  "base-uri 'none'; form-action 'none'";

const values = { policy, script, style: here("page.css") };
writeFileSync(
  output,
  here("index.html").replace(/\{\{(\w+)\}\}/g, (_, name) => values[name]),
);
