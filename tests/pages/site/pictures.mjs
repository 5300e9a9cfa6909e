import assert from 'node:assert/strict';

import { inSite } from '../driver/site.mjs';

export default {
  says: 'A picture that a phone shows smaller than three quarters of its size is enlarged by a press',
  page: 'nothing',
  size: [360, 740],
  async check(tab) {
    let small = 0;
    for (const page of ['en/ch02-edge-functions.html', 'en/effects.html', 'zh/ch06.html']) {
      await tab.go(inSite(page));
      const areEnlarged = await tab.value(() => [...document.querySelectorAll('main img')]
        .filter((image) => !image.closest('rp-figure, .img-wrapper') && image.width < 0.75 * image.getAttribute('width'))
        .map((image) => {
          image.click();
          const large = image.closest('label')?.querySelector('.img-wrapper img');
          const isLarge = Boolean(large?.checkVisibility()) && large.width > image.width;
          large?.click();
          return isLarge;
        }));
      assert(areEnlarged.every(Boolean), `${page}: ${areEnlarged}`);
      small += areEnlarged.length;
    }
    assert(small > 0, 'no picture is small');
  },
};
