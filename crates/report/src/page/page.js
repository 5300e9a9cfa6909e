// The pixel view of the report page: reads the JSON of the page, draws on canvases, loads nothing.
//
// Edge functions are computed here from the corners in BigInt, so they are exact; positions that are
// doubles are taken apart into mantissa and exponent first.
'use strict';
(() => {
  const $ = (selector, root = document) => root.querySelector(selector);
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  /** An element with properties and children; text is set as text, never as HTML. */
  const el = (tag, properties = {}, ...children) => {
    const node = document.createElement(tag);
    for (const [key, value] of Object.entries(properties)) {
      if (key in node) node[key] = value;
      else node.setAttribute(key, value);
    }
    node.append(...children);
    return node;
  };
  const plural = (n, one, many = `${one}s`) => `${n} ${n === 1 ? one : many}`;

  // ---- Exact geometry ----

  /** A double as [m, e] with value m * 2^e, m odd or zero. */
  const takeApart = (value) => {
    const bytes = new DataView(new ArrayBuffer(8));
    bytes.setFloat64(0, value);
    const bits = bytes.getBigUint64(0);
    const field = Number((bits >> 52n) & 0x7ffn);
    let m = bits & 0xfffffffffffffn;
    if (field > 0) m |= 1n << 52n;
    let e = field > 0 ? field - 1075 : -1074;
    if (m === 0n) return [0n, 0];
    while ((m & 1n) === 0n) { m >>= 1n; e += 1; }
    return [bits >> 63n ? -m : m, e];
  };

  /** Corners as whole numbers of 2^-bits px. */
  const fixedPoint = (shape) => {
    if (shape.kind === 'triangles') {
      return { bits: 8, triangles: shape.points.map((t) => t.map((p) => p.map(BigInt))) };
    }
    const parts = shape.points.map((t) => t.map((p) => p.map(takeApart)));
    const bits = Math.max(1, ...parts.flat(2).map(([, e]) => -e));
    const fixed = ([m, e]) => m << BigInt(e + bits);
    return { bits, triangles: parts.map((t) => t.map((p) => p.map(fixed))) };
  };

  const kindOfEdge = (dx, dy) => {
    if (dy < 0n) return 'left';
    if (dy > 0n) return 'right';
    return dx > 0n ? 'top' : dx < 0n ? 'bottom' : 'a point';
  };

  /** The edge functions of a triangle at the centre of a pixel, positive inside. */
  const judgeSample = (triangle, bits, x, y) => {
    const centre = (px) => ((2n * BigInt(px) + 1n) << BigInt(bits)) >> 1n;
    const [px, py] = [centre(x), centre(y)];
    const cross = (a, b, qx, qy) => (b[0] - a[0]) * (qy - a[1]) - (b[1] - a[1]) * (qx - a[0]);
    const area = cross(triangle[0], triangle[1], triangle[2][0], triangle[2][1]);
    const sign = area < 0n ? -1n : 1n;
    const edges = [0, 1, 2].map((i) => {
      const j = (i + 1) % 3;
      const [a, b] = [triangle[i], triangle[j]];
      const kind = kindOfEdge(sign * (b[0] - a[0]), sign * (b[1] - a[1]));
      return {
        name: sign > 0n ? `v${i} \u2192 v${j}` : `v${j} \u2192 v${i}`,
        value: sign * cross(a, b, px, py),
        kind,
        isTopLeft: kind === 'left' || kind === 'top',
      };
    });
    const flat = area === 0n;
    const isTie = !flat && edges.some((e) => e.value === 0n) && edges.every((e) => e.value >= 0n);
    const isIn = !flat && edges.every((e) => e.value > 0n || (e.value === 0n && e.isTopLeft));
    return { edges, isTie, isIn, flat };
  };

  /** Where a line's ideal height lies beside a pixel of it, in exact fractions. */
  const judgeLinePixel = ([from, to], x, y) => {
    const [a, b] = [from, to].map((p) => p.map(BigInt));
    const size = (v) => (v < 0n ? -v : v);
    const major = size(b[0] - a[0]) >= size(b[1] - a[1]) ? 0 : 1;
    const [first, last] = a[major] <= b[major] ? [a, b] : [b, a];
    const pixel = [BigInt(x), BigInt(y)];
    const length = last[major] - first[major];
    const rise = last[1 - major] - first[1 - major];
    const step = pixel[major] - first[major];
    const axes = { major: 'xy'[major], minor: 'xy'[1 - major] };
    if (step < 0n || step > length) return { ...axes, isOn: false, beyond: true };
    if (length === 0n) return { ...axes, isOn: pixel[1 - major] === first[1 - major], length };
    // Twice the distance from the ideal height, in 1/length.
    const twice = 2n * ((pixel[1 - major] - first[1 - major]) * length - step * rise);
    const forward = rise < 0n ? -twice : twice;
    const isTie = size(twice) === length;
    const isOn = size(twice) < length || (isTie && forward > 0n);
    return { ...axes, isOn, isTie, twice, length, step, rise, first };
  };

  /** A BigInt times 2^-bits in decimal, rounded to four digits where it is long. */
  const decimal = (value, bits) => {
    if (value === 0n) return '0';
    const size = value < 0n ? -value : value;
    const length = size.toString(2).length;
    const lead = Number(length > 60 ? size >> BigInt(length - 60) : size);
    const log = Math.log10(lead) + (Math.max(0, length - 60) - bits) * Math.log10(2);
    let exponent = Math.floor(log);
    let lead10 = 10 ** (log - exponent);
    if (lead10 >= 9.9995) { lead10 = 1; exponent += 1; }
    const sign = value < 0n ? '\u2212' : '';
    if (exponent >= -3 && exponent < 7) return sign + String(Number((10 ** log).toPrecision(4)));
    return `${sign}${lead10.toFixed(3)}e${exponent}`;
  };

  // ---- Items: cases of the harness and rendered pictures ----

  const unpack = (runs, size) => {
    const hits = new Uint8Array(size);
    let at = 0;
    for (let i = 0; i < runs.length; i += 2) {
      hits.fill(runs[i + 1], at, at + runs[i]);
      at += runs[i];
    }
    return hits;
  };

  const caseItem = (view) => {
    const { x0, y0, x1, y1 } = view.window;
    const [width, height] = [x1 - x0, y1 - y0];
    const layers = view.layers.map((layer) => ({
      ...layer,
      label: layer.names.length > 1 ? `${layer.names[0]} and ${layer.names.length - 1} alike` : layer.names[0],
      everybody: layer.names.join(', '),
      hits: layer.refused ? null : unpack(layer.runs, width * height),
      wrong: layer.tally.missing + layer.tally.extra + layer.tally.twice,
    }));
    const oracle = layers.findIndex((layer) => ['oracle', 'expected'].includes(layer.role));
    const exact = view.shape.kind === 'lines' ? null : fixedPoint(view.shape);
    return { ...view, isCase: true, x0, y0, width, height, layers, oracle, exact };
  };

  const pictureItem = (view) => ({
    ...view,
    kind: 'picture',
    found: '',
    x0: 0,
    y0: 0,
    width: 1,
    height: 1,
    oracle: -1,
    start: [0, Math.min(1, view.layers.length - 1)],
    layers: view.layers.map((layer) => ({
      ...layer, label: layer.name, everybody: layer.name, names: [layer.name],
    })),
  });

  /** Decodes the pictures of an item; their pixels are then at hand. */
  const load = async (item) => {
    if (item.isCase || item.isLoaded) return;
    await Promise.all(item.layers.map(async (layer) => {
      const image = new Image();
      image.src = layer.png;
      await image.decode();
      const canvas = el('canvas', { width: image.naturalWidth, height: image.naturalHeight });
      const context = canvas.getContext('2d', { willReadFrequently: true });
      context.drawImage(image, 0, 0);
      layer.canvas = canvas;
      layer.pixels = context.getImageData(0, 0, canvas.width, canvas.height);
    }));
    item.width = Math.max(...item.layers.map((layer) => layer.pixels.width));
    item.height = Math.max(...item.layers.map((layer) => layer.pixels.height));
    item.isLoaded = true;
  };

  /** The colour of a picture's pixel as red * 2^16 + green * 2^8 + blue, -1 outside. */
  const colourOf = (layer, x, y) => {
    const { width, height, data } = layer.pixels;
    if (x >= width || y >= height) return -1;
    const at = 4 * (y * width + x);
    return (data[at] << 16) | (data[at + 1] << 8) | data[at + 2];
  };

  const hitsOf = (item, layer, x, y) => (layer.hits ? layer.hits[y * item.width + x] : 0);

  /** Pixels in which two layers differ. */
  const countDifferent = (item, a, b) => {
    let n = 0;
    for (let y = 0; y < item.height; y += 1) {
      for (let x = 0; x < item.width; x += 1) {
        if (item.isCase ? hitsOf(item, a, x, y) !== hitsOf(item, b, x, y)
          : colourOf(a, x, y) !== colourOf(b, x, y)) n += 1;
      }
    }
    return n;
  };

  /** Hits and ties by the rule, computed here for every pixel: what the oracle must say too. */
  const byRule = (item) => {
    const hits = new Uint8Array(item.width * item.height);
    const ties = new Uint8Array(item.width * item.height);
    for (let y = 0; y < item.height; y += 1) {
      for (let x = 0; x < item.width; x += 1) {
        const at = y * item.width + x;
        const [px, py] = [item.x0 + x, item.y0 + y];
        const judged = item.exact
          ? item.exact.triangles.map((t) => judgeSample(t, item.exact.bits, px, py))
          : item.shape.points.map((line) => judgeLinePixel(line, px, py));
        hits[at] = Math.min(255, judged.filter((j) => j.isIn || j.isOn).length);
        ties[at] = judged.filter((j) => j.isTie).length;
      }
    }
    return { hits, ties };
  };
  /** Work that is done without being asked for. */
  const CHEAP = 30000;
  const rule = (item) => {
    if (!item.isCase || item.width * item.height * item.shape.points.length > CHEAP) return null;
    item.rule ??= byRule(item);
    return item.rule;
  };

  const data = JSON.parse($('#data').textContent);
  const items = [...data.cases.map(caseItem), ...data.frames.map(pictureItem)];

  // ---- State ----

  const MODES = [['blink', 'blink'], ['slider', 'slider'], ['side', 'side by side'], ['onion', 'onion skin']];
  const ZOOMS = [0.125, 0.16, 0.2, 0.25, 0.33, 0.5, 0.66, 0.75, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 512, 1024, 2048];
  const BLINK_MS = 700;
  const stillness = matchMedia('(prefers-reduced-motion: reduce)');
  const state = {
    item: null, a: 0, b: 1, mode: 'blink', phase: 'A', paused: stillness.matches,
    zoom: null, whole: false, cell: 1, cursor: null, kind: 'all', panels: [],
  };

  // ---- What matters of a window ----

  /** The smallest box around the pixels that a test picks, a margin of pixels around it, in the window. */
  const boxAround = (item, picks, margin) => {
    let [x0, y0, x1, y1] = [Infinity, Infinity, -1, -1];
    for (let y = 0; y < item.height; y += 1) {
      for (let x = 0; x < item.width; x += 1) {
        if (picks(x, y)) {
          [x0, x1] = [Math.min(x0, x), Math.max(x1, x + 1)];
          [y0, y1] = [Math.min(y0, y), Math.max(y1, y + 1)];
        }
      }
    }
    return x1 < 0 ? null : cut(item, [x0 - margin, y0 - margin, x1 + margin, y1 + margin]);
  };

  /** The part of a box in the window. */
  const cut = (item, [x0, y0, x1, y1]) => {
    const inside = (v, end) => Math.min(end, Math.max(0, v));
    const [left, top] = [inside(x0, item.width - 1), inside(y0, item.height - 1)];
    return {
      x: left, y: top,
      width: Math.max(1, inside(x1, item.width) - left), height: Math.max(1, inside(y1, item.height) - top),
    };
  };

  const differsHere = (item, layers) => (x, y) =>
    layers.some((layer) => hitsOf(item, layer, x, y) !== hitsOf(item, layers[0], x, y));

  /** Larger ones are cropped to the pixels in question. */
  const MOST_CROPPED_PX = 48;

  /** The part that is shown at first: around the shape and what is hit; of a large one, what differs. */
  const cropOf = (item, a, b) => {
    const everything = { x: 0, y: 0, width: item.width, height: item.height };
    if (!item.isCase || state.whole) return everything;
    const layers = [...new Set([a, b, item.oracle])].map((i) => item.layers[i]);
    const hit = boxAround(item, (x, y) => layers.some((layer) => hitsOf(item, layer, x, y) > 0), 1);
    const points = outlines(item).flat();
    const [xs, ys] = [0, 1].map((axis) => points.map((p) => p[axis]));
    const outline = cut(item, [
      Math.floor(Math.min(...xs)) - 1, Math.floor(Math.min(...ys)) - 1,
      Math.ceil(Math.max(...xs)) + 1, Math.ceil(Math.max(...ys)) + 1]);
    const both = (p, q) => cut(item, [Math.min(p.x, q.x), Math.min(p.y, q.y),
      Math.max(p.x + p.width, q.x + q.width), Math.max(p.y + p.height, q.y + q.height)]);
    const isSmall = (box) => box.width <= MOST_CROPPED_PX && box.height <= MOST_CROPPED_PX;
    const shape = hit ? both(outline, hit) : outline;
    if (isSmall(shape)) return shape;
    return boxAround(item, differsHere(item, layers), 4) ?? hit ?? shape;
  };

  // ---- Painting ----

  let palette = {};
  const readPalette = () => {
    const style = getComputedStyle(document.documentElement);
    const names = ['empty', 'grid', 'agrees', 'missing', 'extra', 'twice', 'overlap', 'edge',
      'sample', 'cursor', 'glyph', 'same'];
    palette = Object.fromEntries(names.map((n) => [n, style.getPropertyValue(`--px-${n}`).trim()]));
  };

  /** What a pixel is, judged by the target's hits; `glyph` says it without colour. */
  const judge = (actual, target) => {
    if (actual === 0 && target === 0) return null;
    if (actual > target) {
      return actual > 1 ? { fill: 'twice', glyph: String(actual) } : { fill: 'extra', glyph: '+' };
    }
    if (actual < target) return { fill: 'missing', glyph: '\u2212' };
    return actual === 1 ? { fill: 'agrees', glyph: '' } : { fill: 'overlap', glyph: '*' };
  };

  const differ = (a, b) => {
    if (a === b) return a === 0 ? null : { fill: 'same', glyph: '' };
    return { fill: a > b ? 'extra' : 'missing', glyph: `${a > b ? '+' : '\u2212'}${Math.abs(a - b)}` };
  };

  /** Fills the visible pixels by what `markAt` says of each, whole runs at once. */
  const fillMarks = (g, view, markAt) => {
    const { cell, left, top, columns, rows } = view;
    const glyphs = [];
    for (let y = rows[0]; y < rows[1]; y += 1) {
      let run = null;
      for (let x = columns[0]; x <= columns[1]; x += 1) {
        const mark = x < columns[1] ? markAt(x, y) : null;
        if (run && (!mark || mark.fill !== run.fill)) {
          g.fillStyle = palette[run.fill];
          g.fillRect(run.x * cell - left, y * cell - top, (x - run.x) * cell, cell);
          run = null;
        }
        if (mark && !run) run = { x, fill: mark.fill };
        if (mark && mark.glyph && cell >= 14) glyphs.push([mark.glyph, x, y]);
      }
    }
    return glyphs;
  };

  const writeGlyphs = (g, view, glyphs) => {
    const { cell, left, top } = view;
    const size = Math.min(24, cell * 0.45);
    g.font = `700 ${size}px system-ui, sans-serif`;
    g.textAlign = 'left';
    g.textBaseline = 'top';
    g.fillStyle = palette.glyph;
    for (const [text, x, y] of glyphs) {
      g.fillText(text, x * cell - left + cell * 0.08 + 1, y * cell - top + cell * 0.03 + 1);
    }
  };

  const paintLayer = (g, view, index) => {
    const { item } = state;
    const layer = item.layers[index];
    if (!item.isCase) return paintPicture(g, view, layer);
    const target = item.layers[item.oracle];
    const mark = (x, y) => judge(hitsOf(item, layer, x, y), hitsOf(item, target, x, y));
    return writeGlyphs(g, view, fillMarks(g, view, layer.refused ? () => null : mark));
  };

  const paintPicture = (g, { cell, left, top }, layer) => {
    g.imageSmoothingEnabled = cell < 1;
    g.drawImage(layer.canvas, -left, -top, layer.canvas.width * cell, layer.canvas.height * cell);
  };

  const paintDifference = (g, view) => {
    const { item, a, b } = state;
    const [la, lb] = [item.layers[a], item.layers[b]];
    const mark = item.isCase
      ? (x, y) => differ(hitsOf(item, la, x, y), hitsOf(item, lb, x, y))
      : (x, y) => ({ fill: colourOf(la, x, y) === colourOf(lb, x, y) ? 'same' : 'missing', glyph: '' });
    writeGlyphs(g, view, fillMarks(g, view, mark));
  };

  const paintGrid = (g, { cell, left, top, columns, rows, width, height }) => {
    if (cell < 4) return;
    g.strokeStyle = palette.grid;
    g.lineWidth = 1;
    g.beginPath();
    for (let x = columns[0]; x <= columns[1]; x += 1) {
      const at = Math.round(x * cell - left) + 0.5;
      g.moveTo(at, 0);
      g.lineTo(at, height);
    }
    for (let y = rows[0]; y <= rows[1]; y += 1) {
      const at = Math.round(y * cell - top) + 0.5;
      g.moveTo(0, at);
      g.lineTo(width, at);
    }
    g.stroke();
  };

  /** The part of a segment inside a rectangle a little larger than the view, or nothing. */
  const clip = ([ax, ay], [bx, by], width, height) => {
    let [from, to] = [0, 1];
    const [dx, dy] = [bx - ax, by - ay];
    for (const [p, q] of [[-dx, ax + 9], [dx, width + 9 - ax], [-dy, ay + 9], [dy, height + 9 - ay]]) {
      if (p === 0 && q < 0) return null;
      if (p < 0) from = Math.max(from, q / p);
      if (p > 0) to = Math.min(to, q / p);
    }
    if (from > to) return null;
    return [[ax + from * dx, ay + from * dy], [ax + to * dx, ay + to * dy]];
  };

  const outlines = (item) => {
    const { kind, points } = item.shape;
    const scale = kind === 'triangles' ? 256 : 1;
    const shift = kind === 'lines' ? 0.5 : 0;
    const at = ([x, y]) => [x / scale + shift - item.x0, y / scale + shift - item.y0];
    return points.map((shape) => shape.map(at));
  };

  const paintOutline = (g, { cell, left, top, width, height }) => {
    const { item } = state;
    g.strokeStyle = palette.edge;
    g.lineWidth = cell >= 8 ? 2 : 1;
    g.beginPath();
    for (const points of outlines(item)) {
      const onView = points.map(([x, y]) => [x * cell - left, y * cell - top]);
      const last = points.length === 2 ? 1 : points.length;
      for (let i = 0; i < last; i += 1) {
        const part = clip(onView[i], onView[(i + 1) % points.length], width, height);
        if (!part) continue;
        g.moveTo(...part[0]);
        g.lineTo(...part[1]);
      }
    }
    g.stroke();
  };

  /** A dot in the middle of each pixel; a ring where the sample lies exactly on an edge. */
  const paintSamples = (g, { cell, left, top, columns, rows }) => {
    if (cell < 12) return;
    const ties = rule(state.item)?.ties;
    const radius = Math.min(3.5, Math.max(1, cell / 20));
    g.fillStyle = palette.sample;
    g.strokeStyle = palette.sample;
    g.lineWidth = 1.5;
    for (let y = rows[0]; y < rows[1]; y += 1) {
      for (let x = columns[0]; x < columns[1]; x += 1) {
        const [cx, cy] = [(x + 0.5) * cell - left, (y + 0.5) * cell - top];
        g.beginPath();
        g.arc(cx, cy, radius, 0, 7);
        g.fill();
        if (ties?.[y * state.item.width + x]) {
          g.beginPath();
          g.arc(cx, cy, radius + Math.min(5, cell / 8), 0, 7);
          g.stroke();
        }
      }
    }
  };

  /** A number of 256ths: in decimal where that is short, else as a fraction. */
  const subpixels = (value) => {
    if (value % 32 === 0) return String(value / 256);
    const whole = Math.floor(value / 256);
    const rest = `${value - 256 * whole}/256`;
    return whole === 0 ? rest : `${whole}+${rest}`;
  };

  /** The corners with their names, each place once. */
  const corners = (item) => {
    const { kind, points } = item.shape;
    const number = { triangles: subpixels, lines: String, free: (v) => String(Number(v.toPrecision(6))) }[kind];
    const seen = new Map();
    const places = outlines(item);
    points.forEach((shape, i) => shape.forEach((point, k) => {
      const key = point.join();
      const name = points.length === 1 ? `${kind === 'lines' ? 'p' : 'v'}${k}` : '';
      const text = `${name} (${point.map(number).join(', ')})`.trim();
      if (!seen.has(key)) seen.set(key, { at: places[i][k], name, text });
    }));
    return [...seen.values()];
  };

  /** More corners would hide the picture. */
  const MOST_CORNERS = 8;

  const paintCorners = (g, { cell, left, top, width, height }) => {
    const named = corners(state.item);
    if (cell < 8 || named.length > MOST_CORNERS) return;
    g.font = '600 13px system-ui, sans-serif';
    g.textBaseline = 'middle';
    g.textAlign = 'left';
    const middle = [0, 1].map((axis) => named.reduce((sum, { at }) => sum + at[axis], 0) / named.length);
    const taken = [];
    for (const { at, name, text } of named) {
      const [x, y] = [at[0] * cell - left, at[1] * cell - top];
      if (x < -8 || y < -8 || x > width + 8 || y > height + 8) continue;
      g.fillStyle = palette.edge;
      g.beginPath();
      g.arc(x, y, 4, 0, 7);
      g.fill();
      const place = freePlace(g, [x, y], [at[0] < middle[0], at[1] < middle[1]], [text, name], taken, [width, height]);
      if (!place) continue;
      taken.push(place.box);
      g.lineWidth = 4;
      g.lineJoin = 'round';
      g.strokeStyle = palette.empty;
      g.strokeText(place.text, place.box[0], place.box[1] + 8);
      g.fillStyle = palette.sample;
      g.fillText(place.text, place.box[0], place.box[1] + 8);
    }
  };

  /** Where a corner's words stand: outside the shape first, in short where there is no room, or nowhere. */
  const freePlace = (g, [x, y], [isLeft, isUp], texts, taken, [width, height]) => {
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
  };

  const paintCursor = (g, { cell, left, top }) => {
    if (!state.cursor) return;
    const { x, y } = state.cursor;
    const side = Math.max(cell, 3);
    g.lineWidth = 3;
    g.strokeStyle = palette.empty;
    g.strokeRect(x * cell - left + 0.5, y * cell - top + 0.5, side, side);
    g.lineWidth = 1.5;
    g.strokeStyle = palette.cursor;
    g.strokeRect(x * cell - left - 0.5, y * cell - top - 0.5, side + 2, side + 2);
  };

  /** What a panel shows: a layer, the difference, or A and B mixed as the mode wants. */
  const paintContent = (g, view, what) => {
    if (what === 'difference') return paintDifference(g, view);
    if (typeof what === 'number') return paintLayer(g, view, what);
    if (state.mode === 'blink') return paintLayer(g, view, state.phase === 'A' ? state.a : state.b);
    if (state.mode === 'onion') {
      paintLayer(g, view, state.a);
      g.save();
      g.globalAlpha = Number($('#opacity').value) / 100;
      g.fillStyle = palette.empty;
      g.fillRect(0, 0, view.width, view.height);
      paintLayer(g, view, state.b);
      return g.restore();
    }
    const split = Math.round((state.item.width * view.cell * Number($('#split').value)) / 100) - view.left;
    for (const [layer, x, w] of [[state.a, 0, split], [state.b, split, view.width - split]]) {
      g.save();
      g.beginPath();
      g.rect(x, 0, Math.max(0, w), view.height);
      g.clip();
      paintLayer(g, view, layer);
      g.restore();
    }
    g.fillStyle = palette.cursor;
    return g.fillRect(split - 1, 0, 2, view.height);
  };

  /** The canvas at the size of the screen's own pixels, ready to be painted. */
  const contextOf = (canvas, width, height) => {
    const ratio = window.devicePixelRatio || 1;
    const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== w || canvas.height !== h) Object.assign(canvas, { width: w, height: h });
    canvas.style.width = `${width}px`;
    canvas.style.height = `${height}px`;
    const g = canvas.getContext('2d');
    g.setTransform(ratio, 0, 0, ratio, 0, 0);
    return g;
  };

  /** Numbers of columns above the pixels, of rows at their left, as many as have room. */
  const paintNumbers = (panel, { cell, left, top, columns, rows, width, height }) => {
    const { item } = state;
    const widest = Math.max(String(item.x0 + columns[0]).length, String(item.x0 + columns[1]).length);
    const step = (room) => [1, 2, 5].flatMap((m) => [0, 1, 2, 3, 4].map((e) => m * 10 ** e))
      .sort((p, q) => p - q).find((n) => n * cell >= room) ?? 1e5;
    const places = [
      [panel.above, columns, item.x0, width, AXIS_HIGH, step(widest * 7 + 8), left],
      [panel.beside, rows, item.y0, height, axisWide(item), step(13), top],
    ];
    places.forEach(([canvas, [first, last], origin, length, thick, every, scroll], axis) => {
      const g = axis === 0 ? contextOf(canvas, length + 2, thick) : contextOf(canvas, thick, length + 2);
      g.clearRect(0, 0, length + thick, length + thick);
      g.font = '11px ui-monospace, monospace';
      g.fillStyle = palette.sample;
      g.textBaseline = 'middle';
      g.textAlign = axis === 0 ? 'center' : 'right';
      for (let i = first; i < last; i += 1) {
        if (((origin + i) % every + every) % every !== 0) continue;
        const at = (i + 0.5) * cell - scroll + 1;
        if (at < 5 || at > length - 2) continue;
        if (axis === 0) g.fillText(String(origin + i), at, thick - 7);
        else g.fillText(String(origin + i), thick - 4, at);
      }
    });
  };

  const paintPanel = (panel) => {
    const { port, canvas, what } = panel;
    const { item, cell } = state;
    const [width, height] = [port.clientWidth, port.clientHeight];
    const g = contextOf(canvas, width, height);
    const [left, top] = [port.scrollLeft, port.scrollTop];
    const range = (start, length, end) => [
      Math.max(0, Math.floor(start / cell)), Math.min(end, Math.ceil((start + length) / cell))];
    const view = {
      cell, left, top, width, height,
      columns: range(left, width, item.width), rows: range(top, height, item.height),
    };
    g.fillStyle = palette.empty;
    g.fillRect(0, 0, width, height);
    paintContent(g, view, what);
    if (item.isCase || cell >= 6) paintGrid(g, view);
    if (item.isCase) {
      paintOutline(g, view);
      paintSamples(g, view);
    }
    paintCursor(g, view);
    if (item.isCase) paintCorners(g, view);
    paintNumbers(panel, view);
  };

  const caption = (panel) => {
    const name = (i) => {
      const { label, role } = state.item.layers[i];
      return role === 'specimen' || role === 'planted' ? `${label} (${ROLES[role]})` : label;
    };
    const sign = (letter) => el('b', { className: letter === 'B' ? 'of-b' : '' }, letter);
    const parts = {
      a: () => [sign('A'), name(state.a)],
      b: () => [sign('B'), name(state.b)],
      oracle: () => [name(state.item.oracle)],
      difference: () => [state.item.isCase ? 'difference: hits of A less hits of B' : 'difference: where A and B differ'],
      mix: () => {
        if (state.mode === 'blink') return parts[state.phase === 'A' ? 'a' : 'b']();
        return state.mode === 'slider'
          ? [sign('A'), `${name(state.a)} | `, sign('B'), name(state.b)]
          : [sign('B'), `${name(state.b)} over `, sign('A'), name(state.a)];
      },
    };
    panel.caption.replaceChildren(...parts[panel.role]());
  };

  const paint = () => {
    if (!state.item) return;
    $('#stage').dataset.phase = state.phase;
    for (const panel of state.panels) {
      caption(panel);
      paintPanel(panel);
    }
  };

  // ---- Panels ----

  /** Room for the numbers of columns and rows. */
  const AXIS_HIGH = 18;
  const axisWide = ({ y0, height }) =>
    Math.max(38, 10 + 7 * Math.max(String(y0).length, String(y0 + height).length));

  /** Keeps the scroll positions of the panels together. */
  const scrolled = (port) => {
    for (const panel of state.panels) {
      if (panel.port !== port) {
        panel.port.scrollLeft = port.scrollLeft;
        panel.port.scrollTop = port.scrollTop;
      }
    }
    paint();
  };

  const makePanel = (role, what) => {
    const canvas = el('canvas');
    const space = el('div', { className: 'space' }, canvas);
    const port = el('div', { className: 'port' }, space);
    const head = el('figcaption');
    const above = el('canvas', { className: 'above', 'aria-hidden': 'true' });
    const beside = el('canvas', { className: 'beside', 'aria-hidden': 'true' });
    const figure = el('figure', { className: 'panel' }, head, port, above, beside);
    const at = (event) => {
      const box = canvas.getBoundingClientRect();
      const px = (offset, scroll) => Math.floor((offset + scroll) / state.cell);
      return {
        x: px(event.clientX - box.left, port.scrollLeft),
        y: px(event.clientY - box.top, port.scrollTop),
      };
    };
    canvas.addEventListener('pointermove', (event) => moveCursor(at(event), false));
    canvas.addEventListener('pointerdown', (event) => moveCursor(at(event), false));
    port.addEventListener('scroll', () => scrolled(port));
    return { role, what, canvas, space, port, above, beside, caption: head, figure };
  };

  const layOut = () => {
    const { item, mode } = state;
    const stage = $('#stage');
    stage.dataset.mode = mode;
    state.panels = mode === 'side'
      ? [makePanel('a', state.a), makePanel('b', state.b),
        ...([-1, state.a, state.b].includes(item.oracle) ? [] : [makePanel('oracle', item.oracle)]),
        makePanel('difference', 'difference')]
      : [makePanel('mix', 'mix')];
    stage.replaceChildren(...state.panels.map((panel) => panel.figure));
    $('#blink-controls').hidden = mode !== 'blink';
    $('#split-controls').hidden = mode !== 'slider';
    $('#opacity-controls').hidden = mode !== 'onion';
    resize();
  };

  /** Picture pixels for each pixel so that a part fits; rendered frames as they are, unless small. */
  const cellFor = (part, wide, high) => {
    const fits = Math.min(112, (wide - 1) / part.width, (high - 1) / part.height);
    const most = state.item.isCase || Math.max(part.width, part.height) < SMALL_FRAME_PX ? fits : Math.min(1, fits);
    return most >= 1 ? Math.floor(most) : ZOOMS.findLast((z) => z <= most) ?? ZOOMS[0];
  };
  /** Smaller frames are enlarged. */
  const SMALL_FRAME_PX = 200;

  const resize = () => {
    const { item, panels, mode } = state;
    if (!item || panels.length === 0) return;
    const columns = mode === 'side' ? getComputedStyle($('#stage')).gridTemplateColumns.split(' ').length : 1;
    const gap = 13 * (columns - 1);
    const room = $('#viewer').clientWidth;
    const high = Math.max(220, Math.round(window.innerHeight * (mode === 'side' ? 0.42 : item.isCase ? 0.56 : 0.68)));
    const crop = cropOf(item, state.a, state.b);
    const axis = axisWide(item);
    const fit = (wide) => cellFor(crop, wide - axis, high);
    // The words about a pixel stand beside the picture unless that makes it much smaller.
    const beside = mode !== 'side' && room > 700 && fit(room - 380) > 0.6 * fit(room);
    $('#look').dataset.layout = beside ? 'beside' : 'below';
    const wide = Math.floor((room - gap) / columns) - 3 - axis - (beside ? 380 : 0);
    const before = state.cell;
    state.cell = state.zoom ?? cellFor(crop, wide, high);
    const { cell } = state;
    $('#stage').dataset.cell = String(cell);
    for (const { figure, port, space, canvas } of panels) {
      figure.style.gridTemplateColumns = `${axis}px auto`;
      const [width, height] = [Math.ceil(item.width * cell) + 1, Math.ceil(item.height * cell) + 1];
      // A canvas that is too large for a moment would bring scroll bars.
      Object.assign(canvas.style, { width: '0', height: '0' });
      // Cropped, it does not scroll: the wheel is the page's.
      const shown = state.zoom ? [width, height] : [Math.ceil(crop.width * cell) + 1, Math.ceil(crop.height * cell) + 1];
      port.style.overflow = shown[0] <= wide && shown[1] <= high ? 'hidden' : 'auto';
      space.style.width = `${width}px`;
      space.style.height = `${height}px`;
      // Room for a scroll bar where one is needed.
      const bar = shown[0] > wide ? 16 : 0;
      port.style.width = `${Math.min(shown[0], wide) + 2}px`;
      port.style.height = `${Math.min(shown[1], high) + 2 + bar}px`;
      if (!state.zoom) Object.assign(port, { scrollLeft: crop.x * cell, scrollTop: crop.y * cell });
      else if (before !== cell) Object.assign(port, { scrollLeft: 0, scrollTop: 0 });
    }
    $('#zoom-is').textContent = item.isCase ? `${cell} : 1` : `${Math.round(100 * cell)}%`;
    const isCropped = crop.width < item.width || crop.height < item.height;
    $('#whole').hidden = !(isCropped || state.whole);
    $('#whole').textContent = state.whole ? 'crop' : 'whole window';
    paint();
  };

  const zoomBy = (direction) => {
    const next = direction > 0
      ? ZOOMS.find((z) => z > state.cell) : ZOOMS.findLast((z) => z < state.cell);
    if (next) zoomTo(next);
  };

  const zoomTo = (zoom) => {
    state.zoom = zoom;
    resize();
    const { cursor, item, cell, panels } = state;
    const [port] = panels.map((panel) => panel.port);
    const middle = cursor ?? { x: item.width / 2, y: item.height / 2 };
    port.scrollLeft = (middle.x + 0.5) * cell - port.clientWidth / 2;
    port.scrollTop = (middle.y + 0.5) * cell - port.clientHeight / 2;
    scrolled(port);
  };

  // ---- The pixel under the pointer ----

  /** The run of hit pixels around a column of a row, in the numbers of the window. */
  const spanOf = (item, layer, x, y) => {
    if (!layer.hits || hitsOf(item, layer, x, y) === 0) return '';
    let [from, to] = [x, x + 1];
    while (from > 0 && hitsOf(item, layer, from - 1, y) > 0) from -= 1;
    while (to < item.width && hitsOf(item, layer, to, y) > 0) to += 1;
    return `${item.x0 + from} to ${item.x0 + to - 1} (${to - from} px)`;
  };

  const edgeTable = (judged, bits) => {
    const unit = bits === 8 ? 'E is twice an area in 1/65536 px\u00b2' : 'E is twice an area in px\u00b2';
    const head = ['edge', 'E', 'sample', 'this edge', 'top-left'].map((text, at) =>
      el('th', { scope: 'col', className: at === 1 ? 'number' : '' }, text));
    const rows = judged.edges.map((edge) => {
      const side = edge.value === 0n ? 'on it' : edge.value > 0n ? 'inside' : 'outside';
      const value = bits === 8 ? String(edge.value) : decimal(edge.value, 2 * bits);
      return el('tr', {}, el('th', { scope: 'row' }, edge.name), el('td', { className: 'number' }, value),
        ...[side, edge.kind, edge.isTopLeft ? 'yes' : 'no'].map((text) => el('td', {}, text)));
    });
    return el('div', { className: 'scroll', tabIndex: 0, role: 'group', 'aria-label': `edges, ${unit}` }, el('table', { className: 'edges' },
      el('caption', {}, unit), el('thead', {}, el('tr', {}, ...head)), el('tbody', {}, ...rows)));
  };

  /** The triangles that matter at a pixel: those that hit or touch its sample, else the nearest. */
  const aboutTriangles = (item, x, y) => {
    const { bits, triangles } = item.exact;
    const judged = triangles.map((t, i) => ({ ...judgeSample(t, bits, x, y), i }));
    let chosen = judged.filter((j) => j.isIn || j.isTie);
    if (chosen.length === 0) {
      const outside = (j) => j.edges.filter((edge) => edge.value < 0n).length + (j.flat ? 3 : 0);
      chosen = [...judged].sort((p, q) => outside(p) - outside(q)).slice(0, 1);
    }
    const nodes = chosen.slice(0, 3).flatMap((j) => {
      const which = triangles.length > 1 ? `triangle ${j.i + 1} of ${triangles.length}: ` : '';
      let what = j.isIn ? 'the sample is inside' : 'the sample is outside';
      if (j.flat) what = 'flat, so it covers nothing';
      else if (j.isTie) what = `a tie: the sample lies exactly on an edge, and counts as ${j.isIn ? 'inside' : 'outside'}`;
      return [el('p', {}, which + what), edgeTable(j, bits)];
    });
    if (chosen.length > 3) nodes.push(el('p', {}, `and ${plural(chosen.length - 3, 'more triangle')} at this sample`));
    const isTie = judged.some((j) => j.isTie);
    return { nodes, words: isTie ? 'a tie, the sample lies exactly on an edge' : 'no tie', isTie };
  };

  /** A fraction of a pixel in lowest terms, and in decimal. */
  const distance = (over, under) => {
    const size = over < 0n ? -over : over;
    let [p, q] = [size, under];
    while (q > 0n) [p, q] = [q, p % q];
    const exact = under / p === 1n ? `${size / p}` : `${size / p}/${under / p}`;
    const rounded = Number(size) / Number(under);
    return exact.length > 4 ? `${exact} px (${Number(rounded.toPrecision(3))})` : `${exact} px`;
  };

  const aboutLines = (item, x, y) => {
    const words = [];
    const nodes = item.shape.points.map((line, i) => {
      const j = judgeLinePixel(line, x, y);
      const which = item.shape.points.length > 1 ? `line ${i + 1}: ` : '';
      let text = `${which}beyond its ends along ${j.major}`;
      if (j.length === 0n) text = `${which}a single pixel`;
      else if (!j.beyond) {
        const off = distance(j.twice, 2n * j.length);
        const tie = j.isTie ? ', a tie: halfway between two pixels' : '';
        text = `${which}the centre lies ${off} off the line in ${j.minor}${tie}; ${j.isOn ? 'the pixel is lit' : 'another pixel is nearer'}`;
        if (j.isTie && !j.isOn) text = text.replace('another pixel is nearer', 'the tie goes to the other pixel');
      }
      words.push(text);
      return el('p', {}, text);
    });
    return { nodes, words: words[0], isTie: nodes.length > 0 && words.some((w) => w.includes('a tie')) };
  };

  const hex = (colour) => (colour < 0 ? 'outside' : `#${colour.toString(16).padStart(6, '0')}`);

  const aboutPixel = () => {
    const { item, cursor, a, b } = state;
    const box = $('#about-pixel');
    if (!cursor) {
      box.replaceChildren(el('p', { className: 'quiet' }, 'Point at a pixel, or choose one with the arrow keys.'));
      return '';
    }
    const [x, y] = [item.x0 + cursor.x, item.y0 + cursor.y];
    const title = el('h4', {}, `Pixel ${x}, ${y}`);
    if (!item.isCase) {
      const [ca, cb] = [a, b].map((i) => hex(colourOf(item.layers[i], cursor.x, cursor.y)));
      const text = `A ${ca}, B ${cb}: ${ca === cb ? 'the same' : 'different'}`;
      box.replaceChildren(title, el('p', {}, text));
      return `pixel ${x}, ${y}: ${text}`;
    }
    const about = item.exact ? aboutTriangles(item, x, y) : aboutLines(item, x, y);
    const three = [...new Set([a, b, item.oracle])];
    const letter = (i) => (i === a ? 'A ' : i === b ? 'B ' : '');
    const hits = (i) => {
      const layer = item.layers[i];
      const n = hitsOf(item, layer, cursor.x, cursor.y);
      return layer.refused ? `${letter(i)}${layer.label} draws nothing`
        : `${letter(i)}${layer.label} ${plural(n, 'hit')}`;
    };
    const spans = [a, b].map((i, at) => {
      const span = spanOf(item, item.layers[i], cursor.x, cursor.y);
      return `${'AB'[at]} ${span ? `columns ${span}` : 'none'}`;
    });
    box.replaceChildren(title,
      el('p', { id: 'pixel-hits' }, `${three.map(hits).join('; ')}; ${about.isTie ? 'a tie' : 'no tie'}`),
      el('p', { id: 'pixel-span' }, `span in row ${y}: ${spans.join('; ')}`), ...about.nodes);
    return `pixel ${x}, ${y}: ${three.map(hits).join(', ')}; ${about.words}`;
  };

  let announcing = 0;
  const announce = (text, delay) => {
    clearTimeout(announcing);
    announcing = setTimeout(() => { $('#announce').textContent = text; }, delay);
  };

  const moveCursor = (to, byKeyboard) => {
    const { item } = state;
    const inside = (v, end) => Math.min(end - 1, Math.max(0, v));
    const next = { x: inside(to.x, item.width), y: inside(to.y, item.height) };
    if (state.cursor && next.x === state.cursor.x && next.y === state.cursor.y) return;
    state.cursor = next;
    const words = aboutPixel();
    announce(words, byKeyboard ? 60 : 500);
    if (byKeyboard) showCursor();
    layerTable();
    paint();
    remember();
  };

  const showCursor = () => {
    const { cursor, cell, panels: [{ port }] } = state;
    const into = (start, length, at) => Math.min(at, Math.max(at + cell - length, start));
    port.scrollLeft = into(port.scrollLeft, port.clientWidth, cursor.x * cell);
    port.scrollTop = into(port.scrollTop, port.clientHeight, cursor.y * cell);
  };

  // ---- Tables ----

  const ROLES = { engine: 'engine', planted: 'planted fault', oracle: 'oracle', expected: 'target', specimen: 'published' };

  /** What the layers of a case are compared with. */
  const target = (item) => (item.layers[item.oracle].role === 'oracle' ? 'the oracle' : 'what is expected of its declaration');

  const layerTable = () => {
    const { item, cursor } = state;
    const headings = item.isCase
      ? ['who', 'is', 'pixels', 'missing', 'extra', 'twice', 'hits here', 'span of the row here']
      : ['picture', 'size', 'colour here'];
    const numbers = item.isCase ? [2, 3, 4, 5, 6] : [];
    const rows = item.layers.map((layer, i) => {
      const cells = item.isCase ? caseCells(item, layer, cursor) : [
        `${layer.pixels.width} x ${layer.pixels.height}`,
        cursor ? hex(colourOf(layer, cursor.x, cursor.y)) : ''];
      const chosen = [i === state.a && 'is-a', i === state.b && 'is-b'].filter(Boolean).join(' ');
      const name = el('th', { scope: 'row' }, layer.everybody);
      if (layer.refused) return el('tr', { className: chosen }, name, el('td', {}, ROLES[layer.role]), el('td', { colSpan: 6 }, layer.refused));
      return el('tr', { className: chosen }, name,
        ...cells.map((cell, at) => el('td', { className: numbers.includes(at + 1) ? 'number' : '' }, cell)));
    });
    const head = headings.map((text, at) =>
      el('th', { scope: 'col', className: numbers.includes(at) ? 'number' : '' }, text));
    $('#layers').replaceChildren(el('caption', {}, item.isCase ? `Who draws what, judged by ${target(item)}` : 'Pictures'),
      el('thead', {}, el('tr', {}, ...head)), el('tbody', {}, ...rows));
  };

  const caseCells = (item, layer, cursor) => {
    const { missing, extra, twice } = layer.tally;
    const here = cursor ? String(hitsOf(item, layer, cursor.x, cursor.y)) : '';
    const span = cursor ? spanOf(item, layer, cursor.x, cursor.y) : '';
    return [ROLES[layer.role], ...[layer.covered, missing, extra, twice].map(String), here, span];
  };

  const runsOfRow = (item, layer, y) => {
    const runs = [];
    for (let x = 0; x < item.width; x += 1) {
      const hits = hitsOf(item, layer, x, y);
      const last = runs.at(-1);
      if (last && last.hits === hits && last.to === x) last.to += 1;
      else if (hits > 0) runs.push({ from: x, to: x + 1, hits });
    }
    const text = ({ from, to, hits }) =>
      `${item.x0 + from}${to - from > 1 ? ` to ${item.x0 + to - 1}` : ''}${hits > 1 ? ` (${hits} hits)` : ''}`;
    return runs.map(text).join(', ');
  };

  const rowTable = () => {
    const { item, a, b } = state;
    $('#rows').hidden = !item.isCase;
    if (!$('#rows').open || !item.isCase) return;
    const columns = [['A', a], ['B', b], ['oracle', item.oracle]];
    const rows = Array.from({ length: item.height }, (_, y) => {
      const texts = columns.map(([, i]) => runsOfRow(item, item.layers[i], y));
      const differs = texts[0] === texts[1] ? '' : 'A and B differ';
      return el('tr', { className: differs ? 'wrong' : '' }, el('th', { scope: 'row' }, String(item.y0 + y)),
        ...[...texts, differs].map((text) => el('td', {}, text)));
    });
    const head = ['row', ...columns.map(([name, i]) => (name === 'oracle' ? name : `${name}: ${item.layers[i].label}`)), 'difference'];
    $('#rows .scroll').replaceChildren(el('table', {}, el('caption', {}, 'Columns that are hit in each row'),
      el('thead', {}, el('tr', {}, ...head.map((text) => el('th', { scope: 'col' }, text)))),
      el('tbody', {}, ...rows)));
  };

  const legend = () => {
    const entries = state.item.isCase
      ? [['agrees', '', state.item.layers[state.item.oracle].role === 'oracle' ? 'as the oracle' : 'as expected'], ['missing', '\u2212', 'missing'], ['extra', '+', 'extra'],
        ['twice', '2', 'too often'], ['overlap', '*', 'rightly more than once']]
      : [];
    $('#legend').replaceChildren(...entries.map(([fill, glyph, text]) => {
      const square = el('span', { 'aria-hidden': 'true' }, glyph);
      square.style.background = palette[fill];
      return el('li', {}, square, text);
    }));
  };

  // ---- Choosing ----

  const describePair = () => {
    const { item, a, b } = state;
    const [la, lb] = [item.layers[a], item.layers[b]];
    const refused = [la, lb].find((layer) => layer.refused);
    let text = `A and B differ in ${plural(countDifferent(item, la, lb), 'pixel')} of ${item.width * item.height}.`;
    const map = [la, lb].find((layer) => layer.is_map);
    if (map) text = `${map.label}: its colours mark pixels, so it is not compared.`;
    else if (refused) text = `${refused.label} draws nothing: ${refused.refused}`;
    else if (text.includes(' in 0 ')) {
      text = `A and B agree in every pixel of ${item.width} x ${item.height}.`;
      const wrong = item.isCase && item.layers.some((layer) => layer.role === 'specimen' && layer.wrong > 0);
      if (wrong) text += ' Choose a published algorithm as A to see a fault.';
    }
    $('#agreement').textContent = text;
    const r = rule(item);
    const agrees = r && item.layers[item.oracle].hits.every((hits, i) => hits === r.hits[i]);
    const other = 'Expected is the exact picture of what the program declares, not of the top-left rule at the centre.';
    const words = item.pictured ? item.pictured : item.isCase && item.layers[item.oracle].role === 'expected' ? other : `The rule, computed by this page at every pixel, says ${agrees ? 'what' : 'something else than'} the oracle says.`;
    $('#by-rule').textContent = r || item.pictured ? words : '';
  };

  const pairChanged = () => {
    $('#pick-a').value = String(state.a);
    $('#pick-b').value = String(state.b);
    $('#case-playground').hidden = !(state.item.isCase && data.playground);
    $('#no-playground').hidden = !state.item.isCase || data.playground;
    if (state.item.isCase) $('#case-playground a').href = `playground.html#${new URLSearchParams(playgroundWords(state.item))}`;
    layOut();
    describePair();
    layerTable();
    rowTable();
    aboutPixel();
    remember();
  };

  const fillPickers = () => {
    const { item } = state;
    const label = (layer) => {
      if (!item.isCase) return layer.label;
      if (layer.refused) return `${layer.label} (draws nothing)`;
      return ['oracle', 'expected'].includes(layer.role) ? layer.label : `${layer.label} (${layer.wrong} wrong)`;
    };
    for (const picker of [$('#pick-a'), $('#pick-b')]) {
      const options = item.layers.map((layer, i) => el('option', { value: String(i) }, label(layer)));
      const published = options.filter((_, i) => item.layers[i].role === 'specimen');
      const others = options.filter((_, i) => item.layers[i].role !== 'specimen');
      picker.replaceChildren(...others);
      if (published.length > 0) picker.append(el('optgroup', { label: 'published, with their faults' }, ...published));
    }
  };

  // What was zoomed to in one arrangement of panels does not fit into another: all is seen again.
  const fit = () => {
    state.zoom = null;
    resize();
  };

  const setMode = (mode) => {
    if ((mode === 'side') !== (state.mode === 'side')) state.zoom = null;
    state.mode = mode;
    all('#modes input').forEach((input) => { input.checked = input.value === mode; });
    state.phase = 'A';
    layOut();
    remember();
  };

  const setPaused = (paused) => {
    state.paused = paused;
    $('#pause').textContent = paused ? 'start blinking' : 'pause';
    $('#stage').dataset.paused = String(paused);
  };

  const flip = () => {
    state.phase = state.phase === 'A' ? 'B' : 'A';
    paint();
  };

  const matches = (item) => {
    if (state.kind !== 'all' && item.kind !== state.kind) return false;
    const text = [item.name, item.about, item.found, item.kind, ...item.layers.map((l) => l.everybody)].join(' ').toLowerCase();
    return $('#search').value.toLowerCase().split(/\s+/).every((word) => text.includes(word));
  };

  const KINDS = { failing: 'failing', closest: 'closest to a bound', offgrid: 'off the grid', named: 'named', specimen: 'specimen', picture: 'picture' };

  /** What a case stands under in the list: its family where it fails, else why it is shown. */
  const groupOf = (item) => (item.kind === 'failing' ? item.name.split('#')[0] : KINDS[item.kind]);

  /** The cases that are shown, group by group. */
  const shownItems = () => {
    const shown = items.filter(matches);
    const groups = [...new Set(shown.map(groupOf))];
    return groups.flatMap((group) => shown.filter((item) => groupOf(item) === group));
  };

  const fillList = () => {
    const shown = shownItems();
    $('#found').textContent = `${shown.length} of ${plural(items.length, 'case')}`;
    $('#list').replaceChildren(...shown.flatMap((item, i) => {
      const link = el('a', { href: `#case-${encodeURIComponent(item.name)}` },
        el('span', { className: 'name' }, item.name),
        el('span', { className: 'what' }, item.found || item.about));
      if (item === state.item) link.setAttribute('aria-current', 'true');
      const group = groupOf(item);
      const isFirst = i === 0 || groupOf(shown[i - 1]) !== group;
      const text = item.kind === 'failing' ? `${group}, failing` : group;
      const head = el('li', { className: `group ${item.kind}` }, text);
      return [...(isFirst ? [head] : []), el('li', {}, link)];
    }));
    const at = shown.indexOf(state.item);
    $('#place').textContent = at < 0 ? '' : `${at + 1} of ${shown.length}`;
    $('#steps').hidden = shown.length < 2 && at >= 0;
    // The chosen one is in sight, without moving the page.
    const [list, chosen] = [$('#list'), $('#list a[aria-current]')];
    const top = chosen ? chosen.getBoundingClientRect().top - list.getBoundingClientRect().top : 0;
    if (top < 0 || top > list.clientHeight - 60) list.scrollTop += top - list.clientHeight / 3;
  };

  /** The case that stands before or after the one that is open. */
  const step = (by) => {
    const shown = shownItems();
    const at = shown.indexOf(state.item);
    const next = shown[(at + by + shown.length) % shown.length];
    if (next) location.hash = `case-${encodeURIComponent(next.name)}`;
  };

  const fillFilters = () => {
    const kinds = ['all', ...Object.keys(KINDS).filter((kind) => items.some((item) => item.kind === kind))];
    $('#filters').replaceChildren(...kinds.map((kind) => {
      const count = kind === 'all' ? items.length : items.filter((item) => item.kind === kind).length;
      const button = el('button', { type: 'button' }, `${KINDS[kind] ?? kind} ${count}`);
      button.dataset.kind = kind;
      button.setAttribute('aria-pressed', String(kind === state.kind));
      return button;
    }));
  };

  // ---- Addresses: #case-NAME&mode=MODE&a=NAME&b=NAME&px=X,Y ----

  const address = () => {
    const { item, mode, a, b, cursor } = state;
    const name = (i) => encodeURIComponent(item.layers[i].names[0]);
    const at = cursor ? `&px=${item.x0 + cursor.x},${item.y0 + cursor.y}` : '';
    return `#case-${encodeURIComponent(item.name)}&mode=${mode}&a=${name(a)}&b=${name(b)}${at}`;
  };

  let remembering = 0;
  /** Puts what is shown into the address, some time after the last change. */
  const remember = () => {
    clearTimeout(remembering);
    remembering = setTimeout(() => history.replaceState(null, '', address()), 150);
  };

  const decodeWord = (text) => {
    try { return decodeURIComponent(text); } catch { return text; }
  };

  /** What an address asks for; nothing where it names a part of the page, or nothing. */
  const parseAddress = (url) => {
    const [first, ...rest] = new URL(url).hash.slice(1).split('&');
    if (!first.startsWith('case-')) {
      const isThere = first === '' || document.getElementById(decodeWord(first));
      return isThere ? null : { settings: {}, lost: `This page has no place called ${decodeWord(first)}` };
    }
    const item = items.find((i) => i.name === decodeWord(first.slice(5)));
    const settings = Object.fromEntries(rest.map((part) => part.split('=').map(decodeWord)));
    const lost = item ? lostOf(item, settings) : `This page has no case called ${decodeWord(first.slice(5))}`;
    return { item, settings, lost };
  };

  /** What of an address a case does not have; an address may be older than the page. */
  const lostOf = (item, { a, b, mode, px }) => {
    const isThere = (name) => item.layers.some((layer) => layer.names.includes(name));
    const nobody = [a, b].find((name) => name !== undefined && !isThere(name));
    if (nobody !== undefined) return `Nobody called ${nobody} draws this case`;
    if (mode !== undefined && !MODES.some(([name]) => name === mode)) return `There is no way to compare called ${mode}`;
    const at = px?.split(',').map(Number) ?? [item.x0, item.y0];
    // How large a picture is, is known when it is there.
    const isIn = !item.isCase || (at.length === 2 && at.every(Number.isInteger)
      && at[0] >= item.x0 && at[0] < item.x0 + item.width && at[1] >= item.y0 && at[1] < item.y0 + item.height);
    return isIn ? '' : `This case has no pixel ${px}`;
  };

  /** The first pixel in which A and B differ, in the middle row of those that do; nothing in pictures. */
  const firstDifferent = (item) => {
    if (!item.isCase) return null;
    const differs = differsHere(item, [item.layers[state.a], item.layers[state.b]]);
    const found = [];
    for (let y = 0; y < item.height; y += 1) {
      for (let x = 0; x < item.width; x += 1) if (differs(x, y)) found.push({ x, y });
    }
    return found[Math.floor((found.length - 1) / 2)] ?? null;
  };

  /** The largest window of the playground. */
  const PLAYGROUND_PX = 128;

  /** What opens a case in the playground: its name where it has one there, else its places. */
  const playgroundWords = (item) => {
    const { kind, points } = item.shape;
    const by = [state.a, state.b].map((i) => item.layers[i].names[0]).join();
    const scene = kind === 'lines' ? 'line' : 'triangle';
    const [, name, seed] = / inspect '?([\w.-]+(?:#\d+)?)'?(?: --seed (\d+))?(?: --plant [\w-]+)?$/.exec(item.command) ?? [];
    if (name) return { scene, case: name, ...(seed && { seed }), by };
    const part = Math.max(item.width, item.height) > PLAYGROUND_PX ? cropOf(item, state.a, state.b) : { ...item, x: 0, y: 0 };
    const [x0, y0] = [item.x0 + part.x, item.y0 + part.y];
    const end = (from, length) => from + Math.min(length, PLAYGROUND_PX);
    const window = [x0, y0, end(x0, part.width), end(y0, part.height)].join();
    if (kind === 'lines') return { scene, lines: points.map((line) => line.flat().join()).join(';'), window, by };
    const place = (point) => (kind === 'free' ? point : point.map((sub) => sub / 256)).join();
    const t = points.map((triangle) => triangle.map(place).join('_')).join(';');
    return { scene, t, window, by, ...(kind === 'free' && { snap: 0 }) };
  };

  /** Where a case is explained: a link where the page knows the way to the docs. */
  const chapterOf = (item) => {
    const { title, path } = item.chapter ?? {};
    if (!title) return [];
    const link = data.docs ? el('a', { href: data.docs + path }, title) : title;
    return ['Explained in ', link, data.docs ? '' : `, docs/${path.split('#')[0]}`, '.'];
  };

  const open = async (item, settings = {}) => {
    state.opening = item;
    await load(item);
    // Somebody chose another one in the meantime.
    if (state.opening !== item) return;
    const place = (name, otherwise) => {
      const at = item.layers.findIndex((layer) => layer.names.includes(name));
      return at >= 0 ? at : otherwise;
    };
    const isNew = state.item !== item;
    state.item = item;
    state.a = place(settings.a, item.start[0]);
    state.b = place(settings.b, item.start[1]);
    if (isNew) Object.assign(state, { zoom: null, whole: false, cursor: firstDifferent(item), phase: 'A' });
    const [x, y] = (settings.px ?? '').split(',').map(Number);
    if (Number.isInteger(x) && Number.isInteger(y)) {
      const inside = (v, end) => Math.min(end - 1, Math.max(0, v));
      state.cursor = { x: inside(x - item.x0, item.width), y: inside(y - item.y0, item.height) };
    }
    $('#lost').hidden = true;
    $('#case-title').textContent = item.name;
    $('#case-kind').textContent = KINDS[item.kind];
    $('#case-kind').className = `kind ${item.kind}`;
    $('#case-chapter').replaceChildren(...chapterOf(item));
    const places = item.isCase ? corners(item) : [];
    $('#case-corners').textContent = places.length > 0 && places.length <= MOST_CORNERS
      ? `Corners, in pixels: ${places.map(({ text }) => text).join('  ')}` : '';
    $('#case-about').textContent = item.about;
    $('#case-found').textContent = item.found;
    $('#case-command').hidden = !item.command;
    $('#case-command code').textContent = item.command;
    if (MODES.some(([mode]) => mode === settings.mode)) state.mode = settings.mode;
    all('#modes input').forEach((input) => { input.checked = input.value === state.mode; });
    fillPickers();
    legend();
    fillList();
    pairChanged();
    document.body.dataset.ready = item.name;
  };

  /** Opens what an address names, and says so where there is no such case. */
  const follow = async (url) => {
    const found = parseAddress(url);
    if (!found) return;
    clearTimeout(remembering);
    if (found.item || !state.item) await open(found.item ?? items[0], found.settings);
    if (found.lost) {
      clearTimeout(remembering);
      $('#lost').textContent = `${found.lost}; this is ${state.item.name}.`;
      $('#lost').hidden = false;
    }
    const { top } = $('#viewer').getBoundingClientRect();
    if (top < 0 || top > window.innerHeight / 2) $('#viewer').scrollIntoView({ block: 'start' });
  };

  // ---- The view as a picture ----

  /** What is shown, with its name, captions, numbers and legend, as one canvas. */
  const snapshot = () => {
    const { item, panels } = state;
    const [PAD, LINE] = [16, 22];
    const axis = axisWide(item);
    const legendTexts = all('#legend li').map((li) => [li.querySelector('span').style.background, li.textContent]);
    const sizes = panels.map(({ port }) => [port.clientWidth + axis, port.clientHeight + AXIS_HIGH + LINE]);
    const wide = Math.max(420, sizes.reduce((sum, [w]) => sum + w + PAD, PAD));
    const high = Math.max(...sizes.map(([, h]) => h)) + 4 * LINE + 3 * PAD;
    const canvas = el('canvas', { width: 2 * wide, height: 2 * high });
    const g = canvas.getContext('2d');
    g.scale(2, 2);
    const style = getComputedStyle(document.documentElement);
    const [paper, ink] = ['--paper', '--ink'].map((name) => style.getPropertyValue(name).trim());
    g.fillStyle = paper;
    g.fillRect(0, 0, wide, high);
    g.fillStyle = ink;
    g.textBaseline = 'top';
    const write = (text, x, y, font) => { g.font = `${font} system-ui, sans-serif`; g.fillText(text, x, y, wide - x); };
    write(item.name, PAD, PAD, '600 17px');
    write(item.found || item.about, PAD, PAD + LINE, '13px');
    let x = PAD;
    panels.forEach(({ caption: head, canvas: pixels, above, beside, port }, i) => {
      const y = PAD + 2 * LINE + 6;
      write(head.textContent, x + axis, y, '600 13px');
      const [w, h] = [port.clientWidth, port.clientHeight];
      g.drawImage(above, x + axis, y + LINE, above.clientWidth, AXIS_HIGH);
      g.drawImage(beside, x, y + LINE + AXIS_HIGH, axis, beside.clientHeight);
      g.drawImage(pixels, x + axis, y + LINE + AXIS_HIGH, w, h);
      x += sizes[i][0] + PAD;
    });
    let at = PAD;
    for (const [fill, text] of legendTexts) {
      g.fillStyle = fill;
      g.fillRect(at, high - PAD - 14, 14, 14);
      g.fillStyle = ink;
      write(text, at + 19, high - PAD - 14, '12px');
      at += 34 + g.measureText(text).width;
    }
    return canvas;
  };

  const download = () => {
    const link = el('a', { href: snapshot().toDataURL('image/png'), download: `${state.item.name.replace(/[^\w.-]+/g, '-')}.png` });
    document.body.append(link);
    link.click();
    link.remove();
  };

  // ---- Wiring ----

  const copy = async (button) => {
    const text = $('code', button.parentElement).textContent;
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      const field = el('textarea', { value: text });
      document.body.append(field);
      field.select();
      document.execCommand('copy');
      field.remove();
    }
    button.textContent = 'copied';
    setTimeout(() => { button.textContent = 'copy'; }, 1500);
  };

  const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

  const keyInStage = (event) => {
    const step = STEPS[event.key];
    if (step && !event.ctrlKey && !event.altKey && !event.metaKey) {
      event.preventDefault();
      const { item, cursor } = state;
      const from = cursor ?? { x: Math.floor(item.width / 2) - step[0], y: Math.floor(item.height / 2) - step[1] };
      const far = event.shiftKey ? 8 : 1;
      moveCursor({ x: from.x + far * step[0], y: from.y + far * step[1] }, true);
    } else if (event.key === '+' || event.key === '=') zoomBy(1);
    else if (event.key === '-') zoomBy(-1);
  };

  const keyAnywhere = (event) => {
    const typing = event.target.closest?.('input[type="search"], select, textarea');
    if (typing || event.ctrlKey || event.altKey || event.metaKey || !$('#keys-on').checked) return;
    const mode = MODES['1234'.indexOf(event.key)];
    if (event.key.length === 1 && mode) setMode(mode[0]);
    else if (event.key === 'n') step(1);
    else if (event.key === 'p') step(-1);
    else if (event.key === 'b') {
      if (state.mode === 'blink') setPaused(!state.paused);
      else { setMode('blink'); setPaused(false); }
    }
  };

  const foldTables = () => {
    for (const table of all('table.counts')) {
      const rows = all('tbody tr', table);
      const more = rows.length - 6;
      if (more < 3 || table.closest('details')) continue;
      const button = el('button', { type: 'button', className: 'unfold' });
      const fold = (folded) => {
        table.classList.toggle('folded', folded);
        button.setAttribute('aria-expanded', String(!folded));
        button.textContent = folded ? `show all ${rows.length} rows` : 'show fewer';
      };
      button.addEventListener('click', () => fold(!table.classList.contains('folded')));
      fold(true);
      table.parentElement.after(button);
    }
  };

  const listen = () => {
    document.addEventListener('click', (event) => {
      const button = event.target.closest('button');
      if (button?.classList.contains('find')) {
        const wanted = button.dataset.search;
        const exact = items.find((item) => item.name === wanted);
        $('#search').value = exact ? '' : wanted;
        fillList();
        const link = exact ? `#case-${encodeURIComponent(exact.name)}` : $('#list a')?.getAttribute('href');
        if (link) location.hash = link;
        $('#cases').scrollIntoView();
      }
      if (button?.dataset.kind) {
        state.kind = button.dataset.kind;
        all('#filters button').forEach((b) => b.setAttribute('aria-pressed', String(b === button)));
        fillList();
      }
    });
    $('#search').addEventListener('input', fillList);
    $('#pick-a').addEventListener('change', (e) => { state.a = Number(e.target.value); pairChanged(); });
    $('#pick-b').addEventListener('change', (e) => { state.b = Number(e.target.value); pairChanged(); });
    $('#swap').addEventListener('click', () => { [state.a, state.b] = [state.b, state.a]; pairChanged(); });
    $('#modes').addEventListener('change', (event) => setMode(event.target.value));
    $('#pause').addEventListener('click', () => setPaused(!state.paused));
    $('#other').addEventListener('click', () => { setPaused(true); flip(); });
    $('#split').addEventListener('input', paint);
    $('#opacity').addEventListener('input', paint);
    $('#zoom-in').addEventListener('click', () => zoomBy(1));
    $('#zoom-out').addEventListener('click', () => zoomBy(-1));
    $('#zoom-fit').addEventListener('click', fit);
    $('#whole').addEventListener('click', () => { state.whole = !state.whole; state.zoom = null; resize(); });
    $('#download').addEventListener('click', download);
    $('#previous').addEventListener('click', () => step(-1));
    $('#next').addEventListener('click', () => step(1));
    $('#rows').addEventListener('toggle', rowTable);
    $('#stage').addEventListener('keydown', keyInStage);
    document.addEventListener('keydown', keyAnywhere);
    window.addEventListener('hashchange', (event) => follow(event.newURL));
    window.addEventListener('resize', fit);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { readPalette(); legend(); paint(); });
    stillness.addEventListener('change', () => { if (stillness.matches) setPaused(true); });
    setInterval(() => {
      if (state.mode === 'blink' && !state.paused && !document.hidden && state.item) flip();
    }, BLINK_MS);
  };

  const start = async () => {
    readPalette();
    foldTables();
    document.addEventListener('click', (event) => {
      const button = event.target.closest('button.copy');
      if (button) copy(button);
    });
    if (items.length === 0) return;
    $('#cases').hidden = false;
    $('#chooser').hidden = items.length === 1;
    $('#modes').append(...MODES.map(([value, text], i) => el('label', {},
      el('input', { type: 'radio', name: 'mode', value }), el('kbd', { 'aria-hidden': 'true' }, String(i + 1)), text)));
    setPaused(state.paused);
    fillFilters();
    listen();
    if (parseAddress(location.href)) await follow(location.href);
    else {
      await open(items[0]);
      // What nobody chose is not in the address.
      clearTimeout(remembering);
    }
  };

  // For tests and the curious: the rule over every pixel of every case; cases that differ; the view.
  window.rasterproof = {
    snapshot: () => snapshot().toDataURL('image/png'),
    audit: () => items.filter((item) => item.isCase).filter((item) => {
      const { hits } = byRule(item);
      return !item.layers[item.oracle].hits.every((n, i) => n === hits[i]);
    }).map((item) => item.name),
  };
  start();
})();
