// The report in a browser, made from the invented run of tests/invented_run.cpp, whose numbers are known.
//
// The environment says where things are: WRITE_INVENTED_REPORT and HULLBENCH are those programs, PYTHON the Python for
// plots/, OUTPUT the folder for the run, the page and its screenshots.
import assert from "node:assert/strict";
import { statSync, writeFileSync } from "node:fs";
import { before, test } from "node:test";
import { cases_csv } from "./invented_cases.mjs";
import { SQUARE, write_invented_pictures } from "./invented_pictures.mjs";
import {
  CHARTS_READY,
  assert_ascending,
  assert_shows,
  axe_findings,
  empty_output,
  hullbench,
  output,
  page_tests,
  plot,
  rows_of,
  runs_of,
  write_invented_report,
} from "./page_tests.mjs";

const FILE = "report.html";
const CALIFORNIA = "ca/n:2000/holes:1";
const HAWAII = "hi/n:2000/holes:0";
// Beside the invented metrics: where the right side of the moved square is, in the data set's unit.
const MARKED = `polylidar/${HAWAII}/protocol:paper`;
const FARTHEST = {
  hausdorff: 51.2,
  hausdorff_to_truth: 51.2,
  hausdorff_to_truth_x: 583.68,
  hausdorff_to_truth_y: 450,
  hausdorff_to_result: 51.2,
  hausdorff_to_result_x: 122.88,
  hausdorff_to_result_y: 450,
};
const { open_file, page_test: test_of_file } = page_tests({ ready: CHARTS_READY });
const page_test = (name, options, body) => test_of_file(name, FILE, options, body);

let report;

before(() => {
  empty_output();
  report = write_invented_report("run");
  write_invented_pictures(output("run"));
  Object.assign(row_named(MARKED).metrics, FARTHEST);
  report.metrics = JSON.parse(hullbench("metrics", "--json"));
  writeFileSync(output("run", "report.json"), JSON.stringify(report));
  writeFileSync(output("run", "cases.csv"), cases_csv(report));
  plot("make_report.py", output("run"), "--out", output(FILE));
  write_failed_report();
});

/** The same run, as if every method had crashed. */
function write_failed_report() {
  const failed = write_invented_report("failed");
  const nothing = { status: "crash", detail: "SIGSEGV", time_ns: [], phases_ns: [], metrics: {}, output_sha256: "" };
  const no_statistics = { time: null, paper_time: null, l2: null, l2_paper: null, iou: null, valid: null };
  for (const run of failed.runs) Object.assign(run, nothing);
  for (const row of failed.summary.rows) Object.assign(row, no_statistics, { status: "crash" });
  writeFileSync(output("failed", "report.json"), JSON.stringify(failed));
  plot("make_report.py", output("failed"), "--out", output("failed.html"));
}

function row_named(name) {
  const row = report.runs.find((run) => run.name === name);
  assert.ok(row, `no run ${name}`);
  const statistics = report.summary.rows.find((one) => one.id === row.id);
  return { ...row, median_ms: statistics?.time ? statistics.time.median_ns / 1e6 : null };
}

const of_spatialite_with_holes = () =>
  report.runs.filter((run) => run.method === "spatialite" && run.holes).map((run) => run.name);

function case_of(run_name) {
  return run_name.split("/").slice(1, -1).join("/");
}

async function open_case(page, case_name, run_name) {
  await page.evaluate(([one, run]) => hullbenchReport.gallery.open(one, run), [case_name, run_name]);
  await page.locator('dialog[open][data-ready="true"]').waitFor();
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

/** The rows of the table of all runs, which comes into view. */
async function open_table(page) {
  await page.locator("#runs").scrollIntoViewIfNeeded();
  const rows = page.locator("#runs-table tbody tr");
  await rows.first().waitFor();
  return rows;
}

/** The colour (red, green, blue, alpha) of the open case's picture at a place of the grid of pictures.jsonl. */
function colour_at(page, x, y) {
  return page.evaluate(
    ([grid_x, grid_y]) => {
      const canvas = document.querySelector("dialog[open] canvas");
      // The square and the moved square, in the grid of plots/pictures.py.
      const box = { left: 768, bottom: 768, right: 3648, top: 3328 };
      const { scale, x: x0, y: y0 } = hullbenchReport.fit(box, canvas.clientWidth, canvas.clientHeight, 14);
      const pixel = [x0 + (scale * grid_x) / 16, y0 - (scale * grid_y) / 16].map(Math.round);
      // From a copy: Chromium warns of canvases that are read often.
      const copy = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
      copy.drawImage(canvas, ...pixel, 1, 1, 0, 0, 1, 1);
      return [...copy.getImageData(0, 0, 1, 1).data];
    },
    [x, y],
  );
}

page_test("opens from disk without network, messages or failures", {}, async (page) => {
  await open_table(page);
  assert.match(await page.title(), /Concave hulls/);
});

test("a page that asks for something or complains is noticed", async () => {
  const { page, troubles } = await open_file(FILE);
  await page.evaluate(() => {
    console.warn("a warning");
    return fetch("https://example.org/").catch(() => {});
  });
  const told = troubles.join("; ");
  assert.ok(told.includes("a warning") && troubles.length >= 2, told);
});

page_test("the first screen says who leads, and the league and the charts agree", {}, async (page) => {
  const lead = await page.locator("#summary .lead").first().innerText();
  // SpatiaLite is first on five of six cases and fails on the sixth, which counts as half of a shape of two of one of two
  // kinds; two shapes are too few to be sure. The other two have the same results, which count once.
  const ahead =
    "SpatiaLite is ahead, but not clearly, of 3 entries of 3 methods that know something of the truth: mean rank 1.12";
  assert.ok(lead.startsWith(ahead), lead);
  assert.match(lead, /6 cases of 2 shapes/);
  const rows = await page.locator("#league-informed tbody tr").evaluateAll((all) => {
    const rank = (row) => row.querySelector(".ranks .value").innerText.split(" ")[0];
    return all.map((row) => [row.dataset.entrant, rank(row), row.lastElementChild.innerText]);
  });
  assert.deepEqual(rows, [
    ["spatialite/paper", "1.12", "1"],
    ["cgal_alpha_shape/paper", "1.88", "0"],
  ]);
  assert.match(await page.locator("#league-informed tbody th small").first().innerText(), /and Polylidar/);
  const solved = page.locator("#solved-informed");
  assert.match(await solved.locator("svg:visible").getAttribute("aria-label"), /has solved the most/);
  await solved.locator("summary").click();
  // Of SpatiaLite's cases all but one of weight 1/8 are solved for all targets.
  assert.match(await solved.locator("tbody").innerText(), /SpatiaLite\s+87\.5/);
  const nothing_before = await page.evaluate(() => {
    const before = (one) => document.querySelector(".lead").compareDocumentPosition(one) & Node.DOCUMENT_POSITION_PRECEDING;
    return [...document.querySelectorAll("main p")].filter(before).length;
  });
  assert.equal(nothing_before, 0);
});

page_test("a number of the heat map lists its cases, by keyboard too, and all come back", {}, async (page) => {
  const cell = page.locator('#heat-informed a[data-part="informed/kind/holes"][data-entrant="spatialite/paper"]');
  await cell.focus();
  await page.keyboard.press("Enter");
  const rows = page.locator("#runs-table tbody tr");
  await rows.first().waitFor();
  const shown = () => runs_of(rows);
  assert.deepEqual(await shown(), of_spatialite_with_holes());
  assert.equal(await page.locator("#filter-entrant").inputValue(), "spatialite/paper");
  const again = page.locator("#table-only");
  assert.match(await again.innerText(), /holes/);
  assert.equal(await again.evaluate((one) => one === document.activeElement), true);
  await page.keyboard.press("Enter");
  assert.deepEqual((await shown()).length, report.runs.filter((run) => run.method === "spatialite").length);
  assert.equal(await again.isVisible(), false);
});

page_test("the strip has the leader's telling cases, says what is missing and opens them", {}, async (page) => {
  const cards = page.locator("#strip li");
  const said = await cards.evaluateAll((all) =>
    all.map((card) => [card.querySelector("b").innerText, card.querySelector("a").dataset.run]),
  );
  const of = (words) => said.find(([one]) => one === words)?.[1];
  // Hawaii with 64,000 points, where it fails, has a picture without a truth.
  const errors = report.runs.filter((run) => run.method === "spatialite" && run.metrics.l2).map((run) => run.metrics.l2);
  assert.equal(row_named(of("Best")).metrics.l2, Math.min(...errors));
  assert.equal(row_named(of("Worst")).metrics.l2, Math.max(...errors));
  assert.match(await page.locator("#strip > .muted").innerText(), /none of these: .*real points/);
  await cards.first().locator("a").focus();
  await page.keyboard.press("Enter");
  await page.locator('dialog[open][data-ready="true"]').waitFor();
});

const ASKED_RUN = `spatialite/${CALIFORNIA}/protocol:paper`;
const asked = (what) => ({ hash: `#${new URLSearchParams(what)}` });
page_test("a picture can be asked for behind the #", asked({ run: ASKED_RUN, case: CALIFORNIA }), async (page) => {
  await page.locator('dialog[open][data-ready="true"]').waitFor();
  assert.equal(await page.locator("dialog tr.chosen").getAttribute("data-run"), ASKED_RUN);
});

const ASKED_PART = { part: "informed/kind/holes", entrant: "spatialite/paper" };
page_test("and so can the cases of a number", asked(ASKED_PART), async (page) => {
  await page.locator("#table-only").waitFor();
  assert.deepEqual(await runs_of(page.locator("#runs-table tbody tr")), of_spatialite_with_holes());
});

const said = (page) => page.locator("#announcer").innerText();
page_test("what the report does not have is said", asked({ case: "nowhere", run: "nothing" }), async (page) => {
  assert.equal(await said(page), "The gallery has no picture of nowhere.");
  assert.equal(await page.locator("dialog[open]").count(), 0);
});

page_test("a word that every object knows is no part", asked({ part: "constructor", entrant: "polylidar" }), async (page) => {
  await page.waitForFunction(() => document.getElementById("announcer").textContent !== "");
  assert.equal(await said(page), "The report has no cases of constructor.");
});

page_test("the charts show the report's numbers", {}, async (page) => {
  const drawn = await page.evaluate(async () => {
    const charts = await hullbenchReport.loadCharts();
    return charts
      .flatMap((chart) => Object.values(chart.series).flat())
      .map(({ run, time, metrics }) => ({ run, time: time[0], l2: metrics.l2 }));
  });
  const wanted = report.runs.filter((run) => run.status === "ok" && ["ca", "hi"].includes(run.dataset));
  assert.deepEqual(drawn.map(({ run }) => run).sort(), wanted.map((run) => run.name).sort());
  for (const { run, time, l2 } of drawn) {
    const row = row_named(run);
    assert.ok(Math.abs(time / row.median_ms - 1) < 1e-4, `${run}: ${time} ms in the chart, ${row.median_ms} in the report`);
    assert.ok(Math.abs(l2 / row.metrics.l2 - 1) < 1e-4, `${run}: ${l2} in the chart, ${row.metrics.l2} in the report`);
  }
});

page_test("what is drawn in the chart is what its data say, and a method can be switched off and on", {}, async (page) => {
  const drawn = () =>
    page.evaluate(() =>
      hullbenchReport.charts.plots[0].chart
        .getOption()
        .series.filter((series) => series.data.some((one) => one?.point))
        .map((series) => series.name),
    );
  const toggle = page.locator("#method-toggles [data-entrant]").first();
  const name = (await toggle.innerText()).trim();
  assert.ok((await drawn()).includes(name), `${name} is not among ${await drawn()}`);
  await toggle.click();
  assert.ok(!(await drawn()).includes(name));
  assert.equal(await toggle.getAttribute("aria-pressed"), "false");
  await toggle.click();
  assert.ok((await drawn()).includes(name));
});

test_of_file("a run in which everything failed has a page, which says so", "failed.html", {}, async (page) => {
  assert.match(await page.locator("#charts-place").innerText(), /^No run has a result, so there are no charts\.$/);
  assert.ok((await (await open_table(page)).first().innerText()).includes("crash"));
});

page_test("the table has every run with its status and numbers", {}, async (page) => {
  await open_table(page);
  const shown = await rows_of(page);
  assert.deepEqual(shown.map(({ run }) => run).sort(), report.runs.map((run) => run.name).sort());
  for (const { run, ...cells } of shown) {
    const row = row_named(run);
    assert.equal(cells.status, row.status.replace("_", " "), run);
    if (row.metrics.l2) assert_shows(cells["metric-l2"], 100 * row.metrics.l2, `L2 of ${run}`);
    if (row.median_ms) assert_shows(cells.time, row.median_ms, `time of ${run}`);
  }
});

page_test("the table filters by status, finds words and sorts both ways", {}, async (page) => {
  const rows = await open_table(page);
  await page.locator("#filter-status").selectOption("timeout");
  const timeouts = report.runs.filter((run) => run.status === "timeout").map((run) => run.name);
  assert.deepEqual(await runs_of(rows), timeouts);
  await page.locator("#filter-status").selectOption("");
  await page.locator("#filter-words").fill("hi/n:64000 protocol");
  assert.equal(await rows.count(), report.runs.filter((run) => run.dataset === "hi" && run.n === 64000).length);
  await page.locator("#filter-words").fill("");
  const by_l2 = async () => {
    await page.locator('#runs-table th[data-column="metric-l2"] button').click();
    return (await runs_of(rows)).map((name) => row_named(name).metrics.l2).filter((l2) => typeof l2 === "number");
  };
  const ascending = await by_l2();
  assert_ascending(ascending);
  const descending = await by_l2();
  assert.deepEqual(descending, [...ascending].reverse());
});

page_test("the table's commands name the run", {}, async (page) => {
  const row = (await open_table(page)).first();
  const [run, command] = [await row.getAttribute("data-run"), await row.locator("code").innerText()];
  assert.ok(command.replaceAll("\\", "").includes(run), `${command} does not name ${run}`);
  assert.ok(command.includes(` --seed ${report.seed} `), `${command} would draw other points`);
});

page_test("the gallery lists every case with a picture, the worst of the chosen method first", {}, async (page) => {
  const cards = page.locator(".gallery-card");
  const cases = new Set(report.runs.map((run) => case_of(run.name)));
  await page.locator("select[name=gallery-method]").selectOption("polylidar/paper");
  assert.equal(await cards.count(), cases.size);
  assert_ascending((await runs_of(cards)).map((run) => row_named(run).metrics.l2).reverse());
  for (const card of await cards.all()) {
    const row = row_named(await card.getAttribute("data-run"));
    assert_shows(/L2 (.*)/.exec(await card.innerText())[1], 100 * row.metrics.l2, row.name);
  }
});

page_test("the gallery's failures can be found, and filters narrow the list", {}, async (page) => {
  const cards = page.locator(".gallery-card");
  await page.locator(".gallery-failures").click();
  const failed = report.runs.filter((run) => !["ok", "not_installed", "unsupported"].includes(run.status));
  const cases = new Set(failed.map((run) => case_of(run.name)));
  assert.deepEqual(new Set(await cards.evaluateAll((all) => all.map((card) => card.dataset.case))), cases);
  assert.match(await cards.first().innerText(), /invalid output|timeout/);
  await page.locator("select[name=gallery-status]").selectOption("timeout");
  assert.equal(await cards.count(), 1);
  await page.locator("select[name=gallery-shape]").selectOption("California");
  assert.match(await page.locator(".gallery-count").innerText(), /No case/);
});

page_test("small pictures are painted when they come into view", {}, async (page) => {
  await page.locator("#gallery").scrollIntoViewIfNeeded();
  const canvas = page.locator(".gallery-card canvas.painted").first();
  await canvas.waitFor();
  const painted = await canvas.evaluate(
    (one) => new Set(new Uint32Array(one.getContext("2d").getImageData(0, 0, one.width, one.height).data.buffer)).size,
  );
  assert.ok(painted > 10, `only ${painted} colours`);
});

page_test("an open case shows the numbers of each method and what went wrong", {}, async (page) => {
  for (const case_name of [CALIFORNIA, HAWAII, "hi/n:64000/holes:0"]) {
    await open_case(page, case_name);
    const runs = report.runs.filter((run) => case_of(run.name) === case_name);
    assert.equal(await page.locator("dialog tbody tr").count(), runs.length);
    for (const run of runs) {
      const line = page.locator(`dialog tr[data-run="${run.name}"]`);
      const row = row_named(run.name);
      if (row.status === "ok") assert_shows(await line.locator("[data-column=l2]").innerText(), 100 * row.metrics.l2, run.name);
      else assert.match(await line.innerText(), /invalid output|timeout|not installed/);
      if (row.median_ms) assert_shows(await line.locator("[data-column=time]").innerText(), row.median_ms, run.name);
    }
  }
  await open_case(page, HAWAII, `postgis/${HAWAII}/protocol:auto`);
  assert.match(await page.locator(".gallery-reason").innerText(), /Self-intersection/);
});

page_test("missed and wrongly added areas are shaded where they are, in two colours", {}, async (page) => {
  await open_case(page, HAWAII, `polylidar/${HAWAII}/protocol:paper`);
  for (const name of ["points", "truth"]) await page.locator(`[name=gallery-layer-${name}]`).uncheck();
  await page.waitForTimeout(100);
  const middle = (SQUARE.low + SQUARE.high) / 2;
  const missed = await colour_at(page, SQUARE.low + SQUARE.moved / 2, middle);
  const added = await colour_at(page, SQUARE.high + SQUARE.moved / 4, middle);
  const [both, outside] = [await colour_at(page, middle, middle), await colour_at(page, SQUARE.low - 1500, middle)];
  assert.ok(missed[2] > missed[0] && missed[3] > 90, `missed is ${missed}`);
  assert.ok(added[0] > added[2] && added[3] > 90, `added is ${added}`);
  assert.ok(both[3] > 10 && both[3] < 60, `found by both is ${both}`);
  assert.equal(outside[3], 0, `outside is ${outside}`);
  await page.locator("[name=gallery-layer-shade]").uncheck();
  await page.waitForTimeout(100);
  assert.equal((await colour_at(page, SQUARE.low + SQUARE.moved / 2, middle))[3], 0);
});

page_test("where there is no truth nothing is missed or wrongly added", {}, async (page) => {
  const without_truth = "hi/n:64000/holes:0";
  await open_case(page, without_truth, `polylidar/${without_truth}/protocol:paper`);
  await page.locator("[name=gallery-layer-points]").uncheck();
  await page.waitForTimeout(100);
  const middle = (SQUARE.low + SQUARE.high) / 2;
  const added = await colour_at(page, SQUARE.high + SQUARE.moved / 4, middle);
  const missed = await colour_at(page, SQUARE.low + SQUARE.moved / 2, middle);
  assert.ok(added[3] > 10 && added[3] < 60, `in the hull is ${added}`);
  assert.equal(missed[3], 0, `beside the hull is ${missed}`);
  assert.match(await page.locator("dialog canvas").getAttribute("aria-label"), /no truth, over points$/);
});

page_test("the places that are farthest apart are marked where that is known", {}, async (page) => {
  await open_case(page, HAWAII, `cgal_alpha_shape/${HAWAII}/protocol:paper`);
  const box = page.locator("[name=gallery-layer-farthest]");
  assert.equal(await box.isVisible(), false);
  await open_case(page, HAWAII, MARKED);
  const place = [FARTHEST.hausdorff_to_truth_x * 100, FARTHEST.hausdorff_to_truth_y * 100];
  const [red, green, blue, opaque] = await colour_at(page, ...place);
  assert.ok(Math.max(red, green, blue) < 80 && opaque > 200, `the mark's middle is ${[red, green, blue, opaque]}`);
  assert.match(await page.locator("dialog dd[data-metric=hausdorff]").innerText(), /^51/);
  assert.equal(await page.locator("dialog dd[data-metric=hausdorff_to_truth_x]").count(), 0);
  await box.uncheck();
  await page.waitForTimeout(100);
  const without = await colour_at(page, ...place);
  assert.ok(without[2] > 120 && without[3] > 100, `without the mark there is ${without}, not Polylidar's blue outline`);
});

page_test("a case's method can be switched, and outlines of others laid over it", {}, async (page) => {
  await open_case(page, CALIFORNIA, `polylidar/${CALIFORNIA}/protocol:paper`);
  const picture = () => page.locator("dialog canvas").evaluate((canvas) => canvas.toDataURL());
  const settle = () => page.waitForTimeout(100);
  const of_polylidar = await picture();
  const spatialite = page.locator(`dialog tr[data-run="spatialite/${CALIFORNIA}/protocol:paper"]`);
  await spatialite.locator("input[type=radio]").check();
  await settle();
  const of_spatialite = await picture();
  assert.notEqual(of_spatialite, of_polylidar);
  assert.match(await page.locator(".gallery-facts h3").innerText(), /SpatiaLite/);
  assert.match(await page.locator("dialog canvas").getAttribute("aria-label"), /SpatiaLite/);
  await page.locator(`dialog tr[data-run="polylidar/${CALIFORNIA}/protocol:paper"] input[type=checkbox]`).check();
  await settle();
  assert.notEqual(await picture(), of_spatialite);
});

page_test("a case is used by keyboard: opened, next, previous, zoomed, closed, focus comes back", {}, async (page) => {
  const card = page.locator(".gallery-card").first();
  await card.focus();
  await page.keyboard.press("Enter");
  const dialog = page.locator('dialog[open][data-ready="true"]');
  await dialog.waitFor();
  const first = await dialog.getAttribute("data-case");
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction((name) => document.querySelector("dialog").dataset.case !== name, first);
  await dialog.waitFor();
  await page.keyboard.press("ArrowLeft");
  await page.waitForFunction((name) => document.querySelector("dialog").dataset.case === name, first);
  await dialog.waitFor();
  const zoom = async () => Number(await dialog.locator("canvas").getAttribute("data-zoom"));
  assert.equal(await zoom(), 1);
  await page.keyboard.press("+");
  assert.ok((await zoom()) > 1.4);
  await page.keyboard.press("0");
  assert.equal(await zoom(), 1);
  await dialog.locator("input[type=radio]:checked").focus();
  for (const _ of [1, 2]) {
    const shown = await dialog.getAttribute("data-case");
    await page.keyboard.press("ArrowRight");
    await page.waitForFunction((name) => document.querySelector("dialog").dataset.case !== name, shown);
    await dialog.waitFor();
  }
  await page.keyboard.press("Escape");
  assert.equal(await page.locator("dialog[open]").count(), 0);
  assert.ok(await card.evaluate((element) => element === document.activeElement));
});

page_test("a case is zoomed by wheel and buttons and moved by dragging", {}, async (page) => {
  await open_case(page, CALIFORNIA);
  const canvas = page.locator("dialog canvas");
  const box = await canvas.boundingBox();
  const picture = () => canvas.evaluate((one) => one.toDataURL());
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.wheel(0, -400);
  await page.waitForFunction(() => Number(document.querySelector("dialog canvas").dataset.zoom) > 1.5);
  await page.waitForTimeout(100);
  const before_drag = await picture();
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 80, box.y + box.height / 2 + 40, { steps: 4 });
  await page.mouse.up();
  await page.waitForTimeout(100);
  assert.notEqual(await picture(), before_drag);
  await page.getByRole("button", { name: "Whole case (0)" }).click();
  assert.equal(await canvas.getAttribute("data-zoom"), "1.00");
});

page_test("a row of the table opens its picture", {}, async (page) => {
  await page.locator("#runs").scrollIntoViewIfNeeded();
  const run = `spatialite/${CALIFORNIA}/protocol:paper`;
  await page
    .locator(`#runs-table tr[data-run="${run}"]`)
    .getByRole("button", { name: /Picture/ })
    .click();
  await page.locator('dialog[open][data-ready="true"]').waitFor();
  assert.equal(await page.locator("dialog tr.chosen").getAttribute("data-run"), run);
  assert.equal(await page.evaluate(() => hullbenchReport.gallery.has("spatialite/hi/n:64000/holes:0/protocol:paper")), false);
});

for (const width of [360, 390, 1280]) {
  page_test(`nothing is wider than a window of ${width} pixels`, { width, height: 800 }, async (page) => {
    await open_table(page);
    const excess = () => page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    assert.ok((await excess()) <= 0, `${await excess()} pixels too wide`);
    await open_case(page, CALIFORNIA);
    const cut = await page.evaluate(() =>
      [...document.querySelectorAll("dialog *")]
        .filter((one) => one.getBoundingClientRect().right > innerWidth + 1)
        .map((one) => one.className || one.tagName),
    );
    assert.deepEqual(cut, []);
  });
}

for (const theme of ["light", "dark"]) {
  page_test(`no serious finding of axe, ${theme}`, { theme }, async (page) => {
    await open_table(page);
    for (const one of await page.locator("#summary details, #where details").all())
      await one.evaluate((box) => (box.open = true));
    const findings = () => axe_findings(page, {}, ({ impact }) => ["serious", "critical"].includes(impact));
    assert.deepEqual(await findings(), []);
    await open_case(page, HAWAII, `postgis/${HAWAII}/protocol:auto`);
    assert.deepEqual(await findings(), []);
  });
}

for (const [width, height, theme] of [
  [1280, 900, "light"],
  [390, 844, "dark"],
]) {
  const options = { width, height, theme, deviceScaleFactor: width < 500 ? 2 : 1 };
  page_test(`screenshots, ${width} pixels, ${theme}`, options, async (page) => {
    const shoot = async (name, more = {}) => {
      const path = output(`${name}-${width}-${theme}.png`);
      await page.screenshot({ path, ...more });
      assert.ok(statSync(path).size > 10000, `${path} is nearly empty`);
    };
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), theme);
    for (const section of ["gallery", "runs"]) await page.locator(`#${section}`).scrollIntoViewIfNeeded();
    await page.locator("#runs-table tbody tr").first().waitFor();
    await page.locator("#gallery").evaluate((one) => one.scrollIntoView());
    await page.locator(".gallery-card canvas.painted").first().waitFor();
    await page.waitForTimeout(300);
    await shoot("gallery");
    await page.evaluate(() => scrollTo(0, 0));
    await page.waitForTimeout(300);
    await shoot("page", { fullPage: true });
    await open_case(page, CALIFORNIA, `postgis/${CALIFORNIA}/protocol:auto`);
    await shoot("case");
  });
}

page_test("paper is light, without controls; an open case is printed alone", { theme: "dark" }, async (page) => {
  // Without having been in view.
  await page.locator(".gallery-card canvas.painted").nth(5).waitFor({ state: "attached" });
  await page.emulateMedia({ media: "print", colorScheme: "dark" });
  const visible = (selector) => page.locator(selector).first().isVisible();
  assert.equal(await visible(".gallery-filters"), false);
  assert.equal(await visible("#summary"), true);
  assert.equal(await visible(".gallery-card canvas"), true);
  const brightness = await page.evaluate(() =>
    Math.min(...getComputedStyle(document.body).backgroundColor.match(/\d+/g).slice(0, 3).map(Number)),
  );
  assert.ok(brightness > 240, `the background is ${brightness} of 255`);
  await page.pdf({ path: output("page.pdf"), format: "A4" });
  await page.emulateMedia({ media: "screen", colorScheme: "dark" });
  await open_case(page, CALIFORNIA);
  await page.emulateMedia({ media: "print", colorScheme: "dark" });
  assert.equal(await visible("#summary"), false);
  assert.equal(await visible("dialog canvas"), true);
  await page.pdf({ path: output("case.pdf"), format: "A4" });
});

test("the page is small", () => assert.ok(statSync(output(FILE)).size < 5 * 2 ** 20));
