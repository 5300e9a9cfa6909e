import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { folder } from '../driver/program.mjs';
import { audit, VERDICT } from '../driver/report.mjs';

export default {
  says: 'The page evaluates the rule by itself, in exact arithmetic, for every pixel of every case, and sees a corner that was moved',
  page: VERDICT,
  async check(tab) {
    assert.deepEqual(await audit(tab), []);
    // A corner of T2 is moved by a subpixel to the right: samples on its right edge are inside now.
    const page = fs.readFileSync(tab.file, 'utf8'), parts = page.split('[1408,128],[1408,1408]]');
    assert.equal(parts.length, 2);
    const moved = path.join(folder(), 'index.html');
    fs.writeFileSync(moved, parts.join('[1409,128],[1408,1408]]'));
    await tab.open('#case-T2', moved);
    assert.deepEqual(await audit(tab), ['T2']);
    assert.match(await tab.text('#by-rule'), /says something else than the oracle/);
  },
};
