// Numbers and elements.

/** Three significant digits (or `digits`), without an exponent between a thousandth and a million. */
export function formatNumber(value, digits = 3) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (typeof value !== "number") return String(value);
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-3 || size >= 1e6) return value.toExponential(digits - 1);
  // Rounded first, so that 0.9999 and 1.0001 are written alike.
  return value.toFixed(Math.max(0, digits - 1 - Math.floor(Math.log10(Number(size.toPrecision(digits))))));
}

/** A whole number in groups of three, from 10000 on. */
export function formatCount(value) {
  return value < 10000 ? String(value) : String(value).replace(/\B(?=(\d{3})+$)/g, "\u202f");
}

/** [median, low, high] in milliseconds: 0.395 ms [0.390, 0.412]. */
export function formatTime(time) {
  if (!time) return "–";
  const interval = time[1] === null ? "" : ` [${formatNumber(time[1])}, ${formatNumber(time[2])}]`;
  return `${formatNumber(time[0])} ms${interval}`;
}

/** A metric's value in its unit, without the unit's name: numbers of things are whole, all else has `digits` digits. */
export function formatScore(metric, value, digits = 3) {
  if (metric.whole && Number.isInteger(value)) return formatCount(value);
  return formatNumber(value, digits);
}

/** A metric's recorded value as the page shows it, with its unit. */
export function formatMetric(metric, value) {
  if (value === null || value === undefined) return "–";
  return formatScore(metric, value * metric.factor) + (metric.unit ? ` ${metric.unit}` : "");
}

/**
 * An element with attributes and children. Strings become text nodes, never markup: a record may hold "<script>".
 * Attributes that are functions become listeners; true and false set and leave out an attribute.
 */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** A small button; `more` are attributes beside the usual ones. */
export function smallButton(words, click, more = {}) {
  return make("button", { type: "button", class: "small", click, ...more }, words);
}

/** A labelled choice between `options`, which are [value, text]; `chosen` is called with the value. */
export function makeChoice(words, attributes, options, chosen) {
  const made = options.map(([value, text]) => make("option", { value }, text));
  const select = make("select", { ...attributes, change: (event) => chosen(event.target.value) }, ...made);
  return make("label", {}, words, select);
}

/** A search box under words, which hands on what is in it after every letter. */
export function makeSearch(words, id, typed) {
  const input = (event) => typed(event.target.value);
  const box = make("input", { type: "search", id, placeholder: "ca holes:1 n:64000", autocomplete: "off", input });
  return make("label", {}, words, box);
}

/** A box with words, which hands on whether it is checked; `attributes` are the box's. */
export function makeCheck(words, attributes, changed) {
  const change = (event) => changed(event.target.checked);
  return make("label", { class: "check" }, make("input", { type: "checkbox", ...attributes, change }), words);
}

/** The words of a text that was typed, in small letters. */
export function wordsOf(text) {
  return text.toLowerCase().split(/\s+/).filter(Boolean);
}

export function statusWords(status) {
  return status.replaceAll("_", " ");
}

/** A name behind the method's colour. */
export function makeNamed(method, name, attributes = {}) {
  return make("span", attributes, make("span", { class: "swatch", "data-method": method }), name);
}

/** The box at the pointer: a title, a line on where it is, names with values ([name, value]), and a hint. */
export function makeTip(title, where, lines, hint = "") {
  const line = ([name, value]) => make("div", { class: "tip-line" }, make("span", {}, name), make("b", {}, value));
  const muted = (words) => (words ? make("div", { class: "muted" }, words) : null);
  return make("div", { class: "tip" }, make("strong", {}, title), muted(where), ...lines.map(line), muted(hint));
}

/** Says something to screen readers. */
export function announce(words) {
  document.getElementById("announcer").textContent = words;
}
