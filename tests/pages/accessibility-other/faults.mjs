import assert from 'node:assert/strict';

import { violationsOf, withAxe } from '../driver/axe.mjs';
import { inSite } from '../driver/site.mjs';

/** A fault of a page, and the rule that it breaks. */
const FAULTS = [
  ['scrollable-region-focusable', 'watcher.disconnect(); document.querySelector("pre > [tabindex]").removeAttribute("tabindex")'],
  ['empty-table-header', 'document.querySelector("main th").textContent = ""'],
  ['color-contrast', 'document.querySelector("main p").style.color = "#888"'],
  ['color-contrast', 'document.querySelector("pre .hljs-keyword").style.color = "#888"'],
  ['aria-prohibited-attr', 'document.querySelector("main p").append(document.createElement("i")); document.querySelector("main p i").ariaLabel = "text"'],
  ['aria-allowed-attr', 'document.querySelector(".checkbox-label").ariaExpanded = "false"'],
  ['label-content-name-mismatch', 'document.querySelector(".site-links a").ariaLabel = "elsewhere"'],
  ['image-alt', 'document.querySelector("main").append(new Image(9, 9))'],
  ['region', 'document.body.insertAdjacentHTML("beforeend", "<p>outside</p>")'],
];

export default {
  says: 'Each of nine faults of a page breaks its rule of axe-core and no other',
  page: 'nothing',
  size: [360, 740],
  async check(tab) {
    await withAxe(tab);
    const found = async (fault) => {
      await tab.go(inSite('en/games101.html'));
      await tab.value(`(() => { ${fault}; })()`);
      return (await violationsOf(tab, '')).map((line) => line.split(': ')[1]);
    };
    assert.deepEqual(await found('null'), []);
    for (const [rule, fault] of FAULTS) {
      const rules = await found(fault);
      assert(rules.length > 0 && rules.every((found) => found === rule), `${fault}: ${rules}`);
    }
  },
};
