import { inTurn, unfold, violationsOf, withAxe } from '../driver/axe.mjs';
import { rows, SWIFTSHADER } from '../driver/gpu.mjs';
import { inSite, none } from '../driver/site.mjs';

export default {
  says: 'The page for GPUs follows the rules of axe-core in both languages, with a finding on it',
  page: 'nothing',
  options: SWIFTSHADER,
  async check(tab) {
    await withAxe(tab);
    const wrong = [], nextView = inTurn(tab);
    for (const language of ['en', 'zh']) {
      await tab.open(`#lang=${language}`, inSite('try/your-gpu.html'));
      await rows(tab, 'nudged', { only: [['coverage', 0], ['twice', 0]], bits: 4 });
      await tab.click('[data-check=coverage] button');
      await unfold(tab);
      for (let i = 0; i < 2; i += 1) {
        const view = await nextView();
        wrong.push(...await violationsOf(tab, `${language}, ${view}`));
      }
    }
    none(wrong);
  },
};
