import assert from 'node:assert/strict';

import { SWIFTSHADER } from '../driver/gpu.mjs';

export default {
  says: 'Each check is named before the run, and its address makes it alone',
  page: 'your-gpu #lang=en',
  options: SWIFTSHADER,
  async check(tab) {
    const checks = await tab.value('[...document.querySelectorAll("#checks a")].map(a => a.hash)');
    assert.equal(checks.length, 12, `${checks}`);
    assert(checks.includes('#check=lines&lang=en'), `${checks}`);
    await tab.open('#check=lines&lang=en');
    await tab.when('document.body.dataset.done !== undefined');
    assert.deepEqual(await tab.value('state.results.map(result => Object.keys(result.rows))'), [['lines'], ['lines']]);
  },
};
