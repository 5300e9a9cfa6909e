import assert from 'node:assert/strict';

export default {
  says: 'A plot fills the window and leaves it again',
  page: 'made marks',
  async check(tab) {
    const isWide = () => tab.value('document.querySelector(".plot img").getBoundingClientRect().width > 0.9 * innerWidth');
    assert.equal(await isWide(), false);
    await tab.click('.plot button');
    assert.equal(await isWide(), true);
    await tab.press('Escape');
    assert.equal(await isWide(), false);
  },
};
