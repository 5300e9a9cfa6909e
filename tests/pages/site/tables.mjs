import assert from 'node:assert/strict';

import { inSite } from '../driver/site.mjs';

export default {
  says: 'On a phone a table keeps the name of a row in sight, and at least half of the width for its numbers',
  page: 'nothing',
  size: [360, 740],
  async check(tab) {
    for (const page of ['en/league.html', 'zh/league.html', 'en/effects.html']) {
      await tab.go(inSite(page));
      const seen = await tab.value(() => [...document.querySelectorAll('.table-wrapper')]
        .filter((table) => table.scrollWidth > table.clientWidth).map((table) => {
          table.scrollLeft = 1e6;
          const box = table.getBoundingClientRect(), name = table.querySelector('tbody :is(td, th)').getBoundingClientRect();
          return Math.abs(name.left - box.left) < 2 && name.width < 0.5 * box.width;
        }));
      assert(seen.length > 0 && seen.every(Boolean), `${page}: ${seen}`);
    }
  },
};
