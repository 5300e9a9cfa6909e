import fs from 'node:fs';

import { inSite, none } from '../driver/site.mjs';

/** What readers look for, and the page that is among the first three that are found: a book, words and a page in each line. */
const SEARCHES = fs.readFileSync(new URL('searches.txt', import.meta.url), 'utf8').trim().split('\n').map((line) => line.split(' | '));

export default {
  says: 'The search finds lessons first, and the changelog last',
  page: 'nothing',
  async check(tab) {
    const wrong = [];
    let changes = 0;
    for (const [book, words, found] of SEARCHES) {
      await tab.go(inSite(`${book}/index.html`));
      await tab.value((words) => {
        document.getElementById('mdbook-search-toggle').click();
        document.getElementById('mdbook-searchbar').value = words;
      }, words);
      await tab.when('!document.getElementById("mdbook-searchresults-outer").classList.contains("hidden")');
      // Several places of one page count as one.
      const pages = await tab.value(() => [...new Map([...document.querySelectorAll('#mdbook-searchresults li > a')].map((link) => {
        const page = link.pathname.split('/').pop();
        return [page, page + decodeURI(link.hash)];
      })).values()]);
      if (!pages.slice(0, 3).some((page) => page.startsWith(found))) {
        wrong.push(`${book}, '${words}': ${found} is not among the first three of ${pages}`);
      }
      const all = await tab.value(() => [...document.querySelectorAll('#mdbook-searchresults li > a')].map((link) => link.pathname.split('/').pop()));
      const first = all.indexOf('CHANGELOG.html'), after = first < 0 ? [] : all.slice(first).filter((page) => page !== 'CHANGELOG.html');
      changes += first < 0 ? 0 : 1;
      if (after.length > 0) wrong.push(`${book}, '${words}': the changelog stands before ${after}`);
    }
    if (changes === 0) wrong.push('the changelog is never found');
    none(wrong);
  },
};
