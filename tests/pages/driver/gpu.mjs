// What checks of the page for GPUs have in common.

import assert from 'node:assert/strict';

/** Without a card Chromium draws WebGL by SwiftShader, and WebGPU where it is told to. */
export const SWIFTSHADER = ['--disable-gpu-sandbox', '--enable-unsafe-swiftshader', '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader'];

/**
 * The faults with the check that finds them, its batch, and its word for WebGL 2 and for WebGPU: what the specification leaves open
 * is found, and called free.
 */
export const PLANTS = [
  ['moved', 'lattice', 0, ['allowed', 'allowed']],
  ['coarse', 'lattice', 0, ['outside', 'allowed']],
  ['nudged', 'coverage', 0, ['outside', 'outside']],
  ['dropped', 'coverage', 3, ['outside', 'outside']],
  ['twice', 'coverage', 0, ['outside', 'outside']],
  ['nudged', 'reach', 0, ['outside', 'outside']],
  ['twice', 'tiling', 0, ['outside', 'outside']],
  ['first-corner', 'tiling', 0, ['outside', 'allowed']],
  ['first-corner', 'order', 0, ['outside', 'outside']],
  ['winding', 'facing', 0, ['outside', 'outside']],
  ['lines-moved', 'lines', 0, ['outside', 'allowed']],
  ['farther', 'depth', 0, ['outside', 'outside']],
  ['farther', 'depth', 1, ['outside', 'outside']],
  ['w-ignored', 'values', 0, ['outside', 'outside']],
  ['no-near-plane', 'near-plane', 0, ['outside', 'outside']],
  ['samples-moved', 'samples', 0, ['allowed', 'outside']],
];

const numbered = (check, count) => Array.from({ length: count }, (_, number) => [check, number]);

/** One batch of each check, each family of coverage, and of what a design chose, the first batches. */
export const PARTS = [
  ...['lattice', 'reach', 'tiling', 'order', 'facing', 'lines', 'depth', 'values', 'samples', 'twice'].map((check) => [check, 0]),
  ...numbered('coverage', 13),
  ['reach', 10], ['lines', 2], ['depth', 1], ['values', 3],
  ...numbered('near-plane', 4),
];

/**
 * For the page: plants a fault between the judge and the device, and takes back the one that was planted before. Faults of positions change a
 * vertex, given {v, at, side, index, kind, name, move, step}, as a wrong vertex stage would.
 */
function plant(fault) {
  const POSITIONS = {
    moved: ({ move }) => move(1 / 256, 1 / 256),
    nudged: ({ move, step }) => move(step, step),
    'samples-moved': ({ move, kind }) => kind === 'samples' && move(1 / 16, 0),
    'first-corner': ({ move, step, index, kind }) => kind !== 'lines' && index % 3 === 0 && move(step, 0),
    'lines-moved': ({ move, kind }) => kind === 'lines' && move(2, 0),
    coarse: ({ v, at, side }) => {
      for (const axis of [0, 1]) v[at + axis] = (Math.round((v[at + axis] / v[at + 3]) * side * 4) / (side * 4)) * v[at + 3];
    },
    'w-ignored': ({ v, at }) => {
      const w = v[at + 3];
      if (w > 0) for (const i of [0, 1, 2, 3]) v[at + i] /= w;
    },
    'no-near-plane': ({ v, at, name }) => { v[at + 2] = Math.max(v[at + 2], name === 'webgl2' ? -v[at + 3] : 0); },
    // Smaller than half a square pixel.
    dropped: ({ v, at, index, side, kind }) => {
      if (kind === 'lines' || index % 3 !== 0) return;
      const [a, b, c] = [0, 6, 12].map((next) => [v[at + next] / v[at + next + 3], v[at + next + 1] / v[at + next + 3]]);
      const twice = Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) * (side / 2) ** 2;
      if (twice < 1) v.copyWithin(at + 6, at, at + 6);
    },
  };
  const spoil = POSITIONS[fault];
  const spoiled = ({ vertices, side, kind }, { name, bits }) => {
    const v = numbers(vertices);
    for (let at = 0, index = 0; at < v.length; at += 6, index += 1) {
      const move = (x, y) => {
        v[at] += ((2 * x) / side) * v[at + 3];
        v[at + 1] += ((name === 'webgl2' ? 2 : -2) * y / side) * v[at + 3];
      };
      spoil({ v, at, index, side, kind, name, move, step: 2 ** -Math.min(bits ?? 4, 8) });
    }
    return new TextDecoder().decode(base64(new Uint8Array(v.buffer)));
  };

  window.takeBack?.();
  const before = [];
  window.takeBack = () => { for (const [of, name, value] of before) of[name] = value; };
  /** Calls another function in the place of a method, which is given what it replaces. */
  const instead = (of, name, make) => {
    if (!of) return;
    const old = of[name];
    before.push([of, name, old]);
    of[name] = function replaced(...values) { return make.call(this, (...all) => old.apply(this, all), ...values); };
  };
  const { WebGL2RenderingContext: Gl, GPUDevice: Device, GPURenderPassEncoder: Pass, GPUCommandEncoder: Encoder, GPUAdapter: Adapter } = window;
  if (fault === 'twice') {
    instead(Gl.prototype, 'drawArrays', function twice(_, mode, first, count) { this.drawArraysInstanced(mode, first, count, 2); });
    instead(Pass?.prototype, 'draw', (draw, count, times, first = 0) => draw(count, 2, first));
  }
  if (fault === 'winding') {
    instead(Gl.prototype, 'cullFace', (cull) => cull(Gl.FRONT));
    instead(Device?.prototype, 'createRenderPipeline', (make, { primitive, ...more }) => (
      make({ ...more, primitive: { ...primitive, cullMode: primitive.cullMode === 'back' ? 'front' : 'none' } })));
  }
  if (fault === 'farther') {
    instead(Gl.prototype, 'depthFunc', (set) => set(Gl.GREATER));
    instead(Gl.prototype, 'clearDepth', (set) => set(0));
    instead(Device?.prototype, 'createRenderPipeline', (make, { depthStencil, ...more }) => (
      make({ ...more, ...(depthStencil && { depthStencil: { ...depthStencil, depthCompare: 'greater' } }) })));
    instead(Encoder?.prototype, 'beginRenderPass', (begin, { depthStencilAttachment: depth, ...more }) => (
      begin({ ...more, ...(depth && { depthStencilAttachment: { ...depth, depthClearValue: 0 } }) })));
  }
  // Noise against fingerprinting: pixels that differ from one drawing to the next, or slightly in every drawing.
  let pictures = 0;
  if (fault === 'noise' || fault === 'faint-noise') {
    instead(window, 'hits', (read, bytes, ...more) => {
      pictures += 1;
      const first = bytes.findIndex((byte) => byte > 0);
      if (fault === 'noise' && pictures % 2 === 0 && first >= 0) bytes[first] = 0;
      if (fault === 'faint-noise') for (let at = 0; at < bytes.length; at += 97) if (bytes[at] > 0) bytes[at] ^= 1;
      return read(bytes, ...more);
    });
  }
  // The interface goes away before its second picture, once.
  const isLost = {};
  let lose;
  if (fault === 'lost') {
    instead(HTMLCanvasElement.prototype, 'getContext', (get, ...values) => {
      const context = get(...values), extension = context?.getExtension?.('WEBGL_lose_context');
      if (extension) lose = () => extension.loseContext();
      return context;
    });
    instead(Adapter?.prototype, 'requestDevice', async (get) => {
      const device = await get();
      lose = () => device.destroy();
      return device;
    });
  }
  for (const name of Object.keys(APIS)) {
    instead(APIS, name, async (open) => {
      const api = await open();
      if (api.refused) return api;
      const { draw } = api;
      let drawn = 0;
      api.draw = async (batch) => {
        drawn += 1;
        if (fault === 'lost' && drawn === 2 && !isLost[name]) {
          isLost[name] = true;
          lose();
        }
        return draw(spoil ? { ...batch, vertices: spoiled(batch, api) } : batch);
      };
      return api;
    });
  }
}

/** Plants a fault on the page, or none. */
export const plantOn = (tab, fault) => tab.value(plant, fault);

/** Judges with a fault, or none; the rows of each interface as {check: [word, sentence]}. */
export async function rows(tab, fault, options) {
  await plantOn(tab, fault);
  await tab.value(`(judgeAll(${JSON.stringify(options)}), null)`);
  await tab.when('!state.running');
  const rows = await tab.value(`state.results.map(result => Object.fromEntries(Object.entries(result.rows).map(
    ([check, row]) => [check, [row.word, word('details')[check](row.tally, row.facts)]])))`);
  const notes = JSON.stringify(await tab.value('state.results.map(result => result.notes.map(said))'));
  assert(!notes.includes('The interface failed'), notes);
  return rows;
}

/** Whether each interface has a note of this kind. */
export const haveNote = (tab, kind) => tab.value(`state.results.map(r => r.notes.some(([key]) => key === '${kind}'))`);

/** Checks that everything is as promised or free, but for a corner in the plane w = 0, which one of the renderers does not draw. */
export async function isRight(tab, rows, api) {
  console.log(`${api}: ${JSON.stringify(rows)}`);
  assert.equal(Object.keys(rows).length, 12, `${api} answers every check`);
  for (const [check, [word, sentence]] of Object.entries(rows)) {
    const isKnown = check === 'near-plane' && await tab.value(
      `state.results.find(r => r.name === '${api}').rows['near-plane'].broken?.[0].some(v => v[3] === 0) === true`);
    assert(word !== 'outside' || isKnown, `${api}, ${check}: ${sentence}`);
  }
  for (const check of ['coverage', 'reach', 'tiling', 'order', 'facing', 'values', 'samples', 'twice']) {
    assert.equal(rows[check][0], 'equal', `${api}, ${check}`);
  }
}
