import assert from 'node:assert/strict';

import { isRight, PARTS, rows, SWIFTSHADER } from '../driver/gpu.mjs';

export default {
  says: 'WebGL 2 and WebGPU as SwiftShader draws them are judged, and right',
  page: 'your-gpu #lang=en',
  options: SWIFTSHADER,
  async check(tab) {
    const clean = await rows(tab, null, { only: PARTS, shrinks: false });
    for (const [i, api] of ['webgl2', 'webgpu'].entries()) await isRight(tab, clean[i], api);
    for (const { lattice } of clean) assert.match(lattice[1], /1\/16 px/);
    assert.equal(await tab.value('state.results.every(result => result.isSoftware)'), true);
  },
};
