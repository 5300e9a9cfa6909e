import assert from 'node:assert/strict';

import { PLANTS, rows, SWIFTSHADER } from '../driver/gpu.mjs';

export default {
  says: 'Each planted fault is found by its check, and called what the specification of each interface calls it',
  page: 'your-gpu #lang=en',
  options: SWIFTSHADER,
  async check(tab) {
    // What each batch says without a fault.
    const clean = new Map();
    for (const [plant, check, number, words] of PLANTS) {
      const options = { only: [[check, number]], bits: 4, shrinks: false }, batch = `${check} ${number}`;
      if (!clean.has(batch)) clean.set(batch, await rows(tab, null, options));
      const right = clean.get(batch), planted = await rows(tab, plant, options);
      assert.deepEqual(planted.map((rows) => rows[check][0]), words, `${plant}: ${JSON.stringify(planted)}`);
      for (const [i, rows] of planted.entries()) assert.notEqual(rows[check][1], right[i][check][1], `${plant} is told from no fault`);
    }
  },
};
