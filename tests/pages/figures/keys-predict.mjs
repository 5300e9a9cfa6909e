import assert from 'node:assert/strict';

import { inFigure, visit } from '../driver/figures.mjs';

export default {
  says: 'A prediction is made by keys alone: pixels are marked by arrows and the space bar, and judged',
  page: 'made figures en',
  async check(tab) {
    const name = 'one-sample';
    await visit(tab, name);
    await inFigure(tab, name, (figure) => figure.stage.querySelector('.frame button').focus());
    // From (0, 0) to (1, 1) and around the square of four pixels.
    for (const arrows of [['ArrowRight', 'ArrowDown'], ['ArrowRight'], ['ArrowDown'], ['ArrowLeft']]) {
      for (const arrow of arrows) await tab.press(arrow);
      await tab.press(' ');
    }
    assert.equal(await inFigure(tab, name, (figure) => figure.stage.querySelectorAll('.frame [aria-pressed=true]').length), 4);
    await inFigure(tab, name, (figure) => figure.controls.firstChild.click());
    assert.equal(await inFigure(tab, name, (figure) => figure.verdict.textContent), 'Right.');
    assert.deepEqual(await tab.value('arrows'), [], 'arrow keys that the figure took');
  },
};
