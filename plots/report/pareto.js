// Time against error: who is beaten in both, and who is not.
import { commonOptions, numericAxis, pointValue } from "./chart_options.js";
import { LABEL_SIZE } from "./label_places.js";
import { markerPath } from "./markers.js";

/**
 * {list, leftOut}: what to draw of the entrants shown, and those left out. `chosen` is the index of a case, or "common":
 * the medians over the shapes for which all have both values.
 */
export function paretoEntries(chart, chosen, time, error, shown) {
  const usable = (entrant) =>
    (chart.series[entrant.key] ?? []).filter((point) => pointValue(point, time) && pointValue(point, error));
  if (chosen === "common") {
    const candidates = shown.map((entrant) => ({ entrant, points: usable(entrant) }));
    return commonEntries(chart, time, error, candidates);
  }
  const list = shown.flatMap((entrant) =>
    usable(entrant)
      .filter((point) => point.x === Number(chosen))
      .map((point) => {
        const [its_time, its_error] = [time, error].map((quantity) => pointValue(point, quantity));
        return { entrant, time: its_time, error: its_error, cases: point.count ?? 1, point };
      }),
  );
  return { list, leftOut: [] };
}

/** An entrant with results for less than half of the shapes would leave too few that all have; it is left out. */
function commonEntries(chart, time, error, candidates) {
  const able = candidates.filter(({ points }) => points.length * 2 >= chart.x.length);
  const leftOut = candidates.filter((one) => !able.includes(one)).map(({ entrant }) => entrant);
  const common = chart.x
    .map((_, index) => index)
    .filter((index) => able.every(({ points }) => points.some((point) => point.x === index)));
  if (!common.length) return { list: [], leftOut };
  const middle = (points, quantity) => [
    median(points.filter((point) => common.includes(point.x)).map((point) => pointValue(point, quantity)[0])),
    null,
    null,
  ];
  const list = able.map(({ entrant, points }) => ({
    entrant,
    time: middle(points, time),
    error: middle(points, error),
    cases: common.length,
  }));
  return { list, leftOut };
}

function median(values) {
  const order = [...values].sort((a, b) => a - b);
  const half = order.length >> 1;
  return order.length % 2 ? order[half] : (order[half - 1] + order[half]) / 2;
}

/**
 * Time against error: one dot an entrant. `entries` are {entrant, time, error, cases}; the front joins those that no
 * other beats in both.
 */
export function paretoOptions(entries, time, error, settings, ink) {
  const front = paretoFront(entries, error.metric.better);
  const values = (key) => entries.map((one) => one[key][0]);
  const axis = (quantity, key, logarithmic, room) => numericAxis(quantity.axis, values(key), logarithmic, ink, room);
  return {
    ...commonOptions(ink),
    grid: { left: 8, right: 48, top: 40, bottom: 40, containLabel: true },
    xAxis: { ...axis(time, "time", settings.logTime, 0.12), nameLocation: "middle", nameGap: 32 },
    yAxis: {
      ...axis(error, "error", settings.logError, 0.1),
      nameLocation: "end",
      nameTextStyle: { color: ink.muted, align: "left" },
    },
    series: [
      {
        id: "front",
        name: "Front",
        type: "line",
        step: "end",
        symbol: "none",
        silent: true,
        tooltip: { show: false },
        lineStyle: { color: ink.muted, width: 1.2, type: [4, 4] },
        data: front.map((one) => [one.time[0], one.error[0]]),
        z: 1,
      },
      ...entries.map((one) => ({
        id: one.entrant.key,
        name: one.entrant.label,
        type: "scatter",
        symbol: `path://${markerPath(one.entrant.marker)}`,
        symbolSize: 14,
        symbolKeepAspect: true,
        itemStyle: {
          color: one.entrant.colour,
          opacity: 1,
          borderColor: one.entrant.protocol === "paper" ? undefined : ink.ink,
          borderWidth: one.entrant.protocol === "paper" ? 0 : 1,
        },
        label: {
          show: false,
          distance: 4,
          backgroundColor: ink.panel,
          color: ink.ink,
          fontSize: LABEL_SIZE,
          formatter: (dot) => dot.seriesName,
        },
        emphasis: { scale: 1.3 },
        data: [{ value: [one.time[0], one.error[0]], entry: one }],
        z: 3,
      })),
    ],
  };
}

/** The entries that no other beats in time and error, fastest first; none when neither side of the error is better. */
function paretoFront(entries, better) {
  if (!better) return [];
  // How far from the best a value is.
  const distance = (one) =>
    ({ lower: one.error[0], higher: -one.error[0], zero: Math.abs(one.error[0]), one: Math.abs(one.error[0] - 1) })[better];
  const order = [...entries].sort((a, b) => a.time[0] - b.time[0] || distance(a) - distance(b));
  let best = Infinity;
  return order.filter((one) => {
    if (distance(one) >= best) return false;
    best = distance(one);
    return true;
  });
}
