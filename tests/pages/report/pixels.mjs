import assert from 'node:assert/strict';

import { hover, VERDICT } from '../driver/report.mjs';

export default {
  says: 'A pixel that is pointed at explains itself: hits, spans, the three edges and the rule; the keyboard moves on',
  page: `${VERDICT} #case-T2&mode=slider&a=games101-strict&b=sysu-inclusive`,
  async check(tab) {
    // The sample of (3, 3) lies on the diagonal that both triangles of T2 share.
    await hover(tab, 3, 3);
    assert.equal(await tab.text('#about-pixel h4'), 'Pixel 3, 3');
    const hits = await tab.text('#pixel-hits');
    assert.match(hits, /^A games101-strict.* 0 hits; B sysu-inclusive.* 2 hits; oracle 1 hit; a tie/);
    const span = await tab.text('#pixel-span');
    assert(span.includes('row 3') && span.includes('A none; B columns 0 to 5 (6 px)'), span);
    // By hand: 256 subpixels a pixel, legs of five pixels, (3, 3) two pixels from the right leg and three from the upper one.
    const edges = await tab.text('#about-pixel .edges tbody');
    for (const value of [5 * 256 * 3 * 256, 5 * 256 * 2 * 256, 0]) assert(edges.includes(value.toLocaleString('en')), `${value}: ${edges}`);
    const [upper] = await tab.value(() => [...document.querySelectorAll('#about-pixel .edges')].map((table) =>
      [...table.querySelectorAll('tbody tr')].map((row) => [row.children[2].textContent, row.children[3].textContent])));
    assert.deepEqual(upper, [
      ['inside', 'top edge: keeps it'],
      ['inside', 'right edge: leaves it'],
      ['exactly on this edge', 'left edge: keeps it'],
    ]);
    // The same sentences as in the playground: of both rules that are shown, and of the right one.
    const why = await tab.value('[...document.querySelectorAll("#about-pixel .say")].map(p => p.textContent)');
    const begin = [
      'The sample lies exactly on the edge that two triangles share: E = 0 for both. Strict',
      'The sample lies exactly on the edge that two triangles share: E = 0 for both. Inclusive',
      'The top-left rule: a sample on an edge',
    ];
    assert.deepEqual(why.map((text, i) => text.slice(0, begin[i]?.length)), begin);
    // The live region follows the keyboard.
    await tab.value('document.querySelector("rp-view .pixels").focus()');
    await tab.press('ArrowRight');
    assert.equal(await tab.text('#about-pixel h4'), 'Pixel 4, 3');
    await tab.when('document.querySelector("#announce").textContent.startsWith("pixel 4, 3: ")');
    await tab.when('location.hash.endsWith("px=4,3")');
  },
};
