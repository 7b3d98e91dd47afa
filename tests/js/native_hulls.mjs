// What the native core makes of shared point sets: WRITE_NATIVE_HULLS is the program that says, OUTPUT a folder for it.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { join } from "node:path";

const ARRAYS = ["vertices", "ringEnds", "polygonEnds"];

/** The cases, with their points as an array of doubles. */
export function native_cases() {
  const { WRITE_NATIVE_HULLS, OUTPUT } = process.env;
  const folder = join(OUTPUT, "native");
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const { status, stderr } = spawnSync(WRITE_NATIVE_HULLS, [folder], { encoding: "utf8" });
  assert.equal(status, 0, stderr);
  // JSON has no infinity: a number that is too large for a double is one.
  const cases = JSON.parse(readFileSync(join(folder, "cases.json"), "utf8"));
  assert.ok(cases.length > 40, "the program wrote hardly any case");
  for (const each of cases) {
    const bytes = readFileSync(join(folder, each.points));
    each.points = new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
  }
  return cases;
}

/** A hull of the package with plain members, as it comes from a browser too. */
export function plain({ vertices, ringEnds, polygonEnds, chosenSizes, area }) {
  return { vertices: [...vertices], ringEnds: [...ringEnds], polygonEnds: [...polygonEnds], chosenSizes, area };
}

/** Everything is the same but for the last digits of what logarithms went into: they are not the same in every library. */
export function assert_same(actual, expected, what) {
  for (const name of ARRAYS) assert.deepEqual(actual[name], expected[name], `${what}: ${name}`);
  if ("area" in expected) assert.equal(actual.area, expected.area, `${what}: area`);
  if (!expected.chosenSizes) return assert.equal(actual.chosenSizes, null, what);
  for (const [name, size] of Object.entries(expected.chosenSizes)) {
    const chosen = actual.chosenSizes[name];
    assert.ok(Math.abs(chosen - size) <= 1e-13 * size, `${what}: ${name} is ${chosen} instead of ${size}`);
  }
}
