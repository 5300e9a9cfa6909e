import assert from 'node:assert/strict';

import { answer, inFigure } from '../driver/figures.mjs';
import { inSite } from '../driver/site.mjs';

export default {
  says: 'Numbers in the prose of a chapter follow the grip of its live figure, and arrow keys on the grip turn no page',
  page: 'nothing',
  async check(tab) {
    for (const book of ['en', 'zh']) {
      await tab.go(inSite(`${book}/ch03.html`));
      const name = 'weights', address = await tab.value('location.href');
      await answer(tab, name);
      const numbers = () => inFigure(tab, name, (figure) => figure.numbers.map(({ shown, value }) => [shown.textContent, figure.now.values[value]]));
      await tab.when('document.querySelector("main .follows") !== null');
      const before = await numbers();
      assert(before.length > 0, book);
      await inFigure(tab, name, (figure) => figure.shadowRoot.querySelector('[role=slider]').focus());
      for (let i = 0; i < 3; i += 1) await tab.press('ArrowRight');
      await tab.draw();
      const after = await numbers();
      assert.notDeepEqual(after, before, book);
      for (const [shown, value] of [...before, ...after]) assert.equal(shown, value, book);
      assert.equal(await tab.value('location.href'), address);
    }
  },
};
