// Files that the tests' LAZ encoder wrote, unpacked by laz-perf: the decoder of somebody else, so that our encoder
// and our decoder cannot be wrong in the same way; and files of any bytes, unpacked by both decoders. WRITE_LAZ_FILES,
// PRINT_LAZ_POINTS and OUTPUT are given by ctest.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { createLazPerf } from "laz-perf";

const folder = process.env.OUTPUT;
execFileSync(process.env.WRITE_LAZ_FILES, [folder]);
const names = readdirSync(folder)
  .filter((name) => name.endsWith(".laz") && !name.startsWith("any"))
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

/** What our decoder reads of the points of `laz`, line by line; nothing where it refuses them. */
function printed(laz) {
  const path = join(folder, "any.laz");
  writeFileSync(path, laz);
  const { status, stdout } = spawnSync(process.env.PRINT_LAZ_POINTS, [path], { encoding: "utf8" });
  return status === 0 ? stdout.trim().split("\n") : undefined;
}

/** The same of records, without those that are withheld. */
function lines_of(bytes, size, is_layered) {
  const lines = [];
  for (let at = 0; at < bytes.length; at += size) {
    const [number, flags, classification] = bytes.subarray(at + 14);
    if (is_layered ? flags & 4 : flags & 128) continue;
    const attributes = is_layered ? [classification, number & 15] : [flags & 31, number & 7];
    const source = bytes.readUInt16LE(at + (is_layered ? 20 : 18));
    lines.push([bytes.readInt32LE(at), bytes.readInt32LE(at + 4), ...attributes, source].join(" "));
  }
  return lines;
}

/** `laz` with only `count` points promised, and with other bytes for those behind the first one. */
function with_other_bytes(laz, size, count, next_byte) {
  const other = Buffer.from(laz);
  const begin = laz.readUInt32LE(96) + 8 + size;
  other.writeUInt32LE(count, 107);
  if (laz[25] < 4) {
    for (let i = begin; i < begin + count * size; ++i) other[i] = next_byte();
  } else {
    // Nine layers behind their sizes.
    other.writeBigUInt64LE(BigInt(count), 247);
    const bytes = Array.from({ length: 9 }, (_, i) => laz.readUInt32LE(begin + 4 + 4 * i)).reduce((a, b) => a + b);
    for (let i = begin + 40; i < begin + 40 + bytes; ++i) other[i] = next_byte();
  }
  return other;
}

for (const format of [0, 1, 2, 3, 6]) {
  test(`any bytes are the same points to both decoders, format ${format}`, () => {
    const laz = readFileSync(join(folder, `wild${format}.laz`));
    const size = laz.readUInt16LE(105);
    let seed = format;
    const random = () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) >>> 24;
    const next_bytes = [random, () => (random() < 128 ? 0 : random()), () => (random() < 100 ? 255 : random())];
    let read = 0;
    for (let i = 0; i < 30; ++i) {
      const other = with_other_bytes(laz, size, 900, next_bytes[i % next_bytes.length]);
      const got = printed(other);
      if (got === undefined) continue;
      read += 1;
      assert.deepEqual(got, lines_of(unpacked(other, size), size, format >= 6), `file ${i}`);
    }
    assert.ok(read > 5, `only ${read} are read`);
  });
}
