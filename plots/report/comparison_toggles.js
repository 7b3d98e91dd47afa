// What the sections of the comparison share: colours, and which methods are shown.

/** The colours of the theme; the report's and the two of a significant change. */
function comparisonInk() {
  return Object.fromEntries(
    ["ink", "muted", "line", "grid", "panel", "faster", "slower"].map((name) => [name, cssColour(`--${name}`)]),
  );
}

/** Buttons that show and hide methods; `hidden` is a set of entrants' keys that several parts of the page share. */
class MethodToggles {
  constructor(place, report, keys, hidden, changed) {
    Object.assign(this, { report, hidden, changed });
    this.entrants = report.entrants.filter((entrant) => keys.has(entrant.key));
    this.element = make("div", { class: "toggles", role: "group", "aria-label": "Methods shown" });
    place.append(this.element);
    this.buttons = this.entrants.map((entrant) =>
      make(
        "button",
        {
          type: "button",
          class: "toggle",
          "data-entrant": entrant.key,
          style: `--own: var(--method-${entrant.method})`,
          click: () => this.toggle(entrant.key),
        },
        markerPicture(report.methods[entrant.method].marker),
        entrant.label,
      ),
    );
    const every = (words, act) =>
      make(
        "button",
        {
          type: "button",
          class: "small",
          click: () => {
            for (const { key } of this.entrants) this.hidden[act](key);
            this.changed();
          },
        },
        words,
      );
    this.element.append(
      ...this.buttons,
      ...(this.entrants.length > 3 ? [every("All", "delete"), every("None", "add")] : []),
    );
    this.draw();
  }

  toggle(key) {
    if (!this.hidden.delete(key)) this.hidden.add(key);
    this.changed();
  }

  draw() {
    for (const button of this.buttons)
      button.setAttribute("aria-pressed", String(!this.hidden.has(button.dataset.entrant)));
  }
}
