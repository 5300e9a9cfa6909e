import assert from 'node:assert/strict';

import { hover } from '../driver/report.mjs';

// What a name must not be able to do.
const HOSTILE = `</script><img src=x onerror="document.title='broken into'">&{{data}}'`;

export default {
  says: 'Every section of a report shows any text as it is, and pictures are in the viewer with their difference',
  page: 'made every-section',
  async check(tab) {
    for (const selector of ['h1', '#verdict strong', '#run .command code', '.counts tbody th', '#case-title', '.diff h3']) {
      assert.equal(await tab.text(selector), HOSTILE, selector);
    }
    const title = await tab.value('document.title');
    assert(title.startsWith(HOSTILE), title);
    assert.equal(await tab.value('document.querySelector("#plots img").naturalWidth'), 60);
    assert.equal(await tab.text('.diff .added pre'), HOSTILE);
    assert.equal(await tab.text('.diff .removed pre'), 'old');
    await tab.resize(400, 800);
    await tab.fitsTheWidth();
    await tab.resize(1280, 900);
    assert.equal(await tab.text('#agreement'), 'A and B differ in 1 pixel of 35.');
    await hover(tab, 4, 2);
    assert.match(await tab.text('#about-pixel'), /A #0a141e, B #c8141e: different/);
    await tab.press('3');
    assert.equal(await tab.value('document.querySelectorAll("rp-view .pixels").length'), 3);
  },
};
