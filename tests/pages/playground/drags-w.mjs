import assert from 'node:assert/strict';

import { drag, grip, hold } from '../driver/playground.mjs';

export default {
  says: 'w of a corner is dragged on the picture, by mouse and keys, and its slider follows',
  page: 'playground #scene=perspective&lang=en',
  async check(tab) {
    await tab.settle();
    const picture = 'view.shown[0].canvas.toDataURL()';
    const before = await tab.value(picture);
    const from = await grip(tab, 0, 'w A');
    // Toward the middle of the picture, which is farther from the eye.
    await drag(tab, from, [40, -40]);
    assert.notEqual(await tab.value(picture), before);
    // Both triangles have the corner, and nothing else moved.
    const [w, other] = await tab.value('state.triangles.map(t => t[0].w)');
    assert(w > 2 && w < 8 && w === other, `${w}, ${other}`);
    const corners = await tab.value('handles().map(h => [h.x, h.y, h.members[0].w])');
    assert.deepEqual(corners.slice(0, 2), [[2, 29, w], [12, 4, 4]]);
    // It stays under the pointer, to the nearest step.
    const [x, y] = await grip(tab, 0, 'w A');
    assert(Math.hypot(x - from[0] - 40, y - from[1] + 40) < 8, `${from} to ${x}, ${y}`);
    assert.equal(await tab.value('Number(document.querySelector("#tools input[type=range]").value)'), w);
    await hold(tab, 'w B');
    const chosen = 'grips()[state.chosen].says';
    assert.equal(await tab.value(chosen), 'w B = 4');
    await tab.press('ArrowUp');
    await tab.press('ArrowLeft', 8);
    assert.equal(await tab.value(chosen), 'w B = 4.2');
    await tab.settle();
    assert.match(await tab.text('#announce'), /^w B = 4\.2/);
  },
};
