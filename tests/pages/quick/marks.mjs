import assert from 'node:assert/strict';

export default {
  says: 'Marks of another picture are not compared with it, and the page says what their colours mean',
  page: 'made marks #case-one&mode=side',
  async check(tab) {
    assert.equal(await tab.value('document.querySelector("rp-view").shown.length'), 2, 'no difference, which would be a red sheet');
    const legend = await tab.value(
      '[...document.querySelectorAll(".legend li")].map(li => [li.textContent, getComputedStyle(li.firstChild).backgroundColor])');
    assert.deepEqual(legend, [['where it is wrong', 'rgb(200, 20, 30)']]);
  },
};
