import assert from 'node:assert/strict';

import { answer, dragGrip, figures, inFigure, pixels, stands, visit, wrong } from '../driver/figures.mjs';

export default {
  says: 'Every figure waits for a prediction, and then shows what the oracle draws, wherever the mouse and keys put its grips',
  page: 'made figures en',
  async check(tab) {
    await tab.prefer('prefers-color-scheme', 'light');
    // The engines are loaded once, a screen before a figure comes into view.
    const loaded = () => tab.value('document.querySelectorAll(\'script[src$="engines.js"]\').length');
    assert.equal(await loaded(), 0);
    for (const figure of await figures()) {
      const { name, ends } = figure;
      await visit(tab, name);
      const drawn = await inFigure(tab, name, `(figure) => (${pixels})(figure.view.shown[0].frame)`);
      assert.deepEqual(drawn, [], name);
      assert.equal(await inFigure(tab, name, (figure) => figure.shadowRoot.querySelectorAll('[role=slider]').length), 0);
      await answer(tab, name);
      const states = new Set();
      const isRight = async () => {
        assert.deepEqual(await wrong(tab, figure), []);
        states.add(JSON.stringify(await stands(tab, name)));
      };
      await isRight();
      for (const [i, by] of [[0, [37, 29]], [ends.length - 1, [-61, -45]]]) {
        await dragGrip(tab, name, i, by);
        await isRight();
      }
      await inFigure(tab, name, (figure) => figure.shadowRoot.querySelector('[role=slider]').focus());
      for (const keys of [['ArrowLeft', 'ArrowLeft', 'ArrowLeft'], ['ArrowRight']]) {
        for (const key of keys) await tab.press(key);
        await isRight();
      }
      assert(states.size >= 3, `${name}: ${[...states]}`);
    }
    assert.equal(await loaded(), 1);
    assert.deepEqual(await tab.value('arrows'), [], 'arrow keys that a figure took');
    const roles = await tab.namesEveryControl('figures');
    for (const role of ['button', 'slider', 'link']) assert(roles.has(role), `${role} in ${[...roles]}`);
  },
};
