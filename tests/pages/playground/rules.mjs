import assert from 'node:assert/strict';

const RULES = [
  ['strict', '22 missing', 'hole'],
  ['inclusive', '16 too many, 9 hit twice', 'hit twice'],
  ['tl', 'as the oracle', 'hit once'],
];

export default {
  says: 'The strict rule leaves holes along the diagonal, the inclusive one hits twice, and the page says why; both are shown against each other',
  page: 'playground #lang=en',
  async check(tab) {
    await tab.settle();
    for (const [rule, says, why] of RULES) {
      await tab.click(`#rule-${rule}`);
      await tab.settle();
      const verdict = await tab.text('rp-view figure:nth-child(2) output');
      assert(verdict.includes(says), `${rule}: ${verdict}`);
      assert((await tab.text('#look .say')).includes(why), rule);
    }
    await tab.value('(state.by[1] = "exclusive-edges", document.querySelector("[data-state=difference]").click())');
    await tab.settle();
    assert.equal(await tab.text('rp-view figure:nth-child(3) output'), '22 pixels differ');
  },
};
