// The table of all runs: filters, sorting, pages, a choice of columns and the command that repeats each run.
import { reproduceCommand, groupBy } from "./data.js";
import {
  announce,
  formatCount,
  formatNumber,
  formatScore,
  make,
  makeCheck,
  makeChoice,
  makeNamed,
  makeSearch,
  smallButton,
  statusWords,
  wordsOf,
} from "./format.js";

const PAGE_SIZES = [25, 50, 100, 250];

/** A column of words, of which `value` gives a row's: sorted as they are; `show` gives what is shown where it is more. */
export function wordColumn(id, title, value, usual = true, show = value) {
  return { id, title, group: "Run", usual, numeric: false, value, show };
}

/** A column of numbers or nulls; `show` gives a row's text or element when it is more than the number. */
export function numberColumn(id, title, usual, group, value, show = (row) => formatNumber(value(row), 4)) {
  return { id, title, group, usual, numeric: true, value, show };
}

export class RunTable {
  /** `gallery` is {has(run), open(case, run)}; null: there are no pictures. */
  constructor(place, report, rows, gallery = null) {
    Object.assign(this, { report, rows, gallery });
    this.labels = new Map(report.entrants.map((entrant) => [entrant.key, entrant]));
    this.columns = this.allColumns();
    this.state = {
      words: "",
      experiment: "",
      entrant: "",
      status: "",
      only: null, // {words, cases: names}: of some cases only
      sort: null,
      descending: false,
      page: 0,
      size: 50,
      shown: new Set(this.columns.filter((column) => column.usual).map((column) => column.id)),
    };
    this.build(place);
    this.find();
  }

  /** What the column and the filter of statuses are called. */
  statusTitle() {
    return "Status";
  }

  /** A function that gives a row's value in a column of the page's data. */
  get(name) {
    return (row) => this.rows.get(name, row);
  }

  /** [low, high] in small letters behind a value; nothing where there is no interval. */
  withInterval(value, low, high, format = formatNumber) {
    const [from, to] = [this.get(low), this.get(high)];
    return (row) =>
      make("span", {}, value(row), make("small", {}, from(row) === null ? "" : `[${format(from(row))}, ${format(to(row))}]`));
  }

  /** {id, title, group, numeric, usual, value(row), show(row)}: value is sorted by, show is a text or an element. */
  allColumns() {
    const { rows, report } = this;
    const interval = this.withInterval((row) => formatNumber(rows.get("time", row)), "time_low", "time_high");
    const repetitions = (row) => formatCount(rows.get("repetitions", row));
    const seed = (row) => String(rows.get("seed", row) ?? "–");
    const metrics = report.metrics.filter((metric) => rows.has(`metric ${metric.name}`));
    const parameters = Object.keys(rows.columns).filter((name) => name.startsWith("parameter "));
    const show = (row) => this.reproduce(row);
    return [
      ...this.caseColumns(),
      numberColumn("time", "Time, ms", true, "Time", this.get("time"), interval),
      numberColumn("paper_time", "Time as in the paper, ms", false, "Time", this.get("paper_time")),
      numberColumn("repetitions", "Repetitions", false, "Time", this.get("repetitions"), repetitions),
      ...metrics.map((metric) => this.metricColumn(metric)),
      ...parameters.map((name) => this.parameterColumn(name)),
      wordColumn("flags", "Doubts", this.get("flags"), rows.columns.flags.words.some(Boolean)),
      wordColumn("version", "Version", this.get("version"), false),
      ...(rows.has("output") ? [wordColumn("output", "Result’s SHA-256", this.get("output"), false)] : []),
      numberColumn("seed", "Seed", false, "Run", this.get("seed"), seed),
      { id: "reproduce", title: "Reproduce", group: "Run", usual: true, numeric: false, fixed: true, show },
      this.detailColumn(rows.columns.status.words.some((status) => status !== "ok")),
    ];
  }

  /** What tells a row from the others, and how it ended. */
  caseColumns() {
    const { rows } = this;
    const { experiments } = this.report;
    const experiment = (row) => experiments[rows.get("experiment", row)].title;
    const method = (row) => this.labels.get(rows.get("entrant", row)).label;
    return [
      wordColumn("experiment", "Experiment", experiment, experiments.length > 1),
      wordColumn("method", "Method", method, true, (row) => this.method(row)),
      wordColumn("shape", "Shape", (row) => rows.shape(row)),
      numberColumn("n", "n", true, "Run", this.get("n"), (row) => formatCount(rows.get("n", row))),
      wordColumn("holes", "Holes", (row) => (rows.get("holes", row) ? "yes" : "no")),
      wordColumn("status", this.statusTitle(), this.get("status"), true, (row) => this.status(row)),
    ];
  }

  detailColumn(usual) {
    const detail = this.get("detail");
    return wordColumn("detail", "Why", detail, usual, (row) =>
      make("span", { class: "detail", tabindex: detail(row) ? "0" : null }, detail(row)),
    );
  }

  status(row) {
    const status = this.rows.get("status", row);
    return make("span", { class: `status ${status}` }, statusWords(status));
  }

  metricColumn(metric) {
    const title = metric.title + (metric.unit ? `, ${metric.unit}` : "");
    const value = (row) => {
      const raw = this.rows.get(`metric ${metric.name}`, row);
      return raw === null ? null : raw * metric.factor;
    };
    return numberColumn(`metric-${metric.name}`, title, ["l2", "iou"].includes(metric.name), "Scores", value, (row) =>
      formatScore(metric, value(row), 4),
    );
  }

  /** Sorted as numbers; "∞" is how the records write the largest one. */
  parameterColumn(name) {
    const raw = this.get(name);
    const value = (row) => (raw(row) === "∞" ? Infinity : raw(row));
    return numberColumn(name, name.slice("parameter ".length), false, "Parameters", value, (row) => formatNumber(raw(row), 4));
  }

  method(row) {
    const entrant = this.labels.get(this.rows.get("entrant", row));
    return makeNamed(entrant.method, entrant.label);
  }

  reproduce(row) {
    const command = reproduceCommand(this.report.experiments[this.rows.get("experiment", row)], this.rows.name(row));
    const code = make("code", { title: command }, command);
    const run = this.rows.name(row);
    const copied = () => copyText(command, code, copy);
    const copy = smallButton("Copy", copied, { "aria-label": `Copy the command for ${run}` });
    const open = () => this.gallery.open(this.rows.caseName(row), run);
    const picture = this.gallery?.has(run) ? smallButton("Picture", open, { "aria-label": `Picture of ${run}` }) : null;
    return make("span", { class: "reproduce" }, picture, copy, code);
  }

  // What stays.

  build(place) {
    const { experiments, entrants } = this.report;
    const filter = (words, key, options) =>
      makeChoice(words, { id: `filter-${key}` }, [["", "all"], ...options], (value) => this.set({ [key]: value }));
    const titles = experiments.map((one, index) => [index, one.title]);
    const labels = entrants.map((entrant) => [entrant.key, entrant.label]);
    const statuses = this.rows.columns.status.words.map((status) => [status, statusWords(status)]);
    const sizes = PAGE_SIZES.map((size) => [size, String(size)]);
    const size = makeChoice("Rows a page", { id: "page-size" }, sizes, (value) => this.set({ size: Number(value) }));
    size.lastChild.value = this.state.size;
    this.count = make("p", { class: "muted", id: "table-count", "aria-live": "polite" });
    this.table = make("table", { id: "runs-table", "data-testid": "runs-table" });
    this.pagers = ["top", "bottom"].map((where) => this.pager(where));
    const search = makeSearch("Words in the name or reason", "filter-words", (words) => this.set({ words }));
    const scroll = { class: "scroll", id: "runs-scroll", tabindex: "0", role: "region", "aria-label": "All runs" };
    const showAll = () => {
      this.set({ only: null });
      document.getElementById("runs-scroll").focus(); // the button is gone
    };
    this.only = make("button", { type: "button", id: "table-only", hidden: true, click: showAll });
    place.append(
      make(
        "div",
        { class: "controls", role: "search", "aria-label": "Filter the runs" },
        search,
        experiments.length > 1 ? filter("Experiment", "experiment", titles) : null,
        filter("Method", "entrant", labels),
        filter(this.statusTitle(), "status", statuses),
        size,
      ),
      this.columnChooser(),
      this.only,
      this.count,
      this.pagers[0],
      make("div", scroll, this.table),
      this.pagers[1],
    );
    this.controls = {};
    for (const key of ["words", "experiment", "entrant", "status"]) {
      const control = place.querySelector(`#filter-${key}`);
      if (control) this.controls[key] = control;
    }
  }

  columnChooser() {
    const choosable = this.columns.filter((column) => !column.fixed);
    const groups = groupBy(choosable, (column) => column.group);
    const box = ({ id, title, usual }) =>
      makeCheck(title, { checked: usual, "data-column": id }, (checked) => {
        this.state.shown[checked ? "add" : "delete"](id);
        this.draw();
      });
    return make(
      "details",
      { class: "columns", id: "column-chooser" },
      make("summary", {}, "Columns"),
      ...[...groups].map(([name, columns]) => make("fieldset", {}, make("legend", {}, name), ...columns.map(box))),
    );
  }

  pager(where) {
    const button = (words, label, go) => smallButton(words, () => this.go(go()), { "aria-label": label, "data-go": label });
    const keydown = (event) => this.key(event);
    return make(
      "nav",
      { class: "pager", "aria-label": `Pages, ${where}`, "data-testid": `pager-${where}`, keydown },
      button("«", "First page", () => 0),
      button("‹", "Previous page", () => this.state.page - 1),
      make("span", { class: "page" }),
      button("›", "Next page", () => this.state.page + 1),
      button("»", "Last page", () => this.pages() - 1),
    );
  }

  key(event) {
    const to = { ArrowLeft: this.state.page - 1, ArrowRight: this.state.page + 1, Home: 0, End: this.pages() - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    this.go(to);
  }

  // Finding and showing.

  set(changes) {
    Object.assign(this.state, changes, { page: 0 });
    for (const [key, control] of Object.entries(this.controls)) control.value = this.state[key];
    this.find();
  }

  go(page) {
    this.state.page = Math.min(Math.max(0, page), this.pages() - 1);
    this.draw();
  }

  pages() {
    return Math.max(1, Math.ceil(this.found.length / this.state.size));
  }

  /** The rows that the filters leave, in order. Every word must be in the name or the reason. */
  find() {
    const { rows, state } = this;
    const words = wordsOf(state.words);
    this.found = [];
    for (let row = 0; row < rows.count; row++) {
      if (state.experiment !== "" && rows.get("experiment", row) !== Number(state.experiment)) continue;
      if (state.entrant && rows.get("entrant", row) !== state.entrant) continue;
      if (state.status && rows.get("status", row) !== state.status) continue;
      if (state.only && !state.only.cases.has(rows.caseName(row))) continue;
      if (words.length) {
        const text = `${rows.name(row)} ${rows.shape(row)} ${rows.get("status", row)} ${rows.get("detail", row)}`.toLowerCase();
        if (!words.every((word) => text.includes(word))) continue;
      }
      this.found.push(row);
    }
    this.sort();
    this.draw();
  }

  /** Rows without a value are last, whatever the direction. */
  sort() {
    const column = this.columns.find((one) => one.id === this.state.sort);
    if (!column) return;
    const sign = this.state.descending ? -1 : 1;
    const missing = (value) => value === null || value === undefined || value === "";
    const keys = new Map(this.found.map((row) => [row, column.value(row)]));
    const order = new Intl.Collator("en", { numeric: true });
    this.found.sort((a, b) => {
      const [one, other] = [keys.get(a), keys.get(b)];
      if (missing(one) || missing(other)) return missing(one) - missing(other) || a - b;
      const both = typeof one === "number" && typeof other === "number";
      return sign * (both ? one - other : order.compare(one, other)) || a - b;
    });
  }

  sortBy(id) {
    this.state.descending = this.state.sort === id ? !this.state.descending : false;
    this.state.sort = id;
    this.state.page = 0;
    this.find();
    announce(
      `Sorted by ${this.columns.find((column) => column.id === id).title}, ${this.state.descending ? "descending" : "ascending"}.`,
    );
  }

  draw() {
    const columns = this.columns.filter((column) => column.fixed || this.state.shown.has(column.id));
    const from = this.state.page * this.state.size;
    const page = this.found.slice(from, from + this.state.size);
    const focused = document.activeElement?.closest?.("#runs-table th")?.dataset.column;
    const cells = (row) =>
      columns.map((column) =>
        make("td", { class: column.numeric ? "number" : column.fixed ? "fixed" : null }, column.show(row)),
      );
    this.table.replaceChildren(
      make("thead", {}, make("tr", {}, ...columns.map((column) => this.head(column)))),
      make("tbody", {}, ...page.map((row) => make("tr", { "data-run": this.rows.name(row) }, ...cells(row)))),
    );
    if (focused) this.table.querySelector(`th[data-column="${CSS.escape(focused)}"] button`)?.focus();
    this.count.textContent =
      this.found.length === 0
        ? "No run fits."
        : `${formatCount(this.found.length)} of ${formatCount(this.rows.count)} runs, ${formatCount(from + 1)} to ${formatCount(from + page.length)} shown`;
    this.only.hidden = !this.state.only;
    if (this.state.only) this.only.textContent = `Only the cases of ${this.state.only.words}: show all again`;
    for (const pager of this.pagers) this.drawPager(pager);
  }

  head(column) {
    if (column.fixed) return make("th", { scope: "col", class: "fixed" }, column.title);
    const sorted = this.state.sort === column.id ? (this.state.descending ? "descending" : "ascending") : "none";
    return make(
      "th",
      { scope: "col", class: column.numeric ? "number" : null, "aria-sort": sorted, "data-column": column.id },
      make("button", { type: "button", class: "sort", click: () => this.sortBy(column.id) }, column.title),
    );
  }

  drawPager(pager) {
    pager.hidden = this.pages() === 1;
    pager.querySelector(".page").textContent = `Page ${formatCount(this.state.page + 1)} of ${formatCount(this.pages())}`;
    const [first, last] = [this.state.page === 0, this.state.page === this.pages() - 1];
    // aria-disabled, so that a button that has the focus keeps it.
    for (const button of pager.querySelectorAll("button"))
      button.setAttribute("aria-disabled", String(/First|Prev/.test(button.dataset.go) ? first : last));
  }
}

/** Copies; where the browser does not allow it, selects the text so that Ctrl+C does. */
async function copyText(text, element, button) {
  let done = true;
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    getSelection().selectAllChildren(element);
    done = document.execCommand("copy");
  }
  button.textContent = done ? "Copied" : "Ctrl+C";
  announce(done ? "Copied." : "Selected; press Ctrl and C to copy.");
  setTimeout(() => (button.textContent = "Copy"), 1500);
}
