import assert from 'node:assert/strict';

import { hold } from '../driver/playground.mjs';

export default {
  says: 'The keyboard alone reaches every control of the playground, moves corners by pixels and subpixels, pans and zooms',
  page: 'playground #lang=en',
  async check(tab) {
    await tab.settle();
    const controls = '[...document.querySelectorAll(\'button, select, input, .pixels, .knob[tabindex="0"], summary\')].filter(e => e.checkVisibility())';
    await tab.value('(window.seen = new Set(), 0)');
    for (let i = await tab.value(`${controls}.length + 4`); i > 0; i -= 1) {
      await tab.press('Tab');
      await tab.value('(seen.add(document.activeElement), 0)');
    }
    assert.deepEqual(await tab.value(`${controls}.filter(e => !seen.has(e)).map(e => e.outerHTML.slice(0, 90))`), []);
    const corner = () => tab.value('[handles()[state.chosen].x, handles()[state.chosen].y]');
    await hold(tab, 'A');
    assert.deepEqual(await corner(), [2.5, 2.5]);
    await tab.press('ArrowRight');
    await tab.press('ArrowDown', 8);
    assert.deepEqual(await corner(), [3.5, 2.5 + 1 / 256]);
    // Whoever does not see it hears where the corner is, and what both panels made of it.
    await tab.settle();
    const heard = await tab.text('#announce');
    assert(heard.includes('A 3.5, 2.50390625') && heard.includes('as the oracle'), heard);
    await hold(tab, 'B');
    await tab.press('ArrowLeft');
    assert.deepEqual(await corner(), [9.5, 2.5]);
    await tab.value('view.shown[0].canvas.focus()');
    await tab.press('ArrowDown');
    assert.deepEqual(await tab.value('state.px'), [6, 7]);
    await tab.press('+');
    assert.deepEqual(await tab.value('state.window'), [1, 1, 13, 13]);
    await tab.press('ArrowRight', 1);
    assert.deepEqual(await tab.value('state.window'), [2, 1, 14, 13]);
    await tab.settle();
  },
};
