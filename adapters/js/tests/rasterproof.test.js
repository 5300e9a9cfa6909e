// `node --test rasterproof.test.js` in a folder with these files and the installed package.

import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { test } from 'node:test';
import { AssertionError, assertLines, assertPartition, assertRasterizer, assertValues } from 'rasterproof';
import * as rasterproof from 'rasterproof';
import { edge, exact, fan, line, spans, strict, values } from './functions.js';

const RANGE = 'range=4096';

/** Judges 20 cases of each family, unless the options say otherwise. */
const judge = (fn, options, call = assertRasterizer) =>
  call(fn, { cases: 20, ...(call !== assertPartition && { declare: RANGE }), ...options });
/** The message of the judge, which has to say this. */
const fails = (pattern, ...judged) => {
  try { judge(...judged); } catch (error) {
    assert.ok(error instanceof AssertionError, error.stack);
    assert.match(error.message, pattern);
    return error.message;
  }
  return assert.fail('it passes');
};
/** The printed call is one that fails. */
const repeats = (said, fn) => {
  const call = new RegExp(`(assert\\w+)\\(${fn.name}, \\{ family: .*, case: .*\\}\\)`).exec(said);
  assert.throws(() => new Function(call[1], fn.name, call[0])(rasterproof[call[1]], fn), /is not right/);
};

test('right triangles', () => {
  for (const fn of [exact, spans, (...request) => Array.from(exact(...request), Boolean), (...request) => [...exact(...request)]]) judge(fn);
});

test('strict triangles', () => {
  const said = fails(/draws nothing on an edge/, strict);
  assert.match(said, /^Triangles: it samples at the pixel's centre/);
  assert.match(said, /to be judged by it: declare: 'rule=strict'/);
  repeats(said, strict);
  judge(strict, { declare: `${RANGE} rule=strict`, family: 'flat' });
});

test('the trace begins with the test', () => {
  const wrong = () => assertRasterizer(strict, { cases: 2, declare: RANGE });
  assert.throws(wrong, (error) => /^ +at wrong /.test(error.stack.slice(error.stack.indexOf(error.message) + error.message.length + 1)));
});

test('seed and family choose cases', () => {
  const asked = [1, 1, 2].map((seed) => {
    const seen = [];
    judge((corners, window) => { seen.push(corners); return exact(corners, window); }, { cases: 5, seed, family: ['tiny', 'uniform'] });
    return JSON.stringify(seen);
  });
  assert.equal(asked[0], asked[1]);
  assert.notEqual(asked[0], asked[2]);
});

test('doubles are seen', () => {
  fails(/pixels: [\d,]+ twice/, (...request) => exact(...request).map((count) => 2 * count), { cases: 5, family: 'uniform', hits: true });
});

test('values', () => {
  judge(values(false), {}, assertValues);
  fails(/linearly on the screen and ignores w/, values(true), {}, assertValues);
});

test('lines', () => {
  const nearest = line(0);
  const mask = (ends, [width, height]) => {
    const mask = new Uint8Array(width * height);
    for (const [x, y] of nearest(ends, [width, height])) mask[y * width + x]++;
    return mask;
  };
  for (const fn of [nearest, mask]) judge(fn, {}, assertLines);
  fails(/the last pixel is not drawn/, line(1), {}, assertLines);
});

test('polygons', () => {
  const said = fails(/outside: the smallest polygon that was found\n +\[\[\[/, fan, { family: 'Star' }, assertPartition);
  assert.match(said, /fan speaks version 2: partition fill-rule=even-odd/);
  repeats(said, fan);
  // A convex polygon is a fan, and a polygon that is not taken is not judged.
  const isConvex = (p) => [1, -1].some((way) => p.every((b, i) => way * edge(p.at(i - 1), b, ...p[(i + 1) % p.length]) > 0));
  judge((contours) => (contours.length === 1 && isConvex(contours[0]) ? fan(contours) : null), { family: 'SnappedCircle' }, assertPartition);
  // Holes lie within the first contour.
  let holes = 0;
  const watched = ([outer, ...inner]) => {
    const range = [0, 1].map((axis) => [Math.min, Math.max].map((most) => most(...outer.map((point) => point[axis]))));
    for (const point of inner.flat()) assert.ok(point.every((v, axis) => v >= range[axis][0] && v <= range[axis][1]), `${point}`);
    holes += inner.length;
    return [];
  };
  fails(/gap/, watched, { family: 'Islands' }, assertPartition);
  assert.ok(holes > 20, `${holes} holes`);
  assert.throws(() => judge(() => null, {}, assertPartition), /RangeError: .*accepts none of the polygons/);
});

test('a limited time is kept', () => {
  let calls = 0;
  judge((...request) => { calls++; return exact(...request); }, { cases: 20_000, seconds: 0.2 });
  assert.ok(calls > 10 && calls < 400_000, `${calls} calls, of more than a million`);
});

test('an error of the function carries its case', () => {
  const bad = new Set();
  const once = (corners, window) => {
    const key = JSON.stringify(corners);
    if (bad.has(key) || (bad.size === 0 && window[0] > 40)) {
      bad.add(key);
      throw new EvalError('mine');
    }
    return exact(corners, window);
  };
  const thrown = (judged) => { try { judged(); } catch (error) { return error; } return assert.fail('it passes'); };
  const error = thrown(() => judge(once, { family: 'uniform', seed: 3 }));
  assert.match(error.cause.message, /^rasterproof asked: \[\[.*\]\], window \[\d+,\d+\]\nfor family uniform, case \d+, seed 3\n/);
  // The printed call throws the same.
  const call = /repeat with: (.*)/.exec(error.cause.message)[1];
  assert.throws(() => new Function('assertRasterizer', 'once', call)(assertRasterizer, once), EvalError);
  const inner = new Error('inner');
  const wraps = () => { throw new Error('outer', { cause: inner }); };
  thrown(() => judge(wraps, {}, assertPartition));
  assert.match(inner.cause.message, /the first request, which is no generated case/);
});

test('misuses are refused in seconds', async (t) => {
  const times = (factor) => (...request) => exact(...request).map((count) => factor * count);
  // A function that answers otherwise from its second call on.
  const then = (first, other, calls = 0) => (...request) => (calls++ ? other : first)(...request);
  const range = 'expected a whole number from';
  const most = 2n ** 64n - 1n;
  const misuses = [
    ['TypeError', /a mask of 0 and 255; .*return mask.map.*or pass hits: true/, times(255)],
    ['TypeError', /a mask of 0 and 2; /, times(2)],
    ['TypeError', /a mask of 0 and 255; /, (...request) => Array.from(times(255)(...request))],
    ['TypeError', /a mask of 0 and 255; /, (...request) => new Uint8ClampedArray(times(255)(...request))],
    ['AssertionError', /answer: +H 1 \d+ {2}\d+ \d+ \d+ 255/, times(255), { hits: true }],
    ['AssertionError', /255/, then(exact, times(255))],
    ['AssertionError', /hits: true }\)/, times(4), { hits: true, family: 'uniform' }],
    ['RangeError', /hits is 1; expected true or false/, exact, { hits: 1 }],
    ['TypeError', /returned Float64Array; expected a Uint8Array/, (...request) => Float64Array.from(exact(...request))],
    ['TypeError', /returned Array; expected a Uint8Array/, () => Array(48).fill(0.5)],
    ['TypeError', /a mask with -1; a pixel is drawn at least 0 times/, () => new Int8Array(48).fill(-1)],
    ['TypeError', /returned \[0,1\] in its list; expected integers with the columns y x0 x1/, () => [[0, 1]]],
    ['TypeError', /returned \[0.5,0,1\] in its list/, () => [[0.5, 0, 1]]],
    ['TypeError', /returned a list; in an earlier call counts/, then(exact, spans)],
    ['TypeError', /returned an iterator, as of a generator/, function* rows(...request) { yield* spans(...request); }],
    ['TypeError', /changed its argument window to \[0,0\]/, (corners, window) => { const mask = exact(corners, window); window.fill(0); return mask; }],
    ['TypeError', /returned Promise; expected/, async (...request) => exact(...request)],
    ['TypeError', /returned undefined; expected/, () => undefined],
    ['TypeError', /returned 8 pixels; expected 48: 8 \* 6, row by row/, () => new Uint8Array(8)],
    ['TypeError', /returned Uint8Array; expected \{ mask, values \}/, exact, {}, assertValues],
    ['TypeError', /returned values of type undefined; expected/, (...request) => ({ mask: exact(...request) }), {}, assertValues],
    ['TypeError', /returned 48 values; expected 144/, () => ({ mask: new Uint8Array(48), values: new Float32Array(48) }), {}, assertValues],
    ['TypeError', /returned the triangle \[\[0,1\]\]; expected an array/, () => [[[0, 1]]], {}, assertPartition],
    ['TypeError', /assertRasterizer takes a function; got null/, null],
    ['TypeError', /assertRasterizer takes a function; got 3/, 3],
    ['EvalError', /mine/, () => { throw new EvalError('mine'); }],
    ['EvalError', /mine/, then(exact, () => { throw new EvalError('mine'); })],
    ['RangeError', /declare: 'rule=topleft' is not understood; did you mean 'rule=top-left'/, exact, { declare: 'rule=topleft' }],
    ['RangeError', /declare: 'rul=strict' is not understood; did you mean 'rule=strict'/, exact, { declare: 'rul=strict' }],
    ['RangeError', /declare: 'range=0' is not understood; expected range=N, a whole/, exact, { declare: 'range=0' }],
    ...[0, -1, 1.5, true, NaN, 'x'].map((cases) => ['RangeError', RegExp(`^cases is ${cases}; ${range} 1 to ${most}$`), exact, { cases }]),
    ...[-7, 2n ** 70n].map((seed) => ['RangeError', RegExp(`^seed is ${seed}; ${range} 0 to ${most}$`), exact, { seed }]),
    ['RangeError', /seconds is 0; expected a number above 0/, exact, { seconds: 0 }],
    ['RangeError', /^no family is flatt; expected .*flat/, exact, { family: 'flatt' }],
    ['RangeError', /no case was judged/, exact, { family: 'line-axis' }],
    ['RangeError', /^no option is case_; expected cases, seed/, exact, { case_: 1 }],
  ];
  assert.equal(misuses.length, 42);
  for (const [name, message, fn, options, call] of misuses)
    await t.test(`${message}`, (t) => {
      // Of the processor: other programs may keep the clock waiting.
      const begin = process.cpuUsage();
      try { judge(fn, { cases: 100, ...options }, call); assert.fail('it passes'); } catch (error) {
        assert.deepEqual([error.name, message.test(error.message)], [name, true], error.stack);
        const { user, system } = process.cpuUsage(begin), seconds = (user + system) / 1e6;
        t.diagnostic(`${seconds.toFixed(2)} s  ${name}: ${error.message.split('\n')[0].slice(0, 110)}`);
        assert.ok(seconds < 10, `${seconds} s`);
      }
    });
});

test('what is exported, and how CommonJS gets it', () => {
  assert.throws(() => createRequire(import.meta.url)('rasterproof'), /import\(\)/);
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
