// Points, their hull and another ring on a canvas, and what part of the plane it shows.

const MARGIN = 24; // pixels round the points when all are shown

/** Least and greatest x and y. */
function bounds_of(xy) {
  const bounds = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };
  for (let i = 0; i < xy.length; i += 2) {
    bounds.x0 = Math.min(bounds.x0, xy[i]);
    bounds.x1 = Math.max(bounds.x1, xy[i]);
    bounds.y0 = Math.min(bounds.y0, xy[i + 1]);
    bounds.y1 = Math.max(bounds.y1, xy[i + 1]);
  }
  return bounds;
}

/** Red, green and blue of a colour of CSS, 0 to 255. */
function components(colour) {
  const context = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  context.fillStyle = colour;
  context.fillRect(0, 0, 1, 1);
  return context.getImageData(0, 0, 1, 1).data;
}

export class Picture {
  #canvas;
  #xy = new Float64Array();
  #hull = null;
  #ring = null;
  #view = { x: 0, y: 0, scale: 1 }; // the point in the middle, and pixels per unit
  #points_layer = document.createElement("canvas");
  #layer_is_current = false;
  #frame = 0;

  constructor(canvas) {
    this.#canvas = canvas;
    new ResizeObserver(() => this.#resize()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#redraw(false));
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => canvas.hasPointerCapture(event.pointerId) && this.#drag(event));
    canvas.addEventListener("keydown", (event) => {
      const moved = { ArrowLeft: [60, 0], ArrowRight: [-60, 0], ArrowUp: [0, 60], ArrowDown: [0, -60] }[event.key];
      if (!moved) return;
      event.preventDefault();
      this.#drag({ movementX: moved[0], movementY: moved[1] });
    });
  }

  show_points(xy) {
    this.#xy = xy;
    this.#hull = this.#ring = null;
    this.fit();
  }

  /** A hull of the points by indices, or null. */
  show_hull(hull) {
    this.#hull = hull;
    this.#redraw(true);
  }

  /** Indices of the points along another ring, or null. */
  show_ring(vertices) {
    this.#ring = vertices;
    this.#redraw(true);
  }

  fit() {
    const { x0, y0, x1, y1 } = bounds_of(this.#xy);
    const { clientWidth, clientHeight } = this.#canvas;
    if (!(x1 >= x0)) return this.#redraw(false);
    const room = (pixels, extent) => Math.max(pixels - 2 * MARGIN, 1) / (extent || 1);
    const scale = Math.min(room(clientWidth, x1 - x0), room(clientHeight, y1 - y0));
    this.#view = { x: (x0 + x1) / 2, y: (y0 + y1) / 2, scale };
    this.#redraw(false);
  }

  /** Enlarges by `factor` round a place in the canvas; round its middle where none is given. */
  zoom(factor, left = this.#canvas.clientWidth / 2, top = this.#canvas.clientHeight / 2) {
    const [right, up] = [left - this.#canvas.clientWidth / 2, this.#canvas.clientHeight / 2 - top];
    const { x, y, scale } = this.#view;
    const kept = (1 - 1 / factor) / scale;
    this.#view = { x: x + right * kept, y: y + up * kept, scale: scale * factor };
    this.#redraw(false);
  }

  #wheel(event) {
    if (!event.ctrlKey && !event.metaKey) return; // the page scrolls
    event.preventDefault();
    this.zoom(2 ** (-event.deltaY / 200), event.offsetX, event.offsetY);
  }

  #drag(event) {
    this.#view.x -= event.movementX / this.#view.scale;
    this.#view.y += event.movementY / this.#view.scale;
    this.#redraw(false);
  }

  #resize() {
    const { clientWidth, clientHeight } = this.#canvas;
    const ratio = devicePixelRatio || 1;
    if (this.#canvas.width === Math.round(clientWidth * ratio) && this.#canvas.height === Math.round(clientHeight * ratio))
      return;
    for (const canvas of [this.#canvas, this.#points_layer]) {
      canvas.width = Math.round(clientWidth * ratio);
      canvas.height = Math.round(clientHeight * ratio);
    }
    this.fit();
  }

  #redraw(points_stay) {
    this.#layer_is_current &&= points_stay;
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.#draw();
    });
  }

  #draw() {
    const { width, height } = this.#canvas;
    if (!width || !height) return; // not laid out: it is drawn when it is
    const context = this.#canvas.getContext("2d");
    const colours = getComputedStyle(this.#canvas);
    const colour = (name) => colours.getPropertyValue(name).trim();
    context.clearRect(0, 0, width, height);
    const { left, top, scale } = this.#transform();
    const outline = (begin, end, vertices) => {
      for (let i = begin; i < end; i++) {
        const [x, y] = [left + this.#xy[2 * vertices[i]] * scale, top - this.#xy[2 * vertices[i] + 1] * scale];
        if (i === begin) context.moveTo(x, y);
        else context.lineTo(x, y);
      }
      context.closePath();
    };
    const rings = () => {
      context.beginPath();
      let begin = 0;
      for (const end of this.#hull.ringEnds) (outline(begin, end, this.#hull.vertices), (begin = end));
    };
    context.lineJoin = "round";
    const pixel = devicePixelRatio || 1;
    if (this.#hull) {
      rings();
      context.fillStyle = colour("--hull-fill");
      context.fill("evenodd");
    }
    if (!this.#layer_is_current) this.#draw_points(colour("--point"));
    context.drawImage(this.#points_layer, 0, 0);
    if (this.#hull) {
      rings();
      context.strokeStyle = colour("--hull");
      context.lineWidth = 2 * pixel;
      context.stroke();
    }
    if (this.#ring) {
      context.beginPath();
      outline(0, this.#ring.length, this.#ring);
      context.setLineDash([7 * pixel, 4 * pixel]);
      context.strokeStyle = colour("--rival");
      context.stroke();
      context.setLineDash([]);
    }
  }

  /** Pixel = left + x * scale, top - y * scale. */
  #transform() {
    const scale = this.#view.scale * (devicePixelRatio || 1);
    return { left: this.#canvas.width / 2 - this.#view.x * scale, top: this.#canvas.height / 2 + this.#view.y * scale, scale };
  }

  /** Each point as one dot; where many share one, it is darker. */
  #draw_points(colour) {
    const { width, height } = this.#points_layer;
    const context = this.#points_layer.getContext("2d");
    this.#layer_is_current = true;
    context.clearRect(0, 0, width, height);
    const { left, top, scale } = this.#transform();
    const x_of = (i) => Math.floor(left + this.#xy[2 * i] * scale);
    const y_of = (i) => Math.floor(top - this.#xy[2 * i + 1] * scale);
    const count = this.#xy.length / 2;
    let shown = 0;
    for (let i = 0; i < count; i++) shown += x_of(i) >= 0 && x_of(i) < width && y_of(i) >= 0 && y_of(i) < height;
    // Few points are drawn larger: as large as leaves room between them.
    const room = Math.sqrt((width * height) / Math.max(shown, 1) / 40);
    const side = Math.round(Math.min(3, Math.max(1, room)) * (devicePixelRatio || 1));
    const hits = new Uint16Array(width * height);
    for (let i = 0; i < count; i++) {
      const [x, y] = [x_of(i) - (side >> 1), y_of(i) - (side >> 1)];
      if (x < 0 || y < 0 || x + side > width || y + side > height) continue;
      for (let row = y; row < y + side; row++) {
        for (let column = x; column < x + side; column++) hits[row * width + column]++;
      }
    }
    const [red, green, blue] = components(colour);
    const image = context.createImageData(width, height);
    for (let i = 0; i < hits.length; i++) {
      if (hits[i] === 0) continue;
      image.data.set([red, green, blue, 170 * (1 - 0.4 ** Math.min(hits[i], 8))], 4 * i);
    }
    context.putImageData(image, 0, 0);
  }
}
