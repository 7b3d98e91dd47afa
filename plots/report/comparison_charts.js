// The charts of time and error of both runs.
import { pointValue } from "./chart_options.js";
import { bothChartOptions } from "./comparison_options.js";
import { formatTime, make, makeTip } from "./format.js";
import { MethodToggles } from "./method_toggles.js";
import { PlotSection, formatScores } from "./plot_section.js";
import { themeInk } from "./theme.js";

const SIDES = ["A", "B"];

export class BothCharts extends PlotSection {
  /** Builds the section in `place` and draws; `changed` is called when methods have been shown or hidden. */
  constructor(place, report, charts, hidden, changed) {
    super(report, charts, hidden, false);
    place.append(this.controls(null));
    this.toggles = new MethodToggles(place, report, hidden, changed);
    this.drawable = report.entrants.filter((entrant) => charts.some((chart) => this.has(chart, entrant)));
    place.append(
      make(
        "p",
        { class: "legend", id: "sides-legend" },
        make("span", {}, "○ pale: A, before"),
        make("span", {}, "● full: B, after"),
      ),
      make("div", { class: "plots" }, this.figure("time"), this.figure("error")),
      this.meaning,
    );
    this.start("time", "error");
  }

  has(chart, entrant) {
    return SIDES.some((side) => entrant.key in chart[side.toLowerCase()]);
  }

  choose() {
    this.offer(this.report.metrics);
    this.draw();
  }

  draw() {
    const ink = themeInk();
    const chart = this.chart();
    const shown = this.shown();
    const quantities = this.quantities();
    const columns = shown.flatMap(({ key, label }) =>
      SIDES.map((side) => ({ label: `${label}, ${side}`, points: chart[side.toLowerCase()][key] })),
    );
    for (const plot of this.plots) {
      const quantity = quantities[plot.id];
      const options = bothChartOptions(chart, quantity, shown, this.state, ink, plot.chart.getWidth());
      this.drawPlot(plot, options, quantity.axis, ` of both runs. ${chart.title}`);
      this.valueTable(plot.id, quantity, columns);
    }
    this.toggles.draw(this.drawable);
    this.drawn = { chart: chart.id, metric: quantities.error.name, shown: shown.map((one) => one.key) };
  }

  /** Of the run under the pointer both sides, for they often coincide. */
  tooltip({ data, seriesId, seriesName }, { time, error }) {
    const lines = SIDES.flatMap((side) => {
      const points = this.chart()[side.toLowerCase()][seriesId.slice(0, -2)] ?? [];
      const point = points.find((one) => one.x === data.point.x);
      return [
        [`${side}, time`, point ? formatTime(pointValue(point, time)) : "no result"],
        [`${side}, error`, point ? formatScores(pointValue(point, error), error.metric) : "no result"],
      ];
    });
    return makeTip(seriesName.slice(0, -3), this.placeName(data.point.x), lines);
  }

  /** A click opens nothing here: the pictures are in the report of each run. */
  open() {}
}
