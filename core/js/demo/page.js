// The page: what is asked of the workers, and what is shown of their answers.
import { Picture } from "./picture.js";
import { equal_area } from "./plane.js";
import worker_source from "worker.txt";

const FIRST_EXAMPLE = 20_000;
const element = (id) => document.getElementById(id);
const picture = new Picture(element("picture"));
const format_count = new Intl.NumberFormat("en").format;
const format_measure = new Intl.NumberFormat("en", { maximumSignificantDigits: 4 }).format;
const format_time = (ms) =>
  ms < 10 ? `${ms.toFixed(1)} ms` : ms < 1000 ? `${ms.toFixed(0)} ms` : `${(ms / 1000).toFixed(2)} s`;

/** A worker that answers questions: ask(name, given) is a promise of the answer. */
class Asked {
  #worker = new Worker(URL.createObjectURL(new Blob([worker_source], { type: "text/javascript" })));
  #waiting = new Map();
  #asked = 0;

  constructor() {
    this.#worker.addEventListener("message", ({ data: { number, answer, error } }) => {
      const { resolve, reject } = this.#waiting.get(number);
      this.#waiting.delete(number);
      if (error === undefined) resolve(answer);
      else reject(new Error(error));
    });
  }

  ask(name, given) {
    const number = this.#asked++;
    this.#worker.postMessage({ number, name, given });
    return new Promise((resolve, reject) => this.#waiting.set(number, { resolve, reject }));
  }

  end() {
    this.#worker.terminate();
  }
}

const hulls = new Asked();
let rival; // of a worker of its own, ended when its ring is not wanted any more
let points; // { xy, format, lonlat, name }, as read
let plane; // where they are drawn
let hull;
let asked_points = 0; // how often some were asked for: an older answer is not shown
let asked_hull = 0; // the same
let is_busy = false;

const detail = () => 2 ** Number(element("detail").value);
const is_lonlat = () => element("lonlat").checked;

function say(sentence, is_error = false) {
  element("status").textContent = is_error ? "" : sentence;
  element("error").textContent = is_error ? sentence : "";
  element("error").hidden = !is_error;
}

// ---- Points ----

async function open(name, question, given) {
  const number = ++asked_points;
  say(`Reading ${name} …`);
  document.body.dataset.state = "busy";
  try {
    const answer = await hulls.ask(question, given);
    if (number !== asked_points) return;
    points = { ...answer, name };
    element("lonlat").checked = answer.lonlat;
    element("source").textContent = `${name} (${answer.format})`;
    show_points();
  } catch (error) {
    if (number !== asked_points) return;
    say(`${name}: ${error.message}.`, true);
    document.body.dataset.state = "failed";
  }
}

function show_points() {
  plane = is_lonlat() ? equal_area(points.xy) : points.xy;
  hull = null;
  picture.show_points(plane);
  ask_for_hull();
  ask_for_rival();
}

// ---- The hull ----

/** The newest wish is fulfilled when the one before it is done; those between are dropped. */
async function ask_for_hull() {
  const number = ++asked_hull;
  element("detail-value").textContent = format_measure(detail());
  element("detail").setAttribute("aria-valuetext", format_measure(detail()));
  document.body.dataset.state = "busy";
  if (is_busy || !points) return;
  is_busy = true;
  try {
    const answer = await hulls.ask("hull", { detail: detail(), lonlat: is_lonlat() });
    is_busy = false;
    if (number !== asked_hull) return ask_for_hull();
    hull = { ...answer, detail: detail() };
    show_hull();
  } catch (error) {
    is_busy = false;
    if (number !== asked_hull) return ask_for_hull();
    hull = null;
    show_hull();
    say(`${points.name}: ${error.message}.`, true);
  }
  document.body.dataset.state = "done";
}

function show_hull() {
  const parts = hull?.polygonEnds.length ?? 0;
  const holes = (hull?.ringEnds.length ?? 0) - parts;
  const count = points.xy.length / 2;
  const sizes = hull?.chosenSizes;
  const facts = {
    points: format_count(count),
    parts: format_count(parts),
    holes: format_count(holes),
    area: hull ? area_text(hull.area) : "–",
    vertices: format_count(hull?.vertices.length ?? 0),
    size: sizes ? size_text(sizes) : "–",
    time: hull ? format_time(hull.milliseconds) : "–",
  };
  for (const [name, text] of Object.entries(facts)) element(name).textContent = text;
  picture.show_hull(hull);
  element("download").disabled = parts === 0;
  const counted = (n, one) => `${format_count(n)} ${one}${n === 1 ? "" : "s"}`;
  const found =
    parts === 0 ? "no shape: fewer than 3 points, or all on a line" : `${counted(parts, "part")}, ${counted(holes, "hole")}`;
  const sentence = `${counted(count, "point")}: ${found}`;
  element("picture").setAttribute("aria-label", `The hull of ${sentence}`);
  if (hull) say(`${sentence}, in ${facts.time}.`);
}

function area_text(area) {
  if (!is_lonlat()) return format_measure(area);
  return area < 1e6 ? `${format_measure(area)} m²` : `${format_measure(area / 1e6)} km²`;
}

/** The chosen size of a triangle, from where points are dense to where they are sparse. */
function size_text({ least, most }) {
  const [small, large] = [least, most].map(format_measure);
  return (small === large ? small : `${small} to ${large}`) + (is_lonlat() ? " m" : "");
}

// ---- concaveman ----

async function ask_for_rival() {
  rival?.end();
  rival = undefined;
  picture.show_ring(null);
  element("rival").hidden = !element("compare").checked;
  if (!element("compare").checked || !points) return;
  element("rival-time").textContent = "working …";
  element("rival-area").textContent = "–";
  rival = new Asked();
  try {
    const { vertices, milliseconds } = await rival.ask("concaveman", { xy: points.xy, lonlat: is_lonlat() });
    picture.show_ring(vertices);
    element("rival-time").textContent = format_time(milliseconds);
    element("rival-area").textContent = area_text(ring_area(vertices));
  } catch (error) {
    element("rival-time").textContent = error.message;
  }
}

function ring_area(vertices) {
  let sum = 0;
  for (let i = 1; i + 1 < vertices.length; i++) {
    const [x, y] = [0, 1].map((k) => [0, i, i + 1].map((j) => plane[2 * vertices[j] + k]));
    sum += (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
  }
  return Math.abs(sum / 2);
}

// ---- GeoJSON ----

/** The hull as a feature with the coordinates of the file. */
function feature() {
  let [ring, begin] = [0, 0];
  const coordinates = Array.from(hull.polygonEnds, (last) => {
    const rings = [];
    for (; ring < last; ring++) {
      const indices = [...hull.vertices.subarray(begin, hull.ringEnds[ring]), hull.vertices[begin]];
      rings.push(indices.map((i) => [points.xy[2 * i], points.xy[2 * i + 1]]));
      begin = hull.ringEnds[ring];
    }
    return rings;
  });
  const properties = { points: points.xy.length / 2, detail: hull.detail, area: hull.area };
  return { type: "Feature", properties, geometry: { type: "MultiPolygon", coordinates } };
}

function download() {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([JSON.stringify(feature())], { type: "application/geo+json" }));
  link.download = `${points.name.replace(/\.\w+$/, "")}.hull.geojson`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

// ---- What the reader does ----

const open_file = (file) => file && open(file.name, "read", { file });
const open_example = (count) => open(`${format_count(count)} points`, "example", { count });

element("file").addEventListener("change", ({ target }) => {
  open_file(target.files[0]);
  target.value = ""; // the same file may be chosen again, changed meanwhile
});
for (const button of document.querySelectorAll("[data-example]")) {
  button.addEventListener("click", () => open_example(Number(button.dataset.example)));
}
element("detail").addEventListener("input", ask_for_hull);
element("lonlat").addEventListener("change", () => points && show_points());
element("compare").addEventListener("change", ask_for_rival);
element("download").addEventListener("click", download);
element("larger").addEventListener("click", () => picture.zoom(1.5));
element("smaller").addEventListener("click", () => picture.zoom(1 / 1.5));
element("fit").addEventListener("click", () => picture.fit());

let entered = 0; // elements that a file is dragged over, one in another
for (const [kind, change] of [
  ["dragenter", 1],
  ["dragleave", -1],
]) {
  addEventListener(kind, () => document.body.classList.toggle("dragged", (entered += change) > 0));
}
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
  event.preventDefault();
  entered = 0;
  document.body.classList.remove("dragged");
  open_file(event.dataTransfer.files[0]);
});

open_example(FIRST_EXAMPLE);
