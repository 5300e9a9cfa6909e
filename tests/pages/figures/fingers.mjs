import assert from 'node:assert/strict';

import { answer, figures, gripOf, stands, wrong } from '../driver/figures.mjs';

export default {
  says: 'A grip follows a finger',
  page: 'made figures en',
  async check(tab) {
    await tab.hasFingers(1);
    const figure = (await figures()).find(({ name }) => name === 'shared-edge'), { name } = figure;
    await answer(tab, name);
    const before = await stands(tab, name);
    const [x, y] = await gripOf(tab, name, 0);
    await tab.touch('touchStart', [[x, y]]);
    for (const by of [1, 2]) await tab.touch('touchMove', [[x - 20 * by, y - 30 * by]]);
    await tab.touch('touchEnd', []);
    assert.notDeepEqual(await stands(tab, name), before);
    assert.deepEqual(await wrong(tab, figure), []);
  },
};
