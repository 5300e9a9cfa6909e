import assert from 'node:assert/strict';

export default {
  says: 'In the playground a figure has its grips, which keys move, and its second picture is drawn by whoever is chosen',
  page: 'playground #scene=figure&figure=edge-sign&lang=en',
  async check(tab) {
    // The panels are drawn in the frame after the state is taken.
    await tab.when('state.at === "[[1.5,5.5],[7.5,1.5]]" && view.shown[0]?.grips.length === 2');
    await tab.value('view.shown[0].grips[1].focus()');
    await tab.press('ArrowLeft');
    await tab.when('state.at === "[[1.5,5.5],[7,1.5]]"');
    const says = (text) => tab.when((text) => document.querySelectorAll('figcaption output')[1]?.textContent === text, text);
    await says('the same picture');
    await tab.value('(addressLater(() => {}, 0), location.hash = "#scene=figure&at=[[3.5,3.5]]&by=scanline,inclusive-edges&lang=en", 0)');
    await says('another picture');
    assert.equal(await tab.value('state.scene'), 'figure');
  },
};
