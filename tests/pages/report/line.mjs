import assert from 'node:assert/strict';

import { VERDICT } from '../driver/report.mjs';

export default {
  says: 'A pixel of a line says that it is halfway, and rows are a table for whoever does not see the canvas',
  page: `${VERDICT} #case-L4&px=5,0`,
  async check(tab) {
    assert.match(await tab.text('#about-pixel'), /1\/2 px off the line in y, a tie/);
    await tab.value('(document.querySelector("#rows").open = true)');
    await tab.when('document.querySelectorAll("#rows tbody tr").length === 3');
  },
};
