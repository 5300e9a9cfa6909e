import assert from 'node:assert/strict';

export default {
  says: 'The page of a review shows the picture that changed, and how',
  page: 'made review',
  async check(tab) {
    assert.match(await tab.text('#verdict'), /PENDING/);
    assert.equal(await tab.text('#case-title'), 'snapshots/verdict.snap');
    assert.equal(await tab.text('#case-about'), '1 of 559,989 pixels of the picture changed, from 20,30 to 20,30');
    await tab.press('3');
    assert.equal(await tab.value('document.querySelectorAll("rp-view .pixels").length'), 3);
  },
};
