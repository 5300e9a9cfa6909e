// Judges a rasterizer written in JavaScript, pixel by pixel, against an exact oracle: docs/javascript.md.

const address = new URL('./rasterproof.wasm', import.meta.url), files = 'node:fs'; // which bundlers for pages must not look for
const judge = await WebAssembly.compile(
  address.protocol === 'file:'
    ? (await import(/* webpackIgnore: true */ /* @vite-ignore */ files)).readFileSync(address)
    : await (await fetch(address)).arrayBuffer());

/** What is drawn is wrong; the message is that of the judge. */
export class AssertionError extends Error {
  name = 'AssertionError';
}

class Exit {
  constructor(status) { this.status = status; }
}

/**
 * Runs the judge. It reads `header`, then what `answer` makes of the lines that it has written; both are called in this
 * thread. What the module imports is the part of WASI that a Rust program with streams and a clock needs.
 */
function run(header, answer) {
  const encoder = new TextEncoder(), decoder = new TextDecoder();
  let input = encoder.encode(header), at = 0, requests = '', said = '', memory;
  /** Calls `move` with the bytes of each piece of memory in a list, and stores how many were moved. */
  const each = (list, count, moved, move) => {
    const view = new DataView(memory.buffer);
    let sum = 0;
    for (let i = list; i < list + 8 * count; i += 8)
      sum += move(new Uint8Array(memory.buffer, view.getUint32(i, true), view.getUint32(i + 4, true)));
    view.setUint32(moved, sum, true);
    return 0;
  };
  const system = {
    fd_read(_, list, count, read) {
      if (at === input.length) {
        const lines = requests.split('\n').filter(Boolean);
        [requests, at] = ['', 0];
        input = encoder.encode(lines.map((line) => `${answer(line.split(' '))}\n`).join(''));
      }
      return each(list, count, read, (bytes) => {
        const piece = input.subarray(at, at + bytes.length);
        bytes.set(piece);
        at += piece.length;
        return piece.length;
      });
    },
    fd_write: (stream, list, count, written) => each(list, count, written, (bytes) => {
      if (stream === 1) requests += decoder.decode(bytes);
      else said += decoder.decode(bytes);
      return bytes.length;
    }),
    clock_time_get(_, precision, time) {
      new DataView(memory.buffer).setBigUint64(time, BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    },
    environ_sizes_get: (count, size) => each(0, 0, count, null) || each(0, 0, size, null),
    environ_get: () => 0,
    // The memory as it is: nothing here has to be hard to guess.
    random_get: () => 0,
    proc_exit(status) { throw new Exit(status); },
  };
  // To all other questions: there is no such file.
  const all = new Proxy(system, { get: (known, name) => known[name] ?? (() => 8) });
  const instance = new WebAssembly.Instance(judge, { wasi_snapshot_preview1: all });
  memory = instance.exports.memory;
  try {
    instance.exports._start();
    return { status: 0, said: said.trim() };
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) return { status: 3, said: `${said}${error.stack}` };
    if (!(error instanceof Exit)) throw error;
    return { status: error.status, said: said.trim() };
  }
}

const isIterator = (value) => typeof value?.next === 'function';
const describe = (value) => {
  if (value === null || typeof value !== 'object') return String(value);
  return isIterator(value) ? 'an iterator, as of a generator (write [...f(shape, window)])' : value.constructor?.name ?? 'an object without a name';
};

/** More hits than a byte holds are not told apart. */
const MOST_HITS = 255;

/** What a function returned first, it has to go on returning. */
function keep(judged, kind) {
  judged.kind ??= kind;
  if (judged.kind !== kind) throw new TypeError(`${judged.name} returned ${kind}; in an earlier call ${judged.kind}`);
}

/** Refuses what is no count, and a picture in 0 and 255 in the place of counts: a canvas and many libraries have those. */
function checkCounts({ name, kind, hits }, mask) {
  const least = mask.find((count) => count < 0), most = mask.reduce((most, count) => Math.max(most, count), 0);
  if (least !== undefined) throw new TypeError(`${name} returned a mask with ${least}; a pixel is drawn at least 0 times`);
  if (kind === undefined && !hits && most > 1 && mask.every((count) => count === 0 || count === most))
    throw new TypeError(`${name} returned a mask of 0 and ${most}; a number says how often a pixel is drawn: ` +
      `return mask.map((v) => v > 0 ? 1 : 0), or pass hits: true if a pixel really is drawn ${most} times`);
}

/** Checks how often each pixel is drawn. */
function checkMask(judged, mask, [width, height], expected) {
  const size = width * height, { name } = judged;
  const all = (is) => Array.isArray(mask) && mask.every(is);
  const isBoolean = all((drawn) => typeof drawn === 'boolean');
  if (!isBoolean && !all(Number.isSafeInteger) && !(ArrayBuffer.isView(mask) && /^(Ui|I)nt/.test(mask.constructor.name)))
    throw new TypeError(`${name} returned ${describe(mask)}; expected ${expected}`);
  if (mask.length !== size)
    throw new TypeError(`${name} returned ${mask.length} pixels; expected ${size}: ${width} * ${height}, row by row`);
  if (!isBoolean) checkCounts(judged, mask);
  keep(judged, isBoolean ? 'booleans' : 'counts');
  return mask;
}

/** The rows of a list as text, their number first. */
function rows(judged, list, columns) {
  const wide = columns.split(' ').length;
  for (const row of list)
    if (row?.length !== wide || !Array.prototype.every.call(row, Number.isInteger))
      throw new TypeError(`${judged.name} returned [${row}] in its list; expected integers with the columns ${columns}`);
  keep(judged, 'a list');
  return `${list.length} ${Array.from(list, (row) => Array.prototype.join.call(row, ' ')).join(' ')}`;
}

const isList = (value) => Array.isArray(value) && !['boolean', 'number'].includes(typeof value[0]);

/** Runs of the same number above 0, which `of` makes of each number of a mask: row, first column, one past the last, the number. */
function runsOf(mask, width, of) {
  const runs = [];
  for (let y = 0, start = 0; start < mask.length; y++, start += width)
    for (let x = 0, first = 0, now = 0; x <= width; x++) {
      const next = x < width ? of(Number(mask[start + x])) : -1;
      if (next === now) continue;
      if (now > 0) runs.push([y, first, x, now]);
      [first, now] = [x, next];
    }
  return runs;
}

function coverage(judged, value, window) {
  if (isList(value)) return rows(judged, value, 'y x0 x1');
  const mask = checkMask(judged, value, window, 'a Uint8Array that counts how often each pixel is drawn, booleans, or a list of spans');
  const most = mask.reduce((most, count) => Math.max(most, Number(count)), 0);
  if (most > 2) {
    // Runs with their hits have a letter of their own.
    const counted = runsOf(mask, window[0], (count) => Math.min(count, MOST_HITS));
    return `H${counted.length} ${counted.flat().join(' ')}`;
  }
  // A pixel that is drawn twice is in two runs.
  const runs = [];
  for (let level = 1; level <= most; level++)
    for (const [y, first, end] of runsOf(mask, window[0], (count) => (count >= level ? 1 : 0))) runs.push(y, first, end);
  return `${runs.length / 3} ${runs.join(' ')}`;
}

/** Calls `draw` once for each pixel that is drawn, and again for one that is drawn more than once; returns how many calls that were. */
function drawn(mask, [width], draw) {
  let all = 0;
  for (let i = 0; i < mask.length; i++)
    for (let n = Math.min(Number(mask[i]), 2); n > 0; n--, all++) draw(i % width, Math.floor(i / width), i);
  return all;
}

function pixels(judged, value, window) {
  if (isList(value)) return rows(judged, value, 'x y');
  const mask = checkMask(judged, value, window, 'a list of pixels, a Uint8Array that counts how often each pixel is drawn, or booleans');
  const out = [];
  return `${drawn(mask, window, (x, y) => out.push(x, y))} ${out.join(' ')}`;
}

function fragments(judged, value, window) {
  const both = '{ mask, values }: a Uint8Array, and a Float64Array with z a b of each pixel';
  if (!value?.mask) throw new TypeError(`${judged.name} returned ${describe(value)}; expected ${both}`);
  const mask = checkMask(judged, value.mask, window, both), { values } = value;
  if (!ArrayBuffer.isView(values) || !/^Float/.test(values.constructor.name))
    throw new TypeError(`${judged.name} returned values of type ${describe(values)}; expected ${both}`);
  if (values.length !== 3 * mask.length)
    throw new TypeError(`${judged.name} returned ${values.length} values; expected ${3 * mask.length}: z a b of each pixel`);
  const out = [];
  return `${drawn(mask, window, (x, y, i) => out.push(x, y, ...values.subarray(3 * i, 3 * i + 3)))} ${out.join(' ')}`;
}

/** The points of a list of numbers, so many numbers each. */
const points = (numbers, wide) => Array.from({ length: numbers.length / wide }, (_, i) => numbers.slice(wide * i, wide * i + wide));

/** Reads a window and corners. */
const corners = (wide, round) => ([width, height, ...numbers]) =>
  [points(numbers.map(round), wide), [Number(width), Number(height)]];

/** Reads the contours of a polygon. */
function polygon([count, ...words]) {
  const numbers = words.map(Number);
  return [Array.from({ length: Number(count) }, () => points(numbers.splice(0, 2 * numbers.shift()), 2))];
}

function triangles(judged, value) {
  const expected = 'an array of triangles, each three points [x, y], or null for a polygon that is not taken';
  if (value === null) return null;
  if (!Array.isArray(value)) throw new TypeError(`${judged.name} returned ${describe(value)}; expected ${expected}`);
  const isPoint = (point) => point?.length === 2 && typeof point[0] === 'number' && typeof point[1] === 'number';
  for (const triangle of value)
    if (triangle?.length !== 3 || ![triangle[0], triangle[1], triangle[2]].every(isPoint))
      throw new TypeError(`${judged.name} returned the triangle ${JSON.stringify(triangle)}; expected ${expected}`);
  return `${value.length} ${value.flat(2).join(' ')}`;
}

/**
 * What judges functions of one kind: the letters of request and answer, what is declared, how a request is read, what checks
 * and writes an answer, and a first request.
 */
const judges = (call, [request, reply], capability, read, write, probe) => {
  const ask = (judged, words, where) => {
    const [shape, window] = read(words), given = window && [...window];
    let value;
    try { value = judged.fn(shape, given); } catch (error) {
      // A trace shows the last cause of an error.
      let last = error;
      while (last?.cause instanceof Error) last = last.cause;
      if (last instanceof Error && last.cause === undefined)
        last.cause = new Error(`rasterproof asked: ${JSON.stringify(shape)}${window ? `, window [${window}]` : ''}\n${where()}`);
      throw error;
    }
    if (given?.join() !== window?.join()) throw new TypeError(`${judged.name} changed its argument window to [${given}]; change a copy of it`);
    return write(judged, value, window);
  };
  return function assert(fn, { hits = false, ...options } = {}) {
    if (typeof fn !== 'function') throw new TypeError(`${call} takes a function; got ${describe(fn)}`);
    if (typeof hits !== 'boolean') throw new RangeError(`hits is ${hits}; expected true or false`);
    const judged = { fn, name: fn.name || 'function', kind: undefined, hits };
    const header = Object.entries({ cases: 50, ...options, hits: hits || undefined }).flatMap(([option, value]) =>
      [value].flat().filter((one) => one !== undefined).map((one) => `${option} ${one}`.replace(/\s+/g, ' ')));
    // What it returns for one case, in a window that is no square, says what can be seen in its answers.
    ask(judged, probe.split(' '), () => 'the first request, which is no generated case');
    const masked = { booleans: ' mask', counts: '' }[judged.kind];
    const words = masked === undefined ? '' : `${masked}${request === 'L' ? ' line-set' : ''}`;
    const hello = `HELLO 2 ${judged.name.replace(/[^!-~]+/g, '-')} ${capability} batch=1024${words}`;
    const begin = (...more) => `${[`call ${call}(${judged.name}`, ...header, ...more, hello].join('\n')}\n`;
    // The judge looks up a case, and judges nothing.
    const where = (words) => `for ${run(begin(`locate ${request} 1 ${words.join(' ')}`), () => '').said}`;
    const { status, said } = run(begin(), ([verb, id, ...words]) => {
      const answer = verb === request ? ask(judged, words, () => where(words)) : null;
      if (answer === null) return `E ${id} unsupported`;
      return answer[0] === 'H' ? `H ${id} ${answer.slice(1)}` : `${reply} ${id} ${answer}`;
    });
    if (status === 0) return;
    const error = status === 1 ? new AssertionError(said) : status === 2 ? new RangeError(said) : new Error(`rasterproof gave no verdict:\n${said}`);
    // The first line of the trace is that of the test.
    Error.captureStackTrace?.(error, assert);
    throw error;
  };
};

export const assertRasterizer = judges('assertRasterizer', 'TC', 'coverage', corners(2, Number), coverage, '8 6 1 1 6 1 1 6');
// A position of a line names the pixel that contains it.
export const assertLines = judges('assertLines', 'LP', 'line', corners(2, Math.floor), pixels, '8 6 1 1 6 4');
export const assertValues = judges('assertValues', 'IF', 'attributes', corners(6, Number), fragments,
  '8 6 1 1 0 1 0 0 6 1 0 1 1 0 1 6 1 1 0 1');
export const assertPartition = judges('assertPartition', 'YZ', 'partition', polygon, triangles, '1 3 0 0 4 0 0 4');
