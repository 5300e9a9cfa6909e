import fs from 'node:fs';

import { inSite, none, pages, tags } from '../driver/site.mjs';

export default {
  // A class that came later would give blocks a scrollbar, and move what is below.
  says: 'Code of the books has its look before any script runs',
  page: 'nothing',
  check() {
    const wrong = [];
    for (const page of pages().filter((page) => /^(en|zh)\//.test(page))) {
      const all = tags(fs.readFileSync(inSite(page), 'utf8'));
      const code = all.filter((_, i) => all[i - 1] === 'pre');
      wrong.push(...code.filter((tag) => !tag.includes('hljs')).map((tag) => `${page}: ${tag} gets its look from a script`));
    }
    none(wrong);
  },
};
