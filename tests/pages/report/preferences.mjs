import assert from 'node:assert/strict';

import { data, picture, VERDICT } from '../driver/report.mjs';

export default {
  says: 'Nothing moves for who wants less motion, and a dark page has darker pixels',
  page: VERDICT,
  async check(tab) {
    await tab.prefer('prefers-reduced-motion', 'reduce');
    await tab.open('#case-T2');
    assert.equal(await data(tab, 'paused'), 'true');
    const light = await picture(tab);
    await tab.prefer('prefers-color-scheme', 'dark');
    await tab.open('#case-T2&mode=blink');
    assert.notEqual(await picture(tab), light);
  },
};
