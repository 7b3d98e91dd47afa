/* The gallery: a small picture of every case that has one, the worst first, to be filtered; a click opens it large
   (case_dialog.js). */
import { openCase } from "./case_dialog.js";
import { badness, cases_in_order, metric_text, read_cases, series_title, set_order, worst_run } from "./cases.js";
import { formatCount, make, makeChoice, statusWords } from "./format.js";
import { colours_of, fit, paint, unpack } from "./picture.js";
import { onTheme } from "./theme.js";

const FIRST_CARDS = 48;
// As many as gallery.css leaves on paper.
const PRINTED_CARDS = 12;
let entries = [];
let report = null;
let pictures = null;
const filters = { method: "", experiment: "", shape: "", status: "", order: "mixed" };

/** Fills `element` with the gallery of `page_pictures`, the object of plots/pictures.py, with at least one case. */
export function mountGallery(element, page_report, page_pictures) {
  report = page_report;
  pictures = page_pictures;
  entries = read_cases(report, pictures);
  element.classList.add("gallery");
  const count = make("p", { class: "gallery-count", role: "status" });
  const grid = make("ul", { class: "gallery-grid" });
  const more = make("button", {
    type: "button",
    class: "gallery-more",
    hidden: true,
    click: () => show_rest(grid, more, watcher),
  });
  const watcher = watch_cards();
  const refresh = () => list_cards(grid, count, more, watcher);
  // One method, rather than each case's worst, which is often the simplest one everywhere: who leads, or else that with the
  // most cases.
  const shown = (series) => entries.filter((entry) => entry.runs.some((run) => run.series === series)).length;
  const keys = report.entrants.map((entrant) => entrant.key);
  const most = keys.reduce((one, other) => (shown(other) > shown(one) ? other : one), keys[0]);
  filters.method = shown(report.leader) ? report.leader : most;
  element.replaceChildren(
    ...[filter_bar(refresh), failures_button(element, refresh), legend(), count, grid, more, remark()].filter(Boolean),
  );
  refresh();
  // Paper shows what is painted, and cannot wait for it.
  const idle = window.requestIdleCallback ?? setTimeout;
  idle(() => [...grid.querySelectorAll("canvas")].slice(0, PRINTED_CARDS).forEach(unpack_card));
  onTheme(() => {
    known_colours = null;
    grid.querySelectorAll("canvas.painted").forEach(paint_card);
  });
}

function filter_bar(refresh) {
  const bar = make("div", { class: "controls gallery-filters", role: "group", "aria-label": "Filter the pictures" });
  const add = (key, title, all, options) => {
    if (options.length < 2) return;
    const chosen = (value) => {
      filters[key] = value;
      refresh();
    };
    const choice = makeChoice(title, { name: `gallery-${key}` }, all ? [["", all], ...options] : options, chosen);
    choice.lastChild.value = filters[key];
    bar.append(choice);
  };
  const options = (values, title) => [...new Set(values)].map((value) => [value, title(value)]);
  const runs = entries.flatMap((entry) => entry.runs);
  const series = runs.map((run) => run.series);
  const experiments = entries.flatMap((entry) => entry.experiments);
  const families = entries.map((entry) => entry.family).sort();
  add("method", "Method", "each case’s worst", options(series, series_title));
  add("experiment", "Experiment", "all", options(experiments, experiment_title));
  add("shape", "Shape", "all", options(families, String));
  add("status", "Status", "all", status_options(runs));
  add("order", "Order", null, [
    ["mixed", "all kinds in turn, worst first"],
    ["worst", "worst first"],
    ["best", "best first"],
    ["name", "by shape and size"],
  ]);
  return bar;
}

function status_options(runs) {
  const there = [...new Set(runs.map((run) => run.status))].sort();
  const failed = runs.some((run) => run.failed) ? [["failed", "any failure"]] : [];
  return [...failed, ...there.map((status) => [status, statusWords(status)])];
}

/** Shows the failures of all methods; null when there are none. */
function failures_button(element, refresh) {
  const failures = entries.flatMap((entry) => entry.runs).filter((run) => run.failed).length;
  if (failures === 0) return null;
  const show = () => {
    Object.assign(filters, { method: "", experiment: "", shape: "", status: "failed" });
    for (const select of element.querySelectorAll(".gallery-filters select"))
      select.value = filters[select.name.replace("gallery-", "")];
    refresh();
  };
  const words = failures === 1 ? "1 result failed: show it" : `${formatCount(failures)} results failed: show them`;
  return make("button", { type: "button", class: "gallery-failures", click: show }, words);
}

function experiment_title(name) {
  return report.experiments.find((experiment) => experiment.name === name)?.title ?? name;
}

function legend() {
  const item = (kind, text) =>
    make("span", {}, make("span", { class: `gallery-key gallery-key-${kind}`, "aria-hidden": "true" }), text);
  const has_truth = entries.some((entry) => entry.runs.some((run) => run.l2 !== null));
  const items = has_truth
    ? [item("both", "found"), item("missed", "missed"), item("added", "wrongly added"), item("truth", "ground truth")]
    : [item("both", "hull"), item("point", "points")];
  return make("p", { class: "gallery-legend" }, ...items);
}

/** How many cases have no picture, and why. */
function remark() {
  const sum = (counts) => Object.values(counts).reduce((total, count) => total + count, 0);
  const list = (counts) =>
    Object.entries(counts)
      .map(([name, count]) => `${experiment_title(name)}: ${formatCount(count)}`)
      .join(", ");
  const without = sum(pictures.without_picture);
  const dropped = sum(pictures.dropped);
  const have = (count, what) => (count === 1 ? `1 ${what} has` : `${formatCount(count)} ${what}s have`);
  const words = [];
  if (without > 0) words.push(`${have(without, "case")} no picture (${list(pictures.without_picture)}).`);
  if (without > dropped)
    words.push("Of an experiment with very many runs only each method’s worst results are kept as pictures.");
  if (dropped > 0) words.push(`${have(dropped, "case")} been left out to keep this page small.`);
  if (pictures.results_left_out > 0)
    words.push(`${have(pictures.results_left_out, "single result")} been left out for too many vertices.`);
  if (dropped + pictures.results_left_out > 0) words.push(pictures.rule);
  if (words.length === 0) return null;
  return make("p", { class: "gallery-remark" }, words.join(" "));
}

// The list.

/** The run that stands for a case under the filters; undefined: the case is filtered out. */
function run_for(entry) {
  if (filters.experiment && !entry.experiments.includes(filters.experiment)) return undefined;
  if (filters.shape && entry.family !== filters.shape) return undefined;
  const runs = entry.runs.filter(
    (run) =>
      (!filters.method || run.series === filters.method) &&
      (!filters.status || run.status === filters.status || (filters.status === "failed" && run.failed)),
  );
  return runs.length > 0 ? worst_run(runs) : undefined;
}

/** Experiment, family and ways to sample: what the mixed order takes turns of. */
function stratum(entry) {
  const [shape, ...ways] = entry.case.split("/")[0].split("~");
  const family = shape.split(/[-_]/)[0];
  return [entry.experiments[0], family, entry.holes, ...ways.map((way) => way.split(":")[0])].join(" ");
}

/** The worst of every stratum, then the second worst of each, and so on. */
function in_turn(shown) {
  const turns = new Map();
  const turn = new Map();
  for (const item of shown.sort(ORDERS.worst)) {
    const key = stratum(item.entry);
    turn.set(item, turns.get(key) ?? 0);
    turns.set(key, turn.get(item) + 1);
  }
  return shown.sort((a, b) => turn.get(a) - turn.get(b));
}

const ORDERS = {
  worst: (a, b) => badness(b.run) - badness(a.run) || 0,
  best: (a, b) => badness(a.run) - badness(b.run) || 0,
  name: (a, b) =>
    a.entry.title.localeCompare(b.entry.title, "en", { numeric: true }) ||
    a.entry.n - b.entry.n ||
    a.entry.holes - b.entry.holes,
};

function list_cards(grid, count, more, watcher) {
  const shown = entries.map((entry) => ({ entry, run: run_for(entry) })).filter((item) => item.run);
  if (filters.order === "mixed") in_turn(shown);
  else shown.sort(ORDERS[filters.order]);
  set_order(shown);
  count.textContent =
    shown.length === 0 ? "No case passes these filters." : `${shown.length} of ${entries.length} cases with a picture`;
  watcher.disconnect();
  grid.replaceChildren();
  add_cards(grid, shown.slice(0, FIRST_CARDS), watcher);
  more.hidden = shown.length <= FIRST_CARDS;
  more.textContent = `Show ${shown.length - FIRST_CARDS} more`;
}

function show_rest(grid, more, watcher) {
  const first_new = grid.children.length;
  add_cards(grid, cases_in_order().slice(first_new), watcher);
  more.hidden = true;
  grid.children[first_new].querySelector("button").focus();
}

function add_cards(grid, items, watcher) {
  for (const { entry, run } of items) {
    const card = make_card(entry, run);
    grid.append(make("li", {}, card));
    watcher.observe(card.querySelector("canvas"));
  }
}

function make_card(entry, run) {
  const canvas = make("canvas", { "aria-hidden": "true" });
  canvas.item = { entry, run };
  const words = run.l2 === null ? "no truth" : `L2 ${metric_text("l2", run.l2)}`;
  const facts = run.status === "ok" ? words : statusWords(run.status);
  return make(
    "button",
    {
      type: "button",
      class: "gallery-card",
      "data-case": entry.case,
      "data-run": run.name,
      "aria-haspopup": "dialog",
      click: () => openCase(entry.case, run.name),
    },
    canvas,
    make("span", { class: "gallery-card-title" }, entry.title),
    make("span", { class: "gallery-card-subtitle" }, entry.subtitle),
    make(
      "span",
      { class: "gallery-card-facts" },
      make("span", { class: "gallery-card-method" }, series_title(run.series)),
      make("span", { class: run.status === "ok" ? null : `status ${run.status}` }, facts),
    ),
  );
}

/** Paints a card's picture when it comes near the window. */
function watch_cards() {
  return new IntersectionObserver(
    (seen, watcher) => {
      for (const { isIntersecting, target } of seen) {
        if (!isIntersecting) continue;
        watcher.unobserve(target);
        unpack_card(target);
      }
    },
    { rootMargin: "300px" },
  );
}

async function unpack_card(canvas) {
  canvas.picture = await unpack(canvas.item.entry.source);
  canvas.classList.add("painted");
  if (canvas.isConnected) paint_card(canvas);
}

let known_colours = null;

function paint_card(canvas) {
  const { run } = canvas.item;
  known_colours ??= colours_of(canvas.closest(".gallery"));
  // Without a truth to hold the hull against, its outline and the points are what there is to see.
  const has_truth = canvas.picture.truth.length > 0;
  paint(canvas, canvas.picture, {
    view: fit(canvas.picture.box, canvas.clientWidth, canvas.clientHeight, 8),
    colours: known_colours,
    points: run.result === null || !has_truth,
    truth: true,
    shaded: run.result,
    lines: has_truth || run.result === null ? [] : [{ result: run.result, colour: known_colours.ink }],
    mark: null,
    fine: true,
  });
}
