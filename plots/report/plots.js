// Charts that are drawn anew when the window, the theme or paper wants it.
import { onTheme, printing } from "./theme.js";

/** Whoever extends it has `plots`, made by plot(), and draw(). */
export class Plots {
  /** A chart in the element; without a height it has the element's. */
  plot(id, element_id, height) {
    const element = document.getElementById(element_id);
    const chart = echarts.init(element, null, { renderer: "svg", height });
    new ResizeObserver(() => this.resized(chart, element)).observe(element);
    return { id, element, chart };
  }

  /** Draws after every change; on paper in the size of a sheet, as labels and dots are placed by the width. */
  follow(sheet) {
    const size = Object.fromEntries(Object.keys(sheet).map((side) => [side, "auto"]));
    onTheme(() => this.draw());
    addEventListener("beforeprint", () => this.resizeAll(sheet));
    addEventListener("afterprint", () => this.resizeAll(size));
  }

  resizeAll(size) {
    for (const { chart } of this.plots) chart.resize(size);
    this.draw();
  }

  /** An observer also calls once at the beginning, when nothing has changed. */
  resized(chart, element) {
    if (printing || (chart.getWidth() === element.clientWidth && chart.getHeight() === element.clientHeight)) return;
    chart.resize();
    this.draw();
  }
}
