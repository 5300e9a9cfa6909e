import assert from 'node:assert/strict';

import { violationsOf, withAxe } from '../driver/axe.mjs';
import { inSite, none } from '../driver/site.mjs';

/** For the page: a live figure comes into view. */
const SCROLL = 'document.querySelector("rp-figure").scrollIntoView({ block: "center", behavior: "instant" })';

/** What a reader may do on a page of a book, and how the page shows that it was done. */
const ACTIONS = [
  ['document.getElementById("mdbook-sidebar-toggle").click()',
    'document.getElementById("mdbook-sidebar").getBoundingClientRect().left === 0'],
  ['document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "?", bubbles: true }))',
    'document.getElementById("mdbook-help-container").style.display === "flex"'],
  ['document.querySelector(".clip-button").focus()', 'getComputedStyle(document.querySelector(".buttons:focus-within")).opacity === "1"'],
  ['document.querySelector(".checkbox-img").click()', 'true'],
  ['null', `(${SCROLL}, document.querySelector("rp-figure").shadowRoot.querySelector(".controls").childElementCount > 0)`],
  // With the engines: it is answered, and can be dragged.
  [`(async () => { ${SCROLL}; await document.querySelector("rp-figure").reveal(""); })()`,
    'document.querySelector("rp-figure").shadowRoot.querySelector("[role=slider]") !== null'],
];

export default {
  says: 'The contents, the help, the button that copies, an enlarged picture and a live figure follow the rules of axe-core',
  page: 'nothing',
  size: [360, 740],
  async check(tab) {
    await withAxe(tab);
    const wrong = [];
    for (const [i, [action, done]] of ACTIONS.entries()) {
      await tab.go(inSite(`${['en', 'zh'][i % 2]}/ch01.html`));
      await tab.value(`(async () => { await ${action}; return 0; })()`);
      await tab.when(done);
      wrong.push(...await violationsOf(tab, action));
    }
    assert.equal(ACTIONS.length, 6);
    none(wrong);
  },
};
