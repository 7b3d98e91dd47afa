// Points to try the page with: a land with a lake, an island in it, and two more off the coast.

/** `count` points, uniform on the land, the same ones each time. */
export function example(count) {
  let state = 7;
  const next = () => (state = (state * 48271) % 2147483647) / 2147483647;
  const xy = new Float64Array(2 * count);
  for (let i = 0; i < count;) {
    const [x, y] = [3.6 * next() - 1.6, 2.8 * next() - 1.4];
    if (!is_land(x, y)) continue;
    xy[2 * i] = 500 + 100 * x;
    xy[2 * i++ + 1] = 300 + 100 * y;
  }
  return xy;
}

function is_land(x, y) {
  const within = (x0, y0, radius, waves) => {
    const angle = Math.atan2(y - y0, x - x0);
    return Math.hypot(x - x0, y - y0) < radius * (1 + waves * Math.sin(3 * angle + 1) + waves * 0.6 * Math.sin(7 * angle));
  };
  const lake = within(-0.3, 0.05, 0.42, 0.14) && !within(-0.35, 0.1, 0.17, 0.1);
  return (within(-0.3, 0, 1, 0.17) && !lake) || within(1.25, 0.75, 0.3, 0.2) || within(1.45, -0.45, 0.42, 0.16);
}
