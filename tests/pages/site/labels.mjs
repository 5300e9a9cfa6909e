import assert from 'node:assert/strict';
import fs from 'node:fs';

import { overlapping } from '../driver/labels.mjs';
import { inSite, names, none } from '../driver/site.mjs';

export default {
  says: 'In no drawing of the books words lie over one another; where one word is moved onto another one, that is seen',
  page: 'nothing',
  async check(tab) {
    await tab.go(inSite('404.html'));
    const drawings = names().filter((name) => name.endsWith('.svg') && name.startsWith('files/'));
    assert(drawings.length > 20, `${drawings.length} drawings`);
    const texts = drawings.map((name) => fs.readFileSync(inSite(name), 'utf8'));
    const seen = await tab.value(overlapping, texts), moved = await tab.value(overlapping, texts, true);
    const wrong = [];
    drawings.forEach((name, i) => {
      wrong.push(...seen[i].found.map((pair) => `${name}: ${pair}`));
      if (seen[i].count > 1 && moved[i].found.length === 0) wrong.push(`${name}: nothing is seen of a word that was moved`);
    });
    console.log(`${drawings.length} drawings, ${seen.reduce((sum, { count }) => sum + count, 0)} words`);
    none(wrong);
  },
};
