import assert from 'node:assert/strict';

export default {
  says: 'On paper nothing blinks, and no tool is printed',
  page: 'made marks #case-one&mode=blink',
  async check(tab) {
    await tab.call('Emulation.setEmulatedMedia', { media: 'print' });
    await tab.value('dispatchEvent(new Event("beforeprint"))');
    assert.equal(await tab.value('document.querySelector("rp-view").shown.length'), 2);
    const tools = await tab.value(
      '[...document.querySelectorAll("button, select")].filter(e => e.checkVisibility() && !e.querySelector("img")).map(e => e.outerHTML)');
    assert.deepEqual(tools, []);
  },
};
