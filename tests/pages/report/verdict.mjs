import assert from 'node:assert/strict';
import fs from 'node:fs';

import { reportOf, run } from '../driver/program.mjs';
import { chaptersExist, countsEqualTheJson, thousands, VERDICT } from '../driver/report.mjs';

export default {
  says: 'A verdict comes first, every count is that of the JSON, and a seed makes one page',
  page: VERDICT,
  async check(tab) {
    assert.equal(tab.printed.status, 0);
    const page = fs.readFileSync(tab.file, 'utf8');
    assert(page.length < 2_000_000 && page.length > 100_000, `${page.length} bytes`);
    assert(page === fs.readFileSync(reportOf('verify', run(VERDICT)), 'utf8'), 'a seed makes one page');
    const json = JSON.parse(tab.printed.out);
    const verdict = `${await tab.text('#verdict')} ${await tab.text('#counts')}`;
    for (const part of ['AGREES', ', 0 wrong pixels', `${thousands(json.triangles)} triangles and `]) {
      assert(verdict.includes(part), `${part}: ${verdict}`);
    }
    await countsEqualTheJson(tab, json);
    await chaptersExist(tab);
  },
};
