import assert from 'node:assert/strict';

import { VERDICT } from '../driver/report.mjs';

/** For the page: of places all over the picture, wherever the page is scrolled to, those in the window that something else covers. */
async function covered() {
  const frame = document.querySelector('rp-view .frame'), found = [];
  let count = 0;
  for (let top = 0; top < 700; top += 100) {
    scrollTo({ top, behavior: 'instant' });
    await new Promise(requestAnimationFrame);
    const box = frame.getBoundingClientRect();
    for (const [right, down] of [0.1, 0.5, 0.9].flatMap((x) => [0.05, 0.35, 0.65, 0.95].map((y) => [x, y]))) {
      const [x, y] = [box.left + right * box.width, box.top + down * box.height];
      if (y < 0 || y >= innerHeight) continue;
      count += 1;
      const there = document.elementFromPoint(x, y);
      if (!frame.contains(there)) found.push(`${there?.id || there?.nodeName} over ${right}, ${down} at ${top}`);
    }
  }
  return { count, found };
}

export default {
  says: 'On a phone nothing covers the picture of a case, wherever one reads; a bar that stays at the top is seen to',
  page: VERDICT,
  size: [360, 740],
  async check(tab) {
    const { count, found } = await tab.value(covered);
    assert(count > 30, `${count} places`);
    assert.deepEqual(found, []);
    await tab.value(() => { document.head.append(Object.assign(document.createElement('style'), { textContent: '#controls { order: 0; position: sticky; top: 0; }' })); });
    assert.notDeepEqual((await tab.value(covered)).found, []);
  },
};
