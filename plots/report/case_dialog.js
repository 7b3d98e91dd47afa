/* One case, large, in a dialog: points, ground truth, each method's hull, the difference of one of them to the truth. */
import {
  cases_in_order,
  find_case,
  method_colour,
  metric_list,
  metric_text,
  series_title,
  time_text,
  worst_run,
} from "./cases.js";
import { formatCount, make, makeNamed, statusWords } from "./format.js";
import { colours_of, fit, paint as paint_picture, unpack } from "./picture.js";
import { onTheme, printing } from "./theme.js";

const MARGIN = 14;
const FARTHEST_ZOOM = 40;
// On paper, where the canvas is a square.
const PAPER_SIZE = [760, 760];
let dialog = null;
let parts = {};
// The open case: entry, picture, run (shaded or null), outlined (series), view, whether points and truth are shown.
let open = null;
const layers = { points: true, truth: true, shade: true, farthest: true };
// Kept from case to case.
let chosen_series = null;
const outlined = new Set();

// Opening and closing.

/** Opens the case, such as "ca/n:2000/holes:1", with the result of the run shaded; without a run's name the worst. The
    promise is kept when the picture is there. */
export async function openCase(case_name, run_name) {
  const entry = find_case(case_name, run_name);
  if (!entry) return;
  build();
  const run = entry.runs.find((one) => one.name === run_name) ?? worst_run(entry.runs);
  if (!dialog.open) {
    dialog.showModal();
    dialog.focus();
  }
  await show(entry, run);
}

async function show(entry, run) {
  open = { entry, run, picture: null, view: null };
  chosen_series = run.series;
  dialog.dataset.case = entry.case;
  dialog.dataset.ready = "false";
  parts.title.textContent = entry.title;
  parts.subtitle.textContent = entry.subtitle;
  const place = cases_in_order().findIndex((item) => item.entry === entry);
  parts.place.textContent = place < 0 ? "" : `${place + 1} of ${cases_in_order().length}`;
  parts.previous.disabled = parts.next.disabled = cases_in_order().length < 2;
  list_runs();
  const picture = await unpack(entry.source);
  if (open.entry !== entry) return;
  open.picture = picture;
  parts.subtitle.textContent = entry.subtitle + sample_words(entry, picture);
  list_facts();
  reset_view();
  dialog.dataset.ready = "true";
}

/** Says so when not all points are drawn; a few may coincide in the picture's grid. */
function sample_words(entry, picture) {
  const drawn = picture.points.length / 2;
  return drawn > 0.9 * entry.n ? "" : `; ${formatCount(drawn)} of the points drawn`;
}

/** Goes `step` cases on in the gallery's order, round the end, with the same method where the case has it. */
function go(step) {
  const order = cases_in_order();
  if (order.length === 0) return;
  const place = order.findIndex((item) => item.entry === open.entry);
  const item = order[(Math.max(place, step > 0 ? place : 0) + step + order.length) % order.length];
  show(item.entry, item.entry.runs.find((run) => run.series === chosen_series) ?? item.run);
}

// The dialog's parts, made once.

function button(words, sign, action) {
  return make("button", { type: "button", title: words, "aria-label": words, click: action }, sign);
}

function layer_box(name, text, key) {
  const change = () => {
    layers[name] = box.checked;
    repaint();
  };
  const box = make("input", { type: "checkbox", checked: layers[name], name: `gallery-layer-${name}`, change });
  return make(
    "label",
    {},
    box,
    ...key.map((kind) => make("span", { class: `gallery-key gallery-key-${kind}`, "aria-hidden": "true" })),
    text,
  );
}

function build() {
  if (dialog) return;
  parts = {
    title: make("h2", { id: "gallery-case-title" }),
    subtitle: make("p", { class: "gallery-case-subtitle" }),
    place: make("span", { class: "gallery-case-place" }),
    previous: button("Previous case (left arrow)", "‹", () => go(-1)),
    next: button("Next case (right arrow)", "›", () => go(1)),
    canvas: make("canvas", { role: "img", tabindex: "0" }),
    runs: make("tbody", {}),
    facts: make("div", { class: "gallery-facts" }),
    farthest: layer_box("farthest", "Hausdorff distance", ["circle"]),
  };
  dialog = make(
    "dialog",
    { class: "gallery-case", tabindex: "-1", "aria-labelledby": "gallery-case-title", keydown: on_key },
    make("header", {}, make("div", { "aria-live": "polite" }, parts.title, parts.subtitle), case_buttons()),
    make("div", { class: "gallery-case-body" }, stage(), side()),
  );
  // A click beside the dialog hits the dialog element itself.
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  document.body.append(dialog);
  watch_pointer(parts.canvas);
  new ResizeObserver(() => open?.picture && !printing && reset_view()).observe(parts.canvas);
  onTheme(repaint);
}

function case_buttons() {
  const close = button("Close (Escape)", "✕", () => dialog.close());
  return make("div", { class: "gallery-case-buttons" }, parts.place, parts.previous, parts.next, close);
}

function stage() {
  const drawn = make(
    "div",
    { class: "gallery-layers", role: "group", "aria-label": "What is drawn" },
    layer_box("points", "points", ["point"]),
    layer_box("truth", "ground truth", ["truth"]),
    layer_box("shade", "missed, wrongly added", ["missed", "added"]),
    parts.farthest,
  );
  const zoom = make(
    "div",
    { class: "gallery-zoom", role: "group", "aria-label": "Zoom" },
    button("Zoom in (+)", "+", () => zoom_by(1.5)),
    button("Zoom out (-)", "−", () => zoom_by(1 / 1.5)),
    button("Whole case (0)", "⤢", reset_view),
  );
  const canvas = make("div", { class: "gallery-canvas" }, parts.canvas);
  return make("div", { class: "gallery-stage" }, canvas, make("div", { class: "gallery-tools" }, drawn, zoom));
}

function side() {
  const heads = ["Shade", "Line", "Method", "L2", "Time"].map((text) => make("th", { scope: "col" }, text));
  const caption = make("caption", {}, "Difference to the ground truth of one method; outlines of any");
  const table = make("table", { class: "gallery-runs" }, caption, make("thead", {}, make("tr", {}, ...heads)));
  table.append(parts.runs);
  const attributes = { class: "gallery-side", tabindex: "0", role: "region", "aria-label": "Methods and numbers" };
  return make("div", attributes, table, parts.facts);
}

function on_key(event) {
  if (event.altKey || event.ctrlKey || event.metaKey || !open.picture) return;
  const pan = event.shiftKey
    ? { ArrowLeft: [60, 0], ArrowRight: [-60, 0], ArrowUp: [0, 60], ArrowDown: [0, -60] }[event.key]
    : null;
  const actions = {
    ArrowLeft: () => go(-1),
    ArrowRight: () => go(1),
    "+": () => zoom_by(1.5),
    "=": () => zoom_by(1.5),
    "-": () => zoom_by(1 / 1.5),
    0: reset_view,
  };
  const action = pan ? () => move_by(...pan) : actions[event.key];
  if (!action) return;
  event.preventDefault();
  action();
}

// The methods and their numbers.

function list_runs() {
  const had_focus = parts.runs.contains(document.activeElement);
  parts.runs.replaceChildren(...open.entry.runs.map(run_row));
  // Else the focus would leave the dialog with the row, and its keys with it.
  if (had_focus) parts.runs.querySelector("input[type=radio]:checked").focus();
}

function run_row(run) {
  const title = series_title(run.series);
  const outline = () => {
    if (box.checked) outlined.add(run.series);
    else outlined.delete(run.series);
    repaint();
  };
  const shaded = { type: "radio", name: "gallery-shaded", checked: run === open.run, change: () => choose(run) };
  const drawn = { type: "checkbox", checked: outlined.has(run.series), disabled: run.result === null, change: outline };
  const radio = make("input", { ...shaded, "aria-label": `Shade ${title}` });
  const box = make("input", { ...drawn, "aria-label": `Outline of ${title}` });
  const name = makeNamed(run.method, title, { class: "gallery-run-name" });
  return make(
    "tr",
    { "data-run": run.name, class: run === open.run ? "chosen" : "" },
    make("td", {}, radio),
    make("td", {}, box),
    make("th", { scope: "row", click: () => choose(run) }, name, run_note(run)),
    make("td", { class: "number", "data-column": "l2" }, metric_text("l2", run.status === "ok" ? run.l2 : null)),
    make("td", { class: "number", "data-column": "time" }, time_text(run.median_ns)),
  );
}

function run_note(run) {
  if (run.status !== "ok") return make("span", { class: `status ${run.status}` }, statusWords(run.status));
  return run.result === null ? make("span", { class: "status not_installed" }, "no picture") : null;
}

function choose(run) {
  if (!open.picture) return;
  open.run = run;
  chosen_series = run.series;
  for (const row of parts.runs.rows) {
    const chosen = row.dataset.run === run.name;
    row.classList.toggle("chosen", chosen);
    if (chosen) row.querySelector("input[type=radio]").checked = true;
  }
  list_facts();
  repaint();
}

function list_facts() {
  const { detail, metrics } = open.picture.runs[open.run.index];
  const fact = ({ name, title, definition, text }) =>
    make("div", {}, make("dt", { title: definition }, title), make("dd", { "data-metric": name }, text));
  const list = make("dl", {}, ...metric_list(metrics).map(fact));
  const reason = metrics.invalid_reason || detail;
  const same = open.entry.runs.filter((run) => run !== open.run && run.result !== null && run.result === open.run.result);
  parts.facts.replaceChildren(
    ...[
      make("h3", {}, series_title(open.run.series)),
      reason ? make("p", { class: "gallery-reason" }, `${statusWords(open.run.status)}: ${reason}`) : null,
      open.run.result === null ? make("p", {}, "There is no picture of this result.") : null,
      same.length > 0 ? make("p", {}, `The same polygons as ${same.map((run) => series_title(run.series)).join(", ")}.`) : null,
      list,
      make("p", { class: "gallery-run-id" }, open.run.name),
    ].filter(Boolean),
  );
}

// Painting, zoom and pan.

let frame = 0;

/** At once for paper, since no frame comes before it is printed; else once a frame. */
function repaint() {
  if (printing) paint();
  else if (!frame) frame = requestAnimationFrame(paint);
}

function paint() {
  cancelAnimationFrame(frame);
  frame = 0;
  if (!dialog.open || !open.picture) return;
  const { run, picture } = open;
  const lines = open.entry.runs
    .filter((one) => one.result !== null && (outlined.has(one.series) || one === run))
    .sort((a, b) => (a === run) - (b === run))
    .map((one) => ({ result: one.result, colour: method_colour(one.method) }));
  const mark = farthest_mark(picture, run);
  parts.farthest.hidden = mark === null;
  paint_picture(parts.canvas, picture, {
    mark: layers.farthest ? mark : null,
    size: printing ? PAPER_SIZE : null,
    view: printing ? fit(picture.box, ...PAPER_SIZE, MARGIN) : open.view,
    colours: colours_of(dialog),
    points: layers.points,
    truth: layers.truth,
    shaded: layers.shade ? run.result : null,
    lines,
    fine: false,
  });
  parts.canvas.setAttribute("aria-label", description());
}

function description() {
  const { entry, run } = open;
  const truth = open.picture.truth.length > 0;
  const words = truth ? `L2 ${metric_text("l2", run.l2)}` : "no truth";
  const result = run.status === "ok" ? words : statusWords(run.status);
  const below = truth ? "points and ground truth" : "points";
  return `${entry.title}, ${entry.subtitle}: result of ${series_title(run.series)}, ${result}, over ${below}`;
}

/** Where the boundaries of result and truth are farthest apart, with that distance as the radius; null: not known. */
function farthest_mark(picture, run) {
  const { metrics } = picture.runs[run.index];
  const which = ["hausdorff_to_truth", "hausdorff_to_result"].sort((a, b) => (metrics[b] ?? -1) - (metrics[a] ?? -1))[0];
  const [distance, x, y] = [metrics[which], metrics[`${which}_x`], metrics[`${which}_y`]];
  if (![distance, x, y].every(Number.isFinite)) return null;
  return {
    x: (x - picture.origin[0]) / picture.step,
    y: (y - picture.origin[1]) / picture.step,
    radius: distance / picture.step,
  };
}

function whole_view() {
  return fit(open.picture.box, parts.canvas.clientWidth, parts.canvas.clientHeight, MARGIN);
}

function reset_view() {
  if (open.picture) set_view(whole_view());
}

function set_view(view) {
  open.view = view;
  const zoomed = view.scale > 1.01 * whole_view().scale;
  // A finger scrolls the dialog until there is something to pan.
  parts.canvas.classList.toggle("zoomed", zoomed);
  parts.canvas.dataset.zoom = (view.scale / whole_view().scale).toFixed(2);
  repaint();
}

/** Zooms about a place of the canvas in pixels; about its middle when none is given. */
function zoom_by(factor, x = parts.canvas.clientWidth / 2, y = parts.canvas.clientHeight / 2) {
  const { view } = open;
  if (!view) return;
  const whole = whole_view().scale;
  const scale = Math.min(Math.max(view.scale * factor, 0.5 * whole), FARTHEST_ZOOM * whole);
  const by = scale / view.scale;
  set_view({ scale, x: x + by * (view.x - x), y: y + by * (view.y - y) });
}

function move_by(dx, dy) {
  set_view({ ...open.view, x: open.view.x + dx, y: open.view.y + dy });
}

/** Wheel, mouse and fingers: one moves, two zoom about their middle. */
function watch_pointer(canvas) {
  const down = new Map();
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const middle_and_spread = () => {
    const [a, b] = [...down.values()];
    return b ? { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, spread: Math.hypot(a.x - b.x, a.y - b.y) } : { ...a, spread: 0 };
  };
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      zoom_by(Math.exp(-0.002 * event.deltaY), place(event).x, place(event).y);
    },
    { passive: false },
  );
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    down.set(event.pointerId, place(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!down.has(event.pointerId) || !open.picture) return;
    const before = middle_and_spread();
    down.set(event.pointerId, place(event));
    const after = middle_and_spread();
    move_by(after.x - before.x, after.y - before.y);
    if (before.spread > 0) zoom_by(after.spread / before.spread, after.x, after.y);
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => down.delete(event.pointerId));
  canvas.addEventListener("dblclick", (event) => zoom_by(2, place(event).x, place(event).y));
}
