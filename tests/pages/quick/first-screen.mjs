import assert from 'node:assert/strict';

export default {
  says: 'The first screen shows the picture of the case, cropped, with numbers and corners, at any width',
  page: 'verify --cases 60 --plant inclusive-edges --report --json',
  async check(tab) {
    await tab.resize(360, 740);
    await tab.open();
    const share = await tab.value('document.querySelector("rp-view .frame").getBoundingClientRect().width / document.querySelector("main").clientWidth');
    assert(share > 0.8, `${share} of the width of a phone`);
    for (const [width, height] of [[1280, 900], [400, 850]]) {
      await tab.resize(width, height);
      await tab.open();
      await tab.fitsTheWidth();
      const box = (selector) => tab.value((selector) => {
        const { top, bottom, width } = document.querySelector(selector).getBoundingClientRect();
        return { top, bottom, width };
      }, selector);
      const frame = await box('rp-view .frame'), title = await box('#case-title');
      assert(frame.top > 0 && frame.bottom <= height && frame.width >= 150, `${width}: ${JSON.stringify(frame)}`);
      assert(title.bottom <= frame.top, 'its name stands over it');
      // Something is written on both axes.
      for (const axis of ['above', 'beside']) {
        const ink = await tab.value((axis) => {
          const canvas = document.querySelector(`.${axis}`);
          const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
          return data.filter((byte, i) => i % 4 === 3 && byte > 0).length;
        }, axis);
        assert(ink > 20, `${axis} at ${width}: ${ink}`);
      }
      const cell = await tab.value('Number(document.querySelector("rp-view").dataset.cell)');
      assert(cell >= 16, `${cell}`);
    }
    await tab.resize(1280, 900);
    const png = await tab.value('view.picture().toDataURL()');
    assert(png.startsWith('data:image/png;base64,') && png.length > 5000, `${png.length}`);
  },
};
