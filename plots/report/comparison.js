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
  hooks.loadRows = rows;
  hooks.loadTable = once(
    async () => (hooks.table = new PairTable(document.getElementById("table-place"), report, await rows())),
  );
  hooks.ready = Promise.all([rows(), unpack(readJson("charts"))]).then(([pairs, charts]) => {
    startForests(hooks, pairs, hidden, changed);
    startCharts(hooks, charts, hidden, changed);
    whenNear(document.getElementById("runs"), hooks.loadTable);
    document.documentElement.dataset.ready = "charts";
  });
  addEventListener("beforeprint", hooks.loadTable);
}

function startForests(hooks, pairs, hidden, changed) {
  const place = document.getElementById("ratios-place");
  if (hooks.report.changes.length) hooks.forests = new Forests(place, hooks.report, pairs, hidden, changed);
  else place.append(make("p", {}, "No run has a time in both."));
}

function startCharts(hooks, charts, hidden, changed) {
  const place = document.getElementById("charts-place");
  if (charts.length) hooks.charts = new BothCharts(place, hooks.report, charts, hidden, changed);
  else place.append(make("p", {}, "No shape has a chart in both."));
}

startComparison();
