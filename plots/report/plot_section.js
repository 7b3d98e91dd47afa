// What every section of charts does alike: what can be chosen, the charts themselves and their values as tables.
import { pointValue } from "./chart_options.js";
import { formatCount, formatNumber, formatScore, make, makeCheck, smallButton } from "./format.js";
import { Plots } from "./plots.js";
import { currentTheme } from "./theme.js";

/**
 * A section of charts. Whoever extends it has has(chart, entrant), whether there is anything to draw of the entrant;
 * choose(), called after every choice; draw(); tooltip(event, quantities) and open(point), called after a click.
 */
export class PlotSection extends Plots {
  /** `report` and `charts` are the page's data, `hidden` the keys of the entrants that are not shown. */
  constructor(report, charts, hidden, bands) {
    super();
    Object.assign(this, { report, charts, hidden });
    this.metrics = new Map(report.metrics.map((metric) => [metric.name, metric]));
    this.meaning = make("p", { class: "muted", id: "metric-meaning" });
    // The first chart over numbers of points, else the first.
    const growing = charts.findIndex((chart) => chart.kind === "n");
    this.state = { chart: Math.max(0, growing), time: "time", metric: "l2", logX: true, logTime: true, logError: true, bands };
  }

  /** Makes the charts in the figures of these names, and draws. */
  start(...ids) {
    this.plots = ids.map((id) => this.plot(id, `chart-${id}`));
    for (const { id, element, chart } of this.plots) {
      chart.on("click", (event) => this.open(event.data?.point));
      element.addEventListener("dblclick", () => this.zoom(id, Infinity));
    }
    this.follow({ width: 660, height: 360 });
    this.choose();
  }

  chart() {
    return this.charts[this.state.chart];
  }

  metric() {
    return this.metrics.get(this.state.metric) ?? this.report.metrics.find((metric) => metric.charted);
  }

  quantities() {
    const { time } = this.state;
    const metric = this.metric();
    const axis = time === "time" ? "Time of equal work, ms" : "Time as the paper took it, ms";
    return {
      time: { kind: "time", name: time, axis },
      error: { kind: "metric", name: metric.name, metric, axis: metric.title + (metric.unit ? `, ${metric.unit}` : "") },
    };
  }

  /** The entrants that have results in the chart, in their order, with their colours in this theme. */
  entrants() {
    const theme = currentTheme();
    return this.report.entrants
      .filter((entrant) => this.has(this.chart(), entrant))
      .map((entrant) => {
        const style = this.report.methods[entrant.method];
        return { ...entrant, marker: style.marker, colour: style[theme] };
      });
  }

  shown() {
    return this.entrants().filter((entrant) => !this.hidden.has(entrant.key));
  }

  // What stays while choices change.

  /** The row of choices; `more` is an element between the shape and the error, or null. */
  controls(more) {
    const groups = this.report.experiments.map(({ title }, index) => {
      const options = this.charts.map((chart, number) =>
        chart.experiment === index ? make("option", { value: number }, `${title}: ${chart.title}`) : null,
      );
      return make("optgroup", { label: title }, ...options);
    });
    this.chartSelect = make(
      "select",
      { id: "chart-select", change: (event) => this.set({ chart: Number(event.target.value), paretoCase: null }) },
      ...groups,
    );
    this.chartSelect.value = this.state.chart;
    const change = (event) => this.chooseMetric(event.target.value);
    this.metricSelect = make("select", { id: "metric-select", change });
    const words = { logX: "log n", logTime: "log time", logError: "log error", bands: "intervals" };
    const checks = Object.entries(words).map(([key, text]) =>
      makeCheck(text, { id: `check-${key}`, checked: this.state[key] }, (checked) => this.set({ [key]: checked })),
    );
    return make(
      "div",
      { class: "controls" },
      make("label", {}, "Shape", this.chartSelect),
      more,
      make("label", {}, "Error", this.metricSelect),
      make("span", { class: "checks" }, ...checks),
    );
  }

  /** A chart's place with its title, its buttons and its values as a table; `extra` stands before the buttons. */
  figure(id, extra = null) {
    const button = (words, label, factor) =>
      smallButton(words, () => this.zoom(id, factor), { "aria-label": `${label}: ${id} chart` });
    const zoom = [button("+", "Zoom in", 0.7), button("−", "Zoom out", 1 / 0.7), button("Reset", "Reset zoom", Infinity)];
    return make(
      "figure",
      { class: `plot plot-${id}`, "data-testid": `plot-${id}` },
      make("figcaption", {}, make("span", { id: `title-${id}` }), make("span", { class: "zoom" }, extra, ...zoom)),
      make("div", { class: "canvas", id: `chart-${id}`, role: "img" }),
      make(
        "details",
        { class: "values", id: `values-${id}` },
        make("summary", {}, "Values as a table"),
        make("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": `Values of the ${id} chart` }),
      ),
    );
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

  /** Offers these metrics, one of which is chosen then, and the boxes that the chart has a use for. */
  offer(metrics) {
    if (metrics.length && !metrics.some((metric) => metric.name === this.state.metric)) this.state.metric = metrics[0].name;
    const option = ({ name, title, definition }) => make("option", { value: name, title: definition }, title);
    this.metricSelect.replaceChildren(...metrics.map(option));
    this.metricSelect.value = this.state.metric;
    const { title, definition } = this.metric();
    this.meaning.textContent = definition && `${title}: ${definition}. T is the ground truth, R the result.`;
    document.getElementById("check-logX").parentElement.hidden = this.chart().kind !== "n";
    document.getElementById("check-bands").parentElement.hidden = this.chart().kind === "shape";
  }

  zoom(id, factor) {
    const { chart } = this.plots.find((plot) => plot.id === id);
    // The two entries of the charts' own; the tool for drawing a box adds its own behind them.
    for (const [dataZoomIndex, entry] of chart.getOption().dataZoom.slice(0, 2).entries()) {
      const middle = (entry.start + entry.end) / 2;
      const half = Math.min(50, ((entry.end - entry.start) / 2) * factor);
      const [start, end] = [Math.max(0, middle - half), Math.min(100, middle + half)];
      chart.dispatchAction({ type: "dataZoom", dataZoomIndex, start, end });
    }
    if (factor === Infinity) {
      const batch = chart.getOption().dataZoom.map((_, dataZoomIndex) => ({ dataZoomIndex, start: 0, end: 100 }));
      chart.dispatchAction({ type: "dataZoom", batch });
    }
  }

  // Drawing.

  /** Draws `options` in the chart of that name; `title` is its heading, `where` what it is of. */
  drawPlot({ id, element, chart }, options, title, where) {
    options.tooltip.formatter = (event) =>
      event.data?.point || event.data?.entry ? this.tooltip(event, this.quantities()) : "";
    chart.setOption(options, { notMerge: true });
    // A fine pointer draws a box to zoom; with a finger that would hold the page fast.
    if (matchMedia("(pointer: fine)").matches)
      chart.dispatchAction({ type: "takeGlobalCursor", key: "dataZoomSelect", dataZoomSelectActive: true });
    document.getElementById(`title-${id}`).textContent = title;
    element.setAttribute("aria-label", `${title}${where}. The values are in the table below the chart.`);
  }

  /** What a place on the axis of cases is called. */
  placeName(x) {
    const chart = this.chart();
    return chart.kind === "n" ? `n = ${formatCount(chart.x[x])}` : chart.x[x];
  }

  /** The values of one chart; `columns` are {label, points}. */
  valueTable(id, quantity, columns) {
    const chart = this.chart();
    const cell = ({ points = [] }, x) => {
      const point = points.find((one) => one.x === x);
      return formatThree(point && pointValue(point, quantity), quantity.metric);
    };
    this.fillTable(
      id,
      [quantity.axis, ...columns.map((column) => column.label)],
      chart.x.map((name, x) => [chart.kind === "n" ? formatCount(name) : name, ...columns.map((column) => cell(column, x))]),
    );
  }

  fillTable(id, head, rows) {
    const heads = head.map((word, index) => make("th", { scope: "col", class: index ? "number" : null }, word));
    const cell = (word, index) => make(index ? "td" : "th", index ? { class: "number" } : { scope: "row" }, word);
    const body = rows.map((row) => make("tr", {}, ...row.map(cell)));
    const table = make("table", {}, make("thead", {}, make("tr", {}, ...heads)), make("tbody", {}, ...body));
    document.querySelector(`#values-${id} .scroll`).replaceChildren(table);
  }
}

/** A score that is [value, low, high] with its unit. */
export function formatScores(value, metric) {
  return formatThree(value, metric) + (value && metric.unit ? ` ${metric.unit}` : "");
}

/** [value, low, high] of a time (no metric) or a score, without its unit: 3.21 [3.10, 3.35]. */
function formatThree(value, metric) {
  if (!value) return "–";
  const said = (one) => (metric ? formatScore(metric, one) : formatNumber(one));
  return said(value[0]) + (value[1] === null ? "" : ` [${said(value[1])}, ${said(value[2])}]`);
}
