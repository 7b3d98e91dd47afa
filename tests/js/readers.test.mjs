// The demo page's readers of files, in Node.
import assert from "node:assert/strict";
import { test } from "node:test";
import { gzipSync } from "node:zlib";
import { FileError, read_points } from "../../core/js/demo/readers.js";
import { equal_area } from "../../core/js/demo/plane.js";
import { las, npy, pairs } from "./point_files.mjs";

const ROWS = pairs([1, 2, -3.5, 4, 0.25, -7]);
const read = (content) => read_points(new Uint8Array(Buffer.from(content)));

async function assert_rows(content, rows = ROWS, lonlat = false) {
  const result = await read(content);
  assert.deepEqual([...result.xy], rows.flat());
  assert.equal(result.lonlat, lonlat);
}

async function assert_refused(content, sentence) {
  await assert.rejects(read(content), (error) => {
    assert.ok(error instanceof FileError, error.stack);
    assert.match(error.message, sentence);
    return true;
  });
}

test("columns of text", async () => {
  await assert_rows("1,2\n-3.5,4\n.25,-7\n");
  await assert_rows("x,y\n1,2\n-3.5,4\n.25,-7");
  await assert_rows("# a remark\r\n1 2 9\r\n\r\n  -3.5\t4 9\r\n2.5e-1 -7 9\r\n");
  await assert_rows('name;Y;X\n"a;b";2;1\nc;4;"-3.5"\nd;-7;0.25\n');
  await assert_rows("id\tlon\tlat\n7\t1\t2\n7\t-3.5\t4\n7\t0.25\t-7\n", ROWS, true);
  await assert_rows("\ufeffx,y\n1,2\n-3.5,4\n.25,-7\n");
  await assert_rows(gzipSync("1,2\n-3.5,4\n.25,-7\n"));
  await assert_rows("x,y\n", []);
  await assert_rows("id,x,y\n#1,1,2\n#2,-3.5,4\n#3,.25,-7\n");
  await assert_rows('x,y,"a; b"\n1,2,c\n-3.5,4,d\n.25,-7,e\n');
  await assert_rows("site,x,y,2020\na,1,2,0\nb,-3.5,4,0\nc,.25,-7,0\n");
});

test("GeoJSON", async () => {
  const multipoint = { type: "MultiPoint", coordinates: ROWS.map((row) => [...row, 100]) };
  await assert_rows(JSON.stringify(multipoint), ROWS, true);
  const feature = (geometry) => ({ type: "Feature", properties: { type: "x" }, geometry });
  const points = ROWS.map((coordinates) => feature({ type: "Point", coordinates }));
  await assert_rows(JSON.stringify({ type: "FeatureCollection", features: [...points, feature(null)] }), ROWS, true);
  const polygon = { type: "Polygon", coordinates: [ROWS] };
  await assert_rows(` \n${JSON.stringify({ type: "GeometryCollection", geometries: [polygon] })}`, ROWS, true);
  const named = { ...multipoint, crs: { type: "name", properties: { name: "urn:ogc:def:crs:EPSG::25832" } } };
  await assert_rows(JSON.stringify(named));
  await assert_rows(JSON.stringify({ type: "MultiPoint", coordinates: [[500000, 4000000]] }), [[500000, 4000000]]);
});

test("NPY", async () => {
  await assert_rows(npy(ROWS));
  await assert_rows(npy(ROWS, ">f8", { version: 2 }));
  await assert_rows(npy(ROWS, "<f4", { fortran: true }));
  await assert_rows(npy(pairs([1, 2, 9, 3, 4, 9], 3), ">i4"), pairs([1, 2, 3, 4]));
  await assert_rows(npy(pairs([1, 2, -3, 4]), "<i8", { version: 3 }), pairs([1, 2, -3, 4]));
});

test("LAS", async () => {
  const rows = pairs([500001.25, 4000002.5, 499999.5, 4000000]);
  await assert_rows(las(rows), rows);
  await assert_rows(las(rows, { minor: 4 }), rows);
  assert.equal((await read(las(rows, { minor: 4 }))).format, "LAS 1.4");
  const withheld = [las(rows), las(rows, { minor: 4 })];
  withheld[0][227 + 15] = 128;
  withheld[1][375 + 15] = 4;
  for (const file of withheld) await assert_rows(file, rows.slice(1));
  await assert_rows(las([]), []);
});

test("what is none is refused in one sentence", async () => {
  await assert_refused("", /^the file is empty$/);
  await assert_refused("1,2\n3,four\n", /^line 2: 'four' is not a finite number$/);
  await assert_refused("1,2\n\n3,inf\n", /^line 3: 'inf' is not/);
  await assert_refused("1,2\n3\n", /^line 2 has no column 2$/);
  await assert_refused("a,b,c\n1,2,3\n", /^none of the columns 'a', 'b', 'c' is known to be x or y/);
  await assert_refused(Buffer.from("\ufeff1,2\n", "utf16le"), /UTF-16/);
  await assert_refused(Buffer.from([0x50, 0x4b, 3, 4, 0, 0]), /^the format is not known/);
  await assert_refused('{"type":"MultiPoint","coordinates":[[1,2],[3,', /is none: it is damaged or cut off$/);
  await assert_refused('{"type":"MultiPoint","coordinates":[[1,2],[3,null]]}', /^the position \[3,null\] is not a pair/);
  await assert_refused('{"type":"Topology"}', /is not GeoJSON/);
  await assert_refused(npy(ROWS).subarray(0, -1), /^the NPY array is cut off$/);
  await assert_refused(npy(ROWS, "<f8", { shape: "(6,)" }), /the shape \(6\)/);
  await assert_refused(npy(ROWS, "<f8", { shape: "(2000000000, 2)" }), /cut off/);
  await assert_refused(npy(ROWS).subarray(0, 9), /header is cut off/);
  await assert_refused(las(ROWS, { format: 128 }), /compressed \(LAZ\)/);
  await assert_refused(las(ROWS, { cut: 1 }), /^the file is cut off: it has 2 of 3 points$/);
  await assert_refused(las(ROWS).subarray(0, 100), /header is cut off/);
  await assert_refused(gzipSync("1,2\n3,4\n".repeat(100)).subarray(0, 20), /gzip/);
});

test("areas on the equal-area map are those on the sphere", () => {
  const [south, north] = [59, 61];
  const [x0, y0, x1, , , y1] = equal_area(Float64Array.of(10, south, 12, south, 10, north));
  const radians = Math.PI / 180;
  const expected = 6371007.2 ** 2 * 2 * radians * (Math.sin(north * radians) - Math.sin(south * radians));
  assert.ok(Math.abs((x1 - x0) * (y1 - y0) - expected) < 1e-9 * expected);
  // In the middle a degree of longitude is half as long as one of latitude.
  assert.ok(Math.abs((x1 - x0) / (y1 - y0) - 0.5) < 1e-3);
});
