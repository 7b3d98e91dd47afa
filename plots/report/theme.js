// Light and dark: as the system has it, or as the switch at the top says. Paper is always light.

const themeListeners = [];
const systemDark = matchMedia("(prefers-color-scheme: dark)");
export let printing = false;

/** "light" or "dark". */
export function currentTheme() {
  const chosen = document.querySelector("#theme input:checked")?.value ?? "auto";
  if (printing) return "light";
  return chosen === "auto" ? (systemDark.matches ? "dark" : "light") : chosen;
}

/** Calls `listener` after every change of the theme. */
export function onTheme(listener) {
  themeListeners.push(listener);
}

/** The value of a custom property such as --ink. */
export function cssColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** The colours of the theme that charts are drawn in; those of a change only where the page has them. */
export function themeInk() {
  const names = ["ink", "muted", "line", "grid", "panel", "faster", "slower"];
  return Object.fromEntries(names.map((name) => [name, cssColour(`--${name}`)]));
}

function applyTheme() {
  document.documentElement.dataset.theme = currentTheme();
  for (const listener of themeListeners) listener();
}

export function startTheme() {
  document.getElementById("theme").hidden = false;
  // Private windows and pages from disk may have no storage; the choice then lasts as long as the page.
  const storage = (use) => {
    try {
      return use(localStorage);
    } catch {
      return null;
    }
  };
  const kept = storage((store) => store.getItem("hullbench-theme"));
  const switches = document.querySelectorAll("#theme input");
  for (const one of switches) {
    if (one.value === kept) one.checked = true;
    one.addEventListener("change", () => {
      storage((store) => store.setItem("hullbench-theme", one.value));
      applyTheme();
    });
  }
  systemDark.addEventListener("change", applyTheme);
  addEventListener("beforeprint", () => setPrinting(true));
  addEventListener("afterprint", () => setPrinting(false));
  applyTheme();
}

function setPrinting(now) {
  printing = now;
  applyTheme();
}
