// Buttons that show and hide methods.
import { make, smallButton } from "./format.js";
import { markerPicture } from "./markers.js";

export class MethodToggles {
  /** `hidden` is a set of entrants' keys, which several parts of a page may share; `changed` is called after a click. */
  constructor(place, report, hidden, changed) {
    Object.assign(this, { report, hidden, changed });
    this.element = make("div", { class: "toggles", role: "group", "aria-label": "Methods shown" });
    place.append(this.element);
  }

  /** Shows a button for each of the entrants. A button that has the focus keeps it. */
  draw(entrants) {
    const focused = this.element.contains(document.activeElement) && document.activeElement.dataset.entrant;
    const quick = entrants.length > 3 ? [this.every(entrants, "All"), this.every(entrants, "None", () => false)] : [];
    if (quick.length && new Set(entrants.map((one) => one.protocol)).size > 1)
      quick.push(this.every(entrants, "Only paper’s rules", (entrant) => entrant.protocol === "paper"));
    this.element.replaceChildren(...entrants.map((entrant) => this.toggle(entrant)), ...quick);
    if (focused) this.element.querySelector(`[data-entrant="${CSS.escape(focused)}"]`)?.focus();
  }

  toggle({ key, method, label }) {
    const click = () => {
      if (!this.hidden.delete(key)) this.hidden.add(key);
      this.changed();
    };
    return make(
      "button",
      {
        type: "button",
        class: "toggle",
        "data-entrant": key,
        "aria-pressed": String(!this.hidden.has(key)),
        style: `--own: var(--method-${method})`,
        click,
      },
      markerPicture(this.report.methods[method].marker),
      label,
    );
  }

  /** A button that shows those of the entrants that `keep` says, and hides the others. */
  every(entrants, words, keep = () => true) {
    const click = () => {
      for (const entrant of entrants) this.hidden[keep(entrant) ? "delete" : "add"](entrant.key);
      this.changed();
    };
    return smallButton(words, click);
  }
}
