import assert from 'node:assert/strict';

import { data } from '../driver/report.mjs';

export default {
  says: 'A frame is shown as it is where it has room',
  page: 'render cube --report',
  async check(tab) {
    for (const height of [720, 900]) {
      await tab.resize(1280, height);
      await tab.open();
      assert.equal(await data(tab, 'cell'), '1');
    }
  },
};
