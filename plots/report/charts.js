// The section "Time and error": three charts, and what can be chosen of them.
import { DASHES, caseChartOptions, pointValue } from "./chart_options.js";
import { groupBy } from "./data.js";
import { formatCount, formatNumber, formatScore, formatTime, make, makeChoice, makeTip, statusWords } from "./format.js";
import { placeLabels } from "./label_places.js";
import { MethodToggles } from "./method_toggles.js";
import { paretoEntries, paretoOptions } from "./pareto.js";
import { PlotSection, formatScores } from "./plot_section.js";
import { themeInk } from "./theme.js";

export class Charts extends PlotSection {
  /** Builds the section in `place` and draws. `gallery` is {has(run), open(case, run)}; null: there are no pictures. */
  constructor(place, report, charts, gallery) {
    super(report, charts, new Set(), true);
    this.gallery = gallery;
    this.state.paretoCase = null;
    this.build(place);
    this.start("time", "error", "pareto");
  }

  has(chart, entrant) {
    return entrant.key in chart.series;
  }

  build(place) {
    const times = [
      ["time", "of equal work"],
      ["paper_time", "as the paper took it"],
    ];
    place.append(this.controls(makeChoice("Time", { id: "time-select" }, times, (time) => this.set({ time }))));
    this.toggles = new MethodToggles(place, this.report, this.hidden, () => this.choose());
    this.toggles.element.id = "method-toggles";
    this.missing = make("p", { class: "muted", id: "chart-missing" });
    const change = (event) => this.set({ paretoCase: event.target.value });
    this.paretoSelect = make("select", { id: "pareto-select", change });
    const choice = make("label", { class: "inline" }, "Case ", this.paretoSelect);
    place.append(
      make("div", { class: "plots" }, this.figure("time"), this.figure("error"), this.figure("pareto", choice)),
      this.meaning,
      this.missing,
      make("p", { class: "muted controls-hint" }, this.hint()),
    );
  }

  hint() {
    const lines = Object.entries(DASHES)
      .filter(([protocol]) => this.report.entrants.some((entrant) => entrant.protocol === protocol))
      .map(([protocol, [, words]]) => `${words}, ${protocol}`);
    return (
      "Drag over a chart to zoom in, or hold Ctrl and turn the wheel; on a touch screen pinch. Bands: the 95 % interval " +
      `of the median; by convexity, nine in ten shapes. An axis with a 0 on it is linear. Lines by who chose the parameters: ${lines.join("; ")}. ` +
      "Time against error: a dot with a rim has parameters by another rule than the paper’s."
    );
  }

  /** After a choice: what can be chosen next, then the charts. */
  choose() {
    const points = Object.values(this.chart().series).flat();
    const present = new Set(points.flatMap((point) => Object.keys(point.metrics)));
    this.offer(this.report.metrics.filter((metric) => metric.charted && present.has(metric.name)));
    this.toggles.draw(this.entrants());
    this.choosePareto();
    this.draw();
  }

  choosePareto() {
    const chart = this.chart();
    const options = chart.x.map((_, index) => make("option", { value: index }, this.placeName(index)));
    if (chart.kind === "shape" && chart.x.length > 1)
      options.unshift(make("option", { value: "common" }, "median of the common shapes"));
    this.paretoSelect.replaceChildren(...options);
    const wanted = this.state.paretoCase;
    const first = chart.kind === "n" ? String(this.fullest()) : options[0]?.value;
    this.paretoSelect.value = options.some((one) => one.value === wanted) ? wanted : first;
    this.state.paretoCase = this.paretoSelect.value;
  }

  /** The largest number of points at which most entrants have a result. */
  fullest() {
    const chart = this.chart();
    const counts = chart.x.map(
      (_, index) => Object.values(chart.series).filter((points) => points.some((point) => point.x === index)).length,
    );
    return counts.lastIndexOf(Math.max(...counts));
  }

  draw() {
    const ink = themeInk();
    const { time, error } = this.quantities();
    const chart = this.chart();
    const shown = this.shown();
    const entries = paretoEntries(chart, this.state.paretoCase, time, error, shown);
    const where = `. ${this.report.experiments[chart.experiment].title}: ${chart.title}`;
    for (const plot of this.plots) {
      const quantity = { time, error }[plot.id];
      const options = quantity
        ? caseChartOptions(chart, quantity, shown, this.state, ink, plot.chart.getWidth())
        : paretoOptions(entries.list, time, error, this.state, ink);
      this.drawPlot(plot, options, quantity ? quantity.axis : "Time against error", where);
    }
    this.placeParetoLabels(entries.list);
    const columns = shown.map((entrant) => ({ label: entrant.label, points: chart.series[entrant.key] }));
    this.valueTable("time", time, columns);
    this.valueTable("error", error, columns);
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
          `${entrant.label} ${statusWords(status)} in ${formatCount(rows.length)} of ${formatCount(rows.length + this.countOf(entrant))}`,
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

  tooltip(event, { time, error }) {
    const { entry } = event.data;
    const point = event.data.point ?? entry.point;
    const several = point?.count ? `, ${formatCount(point.count)} shapes: median [5 %, 95 %]` : "";
    const where = point ? this.placeName(point.x) + several : `median of ${entry.cases} shapes`;
    const hint = this.hasPicture(point) ? "Click for the picture." : "";
    const lines = [
      ["Time", formatTime(entry ? entry.time : pointValue(point, time))],
      [error.metric.title, formatScores(entry ? entry.error : pointValue(point, error), error.metric)],
    ];
    return makeTip(event.seriesName, where, lines, hint);
  }

  hasPicture(point) {
    return Boolean(point?.run && this.gallery?.has(point.run));
  }

  open(point) {
    if (this.hasPicture(point)) this.gallery.open(point.case, point.run);
  }

  paretoTable(entries, time, error) {
    this.fillTable(
      "pareto",
      ["Method", time.axis, error.axis],
      entries.map((one) => [one.entrant.label, formatNumber(one.time[0]), formatScore(error.metric, one.error[0])]),
    );
  }
}
