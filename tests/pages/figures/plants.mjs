import assert from 'node:assert/strict';

import { answer, figures, inFigure, put, stands, wrong } from '../driver/figures.mjs';

// What is changed in a question on its way to the engines.
const PLANTS = {
  triangles: '(question) => { question.by = "drops-first-row" }',
  lines: '(question) => { question.by = "line-directed-ties" }',
  // As far as the grip goes, one way and the other.
  right: '(question) => { question.at[0] = question.at[0].map((v) => v + 9) }',
  left: '(question) => { question.at[0] = question.at[0].map((v) => v - 9) }',
};

export default {
  says: 'A planted engine is noticed by the figures that show its fault, and by each a state that is not the one it says',
  page: 'made figures en',
  async check(tab) {
    await tab.prefer('prefers-color-scheme', 'light');
    await tab.value(() => {
      const { encode } = TextEncoder.prototype;
      TextEncoder.prototype.encode = function change(text) {
        const question = JSON.parse(text);
        window.plant?.(question);
        return encode.call(this, JSON.stringify(question));
      };
    });
    const noticed = { triangles: [], lines: [], right: [], left: [] }, all = await figures();
    for (const figure of all) {
      await answer(tab, figure.name);
      const before = await stands(tab, figure.name);
      for (const [kind, plant] of Object.entries(PLANTS)) {
        await tab.value(`(window.plant = ${plant}, 0)`);
        await inFigure(tab, figure.name, (figure, before) => {
          figure.draw();
          figure.dataset.at = JSON.stringify(before);
          window.plant = null;
        }, before);
        if ((await wrong(tab, figure)).length > 0) noticed[kind].push(figure.name);
        await put(tab, figure.name, before);
      }
    }
    const { triangles, lines, right, left } = noticed;
    console.log(`figures: ${all.length}; a planted triangle engine is noticed by ${triangles.length}, a planted line drawer by ${lines.length}`);
    assert(triangles.length >= 10 && lines.length > 0, JSON.stringify(noticed));
    assert.equal(new Set([...right, ...left]).size, all.length, 'another state than it says');
  },
};
