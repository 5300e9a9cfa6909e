import { inTurn, unfold, violationsOf, withAxe } from '../driver/axe.mjs';
import { SCENES } from '../driver/playground.mjs';
import { inSite, none } from '../driver/site.mjs';

export default {
  says: 'Every scene of the playground follows the rules of axe-core, snapped and not, with everything on it that opens',
  page: 'nothing',
  async check(tab) {
    await withAxe(tab);
    const wrong = [], nextView = inTurn(tab);
    for (const [scene, snap] of SCENES.flatMap((scene) => [[scene, true], [scene, false]])) {
      const view = await nextView();
      await tab.open(`#scene=${scene}&lang=${snap ? 'zh' : 'en'}`, inSite('try/playground.html'));
      // Corners that are not snapped are those of one scene.
      await tab.value(`(state.snap &&= ${snap} || state.scene !== 'triangle', redraw(), 0)`);
      await tab.settle();
      await tab.value('(lookAt(6, 6), 0)');
      await tab.settle();
      await unfold(tab);
      wrong.push(...await violationsOf(tab, `${scene}, ${view}`));
    }
    none(wrong);
  },
};
