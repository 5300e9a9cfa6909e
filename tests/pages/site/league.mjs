import assert from 'node:assert/strict';

export default {
  says: 'The league shows scores alone, and all of its columns on a desktop',
  page: 'site en/league.html',
  async check(tab) {
    const heads = await tab.value('[...document.querySelectorAll("table")[0].querySelectorAll("th")].map(h => h.textContent)');
    assert.deepEqual([heads[0], heads[1], heads[9]], ['library', 'as is', undefined], `${heads}`);
    const cut = await tab.value('[...document.querySelectorAll(".table-wrapper")].map(t => t.scrollWidth - t.clientWidth)');
    assert.equal(cut[0], 0, 'nothing of the league is cut');
    assert.equal(await tab.value('document.documentElement.scrollWidth <= innerWidth'), true);
  },
};
