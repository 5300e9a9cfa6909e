import assert from 'node:assert/strict';

import { both, drag, grip } from '../driver/playground.mjs';

export default {
  says: 'A corner is dragged with the mouse: pixels change, and are those of the program',
  page: 'playground #lang=en',
  async check(tab) {
    await tab.settle();
    const picture = 'view.shown[0].canvas.toDataURL()';
    const before = await tab.value(picture);
    await drag(tab, await grip(tab, 0, 'B'), [-60, 40]);
    assert.notEqual(await tab.value(picture), before);
    // The corner was shared by one triangle only; on the lattice, and not where it was.
    const sub = await tab.value('[state.triangles[0][1].x * 256, state.triangles[0][1].y * 256]');
    assert(sub.every(Number.isInteger) && sub[0] < 10.5 * 256, `${sub}`);
    const question = await tab.value('({ ask: "draw", picture: picture(), by: state.by })');
    const drawn = await tab.value('last.answer');
    assert.deepEqual(await both(tab, question), [drawn, drawn]);
  },
};
