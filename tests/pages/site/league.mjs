import assert from 'node:assert/strict';

import { inSite } from '../driver/site.mjs';

/** For the page: each table with its heads, how much of it is cut, where the first score ends, and whether the name stays when it is scrolled. */
const tables = () => [...document.querySelectorAll('main .table-wrapper')].map((table) => {
  const [name, score] = table.querySelectorAll('tbody tr:first-child > *'), box = table.getBoundingClientRect();
  const heads = [...table.querySelectorAll('thead th')].map((head) => head.textContent), cut = table.scrollWidth - table.clientWidth;
  const ends = score.getBoundingClientRect().right;
  table.scrollLeft = 1e6;
  return { heads, cut, right: box.right, ends, staysBy: Math.abs(name.getBoundingClientRect().left - box.left) };
});

/** What is wider than the window, outside of what scrolls by itself. */
const tooWide = () => [...document.querySelectorAll('main *')].filter((element) =>
  !element.closest('.table-wrapper, pre, rp-figure, .katex-display') && element.getBoundingClientRect().right > innerWidth).map(({ outerHTML }) => outerHTML.slice(0, 80));

// Of each page the first two columns of its tables with numbers.
const FIRST = {
  'en/league.html': ['library', 'as is'], 'zh/league.html': ['库', '原样'],
  'en/differential.html': ['family', 'A:O'], 'zh/differential.html': ['family', 'A:O'],
};

export default {
  says: 'The league and the differential tables have the scores first: on a phone they are seen beside the name, which stays; on a desktop no table is cut',
  page: 'nothing',
  async check(tab) {
    for (const [page, first] of Object.entries(FIRST)) {
      for (const [width, height] of [[360, 740], [1280, 900]]) {
        await tab.resize(width, height);
        await tab.go(inSite(page));
        const all = await tab.value(tables), about = `${page}, ${width} px`;
        assert.deepEqual(await tab.value(tooWide), [], about);
        assert.deepEqual(all[0]?.heads.slice(0, 2), first, about);
        assert(!all.some(({ heads }) => heads.some((head, i) => /date|day|日期/i.test(head) && i < heads.length - 1)), `${about}: dates stand last`);
        for (const { cut, right, ends, staysBy } of all) {
          assert(ends <= width && (cut === 0 || staysBy < 2), `${about}: the first score ends at ${ends} px; the name moves by ${staysBy} px`);
          assert(right <= width && (width === 360 || cut === 0), `${about}: ${cut} px are cut, the table ends at ${right} px`);
        }
      }
    }
  },
};
