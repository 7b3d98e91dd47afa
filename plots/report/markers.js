// The markers of methods.json, as paths in a box of 20 by 20.

/** A star of `count` points round the box's middle, the first at `turn` degrees from the top, whose inner corners are `inner`
    from the middle; without these a regular polygon. */
function starPath(count, turn = 0, inner = 0) {
  const radii = inner ? [11, inner] : [10];
  const corners = Array.from({ length: radii.length * count }, (_, corner) => {
    const angle = ((corner * 360) / (radii.length * count) + turn) * (Math.PI / 180);
    const radius = radii[corner % radii.length];
    return `${(10 + radius * Math.sin(angle)).toFixed(2)} ${(10 - radius * Math.cos(angle)).toFixed(2)}`;
  });
  return `M${corners.join("L")}Z`;
}

const MARKERS = {
  circle: "M10 1A9 9 0 1 1 9.99 1Z",
  square: "M2 2H18V18H2Z",
  triangle: starPath(3),
  "triangle-down": starPath(3, 180),
  "triangle-left": starPath(3, 270),
  "triangle-right": starPath(3, 90),
  diamond: starPath(4),
  "thin-diamond": "M10 0L16 10L10 20L4 10Z",
  pentagon: starPath(5),
  hexagon: starPath(6),
  octagon: starPath(8, 22.5),
  star: starPath(5, 0, 4.5),
  "star-four": starPath(4, 0, 4),
  "star-three": starPath(3, 0, 3.5),
  "star-six": starPath(6, 0, 5.5),
  "hexagon-flat": starPath(6, 30),
  plus: "M7 0H13V7H20V13H13V20H7V13H0V7H7Z",
  cross: "M4 0L10 6L16 0L20 4L14 10L20 16L16 20L10 14L4 20L0 16L6 10L0 4Z",
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
