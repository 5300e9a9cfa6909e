import assert from 'node:assert/strict';

import { data, namesListed, search, VERDICT } from '../driver/report.mjs';

export default {
  says: 'Cases are found by name, number and words, by a click in a table, and by filters',
  page: VERDICT,
  async check(tab) {
    const all = await namesListed(tab);
    assert(all.includes('T2') && all.some((name) => name.startsWith('sliver#')));
    assert.deepEqual(await search(tab, 'euc#17'), ['T5']);
    const octants = await search(tab, 'bresenham octants');
    assert(octants.length > 0 && octants.every((name) => name.startsWith('line-octants#')), `${octants}`);
    assert.deepEqual(await search(tab, 'nothing is called this'), []);
    assert.deepEqual(await search(tab, ''), all);
    // Keys are letters while something is typed.
    await tab.value('document.querySelector("#search").focus()');
    await tab.press('2');
    assert.notEqual(await data(tab, 'mode'), 'slider');
    await tab.click('.find[data-search=sliver]');
    const found = await namesListed(tab);
    assert(found.some((name) => name.startsWith('sliver#')), `${found}`);
    await tab.when('document.querySelector("#case-title").textContent.includes("sliver#")');
    await search(tab, '');
    await tab.click('#filters [data-kind=named]');
    const named = await namesListed(tab);
    assert(named.length > 30 && named.length < all.length, `${named}`);
  },
};
