// What a page shows: cases of the harness and rendered pictures, in columns and rows of the window they have.
import { make } from './dom.js';
import { fixedPoint, judgeLinePixel, judgeSample } from './exact.js';
import { boxAround } from './paint.js';

const unpack = (runs, size) => {
  const hits = new Uint8Array(size);
  let at = 0;
  for (let i = 0; i < runs.length; i += 2) {
    hits.fill(runs[i + 1], at, at + runs[i]);
    at += runs[i];
  }
  return hits;
};

export const caseItem = (view) => {
  const { x0, y0, x1, y1 } = view.window;
  const layers = view.layers.map((layer) => ({
    ...layer,
    label: layer.names.length > 1 ? `${layer.names[0]} and ${layer.names.length - 1} alike` : layer.names[0],
    everybody: layer.names.join(', '),
    hits: layer.refused ? null : unpack(layer.runs, (x1 - x0) * (y1 - y0)),
    wrong: layer.tally.missing + layer.tally.extra + layer.tally.twice,
  }));
  const oracle = layers.findIndex((layer) => ['oracle', 'expected'].includes(layer.role));
  const exact = view.shape.kind === 'lines' ? null : fixedPoint(view.shape);
  return { ...view, isCase: true, box: [x0, y0, x1, y1], layers, oracle, exact };
};

export const pictureItem = (view) => ({
  ...view,
  kind: 'picture',
  found: '',
  box: [0, 0, 1, 1],
  oracle: -1,
  start: [0, Math.min(1, view.layers.length - 1)],
  layers: view.layers.map((layer) => ({ ...layer, label: layer.name, everybody: layer.name, names: [layer.name] })),
});

/** Decodes the pictures of an item; their pixels are then at hand. */
export async function load(item) {
  if (item.isCase || item.isLoaded) return;
  await Promise.all(item.layers.map(async (layer) => {
    const image = new Image();
    image.src = layer.png;
    await image.decode();
    const canvas = make('canvas', { width: image.naturalWidth, height: image.naturalHeight });
    const context = canvas.getContext('2d', { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    layer.canvas = canvas;
    layer.pixels = context.getImageData(0, 0, canvas.width, canvas.height);
  }));
  item.box = [0, 0, ...['width', 'height'].map((side) => Math.max(...item.layers.map((layer) => layer.pixels[side])))];
  item.isLoaded = true;
}

/** The colour of a picture's pixel as red * 2^16 + green * 2^8 + blue, -1 outside. */
export const colourOf = (layer, x, y) => {
  const { width, height, data } = layer.pixels;
  if (x < 0 || y < 0 || x >= width || y >= height) return -1;
  const at = 4 * (y * width + x);
  return (data[at] << 16) | (data[at + 1] << 8) | data[at + 2];
};
export const hex = (colour) => (colour < 0 ? 'outside' : `#${colour.toString(16).padStart(6, '0')}`);

const placeIn = ([x0, y0, x1, y1], x, y) => (x < x0 || y < y0 || x >= x1 || y >= y1 ? -1 : (y - y0) * (x1 - x0) + x - x0);
export const hitsOf = (item, layer, x, y) => layer.hits?.[placeIn(item.box, x, y)] ?? 0;

/** The run of hit pixels around a column of a row. */
export const spanOf = (item, layer, x, y) => {
  if (hitsOf(item, layer, x, y) === 0) return '';
  let [from, to] = [x, x + 1];
  while (hitsOf(item, layer, from - 1, y) > 0) from -= 1;
  while (hitsOf(item, layer, to, y) > 0) to += 1;
  return `${from} to ${to - 1} (${to - from} px)`;
};

/** Whether two layers differ in a pixel. */
export const differIn = (item, a, b) => (item.isCase
  ? (x, y) => hitsOf(item, a, x, y) !== hitsOf(item, b, x, y)
  : (x, y) => colourOf(a, x, y) !== colourOf(b, x, y));

/** The pixels of an item that a test picks, row by row. */
export const pixelsWhere = ({ box: [x0, y0, x1, y1] }, picks) => {
  const found = [];
  for (let y = y0; y < y1; y += 1) for (let x = x0; x < x1; x += 1) if (picks(x, y)) found.push([x, y]);
  return found;
};

/** Work that is done without being asked for. */
const CHEAP = 30000;
/** Hits and ties by the rule, computed here for every pixel: what the oracle must say too. */
export const byRule = (item, most = Infinity) => {
  const [x0, y0, x1, y1] = item.box;
  const size = (x1 - x0) * (y1 - y0);
  if (!item.isCase || size * item.shape.points.length > most) return null;
  if (item.rule) return item.rule;
  const [hits, ties] = [new Uint8Array(size), new Uint8Array(size)];
  for (let at = 0; at < size; at += 1) {
    const [x, y] = [x0 + (at % (x1 - x0)), y0 + Math.floor(at / (x1 - x0))];
    const judged = item.exact
      ? item.exact.triangles.map((triangle) => judgeSample(triangle, item.exact.bits, x, y))
      : item.shape.points.map((line) => judgeLinePixel(line, x, y));
    hits[at] = Math.min(255, judged.filter((j) => j.isIn || j.isOn).length);
    ties[at] = judged.filter((j) => j.isTie).length;
  }
  item.rule = { hits, ties };
  return item.rule;
};
export const cheapRule = (item) => byRule(item, CHEAP);
export const isTie = (item, x, y) => cheapRule(item)?.ties[placeIn(item.box, x, y)] > 0;

export const outlines = ({ shape: { kind, points } }) => {
  const scale = kind === 'triangles' ? 256 : 1;
  const shift = kind === 'lines' ? 0.5 : 0;
  return points.map((shape) => shape.map((point) => point.map((value) => value / scale + shift)));
};

/** A number of 256ths: in decimal where that is short, else as a fraction. */
const subpixels = (value) => {
  if (value % 32 === 0) return String(value / 256);
  const whole = Math.floor(value / 256);
  const rest = `${value - 256 * whole}/256`;
  return whole === 0 ? rest : `${whole}+${rest}`;
};

/** The corners with their names, each place once. */
export const corners = (item) => {
  const { kind, points } = item.shape;
  const number = { triangles: subpixels, lines: String, free: (v) => String(Number(v.toPrecision(6))) }[kind];
  const seen = new Map();
  const places = outlines(item);
  points.forEach((shape, i) => shape.forEach((point, k) => {
    const name = points.length === 1 ? `${kind === 'lines' ? 'p' : 'v'}${k}` : '';
    const text = `${name} (${point.map(number).join(', ')})`.trim();
    if (!seen.has(point.join())) seen.set(point.join(), { at: places[i][k], name, text });
  }));
  return [...seen.values()];
};

// ---- What matters of a window ----

/** Larger ones are cropped to the pixels in question. */
const MOST_CROPPED_PX = 48;

/** The part that is shown at first: around the shape and what is hit; of a large one, what differs. */
export const cropOf = (item, a, b) => {
  if (!item.isCase) return item.box;
  const layers = [...new Set([a, b, item.oracle])].map((i) => item.layers[i]);
  const squares = (picks) => pixelsWhere(item, picks).flatMap(([x, y]) => [[x, y], [x + 1, y + 1]]);
  const hit = squares((x, y) => layers.some((layer) => hitsOf(item, layer, x, y) > 0));
  const shape = boxAround([...outlines(item).flat(), ...hit], 1, item.box);
  if (shape[2] - shape[0] <= MOST_CROPPED_PX && shape[3] - shape[1] <= MOST_CROPPED_PX) return shape;
  const differs = squares((x, y) => layers.some((layer) => differIn(item, layer, layers[0])(x, y)));
  if (differs.length > 0) return boxAround(differs, 4, item.box);
  return hit.length > 0 ? boxAround(hit, 1, item.box) : shape;
};
