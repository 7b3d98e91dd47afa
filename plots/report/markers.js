// The markers of methods.json, as paths in a box of 20 by 20.

/** A regular polygon of `count` corners round the box's middle, the first at `turn` degrees from the top. */
function polygonPath(count, turn = 0, radius = 10) {
  const corners = Array.from({ length: count }, (_, corner) => {
    const angle = ((corner * 360) / count + turn) * (Math.PI / 180);
    return `${(10 + radius * Math.sin(angle)).toFixed(2)} ${(10 - radius * Math.cos(angle)).toFixed(2)}`;
  });
  return `M${corners.join("L")}Z`;
}

/** A star of `count` points, whose inner corners are `inner` from the middle. */
function starPath(count = 5, inner = 4.5) {
  const corners = Array.from({ length: 2 * count }, (_, corner) => {
    const angle = ((corner * 180) / count) * (Math.PI / 180);
    const radius = corner % 2 ? inner : 11;
    return `${(10 + radius * Math.sin(angle)).toFixed(2)} ${(10 - radius * Math.cos(angle)).toFixed(2)}`;
  });
  return `M${corners.join("L")}Z`;
}

const PLUS = "M7 0H13V7H20V13H13V20H7V13H0V7H7Z";
const CROSS = "M4 0L10 6L16 0L20 4L14 10L20 16L16 20L10 14L4 20L0 16L6 10L0 4Z";

const MARKERS = {
  circle: "M10 1A9 9 0 1 1 9.99 1Z",
  square: "M2 2H18V18H2Z",
  triangle: polygonPath(3),
  "triangle-down": polygonPath(3, 180),
  "triangle-left": polygonPath(3, 270),
  "triangle-right": polygonPath(3, 90),
  diamond: polygonPath(4),
  "thin-diamond": "M10 0L16 10L10 20L4 10Z",
  pentagon: polygonPath(5),
  hexagon: polygonPath(6),
  octagon: polygonPath(8, 22.5),
  star: starPath(),
  "star-four": starPath(4, 4),
  "star-three": starPath(3, 3.5),
  "star-six": starPath(6, 5.5),
  "hexagon-flat": polygonPath(6, 30),
  plus: PLUS,
  cross: CROSS,
  bar: "M0 7H20V13H0Z",
};

/** A marker's path; a circle for a name that is not known. */
export function markerPath(name) {
  return MARKERS[name] ?? MARKERS.circle;
}

/** A marker as a small picture in the text's colour. */
export function markerPicture(name) {
  const space = "http://www.w3.org/2000/svg";
  const picture = document.createElementNS(space, "svg");
  picture.setAttribute("viewBox", "-1 -1 22 22");
  picture.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(space, "path");
  path.setAttribute("d", markerPath(name));
  picture.append(path);
  return picture;
}
