import assert from 'node:assert/strict';

import { VERDICT } from '../driver/report.mjs';

export default {
  says: 'What was zoomed to in one panel does not spread over four, and the oracle is beside two others once',
  page: `${VERDICT} #case-T2`,
  async check(tab) {
    for (let i = 0; i < 6; i += 1) await tab.click('[data-tool=zoomIn]');
    await tab.press('3');
    await tab.when(() => {
      const frames = [...document.querySelectorAll('rp-view .frame')];
      return frames.length === 3 && frames.every((frame) => frame.getBoundingClientRect().right <= innerWidth);
    });
    await tab.open('#case-T2&mode=side&a=games101-strict&b=sysu-inclusive');
    const heads = await tab.value('[...document.querySelectorAll(".panel figcaption")].map(c => c.textContent)');
    assert.equal(heads.length, 4, `${heads}`);
    assert.equal(heads.filter((head) => head.includes('oracle')).length, 1, `${heads}`);
  },
};
