// The package's types, by TypeScript itself: PACKAGE is its folder, OUTPUT one for a project that uses it.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { copyFileSync, mkdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { before, test } from "node:test";
import { pathToFileURL } from "node:url";

const { PACKAGE, OUTPUT } = process.env;
const tsc = createRequire(new URL("../report/", import.meta.url)).resolve("typescript/bin/tsc");
const own_file = (name) => new URL(`types/${name}`, import.meta.url);

const LOADS = {
  "names.mts": 'import * as polylidar from "polylidar";',
  "names.cts": 'import polylidar = require("polylidar");',
};
let lines;

/** Of a file in the project: a line for each error, "NAME(LINE,COLUMN): ...". */
const errors_of = (name) => lines.filter((line) => line.startsWith(`${name}(`));

before(async () => {
  rmSync(OUTPUT, { recursive: true, force: true });
  mkdirSync(join(OUTPUT, "node_modules"), { recursive: true });
  symlinkSync(resolve(PACKAGE), join(OUTPUT, "node_modules", "polylidar"));
  const own = ["use.mts", "use.cts", "misuse.mts"];
  for (const name of own) copyFileSync(own_file(name), join(OUTPUT, name));
  const names = Object.keys(await import(pathToFileURL(join(PACKAGE, "polylidar.js"))));
  const members = names.map((name) => `"${name}": true`).join(", ");
  for (const [name, load] of Object.entries(LOADS))
    writeFileSync(join(OUTPUT, name), `${load}\nexport const all: Record<keyof typeof polylidar, true> = { ${members} };\n`);
  // All files at once, as most of the time goes into TypeScript's own types.
  const words = [tsc, "--noEmit", "--strict", "--target", "es2022", "--module", "nodenext", ...own, ...Object.keys(LOADS)];
  const { stdout, error } = spawnSync(process.execPath, words, { cwd: OUTPUT, encoding: "utf8" });
  assert.equal(error, undefined);
  lines = stdout.split("\n").filter((line) => /^\S/.test(line));
});

for (const [what, name] of [
  ["an ES module", "use.mts"],
  ["CommonJS", "use.cts"],
])
  test(`${what} can use everything`, () => assert.deepEqual(errors_of(name), []));

test("each misuse is an error", () => {
  const marked = readFileSync(own_file("misuse.mts"), "utf8")
    .split("\n")
    .flatMap((line, i) => (line.includes("// wrong:") ? [i + 1] : []));
  assert.ok(marked.length > 5);
  const found = errors_of("misuse.mts").map((line) => Number(/^misuse\.mts\((\d+),/.exec(line)[1]));
  assert.deepEqual([...new Set(found)], marked);
});

test("the types name what there is, and nothing else", () => {
  for (const name of Object.keys(LOADS)) assert.deepEqual(errors_of(name), [], name);
});

test("there is no error beside those of a file", () => {
  assert.deepEqual(
    lines.filter((line) => !/^(misuse|use|names)\.[cm]ts\(/.test(line)),
    [],
  );
});
