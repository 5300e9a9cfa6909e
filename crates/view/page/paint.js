// Pixels on a canvas: marks, grid, samples, outlines, corners and numbers. A sheet is {g, x0, y0, x1, y1, unit, width, height}: what it shows, in
// pixels of the picture, and how large, in those of the screen.
import { clamp, make } from './dom.js';

/** The colours of the style sheet by their names, as the page around an element has them. */
export let colours = {};
const COLOURS = ['empty', 'grid', 'agrees', 'missing', 'extra', 'twice', 'overlap', 'same', 'edge', 'sample', 'cursor', 'glyph', 'sign', 'a', 'b', 'c', 'd'];
export function readColours(element) {
  const probe = element.appendChild(make('span'));
  const read = (name) => {
    probe.style.color = `var(--px-${name})`;
    return getComputedStyle(probe).color;
  };
  colours = Object.fromEntries(COLOURS.map((name) => [name, read(name)]));
  probe.remove();
  bits.clear();
}

/** What a pixel says without colour. */
export const GLYPHS = { agrees: '', missing: '\u2212', extra: '+', twice: '2', overlap: '*' };
const [AGREES, MISSING, EXTRA, , OVERLAP] = Object.entries(GLYPHS).map(([fill, glyph]) => ({ fill, glyph }));

/** What a pixel is by its hits and what they should be. */
export function judge(hits, right) {
  if (hits === 0 && right === 0) return null;
  if (hits < right) return hits ? { fill: 'missing', glyph: String(hits) } : MISSING;
  if (hits > right) return hits > 1 ? { fill: 'twice', glyph: String(hits) } : EXTRA;
  return hits === 1 ? AGREES : OVERLAP;
}

/** The smallest box of pixels around places with a margin, inside of another box. */
export function boxAround(places, margin, box) {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of places) {
    [x0, x1] = [Math.min(x0, x), Math.max(x1, x)];
    [y0, y1] = [Math.min(y0, y), Math.max(y1, y)];
  }
  const [left, top] = [clamp(Math.floor(x0) - margin, box[0], box[2] - 1), clamp(Math.floor(y0) - margin, box[1], box[3] - 1)];
  return [left, top, clamp(Math.ceil(x1) + margin, left + 1, box[2]), clamp(Math.ceil(y1) + margin, top + 1, box[3])];
}

/** A canvas at the size of the screen's own pixels, ready to be painted. */
export function contextOf(canvas, width, height) {
  const ratio = devicePixelRatio || 1;
  const [w, h] = [Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio))];
  if (canvas.width !== w || canvas.height !== h) Object.assign(canvas, { width: w, height: h });
  const g = canvas.getContext('2d');
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  return g;
}

export const placed = ({ x0, y0, unit }, [x, y]) => [(x - x0) * unit, (y - y0) * unit];
/** The columns and rows that are seen, also in part. */
const seenOf = ({ x0, y0, x1, y1 }) => [Math.floor(x0), Math.floor(y0), Math.ceil(x1), Math.ceil(y1)];

/** A colour as the 32 bits of a picture, by the browser's own reading of it. */
const bits = new Map();
let reader = null;
function bitsOf(colour) {
  let found = bits.get(colour);
  if (found === undefined) {
    if (bits.size > 50000) bits.clear();
    reader ??= make('canvas', { width: 1, height: 1 }).getContext('2d', { willReadFrequently: true });
    reader.fillStyle = colour;
    reader.fillRect(0, 0, 1, 1);
    found = new Uint32Array(reader.getImageData(0, 0, 1, 1).data.buffer)[0];
    bits.set(colour, found);
  }
  return found;
}

/** All pixels as one small picture, enlarged: a rectangle for each of them takes most of a frame. A mark is {fill, glyph, ring} or nothing. */
let small = null;
export function paintMarks(sheet, markAt) {
  const { unit } = sheet;
  const [left, top, right, bottom] = seenOf(sheet);
  const [width, height] = [right - left, bottom - top];
  const image = new ImageData(width, height);
  const data = new Uint32Array(image.data.buffer);
  const signs = [];
  let [before, seen] = [null, 0];
  for (let y = top; y < bottom; y += 1) {
    for (let x = left; x < right; x += 1) {
      const mark = markAt(x, y);
      if (!mark) continue;
      // Neighbours are mostly alike.
      if (mark !== before) [before, seen] = [mark, mark.fill ? bitsOf(colours[mark.fill] ?? mark.fill) : 0];
      data[(y - top) * width + x - left] = seen;
      // A wrong pixel that is smaller than one of the screen is still seen.
      const isLost = unit < 2 && ['missing', 'extra', 'twice'].includes(mark.fill);
      if (mark.ring || isLost || (mark.glyph && unit > 7)) signs.push([x, y, mark]);
    }
  }
  small ??= make('canvas').getContext('2d');
  Object.assign(small.canvas, { width, height });
  small.putImageData(image, 0, 0);
  paintImage(sheet, small.canvas, [left, top]);
  paintSigns(sheet, signs);
}

/** Glyphs and rings; where the sample has a dot, the glyph stands beside it. A font is set only where there are some: for that the browser styles the page. */
function paintSigns(sheet, signs) {
  if (signs.length === 0) return;
  const { g, unit } = sheet;
  const isAside = unit >= DOTS_FROM;
  const size = isAside ? Math.min(24, unit * 0.45) : unit * 0.75;
  g.font = `700 ${size}px system-ui, sans-serif`;
  g.textAlign = isAside ? 'left' : 'center';
  g.textBaseline = isAside ? 'top' : 'middle';
  g.strokeStyle = colours.sample;
  g.lineWidth = 1.5;
  for (const [x, y, { fill, glyph, ring }] of signs) {
    const [left, top] = placed(sheet, [x, y]);
    if (unit < 2) {
      g.fillStyle = colours[fill] ?? fill;
      g.fillRect(Math.round(left) - 1, Math.round(top) - 1, 2, 2);
      continue;
    }
    g.fillStyle = fill === 'missing' || fill === 'twice' ? colours.sign : colours.glyph;
    if (glyph && unit > 7) g.fillText(glyph, left + unit * (isAside ? 0.08 : 0.5) + 1, top + unit * (isAside ? 0.04 : 0.5) + 1);
    if (ring) {
      g.beginPath();
      g.arc(left + unit / 2, top + unit / 2, Math.min(9, unit * 0.25), 0, 7);
      g.stroke();
    }
  }
}

/** A picture whose first pixel is at a place, the first one unless another is given. */
export function paintImage(sheet, image, from = [0, 0]) {
  sheet.g.imageSmoothingEnabled = sheet.unit < 1;
  sheet.g.drawImage(image, ...placed(sheet, from), image.width * sheet.unit, image.height * sheet.unit);
}

export function paintGrid(sheet) {
  const { g, unit, width, height } = sheet;
  if (unit < 4) return;
  const [left, top, right, bottom] = seenOf(sheet);
  g.fillStyle = colours.grid;
  for (let x = left; x <= right; x += 1) g.fillRect(Math.round((x - sheet.x0) * unit), 0, 1, height);
  for (let y = top; y <= bottom; y += 1) g.fillRect(0, Math.round((y - sheet.y0) * unit), width, 1);
}

/** Smaller pixels have no room for a dot. */
const DOTS_FROM = 12;

/** A dot where each pixel is sampled, in its middle unless another place is given. */
export function paintSamples(sheet, [dx, dy] = [0.5, 0.5]) {
  const { g, unit } = sheet;
  if (unit < DOTS_FROM) return;
  const [left, top, right, bottom] = seenOf(sheet);
  const side = Math.min(5, Math.max(1.5, unit / 12));
  g.fillStyle = colours.sample;
  for (let y = top; y < bottom; y += 1) {
    for (let x = left; x < right; x += 1) {
      const [cx, cy] = placed(sheet, [x + dx, y + dy]);
      g.fillRect(cx - side / 2, cy - side / 2, side, side);
    }
  }
}

/** The part of a segment inside a rectangle a little larger than the sheet, or nothing. */
function clip([ax, ay], [bx, by], { width, height }) {
  let [from, to] = [0, 1];
  const [dx, dy] = [bx - ax, by - ay];
  for (const [p, q] of [[-dx, ax + 9], [dx, width + 9 - ax], [-dy, ay + 9], [dy, height + 9 - ay]]) {
    if (p === 0 && q < 0) return null;
    if (p < 0) from = Math.max(from, q / p);
    if (p > 0) to = Math.min(to, q / p);
  }
  return from > to ? null : [[ax + from * dx, ay + from * dy], [ax + to * dx, ay + to * dy]];
}

/** A closed outline; two points are a line. */
export function paintOutline(sheet, points, colour = colours.edge, thick = sheet.unit >= 8 ? 2 : 1) {
  const { g } = sheet;
  const places = points.map((point) => placed(sheet, point));
  g.strokeStyle = colour;
  g.lineWidth = thick;
  g.beginPath();
  const count = points.length === 2 ? 1 : points.length;
  for (let i = 0; i < count; i += 1) {
    const part = clip(places[i], places[(i + 1) % points.length], sheet);
    if (!part) continue;
    g.moveTo(...part[0]);
    g.lineTo(...part[1]);
  }
  g.stroke();
}

/** More corners would hide the picture. */
export const MOST_CORNERS = 8;

/** Corners, each {at, name, text}, with their words where these have room. */
export function paintCorners(sheet, corners) {
  const { g, unit, width, height } = sheet;
  if (unit < 8 || corners.length > MOST_CORNERS) return;
  g.font = '600 13px system-ui, sans-serif';
  g.textBaseline = 'middle';
  g.textAlign = 'left';
  const middle = [0, 1].map((axis) => corners.reduce((sum, { at }) => sum + at[axis], 0) / corners.length);
  const taken = [];
  for (const { at, name, text } of corners) {
    const [x, y] = placed(sheet, at);
    if (x < -8 || y < -8 || x > width + 8 || y > height + 8) continue;
    g.fillStyle = colours.edge;
    g.beginPath();
    g.arc(x, y, 4, 0, 7);
    g.fill();
    const place = freePlace(sheet, [x, y], [at[0] < middle[0], at[1] < middle[1]], [text, name], taken);
    if (!place) continue;
    taken.push(place.box);
    g.lineWidth = 4;
    g.lineJoin = 'round';
    g.strokeStyle = colours.empty;
    g.strokeText(place.text, place.box[0], place.box[1] + 8);
    g.fillStyle = colours.sample;
    g.fillText(place.text, place.box[0], place.box[1] + 8);
  }
}

/** Where a corner's words stand: outside the shape first, in short where there is no room, or nowhere. */
function freePlace({ g, width, height }, [x, y], [isLeft, isUp], texts, taken) {
  for (const text of texts.filter(Boolean)) {
    const wide = g.measureText(text).width;
    const sides = isLeft ? [x - 8 - wide, x + 8] : [x + 8, x - 8 - wide];
    const heights = isUp ? [y - 20, y + 4] : [y + 4, y - 20];
    for (const [tx, ty] of heights.flatMap((ty) => [...sides, x - wide / 2].map((tx) => [tx, ty]))) {
      const box = [tx, ty, tx + wide, ty + 16];
      const isIn = tx >= 2 && ty >= 0 && box[2] <= width - 2 && box[3] <= height;
      const isFree = taken.every((t) => box[0] >= t[2] + 4 || box[2] + 4 <= t[0] || box[1] >= t[3] || box[3] <= t[1]);
      if (isIn && isFree) return { text, box };
    }
  }
  return null;
}

/** A frame around a pixel, light and dark, so that it is seen on any colour. */
export function paintCursor(sheet, pixel) {
  const { g, unit } = sheet;
  const [x, y] = placed(sheet, pixel);
  const side = Math.max(unit, 3);
  g.lineWidth = 3;
  g.strokeStyle = colours.empty;
  g.strokeRect(x + 0.5, y + 0.5, side, side);
  g.lineWidth = 1.5;
  g.strokeStyle = colours.cursor;
  g.strokeRect(x - 0.5, y - 0.5, side + 2, side + 2);
}

/** Room for the numbers of columns. */
export const AXIS_HIGH = 18;
/** Room for the numbers of rows. */
export const axisWide = ([, y0, , y1]) => 10 + 7 * Math.max(2, String(y0).length, String(y1).length);

/** Numbers of columns above the pixels, of rows at their left, as many as have room. */
export function paintNumbers(sheet, above, beside) {
  const { unit, width, height } = sheet;
  const [left, top, right, bottom] = seenOf(sheet);
  const widest = Math.max(String(left).length, String(right).length);
  const step = (room) => [1, 2, 5].flatMap((m) => [0, 1, 2, 3, 4].map((e) => m * 10 ** e))
    .sort((p, q) => p - q).find((n) => n * unit >= room) ?? 1e5;
  const axes = [
    [above, left, right, sheet.x0, width, step(widest * 7 + 8)],
    [beside, top, bottom, sheet.y0, height, step(13)],
  ];
  axes.forEach(([canvas, first, last, start, length, every], axis) => {
    const [wide, high] = axis === 0 ? [length, AXIS_HIGH] : [parseFloat(canvas.style.width), length];
    const g = contextOf(canvas, wide, high);
    g.clearRect(0, 0, wide, high);
    g.font = '11px ui-monospace, monospace';
    g.fillStyle = colours.sample;
    g.textBaseline = 'middle';
    g.textAlign = axis === 0 ? 'center' : 'right';
    for (let i = first; i < last; i += 1) {
      const at = (i + 0.5 - start) * unit;
      if (i % every !== 0 || at < 4 || at > length - 4) continue;
      if (axis === 0) g.fillText(String(i), at, high - 7);
      else g.fillText(String(i), wide - 4, at);
    }
  });
}
