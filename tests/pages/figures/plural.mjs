import assert from 'node:assert/strict';

import { answer, figures, inFigure } from '../driver/figures.mjs';
import { none } from '../driver/site.mjs';

/** For the page: what a figure says wherever its grips stand, in a dozen steps along each way that one may go. */
function saidAnywhere(figure, ends, fault) {
  const start = figure.at, said = new Set(), steps = 12;
  const tell = (at) => {
    figure.at = at;
    figure.draw();
    said.add(`${figure.question.textContent} ${figure.says.textContent}`);
  };
  const once = figure.answer;
  // The fault: one of what is counted is called many.
  if (fault) figure.answer = () => ((answer) => ({ ...answer, answer: answer.answer?.replace(/\b1 (pixel|centre|sample|step|row)\b/, '1 $1s') }))(once.call(figure));
  ends.forEach(([low, high], i) => low.forEach((_, axis) => {
    for (let k = 0; k <= steps; k += 1) {
      tell(start.map((grip, j) => (j === i ? grip.map((value, a) => (a === axis ? low[axis] + ((high[axis] - low[axis]) * k) / steps : value)) : grip)));
    }
  }));
  delete figure.answer;
  tell(start);
  return [...said];
}

/** Words behind a 1 that end like many and are none. */
const VERBS = ['is', 'has', 'lies', 'does', 'was', 'as', 'this', 'its', 'less', 'gives', 'passes', 'stands', 'means', 'belongs'];
const wrongNumbers = (texts) => [...new Set(texts.flatMap((text) => [...text.matchAll(/(?<![\d.,/\u2212^-] ?)\b1 ([a-z]+s)\b/g)]
  .filter(([, word]) => !VERBS.includes(word)).map(([whole]) => `${whole}: ${text}`)))];

export default {
  says: 'Wherever its grips stand, a figure calls one pixel a pixel and one centre a centre; where it does not, that is seen',
  page: 'made figures en',
  async check(tab) {
    const wrong = [];
    let seen = 0, count = 0;
    for (const { name, ends } of await figures()) {
      await answer(tab, name);
      const texts = await inFigure(tab, name, saidAnywhere, ends, false);
      count += texts.length;
      wrong.push(...wrongNumbers(texts).slice(0, 1).map((text) => `${name}: ${text}`));
      seen += wrongNumbers(await inFigure(tab, name, saidAnywhere, ends, true)).length;
    }
    console.log(`${count} texts of figures`);
    none(wrong);
    assert(seen > 3, `a plural of one is seen ${seen} times`);
  },
};
