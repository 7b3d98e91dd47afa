// Puts the page together. All parts share which methods are hidden.
import { BothCharts } from "./comparison_charts.js";
import { Forests } from "./comparison_forest.js";
import { PairTable } from "./comparison_table.js";
import { Rows, once, readJson, unpack, whenNear } from "./data.js";
import { make } from "./format.js";
import { cssColour, startTheme } from "./theme.js";

function startComparison() {
  const report = readJson("report");
  const hooks = { report, cssColour, forests: null, charts: null, table: null };
  window.hullbenchComparison = hooks;
  startTheme();
  const hidden = new Set();
  const changed = () => {
    hooks.forests?.draw();
    hooks.charts?.draw();
  };
  const rows = once(async () => new Rows(await unpack(readJson("rows"))));
  hooks.loadTable = once(
    async () => (hooks.table = new PairTable(document.getElementById("table-place"), report, await rows())),
  );
  hooks.ready = Promise.all([rows(), unpack(readJson("charts"))]).then(([pairs, charts]) => {
    const build = (id, Class, data, given, without) => {
      const place = document.getElementById(id);
      if (given.length) return new Class(place, report, data, hidden, changed);
      place.append(make("p", {}, without));
      return null;
    };
    hooks.forests = build("ratios-place", Forests, pairs, report.changes, "No run has a time in both.");
    hooks.charts = build(
      "charts-place",
      BothCharts,
      charts,
      report.metrics.some((metric) => metric.charted) ? charts : [],
      "No shape has a chart in both.",
    );
    whenNear(document.getElementById("runs"), hooks.loadTable);
    document.documentElement.dataset.ready = "charts";
  });
  addEventListener("beforeprint", hooks.loadTable);
}

startComparison();
