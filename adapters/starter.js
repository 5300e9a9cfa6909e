// 1. Put your code into triangle() and line() below; write `const line = null` if you draw no lines.
// 2. Say in DECLARES what your code promises, for example 'origin=0,0 rule=none' (docs/protocol.md).
// 3. Judge it: rasterproof judge -- node starter.js
const NAME = 'mine';
const DECLARES = 'batch=64';

// ---- YOUR PLACE: replace the bodies of these two functions ----

// Corners in pixels, y down; setPixel(x, y) for every pixel drawn. As it stands it draws every sample on an
// edge, so two neighbours both draw the edge they share.
function triangle(x0, y0, x1, y1, x2, y2, width, height, setPixel) {
  const side = (ax, ay, bx, by, x, y) => (bx - ax) * (y - ay) - (by - ay) * (x - ax);
  const left = Math.max(0, Math.floor(Math.min(x0, x1, x2)));
  const right = Math.min(width, Math.ceil(Math.max(x0, x1, x2)));
  const top = Math.max(0, Math.floor(Math.min(y0, y1, y2)));
  const bottom = Math.min(height, Math.ceil(Math.max(y0, y1, y2)));
  for (let y = top; y < bottom; y++) {
    for (let x = left; x < right; x++) {
      const e0 = side(x0, y0, x1, y1, x + 0.5, y + 0.5);
      const e1 = side(x1, y1, x2, y2, x + 0.5, y + 0.5);
      const e2 = side(x2, y2, x0, y0, x + 0.5, y + 0.5);
      if ((e0 >= 0 && e1 >= 0 && e2 >= 0) || (e0 <= 0 && e1 <= 0 && e2 <= 0)) setPixel(x, y);
    }
  }
}

// From one pixel to another, both drawn, in drawing order. As it stands, a plain DDA.
function line(x0, y0, x1, y1, width, height, setPixel) {
  const dx = x1 - x0, dy = y1 - y0, steps = Math.max(Math.abs(dx), Math.abs(dy));
  // Of the longer direction, only the steps inside the window.
  const [start, step, size] = Math.abs(dx) >= Math.abs(dy) ? [x0, dx, width] : [y0, dy, height];
  const first = Math.max(0, step >= 0 ? -start : start - size + 1);
  const last = Math.min(steps, step >= 0 ? size - 1 - start : start);
  for (let i = first; i <= last; i++) {
    const share = (d) => (d * i) / Math.max(steps, 1);
    setPixel(Math.floor(x0 + share(dx) + 0.5), Math.floor(y0 + share(dy) + 0.5));
  }
}

// ---- the line protocol: nothing to change from here on ----

const MOST_BYTES = 65536, MOST_SIDE = 1024, MOST_HITS = 2 ** 22;

class Refused extends Error {}

function drawn(draw, numbers, width, height) {
  const hits = [];
  draw(...numbers, width, height, (x, y) => {
    if (!Number.isInteger(x) || !Number.isInteger(y)) throw new TypeError(`setPixel(${x}, ${y})`);
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    if (hits.length === MOST_HITS) throw new Refused(`more than ${MOST_HITS} pixels set`);
    hits.push([x, y]);
  });
  return hits;
}

// Row, first column, one past the last; a pixel hit twice is in two runs.
function runs(hits) {
  const found = [];
  for (const [x, y] of hits.sort((a, b) => a[1] - b[1] || a[0] - b[0])) {
    const run = found.at(-1);
    if (run && run[0] === y && run[2] === x) run[2]++;
    else found.push([y, x, x + 1]);
  }
  return found;
}

// A decimal number or a C99 hex float.
function number(word) {
  const hex = /^([+-]?)0x([0-9a-f]*)\.?([0-9a-f]*)(?:p([+-]?\d+))?$/i.exec(word);
  const value = hex
    ? Number(hex[1] + '1') * parseInt(hex[2] + hex[3], 16) * 2 ** (Number(hex[4] || 0) - 4 * hex[3].length)
    : Number(word);
  if (!(value >= -(2 ** 31) && value < 2 ** 31)) throw new Refused('a coordinate is not a number within 2^31 px');
  return value;
}

function answer(words) {
  const [verb, id = '-'] = words;
  if (verb === 'HELLO') {
    const known = 'coverage' + (line ? ' line' : '');
    if (words.length === 2 && id === '1') return `HELLO 1 ${NAME} ${known}`;
    const declared = `window=${MOST_SIDE}x${MOST_SIDE} ${DECLARES}`;
    if (words.length === 2 && id === '2') return `HELLO 2 ${NAME} ${known} ${declared}`;
    return 'E - say HELLO 1 or HELLO 2';
  }
  const [draw, count] = verb === 'T' ? [triangle, 6] : verb === 'L' ? [line, 4] : [null, 0];
  if (!draw) return `E ${id} unsupported`;
  try {
    if (words.length !== count + 4) throw new Refused(`${verb} takes id width height and ${count} numbers`);
    const [width, height] = words.slice(2, 4).map(Number);
    if (![width, height].every((n) => Number.isInteger(n) && n >= 1 && n <= MOST_SIDE)) {
      throw new Refused(`the window must be from 1x1 to ${MOST_SIDE}x${MOST_SIDE}`);
    }
    const numbers = words.slice(4).map(number);
    const found = verb === 'T'
      ? runs(drawn(draw, numbers, width, height))
      : drawn(draw, numbers.map(Math.floor), width, height);
    return [verb === 'T' ? 'C' : 'P', id, found.length, ...found.map((group) => group.join(' '))].join(' ');
  } catch (error) {
    if (error instanceof Refused) return `E ${id} ${error.message}`;
    console.error(error);
    return `E ${id} raised ${error.name}`;
  }
}

const say = process.stdout.write.bind(process.stdout);
process.stdout.write = process.stderr.write.bind(process.stderr); // what your code prints
process.stdout.on('error', () => process.exit(0));

// What has come of a line that has not ended; of one that is too long only its length is kept.
let begun = '', length = 0;
function take(text, ended) {
  length += text.length;
  if (length <= MOST_BYTES) begun += text;
  if (!ended) return;
  const words = begun.trim().split(/[ \t\r\v\f]+/);
  if (length > MOST_BYTES) say(`E - a request has at most ${MOST_BYTES} bytes\n`, 'latin1');
  else if (words[0]) say(answer(words) + '\n', 'latin1');
  begun = '';
  length = 0;
}
process.stdin.setEncoding('latin1');
process.stdin.on('data', (chunk) => {
  const lines = chunk.split('\n');
  lines.forEach((text, i) => take(text, i + 1 < lines.length));
});
process.stdin.on('end', () => take('', true));
