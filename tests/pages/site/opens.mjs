import fs from 'node:fs';

import { SITE } from '../driver/program.mjs';
import { inSite, none, opened } from '../driver/site.mjs';

/** What a reader loads before the first view is complete, pictures and scripts included, the compiled engines not. */
const FIRST_VIEW_BYTES = 300_000;

/** Where the links at the head of a page of a book lead. */
const wanted = (page) => {
  const other = page.startsWith('en/') ? page.replace('en/', 'zh/') : page.replace('zh/', 'en/');
  return ['try/playground.html', 'try/your-gpu.html', other].map(inSite).join();
};

export default {
  says: 'Every page opens at 360 and 1280 pixels without a complaint, cuts no table at the latter, loads little and nothing from elsewhere, and leads to its other language',
  page: 'nothing',
  async check(tab) {
    const wrong = [];
    let heaviest = { weight: 0 };
    for (const page of opened()) {
      await tab.resize(360, 740);
      await tab.go(inSite(page));
      // mdBook's text scrolls inside its own element, so the document alone would never be too wide.
      const excess = await tab.value(() => Math.max(...[document.documentElement, document.getElementById('mdbook-content')]
        .map((element) => (element ? element.scrollWidth - element.clientWidth : 0))));
      if (excess !== 0) wrong.push(`${page} is ${excess} pixels too wide for a screen of 360`);
      const loaded = new Set(await tab.value(() => [location, ...performance.getEntriesByType('resource').map(({ name }) => new URL(name))]
        .map((url) => (url.protocol === 'file:' ? decodeURI(url.pathname) : url.href))));
      const foreign = [...loaded].filter((file) => !file.startsWith(`${SITE}/`) && !file.startsWith('data:'));
      wrong.push(...foreign.map((file) => `${page} loads ${file}`));
      const isBook = /^(en|zh)\//.test(page);
      const weighed = [...loaded].filter((file) => !file.endsWith('/engines.js') && fs.existsSync(file));
      const weight = weighed.reduce((sum, file) => sum + fs.statSync(file).size, 0);
      if (isBook && weight > heaviest.weight) heaviest = { weight, page };
      await tab.resize(1280, 900);
      const cut = await tab.value(() => Math.max(0, ...[...document.querySelectorAll('.table-wrapper')].map((table) => table.scrollWidth - table.clientWidth)));
      if (cut > 0) wrong.push(`${page} cuts ${cut} pixels of a table at 1280`);
      wrong.push(...tab.complaints.splice(0).map((complaint) => `${page}: ${complaint}`));
      const others = await tab.value(() => [...document.querySelectorAll('.site-links a')].filter((link) => link.offsetWidth)
        .map((link) => link.href.replace(/^file:..|#.*/g, '')).join());
      if (isBook && !page.endsWith('/toc.html') && others !== wanted(page)) wrong.push(`${page} leads to ${others}`);
    }
    console.log(`${opened().length} pages; the heaviest first view: ${heaviest.weight} bytes, ${heaviest.page}`);
    if (heaviest.weight > FIRST_VIEW_BYTES) wrong.push(`the first view of ${heaviest.page} is ${heaviest.weight} bytes`);
    none(wrong);
  },
};
