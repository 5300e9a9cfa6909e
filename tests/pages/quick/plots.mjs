import assert from 'node:assert/strict';

export default {
  says: 'A plot is drawn for the width of its page: wide, usual, and for a phone',
  page: 'made plots',
  async check(tab) {
    for (const [width, drawn] of [[1280, 1200], [900, 800], [360, 400]]) {
      await tab.resize(width, 800);
      await tab.when((drawn) => document.querySelector('.plot img').naturalWidth === drawn, drawn);
      await tab.fitsTheWidth();
      const shown = await tab.value('document.querySelector(".plot img").clientWidth');
      assert(shown > 0.8 * width, `${shown} of ${width} px`);
    }
  },
};
