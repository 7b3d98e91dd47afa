/* What the gallery and its dialog know of cases and runs: which have a picture, which is the worst, how they are called.
   An entry is an entry of the page's pictures with its runs by name, in the order of the page's entrants. */
import { formatCount, formatMetric, formatNumber, formatTime } from "./format.js";
import { cssColour } from "./theme.js";

let entries = [];
let report = null;
let pictures = null;
let in_order = [];

/** Takes the page's data; gives the entries of all cases. */
export function read_cases(page_report, page_pictures) {
  report = page_report;
  pictures = page_pictures;
  entries = pictures.cases.map(make_entry);
  return entries;
}

/** The cases in the order of the list, each with the run that stands for it: {entry, run}. */
export function cases_in_order() {
  return in_order;
}

export function set_order(shown) {
  in_order = shown;
}

/** The columns of a run by name, its index in the picture's runs, and what follows from them. */
function make_run(entry, values, index) {
  const run = Object.fromEntries(pictures.run_columns.map((column, k) => [column, values[k]]));
  run.index = index;
  run.name = `${run.method}/${entry.case}/protocol:${run.protocol}`;
  run.series = `${run.method}/${run.protocol}`;
  run.failed = run.status !== "ok" && !pictures.not_tried.includes(run.status);
  return run;
}

/** For sorting: failures are worse than any error, what was not tried better than any. */
export function badness(run) {
  if (run.failed) return Infinity;
  return run.status === "ok" && run.l2 !== null ? run.l2 : -1;
}

export function worst_run(runs) {
  return runs.reduce((worst, run) => (badness(run) > badness(worst) ? run : worst));
}

function make_entry(source) {
  const entry = { ...source, source };
  const place = (run) => report.entrants.findIndex((entrant) => entrant.key === run.series);
  entry.runs = source.runs.map((values, index) => make_run(source, values, index)).sort((a, b) => place(a) - place(b));
  entry.family = source.title.replace(/ \d+$/, "");
  entry.subtitle = `${formatCount(source.n)} points, ${source.holes ? "with holes" : "no holes"}`;
  return entry;
}

export function method_colour(name) {
  return cssColour(`--method-${name}`) || "gray";
}

/** What the page calls the method under that protocol. */
export function series_title(series) {
  return report.entrants.find((entrant) => entrant.key === series).label;
}

/** A metric's value as the table shows it, with its unit. */
export function metric_text(name, value) {
  const metric = report.metrics.find((one) => one.name === name);
  return metric ? formatMetric(metric, value) : formatNumber(value);
}

/** Each of the page's metrics that a run has a number for, in their order, with its value as `text`. */
export function metric_list(metrics) {
  return report.metrics
    .filter(({ name }) => typeof metrics[name] === "number")
    .map((metric) => ({ ...metric, text: formatMetric(metric, metrics[metric.name]) }));
}

export function time_text(ns) {
  return formatTime(ns === null ? null : [ns / 1e6, null, null]);
}

/** The entry of a case that has this run; any run when none is named. */
export function find_case(case_name, run_name) {
  const named = entries.filter((entry) => entry.case === case_name);
  return named.find((entry) => entry.runs.some((run) => run.name === run_name)) ?? named[0];
}

let drawn_runs = null;

/** Whether the result of a run, by the run's name, can be shown. */
export function hasPicture(run_name) {
  drawn_runs ??= new Set(entries.flatMap((entry) => entry.runs.filter((run) => run.result !== null).map((run) => run.name)));
  return drawn_runs.has(run_name);
}
