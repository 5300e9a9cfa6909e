import assert from 'node:assert/strict';

import { isRight, PARTS, PLANTS, rows } from '../driver/gpu.mjs';

export default {
  says: 'A second browser, with another renderer, is judged by the same questions of WebGL 2; Firefox has no WebGPU here',
  page: 'your-gpu #lang=en',
  browser: 'firefox',
  async check(tab) {
    const [clean, none] = await rows(tab, null, { only: PARTS, shrinks: false });
    await isRight(tab, clean, 'webgl2');
    assert.deepEqual(none, {}, 'no WebGPU');
    for (const [plant, check, number, [word]] of PLANTS) {
      const [planted] = await rows(tab, plant, { names: ['webgl2'], only: [[check, number]], shrinks: false });
      // A step of 1/256 px moves no centre over an edge of these triangles, only off one.
      const isTiny = plant === 'nudged' && check === 'coverage';
      assert.equal(planted[check][0], isTiny ? 'allowed' : word, `${plant}: ${planted[check]}`);
    }
  },
};
