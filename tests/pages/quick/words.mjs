import assert from 'node:assert/strict';

export default {
  says: 'Both languages of the playground have the same words, and cases and families are told in Chinese, too',
  page: 'playground',
  async check(tab) {
    const [en, zh] = await tab.value('["en", "zh"].map(lang => [...Object.keys(WORDS[lang]), ...Object.keys(WORDS[lang].about)])');
    assert.deepEqual(en, zh);
    const unnamed = await tab.value(() => Object.entries(names)
      .flatMap(([list, all]) => (['recorded', 'figures'].includes(list) ? [] : all))
      .map(({ name }) => name).filter((name) => !WORDS.zh.cases[name]));
    assert.deepEqual(unnamed, []);
  },
};
