// Puts the page together. Charts first; the table when it comes near, for its rows are most of the data.
import { openCase } from "./case_dialog.js";
import { hasPicture } from "./cases.js";
import { Charts } from "./charts.js";
import { Rows, once, readJson, unpack, whenNear } from "./data.js";
import { make } from "./format.js";
import { startFront } from "./front.js";
import { mountGallery } from "./gallery.js";
import { fit } from "./picture.js";
import { RunTable } from "./table.js";
import { startTheme } from "./theme.js";

function startReport() {
  const report = readJson("report");
  const pictures = readJson("pictures");
  const gallery = pictures.cases.length ? { has: hasPicture, open: openCase } : null;
  const charts = once(() => unpack(readJson("charts")));
  const rows = once(async () => new Rows(await unpack(readJson("rows"))));
  const hooks = { report, pictures, gallery, fit, loadCharts: charts, loadRows: rows, charts: null, table: null };
  window.hullbenchReport = hooks;

  startTheme();
  if (gallery) startGallery(report, pictures);
  hooks.loadTable = once(async () => {
    return (hooks.table = new RunTable(document.getElementById("table-place"), report, await rows(), gallery));
  });
  const parts = once(() => unpack(readJson("parts")));
  startFront(gallery, parts, hooks.loadTable);
  hooks.ready = charts().then((decoded) => {
    const place = document.getElementById("charts-place");
    if (decoded.length && report.metrics.some((metric) => metric.charted)) {
      hooks.charts = new Charts(place, report, decoded, gallery);
    } else {
      place.append(make("p", {}, "No run has a result, so there are no charts."));
    }
    document.documentElement.dataset.ready = "charts";
  });
  whenNear(document.getElementById("runs"), hooks.loadTable);
  addEventListener("beforeprint", hooks.loadTable);
}

function startGallery(report, pictures) {
  document.getElementById("gallery").hidden = false;
  document.getElementById("gallery-link").hidden = false;
  mountGallery(document.getElementById("gallery-place"), report, pictures);
}

startReport();
