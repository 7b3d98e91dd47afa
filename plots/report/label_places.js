// Where the names of dots fit: right of a dot, left, above or below, whichever is free first; nowhere if none is.

const LABEL_HEIGHT = 15;
const DOT = 9;

/**
 * The position of every dot's label. `dots` are {x, y, words} in pixels, `box` the drawing's {width, height}; a position
 * is "right", "left", "top", "bottom" or null.
 */
export function placeLabels(dots, box) {
  const taken = dots.map((dot) => ({ left: dot.x - DOT, right: dot.x + DOT, top: dot.y - DOT, bottom: dot.y + DOT }));
  return dots.map((dot, own) => {
    const width = 6.8 * dot.words.length;
    const rects = {
      right: { left: dot.x + DOT, right: dot.x + DOT + width, top: dot.y - LABEL_HEIGHT / 2, bottom: dot.y + LABEL_HEIGHT / 2 },
      left: { left: dot.x - DOT - width, right: dot.x - DOT, top: dot.y - LABEL_HEIGHT / 2, bottom: dot.y + LABEL_HEIGHT / 2 },
      top: { left: dot.x - width / 2, right: dot.x + width / 2, top: dot.y - DOT - LABEL_HEIGHT, bottom: dot.y - DOT },
      bottom: { left: dot.x - width / 2, right: dot.x + width / 2, top: dot.y + DOT, bottom: dot.y + DOT + LABEL_HEIGHT },
    };
    const inside = (rect) => rect.left >= 0 && rect.right <= box.width && rect.top >= 0 && rect.bottom <= box.height;
    const free = (rect) =>
      taken.every(
        (other, index) =>
          index === own ||
          rect.right <= other.left ||
          rect.left >= other.right ||
          rect.bottom <= other.top ||
          rect.top >= other.bottom,
      );
    const place = Object.keys(rects).find((name) => inside(rects[name]) && free(rects[name]));
    if (place) taken.push(rects[place]);
    return place ?? null;
  });
}
