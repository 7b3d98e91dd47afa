/* Unpacks and paints the pictures that plots/pictures.py packs; its comment describes the format.

   A picture is { origin, step, points, truth, results, dense, runs, box }: origin and step say where the grid is in the
   data set's unit; points are x, y, x, y, ... in steps of the grid (y upwards); truth and each of results an array of
   polygons, each a Path2D of all its rings; dense says of each result whether it has very many vertices; runs is as it was
   packed; box the smallest that holds points, truth and what of the results is not far away. */
import { gunzip } from "./data.js";

// Vertices from which on an outline as wide as usual would cover what it encloses.
const DENSE = 10000;
const unpacked = new WeakMap();

/** The picture of an entry of `pictures.cases`: a promise, always the same one. */
export function unpack(entry) {
  if (!unpacked.has(entry)) unpacked.set(entry, read_block(entry.block));
  return unpacked.get(entry);
}

async function read_block(base64) {
  const bytes = new Uint8Array(await gunzip(base64).arrayBuffer());
  const header_end = 4 + new DataView(bytes.buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, header_end)));
  let position = header_end;
  const numbers = (count) => {
    const low = bytes.subarray(position, position + count);
    const high = bytes.subarray(position + count, position + 2 * count);
    position += 2 * count;
    return Array.from(low, (byte, k) => byte | (high[k] << 8));
  };
  const points = read_points(numbers(header.points), numbers(header.points));
  const box = { left: Infinity, bottom: Infinity, right: -Infinity, top: -Infinity };
  for (let k = 0; k < points.length; k += 2) stretch(box, points[k], points[k + 1]);
  const truth = read_polygons(header.truth, numbers, box);
  const farthest = farther(box);
  const results = header.results.map((counts) => read_polygons(counts, numbers, box, farthest));
  const dense = header.results.map((counts) => counts.flat().reduce((sum, count) => sum + count, 0) > DENSE);
  return { dense, origin: header.origin, step: header.step, points, truth, results, runs: header.runs, box };
}

function read_points(steps, heights) {
  const points = new Int32Array(2 * steps.length);
  let x = 0;
  steps.forEach((step, k) => {
    x += step;
    points[2 * k] = x;
    points[2 * k + 1] = heights[k];
  });
  return points;
}

function read_polygons(counts, numbers, box, farthest = null) {
  const coded = numbers(2 * counts.flat().reduce((sum, count) => sum + count, 0));
  const difference = (value) => (value & 1 ? -(value + 1) / 2 : value / 2);
  let [next, x, y] = [0, 0, 0];
  return counts.map((rings) => {
    const path = new Path2D();
    for (const count of rings) {
      for (let k = 0; k < count; ++k) {
        x += difference(coded[next++]);
        y += difference(coded[next++]);
        if (k === 0) path.moveTo(x, y);
        else path.lineTo(x, y);
        if (farthest) stretch(box, clamp(x, farthest.left, farthest.right), clamp(y, farthest.bottom, farthest.top));
        else stretch(box, x, y);
      }
      path.closePath();
    }
    return path;
  });
}

function stretch(box, x, y) {
  box.left = Math.min(box.left, x);
  box.right = Math.max(box.right, x);
  box.bottom = Math.min(box.bottom, y);
  box.top = Math.max(box.top, y);
}

/** The box and a sixth of its size on each side: one wild result must not make the others small. */
function farther({ left, bottom, right, top }) {
  const [wide, high] = [(right - left) / 6, (top - bottom) / 6];
  return { left: left - wide, bottom: bottom - high, right: right + wide, top: top + high };
}

function clamp(value, low, high) {
  return Math.min(Math.max(value, low), high);
}

/** The view { scale, x, y } that shows the whole box: pixels = (x + scale * grid x, y - scale * grid y). */
export function fit(box, width, height, margin) {
  const scale = Math.min(
    (width - 2 * margin) / Math.max(box.right - box.left, 1),
    (height - 2 * margin) / Math.max(box.top - box.bottom, 1),
  );
  return { scale, x: width / 2 - (scale * (box.left + box.right)) / 2, y: height / 2 + (scale * (box.bottom + box.top)) / 2 };
}

/** What the style sheet says of the colours, as the canvas wants them. */
export function colours_of(element) {
  const probe = document.createElement("span");
  element.append(probe);
  const colour = (name) => {
    probe.style.color = `var(${name})`;
    return getComputedStyle(probe).color;
  };
  const colours = {
    ink: colour("--ink"),
    page: colour("--paper"),
    point: colour("--gallery-point"),
    both: colour("--gallery-both"),
    missed: colour("--gallery-missed"),
    added: colour("--gallery-added"),
  };
  probe.remove();
  return colours;
}

/** Paints over the whole canvas. `drawing`: { view, colours, points, truth (whether to show them), shaded (index of a
    result, its difference to the truth is shaded, or all of it where there is no truth; or null), lines ([{ result, colour }], the last on top), mark (a circle
    { x, y, radius } in the grid, or null), fine
    (small picture: thin lines, small points), size ([width, height] in pixels, if not the canvas's on the page) }. */
export function paint(canvas, picture, drawing) {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = drawing.size ?? [canvas.clientWidth, canvas.clientHeight];
  if (width === 0 || height === 0) return;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  const to_grid = (target) => {
    const { scale, x, y } = drawing.view;
    target.setTransform(ratio * scale, 0, 0, -ratio * scale, ratio * x, ratio * y);
  };
  if (drawing.shaded !== null) {
    const result = picture.results[drawing.shaded];
    to_grid(context);
    fill(context, result, drawing.colours.both);
    const differences = [
      ["missed", picture.truth, result],
      ["added", result, picture.truth],
    ];
    // Of points without a truth nothing is missed or added.
    for (const [kind, whole, part] of picture.truth.length > 0 ? differences : []) {
      const layer = difference(canvas.width, canvas.height, to_grid, whole, part);
      fill_layer(layer, kind, drawing.colours[kind], ratio);
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.drawImage(layer, 0, 0);
    }
  }
  if (drawing.points) paint_points(context, picture.points, drawing, ratio, canvas);
  to_grid(context);
  const line_width = (pixels) => ((drawing.fine ? 0.6 : Math.min(Math.max(width / 700, 0.7), 1)) * pixels) / drawing.view.scale;
  context.lineJoin = "round";
  if (drawing.truth) stroke(context, picture.truth, drawing.colours.ink, line_width(1.2));
  for (const line of drawing.lines) {
    const dense = picture.dense[line.result];
    // A rim in the page's colour keeps the line apart from shades of its own colour.
    if (!dense) stroke(context, picture.results[line.result], drawing.colours.page, line_width(3.2));
    stroke(context, picture.results[line.result], line.colour, line_width(dense ? 0.5 : 1.8));
  }
  if (drawing.mark) paint_mark(context, drawing, line_width);
}

/** The polygons `whole` without the polygons `part` as an opaque layer. Polygon by polygon, so that those of an invalid
    result that overlap do not cancel each other. */
function difference(width, height, to_grid, whole, part) {
  const layer = document.createElement("canvas");
  layer.width = width;
  layer.height = height;
  const context = layer.getContext("2d");
  to_grid(context);
  fill(context, whole, "black");
  context.globalCompositeOperation = "destination-out";
  fill(context, part, "black");
  return layer;
}

function fill_layer(layer, kind, colour, ratio) {
  const context = layer.getContext("2d");
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.globalCompositeOperation = "source-in";
  context.fillStyle = context.createPattern(tile(kind, colour, ratio), "repeat");
  context.fillRect(0, 0, layer.width, layer.height);
}

const tiles = new Map();

/** What is missed is hatched, what is added is plain: also to be told apart in grey. */
function tile(kind, colour, ratio) {
  const key = `${kind} ${colour} ${ratio}`;
  if (!tiles.has(key)) tiles.set(key, make_tile(kind, colour, ratio));
  return tiles.get(key);
}

function make_tile(kind, colour, ratio) {
  const side = Math.round(6 * ratio);
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = side;
  const context = canvas.getContext("2d");
  context.fillStyle = context.strokeStyle = colour;
  context.globalAlpha = kind === "missed" ? 0.4 : 0.85;
  context.fillRect(0, 0, side, side);
  if (kind === "missed") {
    context.globalAlpha = 1;
    context.lineWidth = 1.6 * ratio;
    context.beginPath();
    for (const shift of [-side, 0, side]) {
      context.moveTo(shift - side, 2 * side);
      context.lineTo(shift + 2 * side, -side);
    }
    context.stroke();
  }
  return canvas;
}

function paint_points(context, points, drawing, ratio, canvas) {
  const { scale, x, y } = drawing.view;
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.fillStyle = drawing.colours.point;
  const side = (drawing.fine ? 0.9 : 1.7) * ratio;
  for (let k = 0; k < points.length; k += 2) {
    const [left, top] = [ratio * (x + scale * points[k]), ratio * (y - scale * points[k + 1])];
    if (left < 0 || top < 0 || left > canvas.width || top > canvas.height) continue;
    context.fillRect(left - side / 2, top - side / 2, side, side);
  }
}

function paint_mark(context, { mark, colours }, line_width) {
  const circle = (radius) => {
    const path = new Path2D();
    path.arc(mark.x, mark.y, radius, 0, 2 * Math.PI);
    return [path];
  };
  context.setLineDash([line_width(5), line_width(4)]);
  stroke(context, circle(mark.radius), colours.ink, line_width(1.4));
  context.setLineDash([]);
  fill(context, circle(line_width(3.5)), colours.ink);
}

function fill(context, polygons, colour) {
  context.fillStyle = colour;
  for (const polygon of polygons) context.fill(polygon, "evenodd");
}

function stroke(context, polygons, colour, width) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  for (const polygon of polygons) context.stroke(polygon);
}
