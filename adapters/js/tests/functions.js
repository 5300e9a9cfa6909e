// Functions that are right and wrong, for the tests here and for those of other languages.

export const edge = (p, q, x, y) => (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);

/** A function that counts a pixel where all three edges say so. */
const filled = (keeps) => function filled([a, b, c], [width, height]) {
  const mask = new Uint8Array(width * height);
  if (edge(a, b, ...c) < 0) [b, c] = [c, b];
  const edges = [[a, b], [b, c], [c, a]];
  for (let y = 0, i = 0; y < height; y++)
    for (let x = 0; x < width; x++, i++)
      mask[i] = edge(a, b, ...c) !== 0 && edges.every(([p, q]) => keeps(edge(p, q, x + 0.5, y + 0.5), q[0] - p[0], q[1] - p[1]));
  return mask;
};
export const exact = filled((e, dx, dy) => e > 0 || (e === 0 && (dy < 0 || (dy === 0 && dx > 0))));
export const strict = filled((e) => e > 0);

export const spans = (corners, window) => {
  const mask = exact(corners, window), list = [];
  for (let y = 0; y < window[1]; y++) {
    const row = mask.subarray(y * window[0], (y + 1) * window[0]);
    if (row.includes(1)) list.push([y, row.indexOf(1), row.lastIndexOf(1) + 1]);
  }
  return list;
};

export const values = (flat) => function values(corners, [width, height]) {
  const mask = exact(corners, [width, height]), values = new Float64Array(3 * mask.length);
  const [p, q, r] = corners;
  for (let i = 0; i < mask.length; i++) {
    const x = (i % width) + 0.5, y = Math.floor(i / width) + 0.5;
    const parts = [edge(q, r, x, y), edge(r, p, x, y), edge(p, q, x, y)], sum = parts[0] + parts[1] + parts[2];
    const blend = (of) => parts.reduce((all, part, corner) => all + (part / sum) * of(corners[corner]), 0);
    const w = (v) => (flat ? 1 : v[3]), inverse = blend((v) => 1 / w(v));
    values.set([blend((v) => v[2]), blend((v) => v[4] / w(v)) / inverse, blend((v) => v[5] / w(v)) / inverse], 3 * i);
  }
  return { mask, values };
};

/** Without so many pixels at the end; a tie comes to the same pixel from either end. */
export const line = (missing) => function dda([[x0, y0], [x1, y1]], [width, height]) {
  const [dx, dy] = [x1 - x0, y1 - y0], n = Math.max(Math.abs(dx), Math.abs(dy)), list = [];
  const tie = n - ((Math.abs(dx) === n ? dx : dy) < 0);
  const at = (i, d) => Math.floor((2 * i * Math.abs(d) + tie) / (2 * n || 1)) * Math.sign(d);
  for (let i = 0; i <= n - missing; i++) {
    const [x, y] = [x0 + at(i, dx), y0 + at(i, dy)];
    if (x >= 0 && y >= 0 && x < width && y < height) list.push([x, y]);
  }
  return list;
};

/** Right where there is one contour, and it is convex. */
export const fan = ([outer, ...holes]) => (holes.length ? null : outer.slice(2).map((c, i) => [outer[0], outer[i + 1], c]));
