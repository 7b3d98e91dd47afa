// What "make js" says at its end: a stand-in for cmake says what cmake would.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { test } from "node:test";

const here = (name) => new URL(`../../${name}`, import.meta.url);

/** The lines of "make js" from the last step on, where cmake says `said`. */
function end_of_make(said) {
  const folder = mkdtempSync(join(tmpdir(), "make_js_"));
  try {
    copyFileSync(here("Makefile"), join(folder, "Makefile"));
    writeFileSync(join(folder, "cmake"), `#!/bin/sh\n[ "$1" != --preset ] || echo '-- ${said}'\n`, { mode: 0o755 });
    const { status, stdout, stderr } = spawnSync("make", ["js", "SKIP_DEPS=1", "JOBS=1"], {
      cwd: folder,
      encoding: "utf8",
      env: { PATH: [folder, process.env.PATH].join(delimiter) },
    });
    assert.equal(status, 0, stderr);
    const lines = stdout.trimEnd().split("\n");
    return lines.slice(lines.findIndex((line) => line.startsWith("==> compiling")) + 1);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

test("make js names what it has built, and why there is no page", () => {
  const [, reason] = readFileSync(here("core/js/CMakeLists.txt"), "utf8").match(
    /message\(STATUS "(demo\.html: not built[^"]*)"\)/,
  );
  assert.deepEqual(end_of_make(reason), ["==> build-js/polylidar", `==> ${reason}`]);
  assert.deepEqual(end_of_make("Configuring done"), ["==> build-js/polylidar and build-js/demo.html"]);
});
