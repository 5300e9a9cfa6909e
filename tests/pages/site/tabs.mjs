import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { ROOT } from '../driver/program.mjs';
import { inSite } from '../driver/site.mjs';

// The tab of Rust is open first.
const TABS = [[1, 'Python', 'def stage1('], [2, 'C++', 'void stage1('], [0, 'Rust', 'fn stage1(']];

export default {
  says: 'The code of each stage in Python and C++, to which the page of the repository links, stands in tabs beside that in Rust',
  page: 'nothing',
  async check(tab) {
    const own = fs.readFileSync(path.join(ROOT, 'docs/own.md'), 'utf8');
    const stages = own.split('\nPython: [').length - 1;
    for (const [book, width] of [['en', 360], ['zh', 1280]]) {
      await tab.resize(width, 800);
      await tab.go(inSite(`${book}/own.html`));
      assert.equal(await tab.value('document.querySelectorAll("main .tabs").length'), stages);
      for (const [at, language, code] of TABS) {
        const one = `document.querySelector("main .tabs").children[${at}]`;
        await tab.value(`${one}.firstElementChild.click()`);
        await tab.when(`document.querySelector("main .tabs > [open]") === ${one}`);
        const text = await tab.value(`${one}.innerText`);
        assert.ok(text.startsWith(language) && text.includes(code), `${book}: ${text}`);
      }
    }
  },
};
