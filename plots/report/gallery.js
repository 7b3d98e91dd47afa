"use strict";
/* The gallery: a small picture of every case that has one, the worst first, to be filtered; a click opens it large
   (case_dialog.js). mountGallery() fills the page's element; hasPicture() tells the table which rows can be opened.
   Uses make, formatNumber, formatMetric, formatTime and formatCount of format.js, cssColour and onTheme of theme.js. */
const caseGallery = (() => {
  const FIRST_CARDS = 48;
  // As many as gallery.css leaves on paper.
  const PRINTED_CARDS = 12;
  // Statuses that say nothing about a result.
  const NOT_TRIED = ["not_installed", "unsupported"];
  const STATUS_WORDS = {
    ok: "ok",
    invalid_output: "invalid result",
    timeout: "timeout",
    memory: "out of memory",
    crash: "crash",
    error: "error",
    unsupported: "not supported",
    not_installed: "not installed",
  };
  let entries = [];
  let report = { entrants: [], metrics: [], experiments: [] };
  let pictures = {
    cases: [],
    methods: {},
    without_picture: {},
    dropped: {},
    results_left_out: 0,
    rule: "",
    points_limit: 0,
  };
  let shown = [];

  // ---- what is known of cases and runs --------------------------------------------------------------------

  /** The columns of a run by name, its index in the picture's runs, and what follows from them. */
  function make_run(entry, values, index) {
    const run = Object.fromEntries(pictures.run_columns.map((column, k) => [column, values[k]]));
    run.index = index;
    run.name = `${run.method}/${entry.case}/protocol:${run.protocol}`;
    run.series = `${run.method} ${run.protocol}`;
    run.failed = run.status !== "ok" && !NOT_TRIED.includes(run.status);
    return run;
  }

  /** For sorting: failures are worse than any error, what was not tried better than any. */
  function badness(run) {
    if (run.failed) return Infinity;
    return run.status === "ok" && run.l2 !== null ? run.l2 : -1;
  }

  function worst_run(runs) {
    return runs.reduce((worst, run) => (badness(run) > badness(worst) ? run : worst));
  }

  function make_entry(source) {
    const entry = { ...source, source };
    const place = (run) =>
      report.entrants.findIndex((one) => one.method === run.method && one.protocol === run.protocol);
    entry.runs = source.runs
      .map((values, index) => make_run(source, values, index))
      .sort((a, b) => place(a) - place(b));
    entry.family = source.title.replace(/ \d+$/, "");
    entry.subtitle = `${formatCount(source.n)} points, ${source.holes ? "with holes" : "no holes"}`;
    return entry;
  }

  function method_colour(name) {
    return cssColour(`--method-${name}`) || "gray";
  }

  /** The name of a method, with the protocol where the run has several of it. */
  function series_title(series) {
    const [method, protocol] = series.split(" ");
    const entrant = report.entrants.find((one) => one.method === method && one.protocol === protocol);
    return entrant?.label ?? pictures.methods[method] ?? method;
  }

  function status_words(status) {
    return STATUS_WORDS[status] ?? status.replaceAll("_", " ");
  }

  /** A metric's value as the table shows it, with its unit. */
  function metric_text(name, value) {
    const metric = report.metrics.find((one) => one.name === name);
    return metric ? formatMetric(metric, value) : formatNumber(value);
  }

  /** Name, title and value of each number among a run's metrics, in the table's order; places are no scores. */
  function metric_list(metrics) {
    return report.metrics
      .filter(({ name }) => typeof metrics[name] === "number" && !/_[xy]$/.test(name))
      .map((metric) => ({ name: metric.name, title: metric.title, text: formatMetric(metric, metrics[metric.name]) }));
  }

  function time_text(ns) {
    return formatTime(ns === null ? null : [ns / 1e6, null, null]);
  }

  // ---- the page's part ------------------------------------------------------------------------------------

  const filters = { method: "", experiment: "", shape: "", status: "", order: "worst" };

  function mount(element, page_report, page_pictures) {
    report = page_report;
    pictures = { ...pictures, ...page_pictures };
    entries = pictures.cases.map(make_entry);
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
    // The page's first method, rather than each case's worst: that is often the simplest one everywhere.
    const first = report.entrants
      .map((one) => `${one.method} ${one.protocol}`)
      .find((series) => entries.some((entry) => entry.runs.some((run) => run.series === series)));
    filters.method = first ?? "";
    element.replaceChildren(
      ...[filter_bar(refresh), failures_button(element, refresh), legend(), count, grid, more, remark()].filter(
        Boolean,
      ),
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
      const chosen = () => {
        filters[key] = select.value;
        refresh();
      };
      const select = make("select", { name: `gallery-${key}`, change: chosen });
      if (all) select.append(make("option", { value: "" }, all));
      for (const [value, text] of options) select.append(make("option", { value }, text));
      select.value = filters[key];
      bar.append(make("label", {}, title, select));
    };
    const distinct = (values) => [...new Set(values)];
    const runs = entries.flatMap((entry) => entry.runs);
    add(
      "method",
      "Method",
      "each case’s worst",
      distinct(runs.map((run) => run.series)).map((series) => [series, series_title(series)]),
    );
    add(
      "experiment",
      "Experiment",
      "all",
      distinct(entries.flatMap((entry) => entry.experiments)).map((name) => [name, experiment_title(name)]),
    );
    add(
      "shape",
      "Shape",
      "all",
      distinct(entries.map((entry) => entry.family))
        .sort()
        .map((name) => [name, name]),
    );
    add("status", "Status", "all", status_options(runs));
    add("order", "Order", null, [
      ["worst", "worst first"],
      ["best", "best first"],
      ["name", "by shape and size"],
    ]);
    return bar;
  }

  function status_options(runs) {
    const there = [...new Set(runs.map((run) => run.status))].sort();
    const failed = runs.some((run) => run.failed) ? [["failed", "any failure"]] : [];
    return [...failed, ...there.map((status) => [status, status_words(status)])];
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
    return make(
      "p",
      { class: "gallery-legend" },
      item("both", "found"),
      item("missed", "missed"),
      item("added", "wrongly added"),
      item("truth", "ground truth"),
    );
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

  // ---- the list -------------------------------------------------------------------------------------------

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

  const ORDERS = {
    worst: (a, b) => badness(b.run) - badness(a.run) || 0,
    best: (a, b) => badness(a.run) - badness(b.run) || 0,
    name: (a, b) =>
      a.entry.title.localeCompare(b.entry.title, "en", { numeric: true }) ||
      a.entry.n - b.entry.n ||
      a.entry.holes - b.entry.holes,
  };

  function list_cards(grid, count, more, watcher) {
    shown = entries.map((entry) => ({ entry, run: run_for(entry) })).filter((item) => item.run);
    shown.sort(ORDERS[filters.order]);
    count.textContent =
      shown.length === 0
        ? "No case passes these filters."
        : `${shown.length} of ${entries.length} cases with a picture`;
    watcher.disconnect();
    grid.replaceChildren();
    add_cards(grid, shown.slice(0, FIRST_CARDS), watcher);
    more.hidden = shown.length <= FIRST_CARDS;
    more.textContent = `Show ${shown.length - FIRST_CARDS} more`;
  }

  function show_rest(grid, more, watcher) {
    const first_new = grid.children.length;
    add_cards(grid, shown.slice(first_new), watcher);
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
    const facts = run.status === "ok" ? `L2 ${metric_text("l2", run.l2)}` : status_words(run.status);
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
    const watcher = new IntersectionObserver(
      (seen) => {
        for (const { isIntersecting, target } of seen) {
          if (!isIntersecting) continue;
          watcher.unobserve(target);
          unpack_card(target);
        }
      },
      { rootMargin: "300px" },
    );
    return watcher;
  }

  async function unpack_card(canvas) {
    canvas.picture = await casePicture.unpack(canvas.item.entry.source);
    canvas.classList.add("painted");
    if (canvas.isConnected) paint_card(canvas);
  }

  let known_colours = null;

  function paint_card(canvas) {
    const { run } = canvas.item;
    known_colours ??= casePicture.colours_of(canvas.closest(".gallery"));
    casePicture.paint(canvas, canvas.picture, {
      view: casePicture.fit(canvas.picture.box, canvas.clientWidth, canvas.clientHeight, 8),
      colours: known_colours,
      points: run.result === null,
      truth: true,
      shaded: run.result,
      lines: [],
      mark: null,
      fine: true,
    });
  }

  /** The entry of a case that has this run; any run when none is named. */
  function find(case_name, run_name) {
    const named = entries.filter((entry) => entry.case === case_name);
    return named.find((entry) => entry.runs.some((run) => run.name === run_name)) ?? named[0];
  }

  let drawn_runs = null;

  function has_picture(run_name) {
    drawn_runs ??= new Set(
      entries.flatMap((entry) => entry.runs.filter((run) => run.result !== null).map((run) => run.name)),
    );
    return drawn_runs.has(run_name);
  }

  return {
    mount,
    find,
    has_picture,
    worst_run,
    method_colour,
    series_title,
    status_words,
    metric_text,
    metric_list,
    time_text,
    /** The cases in the order of the list, each with the run that stands for it. */
    in_order: () => shown,
  };
})();

/** Fills `element` with the gallery of `pictures` (the object of plots/pictures.py, with at least one case). `report` is the page's own; of it
    "entrants", "metrics" and the experiments' titles are used. */
function mountGallery(element, report, pictures) {
  caseGallery.mount(element, report, pictures);
}

/** Whether the result of a run, by the run's name, can be shown. */
function hasPicture(run_name) {
  return caseGallery.has_picture(run_name);
}
