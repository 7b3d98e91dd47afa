// What the first screen and the heat map lead to: pictures open, and numbers list their cases in the table of all runs.
import { announce } from "./format.js";

/** `gallery` is {has(run), open(case, run)}; null: there are no pictures. `parts` gives a promise of the cases by part,
    `loadTable` one of the table of all runs. */
export function startFront(gallery, parts, loadTable) {
  document.addEventListener("click", async (event) => {
    const link = event.target.closest?.("#strip a, .heat a");
    if (!link) return;
    const { case: case_name, run, part, entrant } = link.dataset;
    if (part) {
      event.preventDefault();
      const cases = (await parts())[part];
      const table = await loadTable();
      const words = part.split("/").pop();
      table.set({ words: "", experiment: "", status: "", entrant, only: { words, cases: new Set(cases) } });
      document.getElementById("runs").scrollIntoView();
      document.getElementById("table-only").focus({ preventScroll: true });
      announce(`The table has the cases of ${words} only.`);
    } else if (gallery?.has(run)) {
      event.preventDefault();
      gallery.open(case_name, run);
    }
  });
}
