// What the page was given: small parts as JSON, large ones packed and decoded when they are first needed.

/** The value of a <script type="application/json"> element; null: there is no such element. */
export function readJson(id) {
  const element = document.getElementById(id);
  return element ? JSON.parse(element.textContent) : null;
}

/** What is packed as gzip in base64, as a Response. */
export function gunzip(base64) {
  const packed = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip")));
}

/** A value packed by report_data.pack. */
export async function unpack(packed) {
  return gunzip(packed.data).json();
}

/** A function that calls `make` once, when it is first called, and always returns that result. */
export function once(make) {
  let made;
  return () => (made ??= make());
}

/** The columns of all runs, with a `get(name, row)` that resolves words; undefined columns give null. */
export class Rows {
  constructor(packed) {
    this.count = packed.count;
    this.columns = packed.columns;
  }

  has(name) {
    return name in this.columns;
  }

  get(name, row) {
    const column = this.columns[name];
    if (!column) return null;
    const value = column.values[row];
    return column.words && value !== null ? column.words[value] : value;
  }

  /** The data set's name, such as star-17. */
  dataset(row) {
    const member = this.get("member", row);
    return this.get("family", row) + (member === null ? "" : `-${member}`);
  }

  /** Its title, such as California. */
  shape(row) {
    const { titles, values } = this.columns.family;
    const member = this.get("member", row);
    return titles[values[row]] + (member === null ? "" : ` ${member}`);
  }

  /** The case's name, such as ca/n:2000/holes:0. */
  caseName(row) {
    return `${this.dataset(row)}/${this.get("sample", row)}`;
  }

  /** The run's name, which the records put together from method, case and protocol. */
  name(row) {
    if (this.columns.name) return this.get("name", row);
    const [method, protocol] = this.get("entrant", row).split("/");
    return `${method}/${this.caseName(row)}/protocol:${protocol}`;
  }
}

/** The command that measures one run again. */
export function reproduceCommand(experiment, name) {
  const pattern = `^${name.replace(/[\\^$.*+?()[\]{}|]/g, "\\$&")}$`;
  return `build/hullbench run ${experiment.name} --seed ${experiment.seed} --filter '${pattern.replaceAll("'", "'\\''")}'`;
}

/** The values by their key, in the order of the keys' first appearance. */
export function groupBy(values, key) {
  const groups = new Map();
  for (const value of values) groups.set(key(value), [...(groups.get(key(value)) ?? []), value]);
  return groups;
}

/** Calls `act` when the element is less than a screen away. */
export function whenNear(element, act) {
  const observer = new IntersectionObserver(
    (entries) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      observer.disconnect();
      act();
    },
    { rootMargin: "100% 0px" },
  );
  observer.observe(element);
}
