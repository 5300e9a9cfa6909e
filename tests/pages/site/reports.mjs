import assert from 'node:assert/strict';
import fs from 'node:fs';

import { inSite } from '../driver/site.mjs';

export default {
  says: 'From a case of a report its chapter in the site is a link away, at its heading',
  page: 'nothing',
  async check(tab) {
    await tab.open('', inSite('try/verify.html'));
    const links = await tab.value(() => [...new Set(items.map((item) => chapterOf(item)[1]?.href))]);
    assert(links.length > 2, `${links}`);
    for (const link of links.map((link) => new URL(link))) {
      const file = decodeURI(link.pathname), anchor = decodeURIComponent(link.hash.slice(1));
      assert(file.startsWith(inSite('en/')) && fs.existsSync(file), file);
      assert(!anchor || fs.readFileSync(file, 'utf8').includes(` id="${anchor}"`), `${link}`);
    }
  },
};
