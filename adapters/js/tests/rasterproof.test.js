// `node --test rasterproof.test.js` in a folder with this file, example.test.js and the installed package.

import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { test } from 'node:test';
import { AssertionError, assertLines, assertPartition, assertRasterizer, assertValues } from 'rasterproof';
import * as rasterproof from 'rasterproof';

const RANGE = 'range=4096';
const edge = (p, q, x, y) => (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);

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
const exact = filled((e, dx, dy) => e > 0 || (e === 0 && (dy < 0 || (dy === 0 && dx > 0))));
const strict = filled((e) => e > 0);

const spans = (corners, window) => {
  const mask = exact(corners, window), list = [];
  for (let y = 0; y < window[1]; y++) {
    const row = mask.subarray(y * window[0], (y + 1) * window[0]);
    if (row.includes(1)) list.push([y, row.indexOf(1), row.lastIndexOf(1) + 1]);
  }
  return list;
};

const values = (flat) => function values(corners, [width, height]) {
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

/** A tie goes toward larger coordinates. */
const line = (kept) => function dda([[x0, y0], [x1, y1]], [width, height]) {
  const n = Math.max(Math.abs(x1 - x0), Math.abs(y1 - y0)), list = [];
  const at = (i, d) => Math.floor((2 * i * d + n) / (2 * n || 1));
  for (let i = 0; i <= n; i++) {
    const [x, y] = [x0 + at(i, x1 - x0), y0 + at(i, y1 - y0)];
    if (x >= 0 && y >= 0 && x < width && y < height) list.push([x, y]);
  }
  return kept(list);
};

const message = (call) => {
  try { call(); } catch (error) { return error instanceof AssertionError ? error.message : assert.fail(error); }
  return assert.fail('it passes');
};

test('right triangles', () => {
  const booleans = (...request) => Array.from(exact(...request), Boolean);
  for (const fn of [exact, spans, booleans]) assertRasterizer(fn, { cases: 20, declare: RANGE });
});

test('strict triangles', () => {
  const said = message(() => assertRasterizer(strict, { cases: 20, declare: RANGE }));
  assert.match(said, /draws nothing on an edge/);
  assert.match(said, /declare: 'rule=strict'/);
  // The printed call is one that fails with that case, and what is declared is right.
  const call = /assertRasterizer\(filled, \{ family: .*\}\)/.exec(said)[0];
  const again = message(() => new Function('assertRasterizer', 'filled', call)(assertRasterizer, strict));
  assert.match(again, /is not right/);
  assertRasterizer(strict, { cases: 20, declare: `${RANGE} rule=strict`, family: 'flat' });
});

test('the trace begins with the test', () => {
  const wrong = () => assertRasterizer(strict, { cases: 2, declare: RANGE });
  assert.throws(wrong, (error) => /^ +at wrong /.test(error.stack.slice(error.stack.indexOf(error.message) + error.message.length + 1)));
});

test('seed and family choose cases', () => {
  const asked = [1, 1, 2].map((seed) => {
    const seen = [];
    const watched = (corners, window) => { seen.push(corners); return exact(corners, window); };
    assertRasterizer(watched, { cases: 5, seed, family: ['tiny', 'uniform'], declare: RANGE });
    return JSON.stringify(seen);
  });
  assert.equal(asked[0], asked[1]);
  assert.notEqual(asked[0], asked[2]);
});

test('doubles are seen', () => {
  const twice = (...request) => exact(...request).map((count) => 2 * count);
  assert.match(message(() => assertRasterizer(twice, { cases: 5, declare: RANGE, family: 'uniform' })), /pixels: [\d,]+ twice/);
});

test('values', () => {
  assertValues(values(false), { cases: 20, declare: RANGE });
  assert.match(message(() => assertValues(values(true), { cases: 20, declare: RANGE })), /linearly on the screen and ignores w/);
});

test('lines', () => {
  const nearest = line((list) => list), one = { cases: 20, declare: RANGE, family: 'line-axis' };
  assertLines(nearest, one);
  assertLines((ends, [width, height]) => {
    const mask = new Uint8Array(width * height);
    for (const [x, y] of nearest(ends, [width, height])) mask[y * width + x]++;
    return mask;
  }, one);
  assert.match(message(() => assertLines(line((list) => list.slice(0, -1)), { ...one, family: undefined })), /the last pixel is not drawn/);
});

test('polygons', () => {
  const fan = ([outer, ...holes]) => (holes.length ? null : outer.slice(2).map((c, i) => [outer[0], outer[i + 1], c]));
  const said = message(() => assertPartition(fan, { cases: 20, family: 'Star' }));
  assert.match(said, /fan speaks version 2: partition fill-rule=even-odd/);
  assert.match(said, /outside: the smallest polygon that was found\n +\[\[\[/);
  const call = /assertPartition\(fan, \{ family: .*\}\)/.exec(said)[0];
  assert.match(message(() => new Function('assertPartition', 'fan', call)(assertPartition, fan)), /1 polygons are not covered/);
  // A convex polygon is a fan, and a polygon that is not taken is not judged.
  const isConvex = (p) => p.every((b, i) => edge(p.at(i - 1), b, ...p[(i + 1) % p.length]) > 0);
  assertPartition((contours) => (contours.length === 1 && isConvex(contours[0]) ? fan(contours) : null), { family: 'SnappedCircle' });
  // Holes lie within the first contour.
  let holes = 0;
  const watched = ([outer, ...inner]) => {
    const range = [0, 1].map((axis) => [Math.min, Math.max].map((most) => most(...outer.map((point) => point[axis]))));
    for (const point of inner.flat()) assert.ok(point.every((v, axis) => v >= range[axis][0] && v <= range[axis][1]), `${point}`);
    holes += inner.length;
    return [];
  };
  message(() => assertPartition(watched, { cases: 20, family: 'Islands' }));
  assert.ok(holes > 20, `${holes} holes`);
  assert.throws(() => assertPartition(() => null, { cases: 5 }), /gave no verdict:\n.*accepts none of the polygons/);
  assert.throws(() => assertPartition(() => [[[0, 1]]]), /TypeError: function returned the triangle \[\[0,1\]\]; expected an array/);
  assert.throws(() => assertPartition(fan, { cases: 0 }), /RangeError: no case/);
});

test('what is returned is checked', () => {
  const wrong = (fn, pattern, judge = assertRasterizer) => assert.throws(() => judge(fn, { declare: RANGE }), (error) => {
    assert.ok(error instanceof TypeError, error.stack);
    assert.match(error.message, pattern);
    return true;
  });
  wrong(() => new Uint8Array(8), /returned 8 pixels; expected 48: 8 \* 6, row by row/);
  wrong(() => new Float64Array(48), /returned Float64Array; expected a Uint8Array/);
  wrong(() => undefined, /returned undefined; expected/);
  wrong(async () => new Uint8Array(48), /returned Promise; expected/);
  wrong(() => new Int8Array(48).fill(-1), /a mask with -1; a pixel is drawn at least 0 times/);
  wrong(() => [[0, 1]], /returned \[0,1\] in its list; expected integers with the columns y x0 x1/);
  wrong(() => [[0.5, 0, 1]], /returned \[0.5,0,1\] in its list/);
  let calls = 0;
  wrong((corners, window) => (calls++ ? spans : exact)(corners, window), /returned a list; in an earlier call counts/);
  wrong(exact, /returned Uint8Array; expected \{ mask, values \}/, assertValues);
  wrong((...request) => ({ mask: exact(...request) }), /returned values of type undefined; expected/, assertValues);
  wrong(() => ({ mask: new Uint8Array(48), values: new Float32Array(48) }), /returned 48 values; expected 144/, assertValues);
  assert.throws(() => assertRasterizer(3), /TypeError: assertRasterizer takes a function; got 3/);
});

test('nothing to judge', () => {
  for (const cases of [0, -1, 1.5, '7', NaN]) assert.throws(() => assertRasterizer(exact, { cases }), /RangeError: no case would be judged/);
  assert.throws(() => assertRasterizer(exact, { case_: 1 }), /TypeError: assertRasterizer has no option case_; expected cases, seed/);
  assert.throws(() => assertRasterizer(exact, { seed: '1' }), /TypeError: assertRasterizer cannot take 1 for seed/);
  assert.throws(() => assertRasterizer(exact, { family: 'nosuch' }), /Error: rasterproof gave no verdict:\nfamily cannot be nosuch/);
  assert.throws(() => assertRasterizer(exact, { family: 'line-axis' }), /no case was judged/);
});

test('a limited time is kept', () => {
  let calls = 0;
  const counted = (corners, window) => { calls++; return exact(corners, window); };
  assertRasterizer(counted, { cases: 20_000, seconds: 0.2, declare: RANGE });
  assert.ok(calls > 10 && calls < 400_000, `${calls} calls, of more than a million`);
});

test('an error of the function comes through', () => {
  let calls = 0;
  const late = (corners, window) => {
    if (calls++) throw new EvalError('mine');
    return exact(corners, window);
  };
  assert.throws(() => assertRasterizer(late, { declare: RANGE }), /EvalError: mine/);
});

test('the example fails with the message', () => {
  // A test of its own, and no part of this one.
  const { NODE_TEST_CONTEXT, ...env } = process.env;
  const { stdout, status } = spawnSync(process.execPath, ['--test', 'example.test.js'], { encoding: 'utf8', env });
  assert.equal(status, 1);
  assert.match(stdout, /draws\s+nothing on an edge: neighbours leave holes/);
  assert.deepEqual(Object.keys(rasterproof), ['AssertionError', 'assertLines', 'assertPartition', 'assertRasterizer', 'assertValues']);
});

const chromium = ['chromium', 'chromium-browser', 'google-chrome'].find((name) => !spawnSync(name, ['--version']).error);
test('a page judges its canvas', { skip: chromium ? false : 'there is no Chromium' }, async () => {
  const folder = new URL('./node_modules/rasterproof/', import.meta.url);
  const types = { html: 'text/html', js: 'text/javascript', wasm: 'application/wasm' };
  const tell = "<script>setInterval(() => said.textContent.startsWith('judging') || fetch('/said', { method: 'POST', body: said.textContent }), 50)</script>";
  let server, browser;
  const said = new Promise((tells) => {
    server = createServer(async (request, response) => {
      const name = request.url.split('?')[0].slice(1), end = name.split('.').pop();
      if (request.method === 'POST') tells(await request.setEncoding('utf8').toArray());
      response.setHeader('content-type', types[end] ?? 'text/plain');
      response.write(types[end] ? readFileSync(new URL(name, folder)) : '');
      response.end(end === 'html' ? tell : '');
    }).listen(0, '127.0.0.1', () => {
      const page = `http://127.0.0.1:${server.address().port}/examples/canvas.html?cases=4`;
      const profile = `--user-data-dir=${new URL('./chromium', import.meta.url).pathname}`;
      browser = spawn(chromium, ['--headless', '--no-sandbox', '--disable-gpu', '--remote-debugging-port=0', profile, page]);
    });
    setTimeout(tells, 120000, ['the page has said nothing']).unref();
  });
  const text = (await said).join('');
  browser.kill();
  server.closeAllConnections();
  server.close();
  assert.match(text, /canvas2d speaks version 2: coverage .* mask/);
  assert.match(text, /repeat with: assertRasterizer\(canvas2d, \{ family: /);
});
