import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { isTroubled, show } from '../driver/playground.mjs';
import { folder, reportOf, run } from '../driver/program.mjs';

// What is inspected, and what is true of the playground then.
const CASES = [
  ['T2', 'state.named === "T2" && state.triangles.length === 2'],
  ['sliver#3 --seed 7', 'state.generated.index === 3 && state.generated.seed === 7'],
  ['0.5,0.5 5.5,0.5 5.5,5.5', 'state.triangles[0][2].y === 5.5 && !state.named'],
  ['--line 0,0 8,3', 'state.scene === "line" && state.lines[0][1][0] === 8'],
  ['--line 0,0 8,3 8,3 2,9', 'state.lines.length === 2'],
  ['0,0 4,0 0,4 4,0 4,4 0,4', 'state.triangles.length === 2 && state.snap'],
  ['0.1,0.2 5.3,0.7 2,6.1 --exact', 'state.triangles[0][0].x === 0.1 && !state.snap'],
  // A fault is shown beside what is right.
  ['T2 --plant inclusive-edges',
    'state.by[0] === "inclusive-edges" && state.named === "T2" && document.querySelector("#look .say")?.textContent.includes("hit twice")'],
  // So large a window is cut to what the playground can show.
  ['T2 --window 0,0,300x20', 'state.triangles.length === 2 && view.shown.length === 2'],
];

export default {
  says: 'A case of the report page leads to the same corners in the playground, by its name or its places',
  page: 'playground',
  async check(tab) {
    const { file } = tab, here = folder();
    // A page leads to the playground only where that lies beside it.
    fs.mkdirSync(path.join(here, 'target/rasterproof'), { recursive: true });
    fs.writeFileSync(path.join(here, 'target/rasterproof/playground.html'), '');
    for (const [words, shown] of CASES) {
      const made = run(`inspect --report ${words}`, here);
      assert.equal(made.status, words.includes('--plant') ? 1 : 0, made.errors);
      await tab.open('', reportOf('inspect', made));
      assert.equal(await tab.value('document.querySelector("#case-playground").hidden'), false);
      const link = await tab.value('document.querySelector("#case-playground a").getAttribute("href")');
      assert(link.startsWith('playground.html'), link);
      tab.file = file;
      await show(tab, link.slice('playground.html'.length));
      assert.equal(await tab.value(shown), true, `${words}: ${link}`);
      assert.equal(await isTroubled(tab), false, words);
    }
  },
};
