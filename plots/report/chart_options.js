// From the report's numbers to what ECharts draws. Nothing here touches the page.
import { formatCount } from "./format.js";
import { markerPath } from "./markers.js";

// Who chose the parameters, by the line's dashes, and what these are called.
export const DASHES = {
  paper: ["solid", "solid"],
  auto: [[7, 4], "long dashes"],
  default: [[2, 3], "dots"],
  tuned: [[9, 3, 2, 3], "dashes and dots"],
  oracle: [[1, 4], "sparse dots"],
};

/** [value, low, high] of a point for "time", "paper_time" or a metric; null: the point has none. */
export function pointValue(point, quantity) {
  if (quantity.kind === "time") return point[quantity.name] ?? null;
  const value = point.metrics[quantity.name];
  if (value === undefined || value === null) return null;
  const three = Array.isArray(value) ? value : [value, null, null];
  return three.map((one) => (one === null ? null : one * quantity.metric.factor));
}

/** Ticks 1, 2, 5 in every decade that the values span, only decades when there are many. */
export function logTicks(low, high) {
  const from = Math.floor(Math.log10(low));
  const to = Math.ceil(Math.log10(high));
  const decades = Math.log10(high / low);
  const fine = [1, 1.2, 1.4, 1.6, 1.8, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9];
  const coarser = { 2.7: [1], 1.3: [1, 2, 5], 0.5: [1, 2, 3, 4, 5, 7] };
  const steps = coarser[[2.7, 1.3, 0.5].find((least) => decades > least)] ?? fine;
  const ticks = [];
  for (let decade = from; decade <= to; decade++) {
    for (const step of steps) ticks.push(Number(`${step}e${decade}`));
  }
  return ticks.filter((tick) => tick >= low && tick <= high);
}

function plainAxis(name, ink) {
  return {
    name,
    nameTextStyle: { color: ink.muted },
    axisLabel: { color: ink.muted, hideOverlap: true },
    axisLine: { lineStyle: { color: ink.line } },
    axisTick: { lineStyle: { color: ink.line } },
    splitLine: { lineStyle: { color: ink.grid } },
  };
}

/** A numeric axis over these values. Logarithmic only when all of them are above zero. */
export function numericAxis(name, values, logarithmic, ink, share = 0.06) {
  const axis = { ...plainAxis(name, ink), minorSplitLine: { show: false } };
  const finite = values.filter((value) => Number.isFinite(value));
  const low = Math.min(...finite);
  const high = Math.max(...finite);
  if (!logarithmic || !(low > 0)) {
    return {
      ...axis,
      type: "value",
      scale: low > 0 && low > 0.5 * high,
      axisLabel: { ...axis.axisLabel, formatter: (value) => tickLabel(value) },
    };
  }
  const room = Math.max((high / low) ** share, 1.1);
  const [min, max] = [low / room, high * room];
  const customValues = logTicks(min, max);
  return {
    ...axis,
    type: "log",
    min,
    max,
    axisTick: { ...axis.axisTick, customValues },
    axisLabel: { ...axis.axisLabel, customValues, formatter: (value) => tickLabel(value) },
  };
}

function tickLabel(value) {
  return value >= 10000 ? formatCount(Math.round(value)) : String(Number(value.toPrecision(3)));
}

/** The axis of the cases: numbers of points or names. */
function caseAxis(chart, logarithmic, ink, width) {
  if (chart.kind !== "n") {
    // Labels that would not fit side by side are turned.
    const turned = 8 * chart.x.length * Math.max(...chart.x.map((one) => one.length)) > width - 70;
    const axis = plainAxis(chart.kind === "shape" ? "" : chart.axis, ink);
    return {
      ...axis,
      type: "category",
      data: chart.x,
      nameLocation: "middle",
      nameGap: turned ? 54 : 34,
      axisTick: { ...axis.axisTick, alignWithLabel: true },
      axisLabel: { ...axis.axisLabel, rotate: turned ? 40 : 0 },
      splitLine: { ...axis.splitLine, show: true },
    };
  }
  const axis = numericAxis(chart.axis, chart.x, logarithmic, ink);
  return {
    ...axis,
    nameLocation: "middle",
    nameGap: 32,
    axisTick: { ...axis.axisTick, customValues: chart.x },
    axisLabel: { ...axis.axisLabel, customValues: chart.x, formatter: (value) => formatCount(Math.round(value)) },
  };
}

/** The options of one chart of a quantity over the cases. `shown` are the entrants in their order. */
export function caseChartOptions(chart, quantity, shown, settings, ink, width) {
  const place = (point) => (chart.kind === "n" ? chart.x[point.x] : point.x);
  const series = [];
  const values = [];
  // Side by side within a shape, for many methods have nearly the same value.
  const step = chart.kind === "shape" ? Math.min(12, (0.8 * (width - 70)) / chart.x.length / shown.length) : 0;
  for (const [index, entrant] of shown.entries()) {
    const points = (chart.series[entrant.key] ?? []).filter((point) => pointValue(point, quantity));
    if (!points.length) continue;
    const data = points.map((point) => ({ value: [place(point), pointValue(point, quantity)[0]], point }));
    values.push(...data.map((one) => one.value[1]));
    const band =
      settings.bands && chart.kind !== "shape" ? bandSeries(entrant, points, place, quantity) : { values: [], series: [] };
    values.push(...band.values);
    // The first entrants are drawn last: where two lines coincide, the first is on top.
    series.unshift(...band.series, {
      ...lineStyle(entrant, chart.kind),
      symbolOffset: [step * (index - (shown.length - 1) / 2), 0],
      data,
      id: entrant.key,
      name: entrant.label,
    });
  }
  return {
    ...commonOptions(ink),
    grid: { left: 8, right: 18, top: 14, bottom: { n: 40, shape: 14, convexity: 48 }[chart.kind], containLabel: true },
    xAxis: caseAxis(chart, settings.logX, ink, width),
    yAxis: numericAxis("", values, quantity.kind === "time" ? settings.logTime : settings.logError, ink),
    series,
  };
}

/** The interval of every point as a band: an unseen line along its lower end, and the rest stacked on it. */
function bandSeries(entrant, points, place, quantity) {
  const inside = points.map((point) => [place(point), pointValue(point, quantity)]).filter(([, value]) => value[1] !== null);
  const base = {
    type: "line",
    stack: `band ${entrant.key}`,
    silent: true,
    symbol: "none",
    lineStyle: { opacity: 0 },
    itemStyle: { color: entrant.colour },
    tooltip: { show: false },
    animation: false,
    z: 1,
  };
  const low = { ...base, id: `low ${entrant.key}`, data: inside.map(([x, value]) => [x, value[1]]) };
  const data = inside.map(([x, value]) => [x, value[2] - value[1]]);
  const band = { ...base, id: `band ${entrant.key}`, areaStyle: { color: entrant.colour, opacity: 0.2 }, data };
  return { values: inside.flatMap(([, value]) => [value[1], value[2]]), series: inside.length ? [low, band] : [] };
}

function lineStyle(entrant, kind) {
  return {
    type: "line",
    symbol: `path://${markerPath(entrant.marker)}`,
    symbolSize: kind === "shape" ? 9 : 8,
    symbolKeepAspect: true,
    showAllSymbol: true,
    // Between shapes there is nothing to be interpolated.
    lineStyle: { color: entrant.colour, width: 1.8, type: DASHES[entrant.protocol][0], opacity: kind === "shape" ? 0 : 1 },
    itemStyle: { color: entrant.colour, opacity: kind === "shape" ? 0.85 : 1 },
    emphasis: { scale: 1.5, focus: "series", lineStyle: { width: 2.6 } },
    blur: { lineStyle: { opacity: kind === "shape" ? 0 : 0.15 } },
    triggerLineEvent: kind !== "shape",
    z: 3,
  };
}

/** The wheel alone scrolls the page. */
export function commonOptions(ink) {
  const zoom = {
    type: "inside",
    filterMode: "none",
    zoomOnMouseWheel: "ctrl",
    moveOnMouseMove: false,
    moveOnMouseWheel: false,
  };
  return {
    animation: false,
    dataZoom: [
      { ...zoom, xAxisIndex: 0 },
      { ...zoom, yAxisIndex: 0 },
    ],
    backgroundColor: "transparent",
    textStyle: { fontFamily: "inherit", color: ink.ink },
    tooltip: {
      trigger: "item",
      confine: true,
      backgroundColor: ink.panel,
      borderColor: ink.line,
      borderWidth: 1,
      textStyle: { color: ink.ink, fontSize: 13 },
      transitionDuration: 0,
      extraCssText: "box-shadow:0 2px 10px #0003",
    },
    toolbox: {
      show: true,
      itemSize: 0,
      showTitle: false,
      top: -50,
      feature: { dataZoom: { filterMode: "none", brushStyle: { color: ink.grid, opacity: 0.6 } } },
    },
  };
}
