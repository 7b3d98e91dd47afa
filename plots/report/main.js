// Puts the page together. Charts first; the table when it comes near, for its rows are most of the data.

function startReport() {
  const report = readJson("report");
  const pictures = readJson("pictures");
  const charts = once(() => unpack(readJson("charts")));
  const rows = once(async () => new Rows(await unpack(readJson("rows"))));
  const hooks = { report, pictures, loadCharts: charts, loadRows: rows, charts: null, table: null, gallery: null };
  window.hullbenchReport = hooks;

  startTheme();
  if (pictures?.cases?.length && typeof mountGallery === "function") startGallery(hooks);
  const loadTable = once(async () => {
    hooks.table = new RunTable(document.getElementById("table-place"), report, await rows());
  });
  hooks.loadTable = loadTable;
  hooks.ready = charts().then((decoded) => {
    if (decoded.length) hooks.charts = new Charts(document.getElementById("charts-place"), report, decoded);
    document.documentElement.dataset.ready = "charts";
  });
  whenNear(document.getElementById("runs"), loadTable);
  addEventListener("beforeprint", loadTable);
}

function startGallery(hooks) {
  const section = document.getElementById("gallery");
  section.hidden = false;
  document.getElementById("gallery-link").hidden = false;
  hooks.gallery = mountGallery(document.getElementById("gallery-place"), hooks.report, hooks.pictures) ?? true;
}

startReport();
