import assert from 'node:assert/strict';

import { pageOf } from '../driver/program.mjs';

/** Names of colours in the texts of pages, and the marks that have them. No other name may stand there. */
const NAMES = { red: 'missing', 红: 'missing', orange: 'extra', 橙: 'extra', purple: 'twice', 紫: 'twice', grey: 'agrees', 灰: 'agrees' };
const OTHERS = ['yellow', '黄', 'violet', 'brown', 'green', '绿', 'pink'];
/** From which hue to which, in degrees. */
const HUES = { missing: [0, 15], extra: [25, 45], twice: [250, 285] };

/** For the page: every text that it has in a language, and the hue and the saturation of each mark. */
function look() {
  const texts = (value) => (typeof value === 'object' ? Object.values(value).map(texts).join('\n') : String(value));
  const hueOf = (name) => {
    const probe = document.body.appendChild(Object.assign(document.createElement('span'), { style: `color: var(--px-${name})` }));
    const [r, g, b] = getComputedStyle(probe).color.match(/\d+/g).map(Number), most = Math.max(r, g, b), range = most - Math.min(r, g, b);
    const sixth = most === r ? (g - b) / range : most === g ? 2 + (b - r) / range : 4 + (r - g) / range;
    return [(60 * sixth + 360) % 360, range / most];
  };
  return { en: texts(WORDS.en), zh: texts({ ...WORDS.zh, cases: '' }), hues: Object.fromEntries(['missing', 'extra', 'twice', 'agrees'].map((name) => [name, hueOf(name)])) };
}

export default {
  says: 'A text that names a colour of a mark names the colour that it has, on light and dark pages',
  page: 'playground',
  async check(tab) {
    let named = 0;
    for (const [page, scheme] of [['playground', 'light'], ['playground', 'dark'], ['your-gpu', 'light']]) {
      await tab.prefer('prefers-color-scheme', scheme);
      await tab.open('#lang=en', (await pageOf(page)).file);
      const { en, zh, hues } = await tab.value(look);
      const has = (name) => (/\w/.test(name) ? new RegExp(`\\b${name}\\b`, 'i').test(en) : zh.includes(name));
      assert.deepEqual(OTHERS.filter(has), [], page);
      for (const [name, mark] of Object.entries(NAMES).filter(([name]) => has(name))) {
        named += 1;
        const [hue, saturation] = hues[mark];
        if (mark === 'agrees') assert(saturation < 0.2, `${page}, ${scheme}: ${name} is ${saturation} full`);
        else assert(hue >= HUES[mark][0] && hue <= HUES[mark][1], `${page}, ${scheme}: ${name} has the hue ${hue}`);
      }
    }
    assert.equal(named, 16, 'four names in two languages, on two pages');
  },
};
