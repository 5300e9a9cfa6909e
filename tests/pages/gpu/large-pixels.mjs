import assert from 'node:assert/strict';

import { SWIFTSHADER } from '../driver/gpu.mjs';

/** Three corners whose box is 33 columns wide, before the near plane and behind it. */
const WIDE = JSON.stringify([[[32, 32, 0.001953125, 1, 1, 0], [-0.5, 0, -0.001953125, 0, 1, 0], [32, 27, 9.24609375, 1, 1, 0]]]);

export default {
  says: 'Pixels of a case are at least 24 px large, also where the window is smaller than the case: what is seen first is the pixel that is looked at',
  page: `your-gpu #interface=webgl2&check=near-plane&case=${WIDE}&lang=en`,
  options: SWIFTSHADER,
  async check(tab) {
    await tab.when('document.body.dataset.done !== undefined');
    for (const [width, height] of [[1280, 900], [360, 740]]) {
      await tab.resize(width, height);
      await tab.settle();
      const [unit, seen, cursor] = await tab.value(() => [pixels.unit, pixels.seen, pixels.source.cursor ?? pixels.source.part]);
      assert(unit >= 24, `at ${width} px a pixel is ${unit} px large`);
      assert([0, 1].every((i) => seen[i] <= cursor[i] && cursor[i] < seen[i + 2]), `${seen}: ${cursor}`);
      // The rest is there for who zooms out.
      await tab.value(() => { for (let i = 0; i < 9; i++) pixels.zoom(1); });
      const [now, part] = await tab.value(() => [pixels.seen, pixels.source.part]);
      assert(now[0] <= part[0] && now[2] >= part[2], `${now} does not show ${part}`);
      await tab.value(() => pixels.fit());
      assert.deepEqual(await tab.value(() => pixels.seen), seen);
    }
  },
};
