import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { overlapping } from '../driver/labels.mjs';
import { folder, ROOT, run } from '../driver/program.mjs';

export default {
  says: 'In the plots of cost and study no words lie over one another, on no width; where one word is moved onto another one, that is seen',
  page: 'nothing',
  async check(tab) {
    const here = folder();
    fs.copyFileSync(path.join(ROOT, 'tests/data/ties.obj'), path.join(here, 'm.obj'));
    for (const command of ['cost', 'study']) {
      run(`${command} m.obj --once --size 64x48 --report --out .`, here);
      await tab.open('', path.join(here, `${command}.html`));
      // A plot is drawn for each width of a page.
      const drawings = await tab.value(() => [...document.querySelectorAll('.plot :is(img, source)')]
        .map((image) => decodeURIComponent(image.src || image.srcset).replace(/^data:[^,]*;base64,(.*)$/, (_, text) => new TextDecoder().decode(Uint8Array.from(atob(text), (c) => c.charCodeAt(0))))));
      const words = drawings.map((drawing) => drawing.slice(Math.max(0, drawing.indexOf('<svg'))));
      const seen = await tab.value(overlapping, words), moved = await tab.value(overlapping, words, true);
      assert(seen.some(({ count }) => count > 10), `${command}: ${seen.map(({ count }) => count)} words`);
      assert.deepEqual(seen.flatMap(({ found }) => found), [], command);
      assert(moved.every(({ count, found }) => count < 2 || found.length > 0), `${command}: nothing is seen of a word that was moved`);
    }
  },
};
