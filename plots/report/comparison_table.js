// The table of all runs that both have: the report's table with other columns.
import { formatRatio } from "./comparison_options.js";
import { formatNumber, make } from "./format.js";
import { RunTable, numberColumn, wordColumn } from "./table.js";

export class PairTable extends RunTable {
  statusTitle() {
    return "B is";
  }

  allColumns() {
    const { words } = this.rows.columns.status;
    const percent = (name) => (row) => (this.rows.get(name, row) === null ? null : 100 * this.rows.get(name, row));
    const value = (name, format) => (row) => format(this.rows.get(name, row));
    const ratio = this.withInterval(value("ratio", formatRatio), "ratio_low", "ratio_high", formatRatio);
    const time = (side) => {
      const name = `time_${side}`;
      const shown = value(name, (ms) => formatNumber(ms, 4));
      const show = this.withInterval(shown, `${name}_low`, `${name}_high`);
      return numberColumn(name, `${side.toUpperCase()}, ms`, true, "Time", this.get(name), show);
    };
    const change = (row) => this.errorChange(row);
    const differs = this.rows.columns.differs.words.some(Boolean);
    return [
      ...this.caseColumns(),
      numberColumn("ratio", "B ÷ A", true, "Time", this.get("ratio"), ratio),
      time("a"),
      time("b"),
      numberColumn("adjusted_p_value", "p by Holm", false, "Time", this.get("adjusted_p_value")),
      numberColumn("l2_a", "L2 of A, %", true, "Error", percent("l2_a")),
      numberColumn("l2_b", "L2 of B, %", true, "Error", percent("l2_b")),
      numberColumn("error_change", "L2, B\u00a0−\u00a0A, %", true, "Error", percent("error_change"), change),
      wordColumn("differs", "Other in B", this.get("differs"), differs),
      this.detailColumn(words.some((word) => word.startsWith("now "))),
    ];
  }

  status(row) {
    const change = this.rows.get("status", row);
    return make(
      "span",
      { class: `change ${change.replaceAll(" ", "-")}` },
      make("span", { "aria-hidden": "true" }, this.report.signs[change]),
      ` ${change}`,
    );
  }

  errorChange(row) {
    const change = this.rows.get("error_change", row);
    if (change === null) return "–";
    if (change === 0) return "0";
    const words = `${change > 0 ? "▲ +" : "▼ −"}${formatNumber(100 * Math.abs(change))}`;
    // Of other points another error is to be expected.
    const expected = this.rows.get("differs", row).includes("points");
    return make("span", { class: expected ? "change" : `change ${change > 0 ? "error-larger" : "error-smaller"}` }, words);
  }
}
