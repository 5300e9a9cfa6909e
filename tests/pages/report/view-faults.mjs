import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { folder } from '../driver/program.mjs';

// What is taken away from the viewer, or changed, so that one of its sentences is false.
const FAULTS = [
  ['if (isOther) this.seen = null;', ''],
  ['if (isOther) this.seen = null;', 'this.seen = null;'],
  ['    event.stopPropagation();\n', ''],
  ['held.moved ||= Math', 'held.moved = false && Math'],
  ['&& below > 1.3 * beside', '&& false'],
  ['if (byKeys) this.pan', 'if (false) this.pan'],
  ['const isLost = unit < 2 &&', 'const isLost = false &&'],
  ["this.classList.toggle('is-wide', this.isWide);", ''],
  ['this.at(box, { clientX: (a.clientX + b.clientX) / 2,', 'this.at(box, { clientX: 0,'],
  ['if (!panel || !(event.ctrlKey', 'if (!panel || !(true'],
  ['isFirst ? 0 : -1', 'isFirst ? 0 : 0'],
  ['    this.tellSoon();\n', ''],
  ['new ResizeObserver(() => this.resized()).observe(this.body);', ''],
];

export default {
  says: 'Each part that is taken away from the viewer makes a sentence of tests/pages/driver/viewer.js false',
  page: 'made view',
  async check(tab) {
    const page = fs.readFileSync(tab.file, 'utf8'), spoilt = path.join(folder(), 'index.html');
    for (const [part, fault] of FAULTS) {
      const parts = page.split(part);
      assert.equal(parts.length, 2, part);
      fs.writeFileSync(spoilt, parts.join(fault));
      await tab.open('', spoilt);
      const { wrong } = await tab.value('failing()');
      assert.notDeepEqual(wrong, [], `${part} becomes ${fault}`);
    }
  },
};
