// The charts of time and error of both runs.

/** Time and error of both runs. What the report's charts do alike is theirs: see Charts. */
class BothCharts {
  constructor(place, report, charts, hidden, changed) {
    Object.assign(this, { report, charts, hidden });
    this.metrics = new Map(report.metrics.map((metric) => [metric.name, metric]));
    this.state = {
      chart: Math.max(
        0,
        charts.findIndex((chart) => chart.kind === "n"),
      ),
      time: "time",
      metric: "l2",
      logX: true,
      logTime: true,
      logError: true,
      bands: false,
    };
    this.build(place, changed);
    this.plots = ["time", "error"].map((id) => this.plot(id));
    onTheme(() => this.draw());
    addEventListener("beforeprint", () => this.resizeAll({ width: 660, height: 360 }));
    addEventListener("afterprint", () => this.resizeAll({ width: "auto", height: "auto" }));
    this.draw();
  }

  build(place, changed) {
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
      { id: "chart-select", change: (event) => this.set({ chart: Number(event.target.value) }) },
      ...groups,
    );
    this.metricSelect = make(
      "select",
      { id: "metric-select", change: (event) => this.chooseMetric(event.target.value) },
      ...this.report.metrics.map((metric) => option(metric.name, metric.title)),
    );
    place.append(
      make(
        "div",
        { class: "controls" },
        make("label", {}, "Shape", this.chartSelect),
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
    );
    const keys = new Set(this.charts.flatMap((chart) => [...Object.keys(chart.a), ...Object.keys(chart.b)]));
    this.toggles = new MethodToggles(place, this.report, keys, this.hidden, changed);
    place.append(
      make(
        "p",
        { class: "legend", id: "sides-legend" },
        make("span", {}, "○ pale: A, before"),
        make("span", {}, "● full: B, after"),
      ),
      make("div", { class: "plots" }, this.figure("time"), this.figure("error")),
    );
    this.chartSelect.value = this.state.chart;
    this.metricSelect.value = this.state.metric;
  }

  set(changes) {
    Object.assign(this.state, changes);
    this.draw();
  }

  chooseMetric(name) {
    const logError = this.metrics.get(name).better === "lower";
    document.getElementById("check-logError").checked = logError;
    this.set({ metric: name, logError });
  }

  quantities() {
    const metric = this.metrics.get(this.state.metric) ?? this.report.metrics[0];
    return {
      time: { kind: "time", name: "time", axis: "Time of equal work, ms" },
      error: {
        kind: "metric",
        name: metric.name,
        metric,
        axis: metric.title + (metric.unit ? `, ${metric.unit}` : ""),
      },
    };
  }

  /** The entrants to draw, with their colours in this theme. */
  shown() {
    const chart = this.charts[this.state.chart];
    const theme = currentTheme();
    return this.report.entrants
      .filter((entrant) => (chart.a[entrant.key] || chart.b[entrant.key]) && !this.hidden.has(entrant.key))
      .map((entrant) => ({
        ...entrant,
        marker: this.report.methods[entrant.method].marker,
        colour: this.report.methods[entrant.method][theme],
      }));
  }

  draw() {
    const ink = comparisonInk();
    const chart = this.charts[this.state.chart];
    const shown = this.shown();
    const quantities = this.quantities();
    document.getElementById("check-logX").parentElement.hidden = chart.kind !== "n";
    document.getElementById("check-bands").parentElement.hidden = chart.kind === "shape";
    for (const { id, element, chart: plot } of this.plots) {
      const quantity = quantities[id];
      const options = bothChartOptions(chart, quantity, shown, this.state, ink, plot.getWidth());
      options.tooltip.formatter = (event) => (event.data?.point ? this.tooltip(event) : "");
      plot.setOption(options, { notMerge: true });
      // A fine pointer draws a box to zoom; with a finger that would hold the page fast.
      if (matchMedia("(pointer: fine)").matches)
        plot.dispatchAction({ type: "takeGlobalCursor", key: "dataZoomSelect", dataZoomSelectActive: true });
      document.getElementById(`title-${id}`).textContent = quantity.axis;
      element.setAttribute(
        "aria-label",
        `${quantity.axis} of both runs. ${chart.title}. The values are in the table below the chart.`,
      );
      this.valueTable(id, quantity, chart, shown);
    }
    this.toggles.draw();
    this.drawn = { chart: chart.id, metric: quantities.error.name, shown: shown.map((one) => one.key) };
  }

  /** Of the run under the pointer both sides, for they often coincide. */
  tooltip(event) {
    const chart = this.charts[this.state.chart];
    const key = event.seriesId.slice(0, -2);
    const { time, error } = this.quantities();
    const lines = ["A", "B"].flatMap((side) => {
      const point = (chart[side.toLowerCase()][key] ?? []).find((one) => one.x === event.data.point.x);
      const line = (name, value) =>
        make("div", { class: "tip-line" }, make("span", {}, `${side}, ${name}`), make("b", {}, value));
      return [
        line("time", point ? formatTime(pointValue(point, time)) : "no result"),
        line("error", point ? formatMetric(error.metric, point.metrics[error.name]) : "no result"),
      ];
    });
    const x = chart.x[event.data.point.x];
    return make(
      "div",
      { class: "tip" },
      make("strong", {}, event.seriesName.slice(0, -3)),
      make("div", { class: "muted" }, chart.kind === "n" ? `n = ${formatCount(x)}` : x),
      ...lines,
    );
  }

  valueTable(id, quantity, chart, shown) {
    const cell = (entrant, side, x) => {
      const point = (chart[side][entrant.key] ?? []).find((one) => one.x === x);
      const value = point && pointValue(point, quantity);
      return value
        ? formatNumber(value[0], 4) +
            (value[1] === null ? "" : ` [${formatNumber(value[1])}, ${formatNumber(value[2])}]`)
        : "–";
    };
    const head = [quantity.axis, ...shown.flatMap((entrant) => [`${entrant.label}, A`, `${entrant.label}, B`])];
    this.fillTable(
      id,
      head,
      chart.x.map((name, x) => [
        chart.kind === "n" ? formatCount(name) : name,
        ...shown.flatMap((entrant) => [cell(entrant, "a", x), cell(entrant, "b", x)]),
      ]),
    );
  }

  /** A click opens nothing here: the pictures are in the report of each run. */
  open() {}
}

for (const name of ["check", "figure", "plot", "resizeAll", "resized", "zoom", "fillTable"])
  BothCharts.prototype[name] = Charts.prototype[name];
