// The table of all runs: filters, sorting, pages, a choice of columns and the command that repeats each run.

const PAGE_SIZES = [25, 50, 100, 250];

/** A column of words, of which `value` gives a row's: shown and sorted as they are. */
function wordColumn(id, title, value, usual = true, group = "Run") {
  return { id, title, group, usual, numeric: false, value, show: value };
}

/** A column of numbers or nulls; `show` gives a row's text or element when it is more than the number. */
function numberColumn(id, title, usual, group, value, show = (row) => formatNumber(value(row), 4)) {
  return { id, title, group, usual, numeric: true, value, show };
}

class RunTable {
  constructor(place, report, rows) {
    this.report = report;
    this.rows = rows;
    this.labels = new Map(report.entrants.map((entrant) => [entrant.key, entrant]));
    this.columns = this.allColumns();
    this.state = {
      words: "",
      experiment: "",
      entrant: "",
      status: "",
      sort: null,
      descending: false,
      page: 0,
      size: 50,
      shown: new Set(this.columns.filter((column) => column.usual).map((column) => column.id)),
    };
    this.build(place);
    this.find();
  }

  /** {id, title, group, numeric, usual, value(row), show(row)}: value is sorted by, show is a text or an element. */
  allColumns() {
    const { rows, report } = this;
    const get = (name) => (row) => rows.get(name, row);
    const interval = (row) =>
      rows.get("time_low", row) === null
        ? ""
        : `[${formatNumber(rows.get("time_low", row))}, ${formatNumber(rows.get("time_high", row))}]`;
    const columns = [
      wordColumn(
        "experiment",
        "Experiment",
        (row) => report.experiments[rows.get("experiment", row)].title,
        report.experiments.length > 1,
      ),
      wordColumn("method", "Method", (row) => this.labels.get(rows.get("entrant", row)).label),
      wordColumn("shape", "Shape", (row) => rows.shape(row)),
      numberColumn("n", "n", true, "Run", get("n"), (row) => formatCount(rows.get("n", row))),
      wordColumn("holes", "Holes", (row) => (rows.get("holes", row) ? "yes" : "no")),
      wordColumn("status", "Status", get("status")),
      numberColumn("time", "Time, ms", true, "Time", get("time"), (row) =>
        make("span", {}, formatNumber(rows.get("time", row)), make("small", {}, interval(row))),
      ),
      numberColumn("paper_time", "Time as in the paper, ms", false, "Time", get("paper_time")),
      numberColumn("repetitions", "Repetitions", false, "Time", get("repetitions"), (row) =>
        formatCount(rows.get("repetitions", row)),
      ),
      ...report.metrics
        .filter((metric) => rows.has(`metric ${metric.name}`))
        .map((metric) => this.metricColumn(metric)),
      ...Object.keys(rows.columns)
        .filter((name) => name.startsWith("parameter "))
        .map((name) => numberColumn(name, name.slice("parameter ".length), false, "Parameters", get(name))),
      wordColumn("flags", "Doubts", get("flags"), rows.columns.flags.words.some(Boolean)),
      wordColumn("version", "Version", get("version"), false),
      ...(rows.has("output") ? [wordColumn("output", "Result’s SHA-256", get("output"), false)] : []),
      numberColumn("seed", "Seed", false, "Run", get("seed"), (row) => String(rows.get("seed", row) ?? "–")),
      {
        id: "reproduce",
        title: "Reproduce",
        group: "Run",
        usual: true,
        numeric: false,
        fixed: true,
        show: (row) => this.reproduce(row),
      },
      wordColumn("detail", "Why", get("detail"), this.hasFailures()),
    ];
    columns.find((column) => column.id === "method").show = (row) => this.method(row);
    columns.find((column) => column.id === "status").show = (row) =>
      make("span", { class: `status ${rows.get("status", row)}` }, rows.get("status", row).replace("_", " "));
    columns.find((column) => column.id === "detail").show = (row) =>
      make("span", { class: "detail" }, rows.get("detail", row));
    return columns;
  }

  metricColumn(metric) {
    const short = { l2: "L2, %", l2_paper: "L2 as in the paper, %", iou: "IoU" }[metric.name];
    const title = short ?? metric.title + (metric.unit ? `, ${metric.unit}` : "");
    const value = (row) => {
      const raw = this.rows.get(`metric ${metric.name}`, row);
      return raw === null ? null : raw * metric.factor;
    };
    return numberColumn(`metric-${metric.name}`, title, ["l2", "iou"].includes(metric.name), "Scores", value, (row) =>
      formatScore(metric, value(row), 4),
    );
  }

  hasFailures() {
    return this.rows.columns.status.words.some((status) => status !== "ok");
  }

  method(row) {
    const entrant = this.labels.get(this.rows.get("entrant", row));
    return make("span", {}, make("span", { class: "swatch", "data-method": entrant.method }), entrant.label);
  }

  reproduce(row) {
    const command = reproduceCommand(this.report.experiments[this.rows.get("experiment", row)], this.rows.name(row));
    const code = make("code", { title: command }, command);
    const copy = make(
      "button",
      {
        type: "button",
        class: "small",
        "aria-label": `Copy the command for ${this.rows.name(row)}`,
        click: () => copyText(command, code, copy),
      },
      "Copy",
    );
    const run = this.rows.name(row);
    const picture =
      typeof hasPicture === "function" && hasPicture(run)
        ? make(
            "button",
            {
              type: "button",
              class: "small",
              "aria-label": `Picture of ${run}`,
              click: () => openCase(this.rows.caseName(row), run),
            },
            "Picture",
          )
        : null;
    return make("span", { class: "reproduce" }, picture, copy, code);
  }

  // What stays.

  build(place) {
    const filter = (words, key, options) =>
      make(
        "label",
        {},
        words,
        make(
          "select",
          { id: `filter-${key}`, change: (event) => this.set({ [key]: event.target.value }) },
          make("option", { value: "" }, "all"),
          ...options.map(([value, label]) => make("option", { value }, label)),
        ),
      );
    this.count = make("p", { class: "muted", id: "table-count", "aria-live": "polite" });
    this.table = make("table", { id: "runs-table", "data-testid": "runs-table" });
    this.pagers = ["top", "bottom"].map((where) => this.pager(where));
    const search = make("input", {
      type: "search",
      id: "filter-words",
      placeholder: "ca holes:1 n:64000",
      autocomplete: "off",
      input: (event) => this.set({ words: event.target.value }),
    });
    place.append(
      make(
        "div",
        { class: "controls", role: "search", "aria-label": "Filter the runs" },
        make("label", {}, "Words in the name or reason", search),
        this.report.experiments.length > 1
          ? filter(
              "Experiment",
              "experiment",
              this.report.experiments.map((one, index) => [index, one.title]),
            )
          : null,
        filter(
          "Method",
          "entrant",
          this.report.entrants.map((entrant) => [entrant.key, entrant.label]),
        ),
        filter(
          "Status",
          "status",
          this.rows.columns.status.words.map((status) => [status, status.replace("_", " ")]),
        ),
        make(
          "label",
          {},
          "Rows a page",
          make(
            "select",
            { id: "page-size", change: (event) => this.set({ size: Number(event.target.value) }) },
            ...PAGE_SIZES.map((size) =>
              make("option", { value: size, selected: size === this.state.size }, String(size)),
            ),
          ),
        ),
      ),
      this.columnChooser(),
      this.count,
      this.pagers[0],
      make(
        "div",
        { class: "scroll", id: "runs-scroll", tabindex: "0", role: "region", "aria-label": "All runs" },
        this.table,
      ),
      this.pagers[1],
    );
  }

  columnChooser() {
    const groups = groupBy(
      this.columns.filter((column) => !column.fixed),
      (column) => column.group,
    );
    const box = (column) =>
      make(
        "label",
        { class: "check" },
        make("input", {
          type: "checkbox",
          checked: column.usual,
          "data-column": column.id,
          change: (event) => {
            this.state.shown[event.target.checked ? "add" : "delete"](column.id);
            this.draw();
          },
        }),
        column.title,
      );
    return make(
      "details",
      { class: "columns", id: "column-chooser" },
      make("summary", {}, "Columns"),
      ...[...groups].map(([name, columns]) => make("fieldset", {}, make("legend", {}, name), ...columns.map(box))),
    );
  }

  pager(where) {
    const button = (words, label, go) =>
      make(
        "button",
        { type: "button", class: "small", "aria-label": label, "data-go": label, click: () => this.go(go()) },
        words,
      );
    return make(
      "nav",
      {
        class: "pager",
        "aria-label": `Pages, ${where}`,
        "data-testid": `pager-${where}`,
        keydown: (event) => this.key(event),
      },
      button("«", "First page", () => 0),
      button("‹", "Previous page", () => this.state.page - 1),
      make("span", { class: "page" }),
      button("›", "Next page", () => this.state.page + 1),
      button("»", "Last page", () => this.pages() - 1),
    );
  }

  key(event) {
    const to = { ArrowLeft: this.state.page - 1, ArrowRight: this.state.page + 1, Home: 0, End: this.pages() - 1 }[
      event.key
    ];
    if (to === undefined) return;
    event.preventDefault();
    this.go(to);
  }

  // Finding and showing.

  set(changes) {
    Object.assign(this.state, changes, { page: 0 });
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
    const words = state.words.toLowerCase().split(/\s+/).filter(Boolean);
    this.found = [];
    for (let row = 0; row < rows.count; row++) {
      if (state.experiment !== "" && rows.get("experiment", row) !== Number(state.experiment)) continue;
      if (state.entrant && rows.get("entrant", row) !== state.entrant) continue;
      if (state.status && rows.get("status", row) !== state.status) continue;
      if (words.length) {
        const text =
          `${rows.name(row)} ${rows.shape(row)} ${rows.get("status", row)} ${rows.get("detail", row)}`.toLowerCase();
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
    pager.querySelector(".page").textContent =
      `Page ${formatCount(this.state.page + 1)} of ${formatCount(this.pages())}`;
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
