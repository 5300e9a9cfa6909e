// Headless Chromium: `canvas` draws with CanvasRenderingContext2D.fill(), `webgl` (the default) with WebGL 2's
// drawArrays(TRIANGLES) and (LINES) without antialiasing. Needs no package: it speaks to the
// browser over --remote-debugging-pipe. CHROMIUM names the browser if it is in none of the usual places.
//
// A canvas is always antialiased, so it has no line of pixels, and a pixel counts as drawn from alpha 128 on.
// WebGL's y axis points up, and it promises 1 / 2^SUBPIXEL_BITS px: both are declared.
const { spawn } = require('child_process');
const fs = require('fs'), path = require('path');

const MODE = process.argv[2] === 'canvas' ? 'canvas' : 'webgl';
const MOST_SIDE = 1024, MOST_BYTES = 65536, BATCH = 64;
const PLACES = ['/usr/lib/chromium/chromium-headless-shell', '/usr/bin/chromium', '/usr/bin/chromium-browser',
  '/usr/bin/google-chrome', '/Applications/Google Chrome.app/Contents/MacOS/Google Chrome'];

// ---- in the page ----

function page(MODE) {
  const canvas = document.createElement('canvas');
  const shader = (gl, kind, source) => {
    const made = gl.createShader(kind);
    gl.shaderSource(made, source);
    gl.compileShader(made);
    return made;
  };
  function webgl() {
    const gl = canvas.getContext('webgl2', { antialias: false });
    const program = gl.createProgram();
    const place = 'attribute vec2 a; void main() { gl_Position = vec4(a, 0, 1); }';
    gl.attachShader(program, shader(gl, gl.VERTEX_SHADER, place));
    gl.attachShader(program, shader(gl, gl.FRAGMENT_SHADER, 'void main() { gl_FragColor = vec4(1); }'));
    gl.linkProgram(program);
    gl.useProgram(program);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
    const draw = (v, width, height) => {
      const ndc = v.map((value, i) => (i % 2 ? 1 - (value / height) * 2 : (value / width) * 2 - 1));
      gl.viewport(0, 0, width, height);
      gl.clear(gl.COLOR_BUFFER_BIT);
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(ndc), gl.STREAM_DRAW);
      gl.drawArrays(v.length === 4 ? gl.LINES : gl.TRIANGLES, 0, v.length / 2);
      const rgba = new Uint8Array(width * height * 4);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
      return (x, y) => rgba[((height - 1 - y) * width + x) * 4 + 3] > 127;
    };
    return { draw, bits: gl.getParameter(gl.SUBPIXEL_BITS) };
  }
  function flat() {
    const context = canvas.getContext('2d', { willReadFrequently: true });
    const draw = (v, width, height) => {
      context.clearRect(0, 0, width, height);
      context.beginPath();
      for (let i = 0; i < v.length; i += 2) context.lineTo(v[i], v[i + 1]);
      context.fill();
      const rgba = context.getImageData(0, 0, width, height).data;
      return (x, y) => rgba[(y * width + x) * 4 + 3] > 127;
    };
    return { draw, bits: 8 };
  }
  const { draw, bits } = MODE === 'webgl' ? webgl() : flat();
  const answer = ([verb, id, width, height, v]) => {
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    const drawn = draw(v, width, height), found = [];
    for (let y = 0; y < height; y++) {
      for (let x = 0; x < width; x++) {
        if (!drawn(x, y)) continue;
        const first = x;
        if (verb === 'T') while (x + 1 < width && drawn(x + 1, y)) x++;
        found.push(verb === 'T' ? `${y} ${first} ${x + 1}` : `${x} ${y}`);
      }
    }
    return [verb === 'T' ? 'C' : 'P', id, found.length, ...found].join(' ');
  };
  window.answers = (requests) => requests.map(answer);
  return bits;
}

// ---- the browser ----

const find = () => process.env.CHROMIUM || PLACES.find((place) => fs.existsSync(place));

// A browser with these options. What is returned calls a method of the DevTools protocol; `heard` takes what the browser says unasked.
function start(options, heard = () => {}) {
  const browser = find();
  if (!browser) throw new Error('no Chromium found; set CHROMIUM to its program');
  // Below target/, so that a program that is killed leaves nothing elsewhere.
  const scratch = path.join(__dirname, '..', 'target', 'adapters');
  fs.mkdirSync(scratch, { recursive: true });
  const profile = fs.mkdtempSync(path.join(scratch, 'chromium-'));
  const args = ['--headless', '--remote-debugging-pipe', `--user-data-dir=${profile}`, ...options];
  if (process.getuid() === 0) args.push('--no-sandbox');
  const env = { ...process.env, TMPDIR: profile };
  // In a group of its own, so that its helpers end with it and write no more.
  const child = spawn(browser, args, { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'], env, detached: true });
  const waiting = new Map();
  let text = '', count = 0;
  child.stdio[4].setEncoding('utf8').on('data', (chunk) => {
    const messages = (text + chunk).split('\0');
    text = messages.pop();
    for (const message of messages.map(JSON.parse)) {
      if (message.method) {
        heard(message);
        continue;
      }
      const [done, failed] = waiting.get(message.id);
      if (message.error) failed(new Error(message.error.message));
      else done(message.result);
      waiting.delete(message.id);
    }
  });
  child.on('exit', () => process.exit(1));
  process.on('exit', () => {
    process.kill(-child.pid, 'SIGKILL');
    fs.rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
  });
  for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => process.exit(1));
  return (method, params, sessionId) => new Promise((done, failed) => {
    waiting.set(++count, [done, failed]);
    child.stdio[3].write(JSON.stringify({ id: count, method, params, sessionId }) + '\0');
  });
}

// ---- the protocol ----

// The request as the page takes it, or the refusal as text.
function read(words, grid) {
  const [verb, id = '-'] = words, count = verb === 'T' ? 6 : 4;
  if (verb !== 'T' && (verb !== 'L' || MODE === 'canvas')) return `E ${id} unsupported`;
  if (words.length !== count + 4) return `E ${id} ${verb} takes id width height and ${count} numbers`;
  const [width, height, ...v] = words.slice(2).map(Number);
  if (![width, height].every((n) => Number.isInteger(n) && n >= 1 && n <= MOST_SIDE)) {
    return `E ${id} the window must be from 1x1 to ${MOST_SIDE}x${MOST_SIDE}`;
  }
  if (!v.every((n) => n >= -(2 ** 31) && n < 2 ** 31)) return `E ${id} a coordinate is not a number within 2^31 px`;
  if (!v.every((n) => Number.isInteger(n * grid))) return `E ${id} unsupported: off the declared grid`;
  // A line goes from centre to centre.
  return [verb, id, width, height, verb === 'L' ? v.map((n) => Math.floor(n) + 0.5) : v];
}

async function main() {
  const ask = start(['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--force-device-scale-factor=1']);
  const { targetId } = await ask('Target.createTarget', { url: 'about:blank' });
  const { sessionId } = await ask('Target.attachToTarget', { targetId, flatten: true });
  const evaluate = async (expression) => {
    const { result, exceptionDetails } = await ask('Runtime.evaluate', { expression, returnByValue: true }, sessionId);
    if (exceptionDetails) throw new Error(exceptionDetails.exception.description);
    return result.value;
  };
  const grid = 2 ** Math.min(8, await evaluate(`(${page})('${MODE}')`));
  const version = (await ask('Browser.getVersion')).product.replace(/^.*\//, '');
  const known = `chromium-${version}-${MODE} coverage${MODE === 'webgl' ? ' line' : ''}`;
  const declared = `grid=${grid} ${MODE === 'webgl' ? 'yup mask line-set' : 'mask'} batch=${BATCH}`;
  const hello = { 1: `HELLO 1 ${known}`, 2: `HELLO 2 ${known} window=${MOST_SIDE}x${MOST_SIDE} ${declared}` };
  const reply = (line) => {
    if (line.length > MOST_BYTES) return `E - a request has at most ${MOST_BYTES} bytes`;
    const words = line.trim().split(/[ \t\r\v\f]+/);
    if (words[0] !== 'HELLO') return read(words, grid);
    return (words.length === 2 && hello[words[1]]) || 'E - say HELLO 1 or HELLO 2';
  };
  const take = async (lines) => {
    const replies = lines.map(reply), requests = replies.filter(Array.isArray);
    const drawn = requests.length ? await evaluate(`answers(${JSON.stringify(requests)})`) : [];
    process.stdout.write(replies.map((text) => (Array.isArray(text) ? drawn.shift() : text) + '\n').join(''), 'latin1');
  };
  let rest = '';
  for await (const chunk of process.stdin.setEncoding('latin1')) {
    const lines = (rest + chunk).split('\n');
    // Of a line that is too long no more is kept than tells that it is.
    rest = lines.pop().slice(0, MOST_BYTES + 1);
    const spoken = lines.filter((line) => line.trim());
    for (let i = 0; i < spoken.length; i += BATCH) await take(spoken.slice(i, i + BATCH));
  }
  if (rest.trim()) await take([rest]);
  process.exit(0);
}

// The checks of pages start their browser by this file, too.
module.exports = { find, start };

if (require.main === module) {
  main().catch((error) => {
    console.error(error);
    process.exit(1);
  });
}
