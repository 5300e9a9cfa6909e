import assert from 'node:assert/strict';

import { haveNote, rows, SWIFTSHADER } from '../driver/gpu.mjs';

const ONLY = [['coverage', 0], ['twice', 0]];

export default {
  says: 'What changes from one time to the next is shown, noise that does not is said, and what is lost is opened anew',
  page: 'your-gpu #lang=en',
  options: SWIFTSHADER,
  async check(tab) {
    const options = { only: ONLY, bits: 4, shrinks: false };
    const right = await rows(tab, null, options), noisy = await rows(tab, 'noise', options);
    assert.deepEqual(noisy.map(({ twice }) => twice[0]), ['outside', 'allowed']);
    // It is shown as it is, and no cause is looked for.
    await rows(tab, 'noise', { only: ONLY, bits: 4 });
    assert.deepEqual(await tab.value('state.results.map(r => "twice" in r.views && r.cause === undefined)'), [true, true]);
    // Nothing else changes where an interface was lost, or where noise is the same each time.
    for (const [plant, note] of [['lost', 'lostOnce'], ['faint-noise', 'uneven']]) {
      assert.deepEqual(await rows(tab, plant, options), right, plant);
      assert.deepEqual(await haveNote(tab, note), [true, true], plant);
    }
  },
};
