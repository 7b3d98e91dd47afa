// What the first screen and the heat map lead to: pictures open, and numbers list their cases in the table of all runs. Pages
// of a site ask for the same behind the # of the report's address: report.html#case=...&run=... or #part=...&entrant=...
import { announce } from "./format.js";

/** `gallery` is {has(run), open(case, run)}; null: there are no pictures. `parts` gives a promise of the cases by part,
    `loadTable` one of the table of all runs. */
export function startFront(gallery, parts, loadTable) {
  const can = ({ part, run }) => Boolean(part || (run && gallery?.has(run)));

  async function follow({ case: case_name, run, part, entrant }) {
    if (!part) return gallery.open(case_name, run);
    const of_part = await parts();
    if (!Object.hasOwn(of_part, part)) return missing("runs", `The report has no cases of ${part}.`);
    const cases = of_part[part];
    const table = await loadTable();
    const words = part.split("/").pop();
    table.set({ words: "", experiment: "", status: "", entrant, only: { words, cases: new Set(cases) } });
    document.getElementById("runs").scrollIntoView();
    document.getElementById("table-only").focus({ preventScroll: true });
    announce(`The table has the cases of ${words} only.`);
  }

  function missing(section, words) {
    document.getElementById(section)?.scrollIntoView();
    announce(words);
  }

  document.addEventListener("click", (event) => {
    const link = event.target.closest?.("#strip a, .heat a");
    if (!link || !can(link.dataset)) return;
    event.preventDefault();
    follow(link.dataset);
  });
  const asked = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
  if (can(asked)) follow(asked);
  else if (asked.case) missing("gallery", `The gallery has no picture of ${asked.case}.`);
}
