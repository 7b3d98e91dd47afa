// How wide a label is, and where the names of dots fit: right of a dot, left, above or below, whichever is free first;
// nowhere if none is.

export const LABEL_SIZE = 12;
const LABEL_HEIGHT = 15;
const DOT = 9;

/** The width of a label in pixels. */
export function textWidth(words, bold) {
  textWidth.pen ??= document.createElement("canvas").getContext("2d");
  textWidth.pen.font = `${bold ? "600 " : ""}${LABEL_SIZE}px ${getComputedStyle(document.body).fontFamily}`;
  return textWidth.pen.measureText(words).width;
}

/**
 * The position of every dot's label. `dots` are {x, y, words} in pixels, `box` the drawing's {width, height}; a position
 * is "right", "left", "top", "bottom" or null.
 */
export function placeLabels(dots, box) {
  const around = ({ x, y }, wide, high) => ({ left: x - wide, right: x + wide, top: y - high, bottom: y + high });
  const taken = dots.map((dot) => around(dot, DOT, DOT));
  return dots.map((dot, own) => {
    const [wide, high] = [textWidth(dot.words, false) / 2, LABEL_HEIGHT / 2];
    const moved = (right, down) => around({ x: dot.x + right * (DOT + wide), y: dot.y + down * (DOT + high) }, wide, high);
    const rects = { right: moved(1, 0), left: moved(-1, 0), top: moved(0, -1), bottom: moved(0, 1) };
    const inside = (rect) => rect.left >= 0 && rect.right <= box.width && rect.top >= 0 && rect.bottom <= box.height;
    const apart = (a, b) => a.right <= b.left || a.left >= b.right || a.bottom <= b.top || a.top >= b.bottom;
    const free = (rect) => taken.every((other, index) => index === own || apart(rect, other));
    const place = Object.keys(rects).find((name) => inside(rects[name]) && free(rects[name]));
    if (place) taken.push(rects[place]);
    return place ?? null;
  });
}
