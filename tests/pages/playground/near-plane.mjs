import assert from 'node:assert/strict';

import { drag, grip, hold } from '../driver/playground.mjs';

export default {
  says: 'The near plane is dragged by mouse and keys, a corner by a finger behind the eye, and each panel has the grips that lie there',
  page: 'playground #scene=near&lang=en',
  async check(tab) {
    await tab.settle();
    const covered = 'last.answer.panels.map(p => p.covered ?? null)';
    const before = await tab.value(covered);
    await drag(tab, await grip(tab, 0, 'near plane'), [30, 0]);
    const near = await tab.value('state.near');
    assert(near > 1.1 && near < 2, `${near}`);
    const after = await tab.value(covered);
    assert(after[0] < before[0], `${before} ${after}: less is left`);
    assert.equal(after[2], before[2], 'nothing changes where nothing is clipped');
    const onScreen = 'state.points.map(p => p.slice(0, 2))';
    const places = await tab.value(onScreen);
    await tab.hasFingers(2);
    const [x, y] = await grip(tab, 0, 'w C');
    await tab.touch('touchStart', [[x, y]]);
    for (let step = 1; step <= 4; step += 1) await tab.touch('touchMove', [[x - 20 * step, y]]);
    await tab.touch('touchEnd', []);
    await tab.settle();
    assert((await tab.value('state.points[2][2]')) < 0, 'behind the eye');
    assert.deepEqual(await tab.value(onScreen), places, 'along its ray');
    await tab.value('(state.near = 1, redraw(), 0)');
    await tab.settle();
    await hold(tab, 'near plane');
    assert.equal(await tab.value('grips()[state.chosen].says'), 'near plane = 1');
    await tab.press('ArrowRight', 8);
    assert.equal(await tab.value('state.near'), 1.1);
    const grips = await tab.value('view.shown.map(p => p.grips.map(g => g.dataset.name).join())');
    assert.deepEqual(grips, ['w A,w B,w C,near plane', 'A,B,C', 'A,B,C', 'A,B,C']);
  },
};
