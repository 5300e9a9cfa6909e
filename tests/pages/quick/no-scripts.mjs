import assert from 'node:assert/strict';
import { pathToFileURL } from 'node:url';

import { pageOf } from '../driver/program.mjs';

/** Pages, and what they show where scripts are switched off. */
const SHOWN = [
  ['your-gpu', 'noscript', 'scripts are switched off here'],
  ['playground', 'noscript', 'scripts are switched off here'],
  ['verify --cases 60 --plant inclusive-edges --report --json', 'noscript', 'The cases need JavaScript, which is off.'],
  ['verify --cases 60 --plant inclusive-edges --report --json', '#verdict', 'DISAGREES'],
];

export default {
  says: 'Without scripts each page says what it lacks, and a report still says its verdict',
  page: 'nothing',
  async check(tab) {
    await tab.call('Emulation.setScriptExecutionDisabled', { value: true });
    for (const [page, selector, says] of SHOWN) {
      await tab.call('Page.navigate', { url: pathToFileURL((await pageOf(page)).file).href });
      await tab.when('document.readyState === "complete" && location.protocol === "file:"');
      const [isSeen, text] = await tab.value((selector) => {
        const element = document.querySelector(selector);
        return [element.checkVisibility() && element.getBoundingClientRect().height > 0, element.textContent];
      }, selector);
      assert(isSeen && text.includes(says), `${page}: ${isSeen}, ${text}`);
    }
  },
};
