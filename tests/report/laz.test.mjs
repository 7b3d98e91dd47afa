// Files that the tests' LAZ encoder wrote, unpacked by laz-perf: the decoder of somebody else, so that our encoder
// and our decoder cannot be wrong in the same way. WRITE_LAZ_FILES and OUTPUT are given by ctest.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { createLazPerf } from "laz-perf";

const folder = process.env.OUTPUT;
execFileSync(process.env.WRITE_LAZ_FILES, [folder]);
const names = readdirSync(folder)
  .filter((name) => name.endsWith(".laz"))
  .map((name) => name.slice(0, -4));
const lazperf = await createLazPerf();

/** The records of a LAS file, one behind the other. */
function records_of(las) {
  const size = las.readUInt16LE(105);
  const begin = las.readUInt32LE(96);
  return { size, bytes: las.subarray(begin, begin + size * las.readUInt32LE(107)) };
}

function unpacked(laz, size) {
  const file = lazperf._malloc(laz.length);
  lazperf.HEAPU8.set(laz, file);
  const reader = new lazperf.LASZip();
  reader.open(file, laz.length);
  assert.equal(reader.getPointLength(), size);
  const record = lazperf._malloc(size);
  const bytes = Buffer.alloc(size * reader.getCount());
  for (let at = 0; at < bytes.length; at += size) {
    reader.getPoint(record);
    bytes.set(lazperf.HEAPU8.subarray(record, record + size), at);
  }
  reader.delete();
  lazperf._free(record);
  lazperf._free(file);
  return bytes;
}

test("there are files of seven point formats", () => assert.equal(names.length, 35));

for (const name of names) {
  test(`laz-perf unpacks ${name}`, () => {
    const { size, bytes } = records_of(readFileSync(join(folder, `${name}.las`)));
    const got = unpacked(readFileSync(join(folder, `${name}.laz`)), size);
    assert.equal(got.length, bytes.length);
    // laz-perf 0.0.7 predicts colours and extra bytes otherwise than LASzip where scanner channels alternate.
    const compared = /^(scan|wild|extremes)[78]$/.test(name) ? 30 : size;
    for (let at = 0; at < bytes.length; at += size) {
      assert.deepEqual([...got.subarray(at, at + compared)], [...bytes.subarray(at, at + compared)], `point ${at / size}`);
    }
  });
}
