// The section "Time and error": what is chosen, the three charts and their values as a table.

class Charts {
  /** Builds the section in `place` and draws. `report` and `charts` are the page's data. */
  constructor(place, report, charts) {
    this.report = report;
    this.charts = charts;
    this.metrics = new Map(report.metrics.map((metric) => [metric.name, metric]));
    this.state = {
      chart: 0,
      time: "time",
      metric: "l2",
      logX: true,
      logTime: true,
      logError: true,
      bands: true,
      hidden: new Set(),
      paretoCase: null,
    };
    this.state.chart = this.firstChart();
    this.build(place);
    this.plots = ["time", "error", "pareto"].map((id) => this.plot(id));
    onTheme(() => this.draw());
    // As wide as a sheet, and drawn anew, for labels and dots are placed by the width.
    addEventListener("beforeprint", () => this.resizeAll({ width: 660, height: 360 }));
    addEventListener("afterprint", () => this.resizeAll({ width: "auto", height: "auto" }));
    this.choose();
  }

  /** The chart to begin with: the first over numbers of points, else the first. */
  firstChart() {
    return Math.max(
      0,
      this.charts.findIndex((chart) => chart.kind === "n"),
    );
  }

  chart() {
    return this.charts[this.state.chart];
  }

  metric() {
    return this.metrics.get(this.state.metric) ?? [...this.metrics.values()].find((metric) => metric.charted);
  }

  quantities() {
    const metric = this.metric();
    const paper = this.state.time === "paper_time";
    return {
      time: {
        kind: "time",
        name: this.state.time,
        title: paper ? "Time as the paper took it" : "Time of equal work",
        axis: paper ? "Time as the paper took it, ms" : "Time of equal work, ms",
      },
      error: {
        kind: "metric",
        name: metric.name,
        metric,
        title: metric.title,
        axis: metric.title + (metric.unit ? `, ${metric.unit}` : ""),
      },
    };
  }

  /** The entrants that have results in the chart, in their order, with their colours in this theme. */
  entrants() {
    const theme = currentTheme();
    return this.report.entrants
      .filter((entrant) => this.chart().series[entrant.key])
      .map((entrant) => ({
        ...entrant,
        marker: this.report.methods[entrant.method].marker,
        colour: this.report.methods[entrant.method][theme],
      }));
  }

  shown() {
    return this.entrants().filter((entrant) => !this.state.hidden.has(entrant.key));
  }

  // What stays while choices change.

  build(place) {
    const option = (value, label) => make("option", { value }, label);
    const groups = this.report.experiments.map((experiment, index) =>
      make(
        "optgroup",
        { label: experiment.title },
        ...this.charts.flatMap((chart, number) =>
          chart.experiment === index ? [option(number, `${experiment.title}: ${chart.title}`)] : [],
        ),
      ),
    );
    this.chartSelect = make(
      "select",
      { id: "chart-select", change: (event) => this.set({ chart: Number(event.target.value), paretoCase: null }) },
      ...groups,
    );
    this.chartSelect.value = this.state.chart;
    this.timeSelect = make(
      "select",
      { id: "time-select", change: (event) => this.set({ time: event.target.value }) },
      option("time", "of equal work"),
      option("paper_time", "as the paper took it"),
    );
    this.metricSelect = make("select", {
      id: "metric-select",
      change: (event) => this.chooseMetric(event.target.value),
    });
    this.toggles = make("div", {
      class: "toggles",
      id: "method-toggles",
      role: "group",
      "aria-label": "Methods shown",
    });
    this.missing = make("p", { class: "muted", id: "chart-missing" });
    place.append(
      make(
        "div",
        { class: "controls" },
        make("label", {}, "Shape", this.chartSelect),
        make("label", {}, "Time", this.timeSelect),
        make("label", {}, "Error", this.metricSelect),
        make(
          "span",
          { class: "checks" },
          this.check("logX", "log n"),
          this.check("logTime", "log time"),
          this.check("logError", "log error"),
          this.check("bands", "intervals"),
        ),
      ),
      this.toggles,
      make("div", { class: "plots" }, this.figure("time"), this.figure("error"), this.figure("pareto")),
      this.missing,
      make(
        "p",
        { class: "muted controls-hint" },
        "Drag over a chart to zoom in, or hold Ctrl and turn the wheel; on a touch screen pinch. Bands: the 95 % interval of the median; by convexity, nine in ten shapes. Lines: solid, parameters by the paper’s rules; long dashes, by a rule from the points alone; dots, the method’s defaults.",
      ),
    );
  }

  check(key, words) {
    return make(
      "label",
      { class: "check" },
      make("input", {
        type: "checkbox",
        id: `check-${key}`,
        checked: this.state[key],
        change: (event) => this.set({ [key]: event.target.checked }),
      }),
      words,
    );
  }

  figure(id) {
    const button = (words, label, act) =>
      make("button", { type: "button", class: "small", "aria-label": `${label}: ${id} chart`, click: act }, words);
    const extra =
      id === "pareto"
        ? make(
            "label",
            { class: "inline" },
            "Case ",
            make("select", { id: "pareto-select", change: (event) => this.set({ paretoCase: event.target.value }) }),
          )
        : null;
    return make(
      "figure",
      { class: `plot plot-${id}`, "data-testid": `plot-${id}` },
      make(
        "figcaption",
        {},
        make("span", { id: `title-${id}` }),
        make(
          "span",
          { class: "zoom" },
          extra,
          button("+", "Zoom in", () => this.zoom(id, 0.7)),
          button("−", "Zoom out", () => this.zoom(id, 1 / 0.7)),
          button("Reset", "Reset zoom", () => this.zoom(id, Infinity)),
        ),
      ),
      make("div", { class: "canvas", id: `chart-${id}`, role: "img" }),
      make(
        "details",
        { class: "values", id: `values-${id}` },
        make("summary", {}, "Values as a table"),
        make("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": `Values of the ${id} chart` }),
      ),
    );
  }

  plot(id) {
    const element = document.getElementById(`chart-${id}`);
    const chart = echarts.init(element, null, { renderer: "svg" });
    chart.on("click", (event) => this.open(event.data?.point));
    element.addEventListener("dblclick", () => this.zoom(id, Infinity));
    new ResizeObserver(() => this.resized(chart, element)).observe(element);
    return { id, element, chart };
  }

  resizeAll(size) {
    for (const { chart } of this.plots) chart.resize(size);
    this.draw();
  }

  /** An observer also calls once at the beginning, when nothing has changed. */
  resized(chart, element) {
    if (printing || (chart.getWidth() === element.clientWidth && chart.getHeight() === element.clientHeight)) return;
    chart.resize();
    this.draw();
  }

  // Choices.

  set(changes) {
    Object.assign(this.state, changes);
    this.choose();
  }

  /** Shares and scores near 1 are read on a linear axis. */
  chooseMetric(name) {
    const logError = this.metrics.get(name).better === "lower";
    document.getElementById("check-logError").checked = logError;
    this.set({ metric: name, logError });
  }

  toggle(key) {
    if (!this.state.hidden.delete(key)) this.state.hidden.add(key);
    this.choose();
  }

  /** After a choice: what can be chosen next, then the charts. */
  choose() {
    const present = new Set(
      Object.values(this.chart().series)
        .flat()
        .flatMap((point) => Object.keys(point.metrics)),
    );
    const usable = this.report.metrics.filter((metric) => metric.charted && present.has(metric.name));
    if (usable.length && !usable.some((metric) => metric.name === this.state.metric))
      this.state.metric = usable[0].name;
    this.metricSelect.replaceChildren(...usable.map((metric) => make("option", { value: metric.name }, metric.title)));
    this.metricSelect.value = this.state.metric;
    document.getElementById("check-logX").parentElement.hidden = this.chart().kind !== "n";
    document.getElementById("check-bands").parentElement.hidden = this.chart().kind === "shape";
    this.drawToggles();
    this.choosePareto();
    this.draw();
  }

  drawToggles() {
    const focused = document.activeElement?.dataset?.entrant;
    const toggle = (entrant) => {
      const button = make(
        "button",
        {
          type: "button",
          class: "toggle",
          "data-entrant": entrant.key,
          "aria-pressed": String(!this.state.hidden.has(entrant.key)),
          style: `--own: var(--method-${entrant.method})`,
          click: () => this.toggle(entrant.key),
        },
        markerPicture(entrant.marker),
        entrant.label,
      );
      return button;
    };
    const every = (words, keep) =>
      make(
        "button",
        {
          type: "button",
          class: "small",
          click: () => {
            for (const entrant of this.entrants()) this.state.hidden[keep(entrant) ? "delete" : "add"](entrant.key);
            this.choose();
          },
        },
        words,
      );
    const entrants = this.entrants();
    const quick = entrants.length > 3 ? [every("All", () => true), every("None", () => false)] : [];
    if (quick.length && new Set(entrants.map((one) => one.protocol)).size > 1)
      quick.push(every("Only paper’s rules", (entrant) => entrant.protocol === "paper"));
    this.toggles.replaceChildren(...entrants.map(toggle), ...quick);
    if (focused) this.toggles.querySelector(`[data-entrant="${CSS.escape(focused)}"]`)?.focus();
  }

  choosePareto() {
    const select = document.getElementById("pareto-select");
    const chart = this.chart();
    const options = chart.x.map((x, index) =>
      make("option", { value: index }, chart.kind === "n" ? `n = ${formatCount(x)}` : x),
    );
    if (chart.kind === "shape" && chart.x.length > 1)
      options.unshift(make("option", { value: "common" }, "median of the common shapes"));
    select.replaceChildren(...options);
    const wanted = this.state.paretoCase;
    const first = chart.kind === "n" ? String(this.fullest()) : options[0]?.value;
    select.value = options.some((one) => one.value === wanted) ? wanted : first;
    this.state.paretoCase = select.value;
  }

  /** The largest number of points at which most entrants have a result. */
  fullest() {
    const chart = this.chart();
    const counts = chart.x.map(
      (_, index) => Object.values(chart.series).filter((points) => points.some((point) => point.x === index)).length,
    );
    return counts.lastIndexOf(Math.max(...counts));
  }

  // Drawing.

  draw() {
    const ink = {
      ink: cssColour("--ink"),
      muted: cssColour("--muted"),
      line: cssColour("--line"),
      grid: cssColour("--grid"),
      panel: cssColour("--panel"),
    };
    const { time, error } = this.quantities();
    const chart = this.chart();
    const shown = this.shown();
    const entries = paretoEntries(chart, this.state.paretoCase, time, error, shown);
    const where = `${this.report.experiments[chart.experiment].title}: ${chart.title}`;
    const options = {
      time: caseChartOptions(chart, time, shown, this.state, ink, this.plots[0].chart.getWidth()),
      error: caseChartOptions(chart, error, shown, this.state, ink, this.plots[1].chart.getWidth()),
      pareto: paretoOptions(entries.list, time, error, this.state, ink),
    };
    const titles = { time: time.axis, error: error.axis, pareto: "Time against error" };
    for (const { id, element, chart: plot } of this.plots) {
      const option = options[id];
      option.tooltip.formatter = (event) => this.tooltip(event, id);
      plot.setOption(option, { notMerge: true });
      // A fine pointer draws a box to zoom; with a finger that would hold the page fast.
      if (matchMedia("(pointer: fine)").matches)
        plot.dispatchAction({ type: "takeGlobalCursor", key: "dataZoomSelect", dataZoomSelectActive: true });
      document.getElementById(`title-${id}`).textContent = titles[id];
      element.setAttribute("aria-label", `${titles[id]}. ${where}. The values are in the table below the chart.`);
    }
    this.placeParetoLabels(entries.list);
    this.valueTable("time", time, shown);
    this.valueTable("error", error, shown);
    this.paretoTable(entries.list, time, error);
    this.missing.textContent = this.missingWords(entries.leftOut);
    this.drawn = { chart: chart.id, time: time.name, metric: error.name, shown: shown.map((one) => one.key) };
  }

  /** Names beside the dots, as far as they fit. */
  placeParetoLabels(list) {
    const { chart } = this.plots.find((plot) => plot.id === "pareto");
    const dots = list.map((one) => {
      const [x, y] = chart.convertToPixel({ gridIndex: 0 }, [one.time[0], one.error[0]]);
      return { x, y, words: one.entrant.label };
    });
    const places = placeLabels(dots, { width: chart.getWidth(), height: chart.getHeight() });
    chart.setOption({
      series: list.map((one, index) => ({
        id: one.entrant.key,
        label: { show: places[index] !== null, position: places[index] ?? "top" },
      })),
    });
  }

  missingWords(leftOut) {
    const chart = this.chart();
    const words = this.report.entrants.flatMap((entrant) => {
      const gone = chart.missing[entrant.key] ?? [];
      const byStatus = groupBy(gone, (one) => one.status);
      return [...byStatus].map(
        ([status, rows]) =>
          `${entrant.label} ${status.replace("_", " ")} in ${formatCount(rows.length)} of ${formatCount(rows.length + this.countOf(entrant))}`,
      );
    });
    const said = words.length ? `Not drawn: ${words.join("; ")}.` : "";
    return leftOut.length
      ? `${said} Not in the median of time against error, with results for less than half of the shapes: ${leftOut.map((one) => one.label).join(", ")}.`
      : said;
  }

  countOf(entrant) {
    return (this.chart().series[entrant.key] ?? []).reduce((sum, point) => sum + (point.count ?? 1), 0);
  }

  tooltip(event, id) {
    if (!event.data || (!event.data.point && !event.data.entry)) return "";
    const { time, error } = this.quantities();
    const point = event.data.point ?? event.data.entry.point;
    const entry = event.data.entry;
    const chart = this.chart();
    const where =
      entry && !point
        ? `median of ${entry.cases} shapes`
        : chart.kind === "n"
          ? `n = ${formatCount(chart.x[point.x])}`
          : chart.x[point.x];
    const line = (name, value) => make("div", { class: "tip-line" }, make("span", {}, name), make("b", {}, value));
    const times = entry ? entry.time : pointValue(point, time);
    const errors = entry ? entry.error : pointValue(point, error);
    const unit = error.metric.unit ? ` ${error.metric.unit}` : "";
    const score = (value) => formatScore(error.metric, value);
    const errorWords = errors
      ? score(errors[0]) + unit + (errors[1] === null ? "" : ` [${score(errors[1])}, ${score(errors[2])}]`)
      : "–";
    const hint =
      point?.run && typeof hasPicture === "function" && hasPicture(point.run)
        ? make("div", { class: "muted" }, "Click for the picture.")
        : null;
    return make(
      "div",
      { class: "tip" },
      make("strong", {}, event.seriesName),
      make(
        "div",
        { class: "muted" },
        where + (point?.count ? `, ${formatCount(point.count)} shapes: median [5 %, 95 %]` : ""),
      ),
      line("Time", formatTime(times)),
      line(error.metric.title, errorWords),
      hint,
    );
  }

  open(point) {
    if (point?.run && typeof hasPicture === "function" && hasPicture(point.run)) openCase(point.case, point.run);
  }

  zoom(id, factor) {
    const { chart } = this.plots.find((plot) => plot.id === id);
    // The two entries of the charts' own; the tool for drawing a box adds its own behind them.
    chart
      .getOption()
      .dataZoom.slice(0, 2)
      .forEach((entry, dataZoomIndex) => {
        const middle = (entry.start + entry.end) / 2;
        const half = Math.min(50, ((entry.end - entry.start) / 2) * factor);
        chart.dispatchAction({
          type: "dataZoom",
          dataZoomIndex,
          start: Math.max(0, middle - half),
          end: Math.min(100, middle + half),
        });
      });
    if (factor === Infinity)
      chart.dispatchAction({
        type: "dataZoom",
        batch: chart.getOption().dataZoom.map((_, dataZoomIndex) => ({ dataZoomIndex, start: 0, end: 100 })),
      });
  }

  // The same numbers as text.

  valueTable(id, quantity, shown) {
    const chart = this.chart();
    const cell = (entrant, index) => {
      const point = (chart.series[entrant.key] ?? []).find((one) => one.x === index);
      const value = point && pointValue(point, quantity);
      if (!value) return "–";
      const said = (one) => (quantity.metric ? formatScore(quantity.metric, one) : formatNumber(one));
      return said(value[0]) + (value[1] === null ? "" : ` [${said(value[1])}, ${said(value[2])}]`);
    };
    const names = chart.x.map((x) => (chart.kind === "n" ? formatCount(x) : x));
    this.fillTable(
      id,
      [quantity.axis, ...shown.map((entrant) => entrant.label)],
      names.map((name, index) => [name, ...shown.map((entrant) => cell(entrant, index))]),
    );
  }

  paretoTable(entries, time, error) {
    this.fillTable(
      "pareto",
      ["Method", time.axis, error.axis],
      entries.map((one) => [one.entrant.label, formatNumber(one.time[0]), formatScore(error.metric, one.error[0])]),
    );
  }

  fillTable(id, head, rows) {
    const table = make(
      "table",
      {},
      make(
        "thead",
        {},
        make(
          "tr",
          {},
          ...head.map((word, index) => make("th", { scope: "col", class: index ? "number" : null }, word)),
        ),
      ),
      make(
        "tbody",
        {},
        ...rows.map((row) =>
          make(
            "tr",
            {},
            ...row.map((word, index) =>
              make(index ? "td" : "th", index ? { class: "number" } : { scope: "row" }, word),
            ),
          ),
        ),
      ),
    );
    document.querySelector(`#values-${id} .scroll`).replaceChildren(table);
  }
}
