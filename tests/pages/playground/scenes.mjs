import assert from 'node:assert/strict';

import { isTroubled, SCENES, show } from '../driver/playground.mjs';

export default {
  says: 'Every scene opens in both languages, light and dark, wide and narrow, by its address alone, which leads back to it',
  page: 'playground',
  async check(tab) {
    for (const [scene, lang, scheme] of SCENES.flatMap((scene) => [[scene, 'en', 'light'], [scene, 'zh', 'dark']])) {
      await tab.prefer('prefers-color-scheme', scheme);
      await show(tab, `#scene=${scene}&lang=${lang}`);
      const shown = await tab.value('[state.scene, state.lang, view.shown.length > 0, last.answer.error ?? null]');
      assert.deepEqual(shown, [scene, lang, true, null]);
      assert.equal(await isTroubled(tab), false);
      for (const width of [1280, 400]) {
        await tab.resize(width, 900);
        await tab.settle();
        const wide = await tab.value('document.documentElement.scrollWidth');
        assert(wide <= width, `${scene}: ${wide} px wide in a window of ${width}`);
      }
      const isSame = await tab.value(() => {
        const now = JSON.stringify(scene().ask());
        restore(address());
        return JSON.stringify(scene().ask()) === now;
      });
      assert(isSame, scene);
    }
  },
};
