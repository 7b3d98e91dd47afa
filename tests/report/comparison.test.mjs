// The comparison of two runs in a browser. A and B are the invented run of tests/invented_run.cpp, B with known changes;
// `hullbench compare` itself compares them.
//
// The environment says where things are: WRITE_INVENTED_REPORT and HULLBENCH are those programs, PYTHON the Python for
// plots/, OUTPUT the folder for the runs, the pages and their screenshots.
import assert from "node:assert/strict";
import { mkdirSync, statSync, writeFileSync } from "node:fs";
import { before, test } from "node:test";
import {
  CHARTS_READY,
  assert_ascending,
  assert_readable,
  assert_shows,
  empty_output,
  hullbench,
  output,
  page_tests,
  plot,
  read_json,
  rows_of,
  runs_of,
  screen_options,
  write_invented_report,
} from "./page_tests.mjs";

const { page_test: test_of_file } = page_tests({ ready: CHARTS_READY });
const REPETITIONS = 20;
const SLOWER = 1.5;
const FASTER = 0.5;
const FAILS = "spatialite/ca/n:2000/holes:1/protocol:paper";
const WORKS = "spatialite/hi/n:64000/holes:0/protocol:paper";
const CRASHED = { status: "crash", detail: "SIGSEGV", time_ns: [], phases_ns: [], metrics: {}, output_sha256: "" };
const LARGER_ERROR = "polylidar/ca/n:64000/holes:0/protocol:paper";

let invented;
const compared = {}; // by page: what the program said

function median(values) {
  const order = [...values].sort((a, b) => a - b);
  return (order[(order.length - 1) >> 1] + order[order.length >> 1]) / 2;
}

/** The invented report with twenty repetitions, a per mille apart, each `factor(run)` times the first time. */
function report_with(factor, change = () => {}) {
  const made = structuredClone(invented);
  change(made);
  const statistics = new Map(made.summary.rows.map((row) => [row.id, row]));
  const usual = made.summary.rows.find((row) => row.time).time;
  for (const run of made.runs) {
    if (run.time_ns.length)
      run.time_ns = Array.from({ length: REPETITIONS }, (_, index) =>
        Math.round(run.time_ns[0] * factor(run) * (1 + index / 1000)),
      );
    run.phases_ns = run.time_ns.map(() => run.phases_ns[0]);
    const told = statistics.get(run.id);
    if (run.status !== "ok") told.time = null;
    else
      told.time = {
        ...usual,
        repetitions: REPETITIONS,
        median_ns: median(run.time_ns),
        median_low_ns: run.time_ns[5],
        median_high_ns: run.time_ns[14],
      };
  }
  return made;
}

function change_b(made) {
  const named = (name) => made.runs.find((run) => run.name === name);
  made.tool.commit = "fedcba9876543210fedcba9876543210fedcba98";
  Object.assign(named(FAILS), { status: "timeout", detail: "after 60 s", time_ns: [], phases_ns: [], metrics: {} });
  const twin = made.runs.find((run) => run.name === WORKS.replace("spatialite", "cgal_alpha_shape"));
  Object.assign(named(WORKS), {
    status: "ok",
    detail: "",
    time_ns: [...twin.time_ns],
    phases_ns: [...twin.phases_ns],
    metrics: { ...twin.metrics },
    output_sha256: "1".repeat(64),
  });
  named(LARGER_ERROR).metrics.l2 *= 1.25;
}

function write_run(name, report) {
  mkdirSync(output(name));
  writeFileSync(output(name, "report.json"), JSON.stringify(report));
}

function compare(page, a, b) {
  const told = hullbench("compare", output(a, "report.json"), output(b, "report.json"), "--format", "json");
  writeFileSync(output(`${page}.json`), told);
  plot("make_comparison.py", output(a), output(b), "--compared", output(`${page}.json`), "--out", output(file_of(page)));
  compared[page] = JSON.parse(told);
}

const file_of = (page) => `${page}.html`;

before(() => {
  empty_output();
  invented = write_invented_report("invented");
  invented.metrics = JSON.parse(hullbench("metrics", "--json"));
  const factor = (run) => ({ polylidar: FASTER, cgal_alpha_shape: SLOWER })[run.method] ?? 1;
  const elsewhere = (made) => Object.assign(made.environment, { machine_id: "feedbeef" });
  const all_fail = (made) => made.runs.forEach((run) => Object.assign(run, CRASHED));
  for (const [name, ...how] of [
    ["a", () => 1],
    ["b", factor, change_b],
    ["other", factor, elsewhere],
    ["failed", () => 1, all_fail],
  ])
    write_run(name, report_with(...how));
  compare("before_after", "a", "b");
  compare("machines", "a", "other");
  compare("itself", "a", "a");
  compare("failures", "failed", "failed");
});

function page_test(name, { page = "before_after", ...options }, body) {
  test_of_file(name, file_of(page), options, body);
}

const open_table = (page) => page.evaluate(() => hullbenchComparison.loadTable());

async function table_rows(page) {
  await open_table(page);
  return rows_of(page);
}

/** A ratio with its interval as they are written. */
const digits_of = ({ ratio, ratio_low, ratio_high }) => [ratio, ratio_low, ratio_high].map((one) => one.toPrecision(3));

/** The points that the chart of ratios draws, by the run's name: what it draws, and the change's sign. */
function drawn_ratios(page) {
  return page.evaluate(() => {
    const { forests } = hullbenchComparison;
    const { series } = forests.plots[1].chart.getOption();
    return series
      .filter((one) => one.type === "scatter")
      .flatMap((one) =>
        one.data.map(({ value, line }) => {
          const interval = series.find((other) => other.id === `interval ${one.id}`).data;
          const at = interval.findIndex(([, index]) => index === value[1]);
          return {
            run: forests.rows.name(line.row),
            ratio: value[0],
            low: interval[at]?.[0] ?? null,
            high: interval[at + 1]?.[0] ?? null,
            change: one.id,
            filled: one.itemStyle.borderWidth === 0,
            colour: one.itemStyle.color,
          };
        }),
      );
  });
}

page_test("opens from disk without network or messages, and the verdict is the program's", {}, async (page) => {
  const { pairs, methods } = compared.before_after;
  const count = (change) => pairs.filter((pair) => pair.change === change).length;
  const judged = pairs.filter((pair) => pair.adjusted_p_value !== null).length;
  assert.equal(
    await page.locator("#verdict").innerText(),
    `${pairs.length} runs in both, ${judged} of them judged: in B ${count("slower")} slower, ${count("faster")} faster, ${count("not told apart")} not told apart. ` +
      "1 run now fails and 1 run now works. The error changed in 1 run: 1 larger, 0 smaller.",
  );
  const changed = { polylidar: "#verdict-faster", cgal_alpha_shape: "#verdict-slower" };
  for (const [method, place] of Object.entries(changed)) {
    const told = methods.find((one) => one.method === method);
    const words = await page.locator(place).innerText();
    const [ratio, low, high] = digits_of(told);
    assert.ok(words.includes(`${ratio} times the time of A (95 %: ${low} to ${high})`), words);
  }
  assert.match(await page.locator("#verdict-statuses").innerText(), new RegExp(`✕\\s${FAILS}: now timed out \\(after 60 s\\)`));
  assert.match(await page.locator("#verdict-errors").innerText(), new RegExp(`▲\\s${LARGER_ERROR}: L2 larger`));
  assert.match(await page.locator("#warnings").innerText(), /Two runs of the very same program differ/);
});

page_test("the chart of ratios draws the program's ratios and intervals, coloured only where significant", {}, async (page) => {
  const drawn = await drawn_ratios(page);
  const wanted = compared.before_after.pairs.filter((pair) => pair.ratio !== null);
  assert.deepEqual(drawn.map(({ run }) => run).sort(), wanted.map(({ name }) => name).sort());
  const [faster, slower, muted] = await page.evaluate(() =>
    ["--faster", "--slower", "--muted"].map(hullbenchComparison.cssColour),
  );
  const panel = await page.evaluate(() => hullbenchComparison.cssColour("--panel"));
  assert.equal(new Set([faster, slower, muted]).size, 3);
  for (const one of drawn) {
    const told = wanted.find(({ name }) => name === one.run);
    for (const [key, value] of Object.entries({ ratio: told.ratio, low: told.ratio_low, high: told.ratio_high })) {
      const same = value === null ? one[key] === null : Math.abs(one[key] / value - 1) < 1e-4;
      assert.ok(same, `${key} of ${one.run}: ${one[key]}, not ${value}`);
    }
    assert.equal(one.change, told.change);
    const significant = ["faster", "slower"].includes(told.change);
    assert.equal(one.filled, significant);
    assert.equal(one.colour, { faster, slower }[told.change] ?? panel, one.run);
  }
});

page_test("times of two machines are said to be that and are not coloured", { page: "machines" }, async (page) => {
  assert.match(await page.locator("#warnings").innerText(), /The machines differ \(A: 0123abcd; B: feedbeef\)/);
  assert.match(await page.locator("#verdict").innerText(), /nothing is said to have become faster or slower/);
  const drawn = await drawn_ratios(page);
  assert.ok(drawn.some((one) => one.change === "lower time") && drawn.some((one) => one.change === "higher time"));
  assert.ok(drawn.every((one) => !one.filled));
  await open_table(page);
  assert.equal(await page.locator(".change.faster, .change.slower, .legend .filled").count(), 0);
});

page_test("a run beside itself has no change", { page: "itself" }, async (page) => {
  assert.match(await page.locator("#verdict").innerText(), /^A and B are the same measurements/);
  const rows = await table_rows(page);
  assert.equal(rows.length, compared.itself.pairs.length);
  assert.deepEqual([...new Set(rows.map((row) => row.status))].sort(), ["– fails in both", "○ not told apart"]);
  assert.match(await page.locator("#differences").innerText(), /Nothing that is recorded differs/);
});

page_test("the table has every pair with the program's numbers, status changes first", {}, async (page) => {
  const rows = await table_rows(page);
  const { pairs } = compared.before_after;
  assert.deepEqual(rows.map((row) => row.run).sort(), pairs.map((pair) => pair.name).sort());
  assert.deepEqual([rows[0].run, rows[1].run], [FAILS, WORKS]);
  for (const row of rows) {
    const told = pairs.find((pair) => pair.name === row.run);
    assert.ok(row.status.endsWith(told.change), `${row.run}: ${row.status}`);
    if (told.ratio !== null) assert_shows(row.ratio, told.ratio, `ratio of ${row.run}`);
    for (const side of ["a", "b"]) {
      const time = told[`median_${side}_ns`];
      const error = told[`l2_${side}`];
      if (time !== null)
        assert_shows(row[`time_${side}`].replace(/^([0-9]+)(?= |$)/, "$1.000"), time / 1e6, `time of ${row.run} in ${side}`);
      if (error !== null) assert_shows(row[`l2_${side}`], 100 * error, `error of ${row.run} in ${side}`);
    }
  }
  const grown = rows.find((row) => row.run === LARGER_ERROR);
  assert.match(grown.error_change, /^▲ \+0\.346/);
  assert.equal(rows.find((row) => row.run === FAILS).detail, "B: timeout, after 60 s");
});

page_test("the table filters by what became of a run, finds words and sorts", {}, async (page) => {
  await open_table(page);
  const names = () => runs_of(page.locator("#runs-table tbody tr"));
  const { pairs } = compared.before_after;
  await page.locator("#filter-status").selectOption("slower");
  const slower = pairs.filter((pair) => pair.change === "slower").map((pair) => pair.name);
  assert.deepEqual(await names(), slower);
  await page.locator("#filter-status").selectOption("");
  await page.locator("#filter-words").fill("hi/n:64000 polylidar");
  assert.deepEqual(await names(), ["polylidar/hi/n:64000/holes:0/protocol:paper"]);
  await page.locator("#filter-words").fill("");
  await page.locator('#runs-table th[data-column="ratio"] button').click();
  const ratios = (await names())
    .map((name) => pairs.find((pair) => pair.name === name).ratio)
    .filter((ratio) => ratio !== null);
  assert_ascending(ratios);
});

page_test("the chart of ratios filters, orders and hides methods; the other charts follow", {}, async (page) => {
  const labels = () =>
    page.evaluate(() => hullbenchComparison.forests.drawn.runs.filter((line) => !line.heading).map((line) => line.ratio));
  const count = async () => (await labels()).length;
  const pairs = (keep) => compared.before_after.pairs.filter((pair) => pair.ratio !== null && keep(pair)).length;
  const all = await count();
  await page.locator("#forest-words").fill("hi/n:2000");
  assert.equal(
    await count(),
    pairs(({ name }) => name.includes("/hi/n:2000/")),
  );
  await page.locator("#forest-words").fill("");
  await page.locator("#forest-order").selectOption("high");
  assert_ascending((await labels()).reverse());
  await page.locator("#forest-changed").selectOption("differ");
  assert.equal(
    await count(),
    pairs(({ change }) => ["faster", "slower"].includes(change)),
  );
  await page.locator("#forest-changed").selectOption("");
  const toggle = page.locator('#ratios [data-entrant="polylidar/paper"]');
  await toggle.focus();
  await page.keyboard.press("Space");
  assert.equal(await toggle.getAttribute("aria-pressed"), "false");
  assert.equal(await count(), all - pairs(({ name }) => name.startsWith("polylidar/")));
  assert.ok(!(await page.evaluate(() => hullbenchComparison.charts.drawn.shown)).includes("polylidar/paper"));
  await toggle.click();
  assert.equal(await count(), all);
});

page_test("a line of the chart tells its numbers under the pointer", {}, async (page) => {
  const { name, x, y } = await page.evaluate(() => {
    const { forests } = hullbenchComparison;
    const place = forests.drawn.runs.findIndex((line) => line.change === "slower");
    const line = forests.drawn.runs[place];
    forests.plots[1].element.scrollIntoView();
    const [left, top] = forests.plots[1].chart.convertToPixel({ gridIndex: 0 }, [line.ratio, place]);
    const box = forests.plots[1].element.getBoundingClientRect();
    return { name: forests.rows.name(line.row), x: box.left + left, y: box.top + top };
  });
  await page.mouse.move(x, y);
  const words = await page.locator("#forest-runs .tip").innerText();
  const told = compared.before_after.pairs.find((pair) => pair.name === name);
  assert.match(words, /▲ slower/);
  const [ratio, low, high] = digits_of(told);
  assert.ok(words.includes(`${ratio} [${low}, ${high}]`), words);
});

page_test("time and error of both runs are drawn with the reports' numbers", {}, async (page) => {
  const reports = { A: read_json("a", "report.json"), B: read_json("b", "report.json") };
  const drawn = await page.evaluate(() =>
    hullbenchComparison.charts.plots.map(({ chart }) =>
      chart
        .getOption()
        .series.flatMap((series) =>
          series.data
            .filter((one) => one?.point)
            .map((one) => ({ side: series.id.slice(-1), run: one.point.run, value: one.value[1] })),
        ),
    ),
  );
  for (const [place, value] of [(run) => median(run.time_ns) / 1e6, (run) => 100 * run.metrics.l2].entries()) {
    assert.deepEqual([...new Set(drawn[place].map(({ side }) => side))].sort(), ["A", "B"]);
    for (const { side, run, value: shown } of drawn[place]) {
      const row = reports[side].runs.find((one) => one.name === run);
      assert.ok(Math.abs(shown / value(row) - 1) < 1e-4, `${run} of ${side}: ${shown}, not ${value(row)}`);
    }
  }
  const california = (report) => report.runs.filter((run) => run.status === "ok" && run.dataset === "ca" && !run.holes).length;
  assert.equal(drawn[0].length, california(reports.A) + california(reports.B));
});

page_test("what differs between the runs is marked", {}, async (page) => {
  const rows = await page
    .locator("#differences-table tbody tr")
    .evaluateAll((all) => all.map((row) => row.innerText.replace(/\s+/g, " ")));
  assert.equal(rows.length, 1, rows.join("\n"));
  assert.match(rows[0], /^≠ differs Program hullbench .* commit 0123456789.* commit fedcba98/);
});

page_test("two runs in which everything failed have a page, which says so", { page: "failures" }, async (page) => {
  assert.equal(await page.locator("#charts-place").innerText(), "No shape has a chart in both.");
  assert.equal(await page.locator("#ratios-place").innerText(), "No run has a time in both.");
  assert.ok((await table_rows(page)).length > 0);
});

for (const screen of ["1280 light", "390 dark"]) {
  for (const name of ["before_after", "machines"]) {
    const options = { page: name, ...screen_options(screen) };
    page_test(`${name} is readable and accessible at ${screen}`, options, async (page) => {
      await open_table(page);
      await assert_readable(page, `${name}-${screen.replace(" ", "-")}`, 360);
    });
  }
}

page_test("paper is light and without controls", { theme: "dark" }, async (page) => {
  await open_table(page);
  await page.emulateMedia({ media: "print", colorScheme: "dark" });
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "light");
  assert.equal(
    await page.locator(".controls:visible, #ratios .toggles:visible, .contents:visible, button.small:visible").count(),
    0,
  );
  assert.ok((await page.evaluate(() => hullbenchComparison.forests.plots[1].chart.getWidth())) <= 660);
});

test("the pages are small", () => {
  for (const page of Object.keys(compared)) assert.ok(statSync(output(file_of(page))).size < 5 * 2 ** 20, page);
});
