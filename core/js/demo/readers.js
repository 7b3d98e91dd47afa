// Files of points, as bytes: whatever is not what it should be is a FileError of one sentence.

export class FileError extends Error {}

/**
 * What `bytes` hold: { xy: x0, y0, x1, y1 ..., format, lonlat: whether they are longitudes and latitudes, as far as one can
 * tell }. The format is known by the first bytes.
 */
export async function read_points(bytes) {
  if (bytes.length === 0) throw new FileError("the file is empty");
  const starts_with = (...codes) => codes.every((code, i) => bytes[i] === code);
  if (starts_with(0x1f, 0x8b)) return read_points(await unzipped(bytes));
  if (starts_with(0x4c, 0x41, 0x53, 0x46)) return las_points(bytes);
  if (starts_with(0x93, 0x4e, 0x55, 0x4d, 0x50, 0x59)) return npy_points(bytes);
  if (starts_with(0xff, 0xfe) || starts_with(0xfe, 0xff)) throw new FileError("the text is in UTF-16: save it as UTF-8");
  if (bytes.subarray(0, 1024).includes(0)) {
    throw new FileError("the format is not known: CSV and other columns of text, GeoJSON, NPY and LAS are");
  }
  const text = new TextDecoder().decode(bytes);
  return /^\s*[{[]/.test(text.slice(0, 1024)) ? geojson_points(text) : text_points(text);
}

async function unzipped(bytes) {
  try {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  } catch {
    throw new FileError("the file begins as one of gzip does, but cannot be unpacked: it is damaged or cut off");
  }
}

// ---- LAS 1.0 to 1.4 (ASPRS), whose coordinates are integers with a scale and an offset ----

function las_points(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 227) throw new FileError("the LAS header is cut off");
  const minor = view.getUint8(25);
  const begin = view.getUint32(96, true);
  const format = view.getUint8(104);
  const size = view.getUint16(105, true);
  if (format & 0xc0)
    throw new FileError("the points are compressed (LAZ): unpack the file to LAS first, as laszip and PDAL do");
  const wide = minor >= 4 && bytes.length >= 255;
  const count = Number(wide ? view.getBigUint64(247, true) : view.getUint32(107, true)) || view.getUint32(107, true);
  if (size < 20) throw new FileError(`a LAS point of ${size} bytes is too short: 20 are needed`);
  const there = Math.max(0, Math.floor((bytes.length - begin) / size));
  if (count > there) throw new FileError(`the file is cut off: it has ${there} of ${count} points`);
  const [scale_x, scale_y] = [view.getFloat64(131, true), view.getFloat64(139, true)];
  const [offset_x, offset_y] = [view.getFloat64(155, true), view.getFloat64(163, true)];
  const withheld = format < 6 ? 128 : 4; // a bit of byte 15: the point is to be left out
  const xy = new Float64Array(2 * count);
  let end = 0;
  for (let i = 0, at = begin; i < count; i++, at += size) {
    if (view.getUint8(at + 15) & withheld) continue;
    xy[end++] = view.getInt32(at, true) * scale_x + offset_x;
    xy[end++] = view.getInt32(at + 4, true) * scale_y + offset_y;
  }
  return { xy: xy.subarray(0, end), format: `LAS ${view.getUint8(24)}.${minor}`, lonlat: false };
}

// ---- NumPy's .npy, versions 1 to 3 ----

const NUMBERS = {
  f8: [8, "getFloat64"],
  f4: [4, "getFloat32"],
  i8: [8, "getBigInt64"],
  u8: [8, "getBigUint64"],
  i4: [4, "getInt32"],
  u4: [4, "getUint32"],
  i2: [2, "getInt16"],
  u2: [2, "getUint16"],
  i1: [1, "getInt8"],
  u1: [1, "getUint8"],
};

function npy_points(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const header_begin = bytes[6] === 1 ? 10 : 12;
  if (bytes.length < header_begin) throw new FileError("the NPY header is cut off");
  const begin = header_begin + (bytes[6] === 1 ? view.getUint16(8, true) : view.getUint32(8, true));
  const header = new TextDecoder().decode(bytes.subarray(header_begin, begin));
  const type = /'descr': *'([<>|=])(\w+)'/.exec(header);
  const shape = /'shape': *\(([^)]*)\)/.exec(header)?.[1].split(",").filter((n) => n.trim()).map(Number); // prettier-ignore
  if (!type || !(type[2] in NUMBERS)) throw new FileError("the NPY array is not of plain numbers, such as float64");
  if (shape?.length !== 2 || !(shape[1] >= 2)) {
    throw new FileError(`the NPY array has the shape (${shape}): n rows of x and y are needed`);
  }
  const [rows, columns] = shape;
  const [size, getter] = NUMBERS[type[2]];
  if (begin + rows * columns * size > bytes.length) throw new FileError("the NPY array is cut off");
  const little = type[1] !== ">";
  const [row_step, column_step] = /'fortran_order': *True/.test(header) ? [size, rows * size] : [columns * size, size];
  const xy = new Float64Array(2 * rows);
  for (let i = 0; i < rows; i++) {
    const at = begin + i * row_step;
    xy[2 * i] = Number(view[getter](at, little));
    xy[2 * i + 1] = Number(view[getter](at + column_step, little));
  }
  return { xy, format: "NPY", lonlat: false };
}

// ---- GeoJSON (RFC 7946): all positions of all geometries ----

function geojson_points(text) {
  let root;
  try {
    root = JSON.parse(text);
  } catch {
    throw new FileError("the file begins as JSON does, but is none: it is damaged or cut off");
  }
  const flat = [];
  const add_positions = (coordinates) => {
    if (!Array.isArray(coordinates)) throw new FileError("GeoJSON coordinates must be arrays of numbers");
    if (!Array.isArray(coordinates[0]) && coordinates.length) {
      if (!Number.isFinite(coordinates[0]) || !Number.isFinite(coordinates[1])) {
        throw new FileError(`the position ${JSON.stringify(coordinates)} is not a pair of numbers`);
      }
      flat.push(coordinates[0], coordinates[1]);
    } else {
      coordinates.forEach(add_positions);
    }
  };
  const add = (thing) => {
    if (thing?.type === "FeatureCollection") (thing.features ?? []).forEach(add);
    else if (thing?.type === "GeometryCollection") (thing.geometries ?? []).forEach(add);
    else if (thing?.type === "Feature") thing.geometry && add(thing.geometry);
    else if (thing?.coordinates) add_positions(thing.coordinates);
    else throw new FileError("the JSON is not GeoJSON: it has neither features nor coordinates");
  };
  add(root);
  const named = root.crs?.properties?.name;
  const on_globe = flat.every((value, i) => Math.abs(value) <= (i % 2 ? 90 : 180));
  return {
    xy: Float64Array.from(flat),
    format: "GeoJSON",
    lonlat: on_globe && flat.length > 0 && (!named || /CRS84|4326/.test(named)),
  };
}

// ---- Columns of text: CSV and the like ----

// In any case; the second name of each pair is y.
const KNOWN_NAMES = [["x", "y"], ["lon", "lat"], ["longitude", "latitude"], ["lng", "lat"], ["easting", "northing"]]; // prettier-ignore

/** The fields of a row; a delimiter of " " stands for any run of blanks. */
function fields_of(line, delimiter) {
  if (delimiter === " ") return line.trim().split(/\s+/);
  if (!line.includes('"')) return line.split(delimiter);
  const fields = [""];
  let quoted = false;
  for (const c of line) {
    if (c === '"') quoted = !quoted;
    else if (c === delimiter && !quoted) fields.push("");
    else fields[fields.length - 1] += c;
  }
  return fields;
}

const is_number = (field) => field.trim() !== "" && !Number.isNaN(Number(field));

/** Which columns hold x and y, and whether the first row names them. */
function columns_of(row) {
  const names = row.map((name) => name.trim().toLowerCase());
  for (const [x, y] of KNOWN_NAMES) {
    if (!names.includes(x) || !names.includes(y)) continue;
    return { x: names.indexOf(x), y: names.indexOf(y), named: true, lonlat: x.startsWith("l") };
  }
  if (row.some(is_number)) return { x: 0, y: 1, named: false, lonlat: false };
  if (row.length === 2) return { x: 0, y: 1, named: true, lonlat: false };
  const listed = row.map((name) => `'${name.trim()}'`).join(", ");
  throw new FileError(`none of the columns ${listed} is known to be x or y: name two of them x and y, or lon and lat`);
}

function text_points(text) {
  const flat = [];
  let delimiter;
  let columns;
  let number = 0;
  for (let begin = 0; begin < text.length; number++) {
    let end = text.indexOf("\n", begin);
    if (end < 0) end = text.length;
    const line = text.slice(begin, text[end - 1] === "\r" ? end - 1 : end);
    begin = end + 1;
    if (line.trim() === "" || (!columns && line.startsWith("#"))) continue;
    delimiter ??= [";", "\t", ","].find((each) => line.replace(/"[^"]*"/g, "").includes(each)) ?? " ";
    const fields = fields_of(line, delimiter);
    if (!columns) {
      columns = columns_of(fields);
      if (columns.named) continue;
    }
    for (const column of [columns.x, columns.y]) {
      const field = fields[column];
      if (field === undefined) throw new FileError(`line ${number + 1} has no column ${column + 1}`);
      const value = Number(field);
      if (!Number.isFinite(value) || field.trim() === "") {
        throw new FileError(`line ${number + 1}: '${field.trim().slice(0, 40)}' is not a finite number`);
      }
      flat.push(value);
    }
  }
  return { xy: Float64Array.from(flat), format: "columns of text", lonlat: columns?.lonlat ?? false };
}
