// The forest plots of ratios: a line a method, then a line a run.
import { CHANGE_MARKS, forestHeight, forestOptions, formatRatioInterval } from "./comparison_options.js";
import {
  formatCount,
  formatNumber,
  formatTime,
  make,
  makeChoice,
  makeSearch,
  makeTip,
  smallButton,
  wordsOf,
} from "./format.js";
import { markerPicture } from "./markers.js";
import { MethodToggles } from "./method_toggles.js";
import { Plots } from "./plots.js";
import { themeInk } from "./theme.js";

const FOREST_PAGE = 40;

export class Forests extends Plots {
  constructor(place, report, rows, hidden, changed) {
    super();
    Object.assign(this, { report, rows, hidden });
    this.labels = new Map(report.entrants.map((entrant) => [entrant.key, entrant]));
    this.withRatio = [...Array(rows.count).keys()].filter((row) => rows.get("ratio", row) !== null);
    this.index();
    this.state = { words: "", changed: "", order: "method", page: 0 };
    this.build(place, changed);
    this.follow({ width: 660 });
    this.draw();
  }

  /** What filters and orders look at, by row: once, for a suite has twenty thousand rows. */
  index() {
    const { rows } = this;
    const all = [...Array(rows.count).keys()];
    const methods = new Map(this.report.entrants.map((entrant, index) => [entrant.key, index]));
    const cases = new Map();
    for (const row of all) if (!cases.has(rows.caseName(row))) cases.set(rows.caseName(row), cases.size);
    this.texts = all.map((row) => `${rows.name(row)} ${rows.shape(row)}`.toLowerCase());
    this.places = {
      method: all.map((row) => methods.get(rows.get("entrant", row))),
      cases: all.map((row) => cases.get(rows.caseName(row))),
    };
  }

  build(place, changed) {
    const choice = (words, key, options) =>
      makeChoice(words, { id: `forest-${key}` }, options, (value) => this.set({ [key]: value, page: 0 }));
    const words = makeSearch("Words in the run’s name", "forest-words", (typed) => this.set({ words: typed, page: 0 }));
    this.count = make("p", { class: "muted", id: "forest-count", "aria-live": "polite" });
    place.append(this.legend());
    this.toggles = new MethodToggles(place, this.report, this.hidden, changed);
    const changes = new Set(this.report.changes.map((one) => one.key));
    this.entrants = this.report.entrants.filter((entrant) => changes.has(entrant.key));
    place.append(
      this.figure("methods", "Every method: the median of its runs’ ratios"),
      make(
        "div",
        { class: "controls", role: "search", "aria-label": "Filter the runs of the chart" },
        words,
        choice("Runs", "changed", [
          ["", "all"],
          ["differ", "only those that differ"],
        ]),
        choice("Order", "order", [
          ["method", "by method"],
          ["case", "by case"],
          ["low", "smallest ratio first"],
          ["high", "largest ratio first"],
        ]),
      ),
      this.count,
      this.figure("runs", "Every run"),
      this.pager(),
    );
    this.plots = ["methods", "runs"].map((id) => this.plot(id, `forest-${id}`, 100));
  }

  legend() {
    const words = this.report.same_machine ? ["faster", "slower"] : ["lower time", "higher time"];
    const signs = [...words, "not told apart", "not judged"].map((change) => {
      const { marker, filled } = CHANGE_MARKS[change];
      return make(
        "span",
        { class: `change ${change.replaceAll(" ", "-")}${filled ? " filled" : ""}` },
        markerPicture(marker),
        change,
      );
    });
    const why = this.report.same_machine
      ? "Coloured only where the difference is significant, of a run after Holm’s correction over all; bars are 95 % intervals."
      : "The machines differ, so nothing is coloured; bars are 95 % intervals.";
    return make("p", { class: "legend", id: "forest-legend" }, ...signs, make("span", { class: "muted" }, why));
  }

  figure(id, title) {
    return make(
      "figure",
      { class: "plot forest", "data-testid": `forest-${id}` },
      make("figcaption", {}, title),
      make("div", { id: `forest-${id}`, role: "img", class: "forest-canvas" }),
    );
  }

  pager() {
    const button = (words, label, step) => smallButton(words, () => this.go(step), { "aria-label": label });
    this.page = make("span", { class: "page" });
    this.pages = make(
      "nav",
      { class: "pager", "aria-label": "Pages of the chart" },
      button("‹", "Previous runs", -1),
      this.page,
      button("›", "Next runs", 1),
    );
    return this.pages;
  }

  set(changes) {
    Object.assign(this.state, changes);
    this.draw();
  }

  go(step) {
    this.set({ page: Math.max(0, this.state.page + step) });
  }

  // What is shown.

  /** The rows that the choices leave, in their order. */
  find() {
    const { rows, state } = this;
    const words = wordsOf(state.words);
    const found = this.withRatio.filter(
      (row) =>
        !this.hidden.has(rows.get("entrant", row)) &&
        (!state.changed || !/^not /.test(rows.get("status", row))) &&
        words.every((word) => this.texts[row].includes(word)),
    );
    const { method, cases } = this.places;
    const ratio = (row) => rows.get("ratio", row);
    const by = {
      method: (a, b) => method[a] - method[b] || a - b,
      low: (a, b) => ratio(a) - ratio(b) || a - b,
      high: (a, b) => ratio(b) - ratio(a) || a - b,
      case: (a, b) => cases[a] - cases[b] || method[a] - method[b] || a - b,
    };
    return found.sort(by[state.order]);
  }

  methodLines() {
    return this.report.changes
      .filter((one) => !this.hidden.has(one.key))
      .map((one) => ({ ...one, label: this.labels.get(one.key).label, method: true }));
  }

  runLines(page) {
    const { rows, state } = this;
    const lines = [];
    let group = null;
    for (const row of page) {
      const method = this.labels.get(rows.get("entrant", row)).label;
      const shape = this.caseLabel(row);
      const [heading, label] = { method: [method, shape], case: [shape, method] }[state.order] ?? [
        null,
        `${shape} · ${method}`,
      ];
      if (heading !== null && heading !== group) lines.push({ heading, ratio: null, low: null, high: null });
      group = heading;
      const [ratio, low, high, change] = ["ratio", "ratio_low", "ratio_high", "status"].map((name) => rows.get(name, row));
      lines.push({ row, label, ratio, low, high, change });
    }
    return lines;
  }

  caseLabel(row) {
    const before = this.plots[1].chart.getWidth() < 500 ? " " : ", n = ";
    return `${this.rows.shape(row)}${before}${formatCount(this.rows.get("n", row))}${this.rows.get("holes", row) ? ", holes" : ""}`;
  }

  draw() {
    this.found = this.find();
    const last = Math.max(0, Math.ceil(this.found.length / FOREST_PAGE) - 1);
    this.state.page = Math.min(this.state.page, last);
    const from = this.state.page * FOREST_PAGE;
    const page = this.found.slice(from, from + FOREST_PAGE);
    const lines = { methods: this.methodLines(), runs: this.runLines(page) };
    const ink = themeInk();
    for (const { id, element, chart } of this.plots) {
      const height = forestHeight(lines[id].length);
      element.style.height = `${height}px`;
      element.parentElement.hidden = lines[id].length === 0;
      chart.resize({ height });
      const options = forestOptions(lines[id], ink, chart.getWidth());
      options.tooltip.formatter = (event) => (event.data?.line ? this.tooltip(event.data.line) : "");
      chart.setOption(options, { notMerge: true });
      element.setAttribute(
        "aria-label",
        `Ratios of times, B over A, with 95 % intervals: ${lines[id].length} lines. The values are in the table of ${id === "runs" ? "all runs" : "methods"}.`,
      );
    }
    this.count.textContent = this.countWords(from, page.length);
    this.pages.hidden = this.found.length <= FOREST_PAGE;
    this.page.textContent = `${formatCount(from + 1)} to ${formatCount(from + page.length)}`;
    this.toggles.draw(this.entrants);
    this.drawn = lines;
  }

  countWords(from, count) {
    if (this.found.length === 0) return "No run fits.";
    const said = `${formatCount(this.found.length)} of ${formatCount(this.withRatio.length)} runs with times in both`;
    return count === this.found.length ? said : `${said}, ${formatCount(from + 1)} to ${formatCount(from + count)} shown`;
  }

  tooltip(line) {
    const { report, rows } = this;
    const numbers = [
      ["B ÷ A", formatRatioInterval(line.ratio, line.low, line.high)],
      ["B is", `${report.signs[line.change]} ${line.change}`],
    ];
    if (line.method) {
      const runs = [
        ["Runs", `${line.pairs}, judged ${line.judged}`],
        ["Slower / faster", `${line.slower} / ${line.faster}`],
      ];
      return makeTip(line.label, "", [...numbers, ...runs]);
    }
    const time = (side) => formatTime(["", "_low", "_high"].map((end) => rows.get(`time_${side}${end}`, line.row)));
    const p = rows.get("adjusted_p_value", line.row);
    const label = this.labels.get(rows.get("entrant", line.row)).label;
    const judged = p === null ? [] : [["p by Holm", formatNumber(p)]];
    return makeTip(label, this.caseLabel(line.row), [["A", time("a")], ["B", time("b")], ...numbers, ...judged]);
  }
}
