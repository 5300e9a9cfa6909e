import fs from 'node:fs';
import path from 'node:path';

import { inTurn, unfold, violationsOf, withAxe } from '../driver/axe.mjs';
import { folder, pageOf, ROOT, run } from '../driver/program.mjs';
import { inSite, none } from '../driver/site.mjs';

/** Of the pages that the program writes, one of each command. */
const WRITTEN = {
  judge: 'judge --cases 20 --report --out . -- PROGRAM engine games101-strict',
  study: 'study m.obj --once --size 64x48 --report --out .',
  cost: 'cost m.obj --once --size 64x48 --report --out .',
  specimens: 'specimens --cases 1 --report --out .',
  'course-fans': 'course show fans --out . -- PROGRAM engine exclusive-edges',
};

export default {
  says: 'The reports of every command follow the rules of axe-core, with everything on them that opens',
  page: 'nothing',
  async check(tab) {
    await withAxe(tab);
    const here = folder(), wrong = [], nextView = inTurn(tab);
    fs.copyFileSync(path.join(ROOT, 'tests/data/ties.obj'), path.join(here, 'm.obj'));
    const written = Object.entries(WRITTEN).map(([name, words]) => {
      run(words, here);
      return [path.join(here, `${name}.html`), ''];
    });
    for (const [page, fragment] of [
      [inSite('try/inclusive-edges.html'), '#case-T2&px=2,5'],
      [inSite('try/verify.html'), '#case-T2&mode=side&a=games101-strict&b=sysu-inclusive&px=2,5'],
      [(await pageOf('made every-section')).file, ''],
      ...written,
    ]) {
      for (let i = 0; i < 2; i += 1) {
        const view = await nextView();
        await tab.open(fragment, page);
        await unfold(tab);
        await tab.value('for (let i = 0; i < 9; i++) document.querySelector("#cases:not([hidden]) [data-tool=zoomIn]")?.click()');
        wrong.push(...await violationsOf(tab, `${page}, ${view}`));
      }
    }
    none(wrong);
  },
};
