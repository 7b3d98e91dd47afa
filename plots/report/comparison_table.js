// The table of all runs that both have: the report's table with other columns.

class PairTable extends RunTable {
  allColumns() {
    const { rows, report } = this;
    const get = (name) => (row) => rows.get(name, row);
    const interval = (low, high) => (row) =>
      rows.get(low, row) === null ? "" : `[${formatNumber(rows.get(low, row))}, ${formatNumber(rows.get(high, row))}]`;
    const withInterval = (name, words) => (row) =>
      make("span", {}, formatNumber(rows.get(name, row), 4), make("small", {}, words(row)));
    const percent = (name) => (row) => (rows.get(name, row) === null ? null : 100 * rows.get(name, row));
    const columns = [
      wordColumn(
        "experiment",
        "Experiment",
        (row) => report.experiments[rows.get("experiment", row)].title,
        report.experiments.length > 1,
      ),
      wordColumn("method", "Method", (row) => this.labels.get(rows.get("entrant", row)).label),
      wordColumn("shape", "Shape", (row) => rows.shape(row)),
      numberColumn("n", "n", true, "Run", get("n"), (row) => formatCount(rows.get("n", row))),
      wordColumn("holes", "Holes", (row) => (rows.get("holes", row) ? "yes" : "no")),
      wordColumn("status", "B is", get("status")),
      numberColumn("ratio", "B ÷ A", true, "Time", get("ratio"), (row) => this.ratio(row)),
      numberColumn(
        "time_a",
        "A, ms",
        true,
        "Time",
        get("time_a"),
        withInterval("time_a", interval("time_a_low", "time_a_high")),
      ),
      numberColumn(
        "time_b",
        "B, ms",
        true,
        "Time",
        get("time_b"),
        withInterval("time_b", interval("time_b_low", "time_b_high")),
      ),
      numberColumn("adjusted_p_value", "p by Holm", false, "Time", get("adjusted_p_value")),
      numberColumn("l2_a", "L2 of A, %", true, "Error", percent("l2_a")),
      numberColumn("l2_b", "L2 of B, %", true, "Error", percent("l2_b")),
      numberColumn("error_change", "L2, B\u00a0−\u00a0A", true, "Error", percent("error_change"), (row) =>
        this.errorChange(row),
      ),
      wordColumn("differs", "Other in B", get("differs"), rows.columns.differs.words.some(Boolean)),
      wordColumn(
        "detail",
        "Why",
        get("detail"),
        rows.columns.status.words.some((word) => word.startsWith("now ")),
      ),
    ];
    columns.find((column) => column.id === "method").show = (row) => this.method(row);
    columns.find((column) => column.id === "status").show = (row) => this.change(row);
    columns.find((column) => column.id === "detail").show = (row) =>
      make("span", { class: "detail" }, rows.get("detail", row));
    return columns;
  }

  change(row) {
    const change = this.rows.get("status", row);
    return make(
      "span",
      { class: `change ${change.replaceAll(" ", "-")}` },
      make("span", { "aria-hidden": "true" }, this.report.signs[change]),
      ` ${change}`,
    );
  }

  ratio(row) {
    const { rows } = this;
    const low = rows.get("ratio_low", row);
    return make(
      "span",
      {},
      formatRatio(rows.get("ratio", row)),
      make("small", {}, low === null ? "" : `[${formatRatio(low)}, ${formatRatio(rows.get("ratio_high", row))}]`),
    );
  }

  errorChange(row) {
    const change = this.rows.get("error_change", row);
    if (change === null) return "–";
    if (change === 0) return "0";
    const words = `${change > 0 ? "▲ +" : "▼ −"}${formatNumber(100 * Math.abs(change))}`;
    // Of other points another error is to be expected.
    const expected = this.rows.get("differs", row).includes("points");
    return make(
      "span",
      { class: expected ? "change" : `change ${change > 0 ? "error-larger" : "error-smaller"}` },
      words,
    );
  }

  build(place) {
    super.build(place);
    document.getElementById("filter-status").parentElement.firstChild.textContent = "B is";
  }
}
