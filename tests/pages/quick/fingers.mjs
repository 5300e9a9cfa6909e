import assert from 'node:assert/strict';

import { grip } from '../driver/playground.mjs';

export default {
  says: 'Two fingers zoom about the spot between them, and move no corner; one finger drags',
  page: 'playground #lang=en',
  async check(tab) {
    await tab.hasFingers(2);
    await tab.settle();
    let [x, y] = await grip(tab, 0, 'C');
    const around = (by) => [[x - by, y - 30], [x + by, y - 30]];
    await tab.touch('touchStart', around(20));
    for (let step = 1; step <= 6; step += 1) await tab.touch('touchMove', around(20 + 5 * step));
    await tab.touch('touchEnd', []);
    await tab.settle();
    const [x0, , x1] = await tab.value('state.window');
    assert(x1 - x0 < 14 && x1 > 10, `${x0} to ${x1} still holds the corner`);
    assert.equal(await tab.value('state.triangles[0][2].x'), 10.5);
    [x, y] = await grip(tab, 0, 'C');
    await tab.touch('touchStart', [[x, y]]);
    for (const by of [20, 40]) await tab.touch('touchMove', [[x - by, y - by]]);
    await tab.touch('touchEnd', []);
    assert((await tab.value('state.triangles[0][2].x')) < 10.5);
  },
};
