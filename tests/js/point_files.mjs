// Points, and files of them in the formats that the demo page reads, written independently of its readers.

/** Numbers as points of two each, or as rows of `width`. */
export const pairs = (numbers, width = 2) =>
  Array.from({ length: numbers.length / width }, (_, i) => [...numbers.slice(width * i, width * (i + 1))]);

/** Points [x, y] as a LAS file: version 1.2 with point format 0, or 1.4 with format 6. */
export function las(points, { minor = 2, scale = 0.01, offset = [500000, 4000000], format = minor < 4 ? 0 : 6, cut = 0 } = {}) {
  const [header, record] = minor < 4 ? [227, 20] : [375, 30];
  const bytes = Buffer.alloc(header + record * points.length);
  bytes.write("LASF", 0, "latin1");
  bytes.set([1, minor], 24);
  bytes.writeUInt16LE(header, 94);
  bytes.writeUInt32LE(header, 96);
  bytes.writeUInt8(format, 104);
  bytes.writeUInt16LE(record, 105);
  if (minor < 4) bytes.writeUInt32LE(points.length, 107);
  else bytes.writeBigUInt64LE(BigInt(points.length), 247);
  [scale, scale, scale, ...offset, 0].forEach((value, i) => bytes.writeDoubleLE(value, 131 + 8 * i));
  points.forEach(([x, y], i) => {
    bytes.writeInt32LE(Math.round((x - offset[0]) / scale), header + record * i);
    bytes.writeInt32LE(Math.round((y - offset[1]) / scale), header + record * i + 4);
  });
  return bytes.subarray(0, bytes.length - cut);
}

/** Rows of numbers as a NumPy array of the type "<f8", ">f4", "<i4" ... */
export function npy(rows, type = "<f8", { fortran = false, version = 1, shape = `(${rows.length}, ${rows[0].length})` } = {}) {
  const dictionary = `{'descr': '${type}', 'fortran_order': ${fortran ? "True" : "False"}, 'shape': ${shape}, }\n`;
  const begin = Buffer.from([0x93, ...Buffer.from("NUMPY"), version, 0]);
  const length = Buffer.alloc(version === 1 ? 2 : 4);
  if (version === 1) length.writeUInt16LE(dictionary.length);
  else length.writeUInt32LE(dictionary.length);
  const values = fortran ? rows[0].map((_, column) => rows.map((row) => row[column])).flat() : rows.flat();
  const write = `write${{ f8: "Double", f4: "Float", i4: "Int32", i8: "BigInt64" }[type.slice(1)]}${type[0] === ">" ? "BE" : "LE"}`;
  const size = Number(type[2]);
  const data = Buffer.alloc(values.length * size);
  values.forEach((value, i) => data[write](type.slice(1) === "i8" ? BigInt(value) : value, size * i));
  return Buffer.concat([begin, length, Buffer.from(dictionary), data]);
}
