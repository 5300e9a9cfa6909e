import assert from 'node:assert/strict';

import { audit, countsEqualTheJson, thousands } from '../driver/report.mjs';

export default {
  says: 'A planted fault is the first thing on the page: the verdict, the worst family, its failing case, who drew it, and the difference',
  page: 'verify --cases 60 --plant inclusive-edges --report --json',
  async check(tab) {
    assert.equal(tab.printed.status, 1);
    const json = JSON.parse(tab.printed.out);
    const verdict = `${await tab.text('#verdict')} ${await tab.text('#counts')}`;
    // Thousands are apart, also in the tables.
    const wrong = `${thousands(json.mismatches)} wrong pixels in `;
    assert(verdict.includes('DISAGREES') && verdict.includes(wrong), verdict);
    await countsEqualTheJson(tab, json);
    // The worst row first after the sum, and the failing case is open.
    const marks = await tab.value('[...document.querySelectorAll("table.counts tbody tr")].slice(0, 2).map(r => r.className)');
    assert.deepEqual(marks, ['sum', 'wrong']);
    // Each family has a bar, the worst the longest, and all tables but the first are folded.
    const bars = await tab.value(() => [...document.querySelectorAll('tr.wrong th')]
      .map((head) => parseFloat(getComputedStyle(head).getPropertyValue('--share'))));
    assert(bars.length > 5 && bars[0] === 100, `${bars}`);
    assert.deepEqual(bars, [...bars].sort((a, b) => b - a));
    const [first, ...others] = await tab.value(
      '[...document.querySelectorAll("table.counts")].map(table => table.closest("details")?.open ?? null)');
    assert(first === null && others.length > 0 && others.every((open) => open === false), `${first}, ${others}`);
    const [failure] = json.failures;
    assert.equal(await tab.text('#case-title'), `${failure.family}#${failure.index}`);
    assert.equal(await tab.text('#case-command code'), failure.repeat);
    assert.match(await tab.text('#case-found'), /^inclusive-edges against oracle: /);
    const [a, b] = await tab.value('["a", "b"].map(p => document.querySelector(`#pick-${p}`).selectedOptions[0].textContent)');
    assert(a.startsWith('inclusive-edges (') && b === 'oracle', `${a}, ${b}`);
    assert.doesNotMatch(await tab.text('#agreement'), /agree in every pixel/);
    // What is drawn, what is expected and the difference stand side by side, each at the same scale.
    const panels = await tab.value('document.querySelector("rp-view").shown.map(({ caption, canvas }) => [caption.textContent.trim(), canvas.clientWidth, canvas.clientHeight])');
    const [drawn, expected, difference] = panels;
    assert(drawn[0].includes('inclusive-edges') && expected[0].includes('oracle'), `${panels}`);
    assert.equal(difference[0], 'difference: A less B');
    assert.deepEqual([expected, difference].map((panel) => panel.slice(1)), [drawn, drawn].map((panel) => panel.slice(1)));
    // Nobody calls a case with wrong pixels close to a bound.
    const close = await tab.value(() => JSON.parse(document.querySelector('#data').textContent).cases
      .filter(({ kind, layers }) => kind === 'closest' && layers.some(({ role, tally }) =>
        role !== 'specimen' && tally.missing + tally.extra + tally.twice > 0)).map(({ name }) => name));
    assert.deepEqual(close, []);
    // A wrong rasterizer does not fool the rule as the page computes it.
    assert.deepEqual(await audit(tab), []);
  },
};
