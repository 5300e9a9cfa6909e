import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { isTroubled, show } from '../driver/playground.mjs';
import { ROOT } from '../driver/program.mjs';

const PAGES = [...Array.from({ length: 11 }, (_, i) => `ch${String(i + 1).padStart(2, '0')}`), 'games101'];

/** The scenes that a chapter links itself, or that the page with its evidence does. */
function links(folder, page) {
  const files = [`${page}.md`, `${page}-evidence.md`].map((file) => path.join(ROOT, folder, file)).filter(fs.existsSync);
  const text = files.map((file) => fs.readFileSync(file, 'utf8')).join('');
  const found = [...text.matchAll(/\]\(playground\.md(#scene=[^)]*)\)/g)].map(([, address]) => address);
  assert(found.length > 0, `${folder}/${page} names no scene of the playground`);
  return found;
}

export default {
  says: 'Every chapter names its scene, from both languages alike, and the address opens it',
  page: 'playground',
  async check(tab) {
    for (const page of PAGES) {
      assert.deepEqual(links('docs', page), links('docs/zh', page), page);
      for (const address of links('docs', page)) {
        await show(tab, address);
        const scene = await tab.value('`#scene=${state.scene}`');
        assert(address.startsWith(scene), `${page}: ${address}`);
        assert.equal(await isTroubled(tab), false, `${page}: ${address}`);
      }
    }
  },
};
