import assert from 'node:assert/strict';

export default {
  says: 'The sentences of tests/pages/driver/viewer.js are true of the viewer, light and dark',
  page: 'made view',
  async check(tab) {
    for (const scheme of ['light', 'dark']) {
      await tab.prefer('prefers-color-scheme', scheme);
      await tab.open();
      const { wrong, count } = await tab.value('failing()');
      assert.deepEqual(wrong, [], scheme);
      assert(count >= 15, `${count} sentences`);
    }
  },
};
