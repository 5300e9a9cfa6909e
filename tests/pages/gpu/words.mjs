import assert from 'node:assert/strict';

import { SWIFTSHADER } from '../driver/gpu.mjs';

export default {
  says: 'The page says what it does, and both languages have the same words',
  page: 'your-gpu #lang=en',
  options: SWIFTSHADER,
  async check(tab) {
    assert.equal(await tab.text('#judge'), 'Judge my GPU');
    const [en, zh] = await tab.value('["en", "zh"].map(l => [WORDS[l], WORDS[l].checks, WORDS[l].details].map(Object.keys))');
    assert.deepEqual(en, zh);
  },
};
