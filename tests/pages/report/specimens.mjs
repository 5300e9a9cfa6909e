import assert from 'node:assert/strict';

import { ours } from '../driver/program.mjs';
import { chaptersExist, namesListed } from '../driver/report.mjs';

export default {
  says: 'The page of the specimens shows what each of them draws wrong, as a case or as pictures',
  page: 'specimens --cases 5 --report',
  async check(tab) {
    assert.equal(tab.printed.status, 0);
    assert.match(await tab.text('#verdict'), /CAUGHT/);
    const names = await namesListed(tab);
    for (const name of names) {
      await tab.value((name) => { location.hash = `#case-${name.replaceAll(' ', '%20')}`; }, name);
      await tab.when((name) => document.body.dataset.ready === name, name);
      assert.match(await tab.text('#agreement'), /differ in/, name);
    }
    // A click on a specimen opens that one.
    for (const name of ['sysu-inclusive', 'games101-strict', 'book-painter']) {
      await tab.click(`.find[data-search=${name}]`);
      await tab.when((name) => document.querySelector('#case-title').textContent === name, name);
    }
    await chaptersExist(tab);
    const shown = names.map((name) => name.split(' ')[0]);
    for (const card of await ours({ list: 'cards' })) assert(shown.includes(card), `${card} in ${names}`);
  },
};
