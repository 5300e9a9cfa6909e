import assert from 'node:assert/strict';

import { inSite } from '../driver/site.mjs';

export default {
  says: 'The keyboard is at the text after two keys, Escape closes the contents, and the other language is read on at the same heading',
  page: 'nothing',
  async check(tab) {
    for (const [book, says] of [['en', 'Skip to the text'], ['zh', '跳到正文']]) {
      await tab.go(inSite(`${book}/ch03.html`));
      await tab.press('Tab');
      assert.equal(await tab.value('document.activeElement.textContent'), says);
      await tab.press('Enter');
      await tab.when('document.activeElement.id === "text"');
    }
    await tab.value('document.querySelector("#mdbook-sidebar a").focus()');
    assert.equal(await tab.value('document.activeElement.closest("nav").id'), 'mdbook-sidebar');
    await tab.press('Escape');
    await tab.when('document.activeElement.id === "mdbook-sidebar-toggle"');

    await tab.go(inSite('en/ch03.html'));
    const heading = 'document.querySelectorAll("main h2")[3]';
    await tab.value(`${heading}.scrollIntoView({ behavior: 'instant' })`);
    await tab.draw();
    const other = await tab.value(`${heading}.dataset.other`);
    await tab.click('.site-links [rel=alternate]:not([hidden]).in-en');
    await tab.when('location.pathname.endsWith("/zh/ch03.html") && document.readyState === "complete"');
    assert.equal(await tab.value('decodeURI(location.hash)'), `#${other}`);
  },
};
