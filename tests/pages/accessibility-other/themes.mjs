import assert from 'node:assert/strict';

import { violationsOf, withAxe } from '../driver/axe.mjs';
import { inSite, none } from '../driver/site.mjs';

export default {
  says: 'In each of the five themes the list of themes, results of a search and marks of what was searched for follow the rules of axe-core',
  page: 'site en/ch01.html',
  async check(tab) {
    await withAxe(tab);
    const wrong = [];
    for (const theme of ['light', 'rust', 'coal', 'navy', 'ayu']) {
      await tab.value((theme) => localStorage.setItem('mdbook-theme', theme), theme);
      const file = inSite('en/ch01.html');
      await tab.call('Page.navigate', { url: 'about:blank' });
      await tab.call('Page.navigate', { url: `file://${file}?highlight=sample` });
      await tab.when('document.readyState === "complete" && location.search !== ""');
      await tab.value(() => {
        document.getElementById('mdbook-search-toggle').click();
        document.getElementById('mdbook-searchbar').value = 'sample';
      });
      await tab.when('document.querySelector("#mdbook-searchresults a") !== null');
      await tab.click('#mdbook-theme-toggle');
      const shown = await tab.value(() => [document.documentElement.classList.contains(localStorage.getItem('mdbook-theme')),
        document.querySelectorAll('main mark').length > 0]);
      assert.deepEqual(shown, [true, true], theme);
      wrong.push(...await violationsOf(tab, theme));
    }
    none(wrong);
  },
};
