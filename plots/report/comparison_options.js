// From the comparison's numbers to what ECharts draws. Nothing here changes the page.
import { caseChartOptions, commonOptions, logTicks } from "./chart_options.js";
import { formatNumber } from "./format.js";
import { LABEL_SIZE, textWidth } from "./label_places.js";
import { markerPath } from "./markers.js";

// Only what is significant has a colour and a filled sign; the others are drawn in grey, hollow.
export const CHANGE_MARKS = {
  faster: { marker: "triangle-left", colour: "faster", filled: true, size: 12 },
  slower: { marker: "triangle-right", colour: "slower", filled: true, size: 12 },
  "lower time": { marker: "triangle-left", colour: "muted", filled: false, size: 12 },
  "higher time": { marker: "triangle-right", colour: "muted", filled: false, size: 12 },
  "not told apart": { marker: "circle", colour: "muted", filled: false, size: 9 },
  "not judged": { marker: "bar", colour: "muted", filled: false, size: 8 },
};

const FOREST_ROW = 22;

/** The height of a forest plot of so many lines, in pixels. */
export function forestHeight(count) {
  return FOREST_ROW * count + 64;
}

/** About `most` round ratios between low and high; decades of 1, 2 and 5 where they span more than eight times. */
function ratioTicks(low, high, most) {
  if (high / low > 8) return logTicks(low, high);
  const step = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1].find((one) => (high - low) / one <= most) ?? 2;
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.floor(high / step + 1e-9) - first + 1 }, (_, index) =>
    Number(((first + index) * step).toPrecision(6)),
  );
}

/**
 * A line with its interval for every ratio, round the line at 1, on a logarithmic axis. `lines` are {label, heading,
 * ratio, low, high, change}, from the top; those with a heading have only that.
 */
export function forestOptions(lines, ink, width) {
  const values = lines.flatMap((line) => [line.ratio, line.low, line.high]).filter((value) => value > 0);
  const low = Math.min(0.95, ...values);
  const high = Math.max(1.05, ...values);
  const room = Math.max((high / low) ** 0.03, 1.005);
  const [min, max] = [low / room, high * room];
  // SVG text with "inherit" as its family takes the page's size as well.
  const font = { fontFamily: getComputedStyle(document.body).fontFamily, fontSize: LABEL_SIZE };
  const customValues = ratioTicks(min, max, width < 500 ? 3 : 8);
  const labels = Math.min(
    width * 0.48,
    14 + Math.max(...lines.map((line) => textWidth(line.heading ?? line.label, line.heading !== undefined))),
  );
  const changes = Object.entries(CHANGE_MARKS).filter(([change]) => lines.some((line) => line.change === change));
  return {
    ...commonOptions(ink),
    toolbox: undefined,
    dataZoom: [],
    grid: { left: labels, right: 22, top: 6, bottom: 48 },
    xAxis: {
      type: "log",
      min,
      max,
      name: width < 500 ? "← B takes less    B takes more →" : "← B takes less    time B ÷ A    B takes more →",
      nameLocation: "middle",
      nameGap: 30,
      nameTextStyle: { ...font, color: ink.muted },
      axisLine: { lineStyle: { color: ink.line } },
      axisTick: { customValues, lineStyle: { color: ink.line } },
      splitLine: { show: false },
      axisLabel: { customValues, ...font, hideOverlap: true, color: ink.muted, formatter: ratioTick },
    },
    yAxis: {
      type: "category",
      inverse: true,
      data: lines.map((_, index) => String(index)),
      axisTick: { show: false },
      axisLine: { show: false },
      splitLine: { show: true, interval: 0, lineStyle: { color: ink.grid } },
      axisLabel: {
        ...font,
        interval: 0,
        color: ink.ink,
        width: labels - 8,
        overflow: "truncate",
        formatter: (index) => (lines[index].heading ? `{heading|${plain(lines[index].heading)}}` : plain(lines[index].label)),
        rich: { heading: { ...font, fontWeight: 600, color: ink.ink, width: labels - 8, overflow: "truncate" } },
      },
    },
    series: [
      {
        id: "one",
        type: "line",
        data: [],
        silent: true,
        markLine: {
          silent: true,
          symbol: "none",
          label: { show: false },
          lineStyle: { color: ink.ink, width: 1, type: "solid" },
          data: [{ xAxis: 1 }],
        },
      },
      ...changes.flatMap(([change, mark]) => forestSeries(change, mark, lines, ink)),
    ],
  };
}

function ratioTick(value) {
  return value >= 0.01 && value < 10 ? value.toFixed(2) : String(Number(value.toPrecision(3)));
}

/** Labels are rich text in ECharts: braces and bars of a record must not become styles. */
function plain(words) {
  return words.replace(/[{}|]/g, " ");
}

function forestSeries(change, mark, lines, ink) {
  const own = lines.map((line, index) => ({ line, index })).filter(({ line }) => line.change === change);
  const colour = ink[mark.colour];
  const ends = own
    .filter(({ line }) => line.low !== null)
    .flatMap(({ line, index }) => [
      [line.low, index],
      [line.high, index],
      ["-", index],
    ]);
  return [
    {
      id: `interval ${change}`,
      type: "line",
      silent: true,
      symbol: "none",
      data: ends,
      lineStyle: { color: colour, width: mark.filled ? 2.4 : 1.6 },
      tooltip: { show: false },
      z: 2,
    },
    {
      id: change,
      name: change,
      type: "scatter",
      symbol: `path://${markerPath(mark.marker)}`,
      symbolSize: mark.size,
      symbolKeepAspect: true,
      cursor: "default",
      itemStyle: {
        color: mark.filled ? colour : ink.panel,
        borderColor: colour,
        borderWidth: mark.filled ? 0 : 1.5,
        opacity: 1,
      },
      emphasis: { scale: 1.4 },
      data: own.map(({ line, index }) => ({ value: [line.ratio, index], line })),
      z: 3,
    },
  ];
}

/** A ratio with three digits: 1.00 where formatNumber writes 1, for 1.00 and 0.99 must not look alike. */
export function formatRatio(value) {
  return Number.isInteger(value) && value < 10 ? value.toFixed(2) : formatNumber(value);
}

/** 0.935 [0.923, 0.948]; without the interval where there is none. */
export function formatRatioInterval(ratio, low, high) {
  return formatRatio(ratio) + (low === null || low === undefined ? "" : ` [${formatRatio(low)}, ${formatRatio(high)}]`);
}

/**
 * The options of a chart of the report, with both runs in it: those of A pale and hollow. `shown` are the entrants; the
 * series' ids are the entrant's key and the side.
 */
export function bothChartOptions(chart, quantity, shown, settings, ink, width) {
  // The first is drawn on top: the full sign of B within the ring of A.
  const order = chart.kind === "shape" ? ["A", "B"] : ["B", "A"];
  const sides = shown.flatMap((entrant) =>
    order.map((side) => ({ ...entrant, key: `${entrant.key} ${side}`, label: `${entrant.label}, ${side}` })),
  );
  const series = Object.fromEntries(
    ["A", "B"].flatMap((side) => Object.entries(chart[side.toLowerCase()]).map(([key, points]) => [`${key} ${side}`, points])),
  );
  const options = caseChartOptions({ ...chart, series }, quantity, sides, settings, ink, width);
  for (const one of options.series) {
    if (!one.id.endsWith(" A") || one.stack) continue;
    one.itemStyle = { ...one.itemStyle, color: ink.panel, borderColor: one.itemStyle.color, borderWidth: 1.5 };
    one.lineStyle = { ...one.lineStyle, width: 1.2, opacity: one.lineStyle.opacity * 0.55 };
    one.symbolSize = 13;
  }
  return options;
}
