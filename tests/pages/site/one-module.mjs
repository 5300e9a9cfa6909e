import assert from 'node:assert/strict';
import fs from 'node:fs';

import { attribute, inSite, names, tags } from '../driver/site.mjs';

/** The compiled engines, before a server compresses them. */
const MODULE_BYTES = 1_410_000;
/** As bytes, and in base64. */
const MARKS = ['\0asm\x01\0\0\0', 'AGFzbQEAAAA'];

export default {
  says: 'The engines are in the site once, for live figures and for the pages that ask them, and small enough',
  page: 'nothing',
  async check() {
    // A copy of the module is larger than most files.
    const large = names().filter((name) => fs.statSync(inSite(name)).size > 300_000);
    const modules = large.filter((name) => MARKS.some((mark) => fs.readFileSync(inSite(name)).includes(mark)));
    assert.deepEqual(modules, ['try/engines.js']);
    const bytes = Math.floor(fs.readFileSync(inSite('try/engines.js'), 'utf8').split('"')[1].length / 4) * 3;
    console.log(`the module: ${bytes} bytes`);
    assert(bytes <= MODULE_BYTES, `the module has ${bytes} bytes`);
    for (const page of ['playground', 'your-gpu']) {
      const loads = tags(fs.readFileSync(inSite(`try/${page}.html`), 'utf8')).map((tag) => attribute(tag, 'src'));
      assert.deepEqual(loads.filter((link) => link !== undefined), ['engines.js'], page);
    }
  },
};
