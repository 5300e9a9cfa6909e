import assert from 'node:assert/strict';

import { answer, expected, figures, inFigure, visit } from '../driver/figures.mjs';

export default {
  says: 'In Chinese, too, and dark, every figure asks in its language, is no wider than a telephone, and fills the window',
  page: 'made figures zh',
  size: [360, 740],
  async check(tab) {
    await tab.prefer('prefers-color-scheme', 'dark');
    await tab.open();
    for (const { name } of await figures()) {
      await visit(tab, name);
      const { question } = await expected(name, [], { language: 'zh', isAnswered: false });
      assert.equal(await inFigure(tab, name, (figure) => figure.question.textContent), question);
      await answer(tab, name);
      const wide = await tab.value('document.documentElement.scrollWidth');
      assert(wide <= 360, `${name}: ${wide} px wide`);
      // What brings it back is there to be pressed.
      const enlarge = () => inFigure(tab, name, (figure) => figure.shadowRoot.querySelector('[data-tool=enlarge]').click());
      await enlarge();
      const shown = await inFigure(tab, name, (figure) => {
        const { top, bottom } = figure.shadowRoot.querySelector('[data-tool=enlarge]').getBoundingClientRect();
        return [figure.view.clientHeight, top >= 0 && bottom <= innerHeight];
      });
      assert.deepEqual(shown, [740, true], name);
      await enlarge();
    }
  },
};
