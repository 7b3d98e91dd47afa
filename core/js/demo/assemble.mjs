// Puts the page into one file: assemble.mjs SCRIPT MODULES OUTPUT, where the folder MODULES has the npm packages in it.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";

const [script_file, modules, output] = process.argv.slice(2);
const here = (name) => readFileSync(new URL(name, import.meta.url), "utf8");
const script = readFileSync(script_file, "utf8");
const hash = createHash("sha256").update(script).digest("base64");

// No request leaves the page; its worker, which is made of a text in it, may compile the module.
const policy =
  `default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-${hash}' 'wasm-unsafe-eval' blob:; worker-src blob:; ` +
  "base-uri 'none'; form-action 'none'";

// concaveman and what it is made of.
const packages = ["concaveman", "rbush", "quickselect", "tinyqueue", "point-in-polygon", "robust-predicates"];
const licences = packages.map((name) => `${name}\n\n${readFileSync(`${modules}/${name}/LICENSE`, "utf8").trim()}`);
const notices = `<!--\nParts of this page are from:\n\n${licences.join("\n\n").replaceAll("--", "- -")}\n-->`;

const values = { policy, script, notices, style: here("page.css") };
writeFileSync(
  output,
  here("index.html").replace(/\{\{(\w+)\}\}/g, (_, name) => values[name]),
);
