import assert from 'node:assert/strict';

import { SWIFTSHADER } from '../driver/gpu.mjs';

export default {
  says: 'An address that holds no case says so, and the page is no wider than its window',
  page: 'your-gpu',
  options: SWIFTSHADER,
  async check(tab) {
    for (const bad of ['%5B%5D', 'nothing', '%5B%5B%5B1%5D%5D%5D', '%5B%5B%5B1e9%2C0%2C0%2C0%2C0%2C0%5D%5D%5D']) {
      await tab.open(`#interface=webgl2&check=coverage&case=${bad}&lang=en`);
      await tab.when('document.querySelector("#one .outside") !== null');
      assert((await tab.text('#one')).includes('no case that can be drawn'), bad);
    }
    for (const width of [1280, 360]) {
      await tab.resize(width, 900);
      const wide = await tab.value('document.documentElement.scrollWidth');
      assert(wide <= width, `${wide} px wide in a window of ${width}`);
    }
  },
};
