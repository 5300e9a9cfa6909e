import assert from 'node:assert/strict';
import { setTimeout as sleep } from 'node:timers/promises';

import { data, picture, VERDICT } from '../driver/report.mjs';

export default {
  says: 'Two pictures blink, slowly and until they are paused, and are compared in three other ways, each by its key',
  page: `${VERDICT} #case-T2&a=games101-strict&b=oracle&mode=blink`,
  async check(tab) {
    assert.equal(await tab.text('#case-title'), 'T2');
    assert.equal(await tab.text('#case-command code'), 'rasterproof inspect T2');
    // It blinks by itself, slower than three times a second.
    const phase = (phase) => tab.when((phase) => document.querySelector('rp-view').dataset.phase === phase, phase);
    await phase('A');
    const a = await picture(tab);
    await phase('B');
    const b = await picture(tab);
    assert.notEqual(a, b);
    await tab.press('b');
    const paused = await data(tab, 'phase');
    await sleep(900);
    assert.equal(await data(tab, 'phase'), paused, 'paused');
    await tab.click('#other');
    assert.notEqual(await data(tab, 'phase'), paused);
    for (const [key, mode, panels] of [['2', 'slider', 1], ['3', 'side', 3], ['4', 'onion', 1], ['1', 'blink', 1]]) {
      await tab.press(key);
      const is = await tab.value(`[document.querySelector('rp-view').dataset.mode, document.querySelectorAll('rp-view .pixels').length,
        document.querySelector('#modes :checked').value]`);
      assert.deepEqual(is, [mode, panels, mode]);
      await tab.when((mode) => location.hash.includes(`mode=${mode}`), mode);
    }
    await tab.press('2');
    // Without a playground beside the page no link leads there.
    const hidden = await tab.value("['#case-playground', '#no-playground'].map(id => document.querySelector(id).hidden)");
    assert.deepEqual(hidden, [true, false]);
    assert(![a, b].includes(await picture(tab)), 'a slider shows a part of both');
    await tab.press('b');
    assert.equal(await data(tab, 'mode'), 'blink');
  },
};
