import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { folder } from '../driver/program.mjs';
import { inSite } from '../driver/site.mjs';

export default {
  says: "A server's page for an address that leads nowhere offers the page that was probably meant",
  page: 'nothing',
  async check(tab) {
    const root = folder(), url = (name) => pathToFileURL(path.join(root, name)).href;
    fs.mkdirSync(path.join(root, 'zh'));
    for (const [asked, offered] of [
      ['zh/edge-functions.html', 'zh/ch02-edge-functions.html'],
      ['tessellator.html', 'en/tessellators.html'],
      ['zh/qqq.html', null],
    ]) {
      fs.copyFileSync(inSite('404.html'), path.join(root, asked));
      await tab.go(path.join(root, asked));
      const near = await tab.value('document.getElementById("near").hidden ? null : document.querySelector("#near a").href');
      assert.equal(near, offered && url(offered), asked);
      assert.equal(await tab.value('document.querySelector(".to-book").href'), url('en/index.html'));
    }
  },
};
