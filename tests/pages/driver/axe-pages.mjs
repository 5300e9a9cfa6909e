// The pages of the site, each of which is judged at the width of a phone in light colours, and each form of a page also at that of a
// desktop in dark ones: the Chinese book has the elements of the English one, and the pages that show files of the repository do not
// depend on the width, so that every second of them is opened in dark colours alone.

import assert from 'node:assert/strict';

import { look, violationsOf, withAxe } from './axe.mjs';
import { inSite, none, opened } from './site.mjs';

function views() {
  const light = [], dark = [], desktop = [];
  for (const [i, page] of opened().entries()) {
    const isFile = page.startsWith('files/');
    (isFile && i % 2 === 0 ? dark : light).push(page);
    if (!isFile && !page.startsWith('zh/')) desktop.push(page);
  }
  return [[[360, 'light'], light], [[360, 'dark'], dark], [[1280, 'dark'], desktop]];
}

/** A check of one half of the views: every second page, from the first or from the second. */
export const half = (first) => ({
  says: `Every page of the site follows the rules of axe-core (${first === 0 ? 'one' : 'the other'} half of them)`,
  page: 'nothing',
  async check(tab) {
    await withAxe(tab);
    const wrong = [];
    let count = 0;
    for (const [view, all] of views()) {
      const name = await look(tab, view);
      for (const page of all.filter((_, i) => i % 2 === first)) {
        await tab.go(inSite(page));
        wrong.push(...await violationsOf(tab, `${page}, ${name}`));
        count += 1;
      }
    }
    console.log(`${count} views of pages`);
    assert(count > 100, `${count} views`);
    none(wrong);
  },
});
