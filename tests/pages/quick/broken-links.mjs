import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { folder } from '../driver/program.mjs';
import { brokenLinks } from '../driver/site.mjs';

const PAGE = `<h1 id="a"></h1><a href="b.html#a"></a><a href="#a"></a><a class=x
href="no.html"></a><script src="../c.js">'<a href="no.html">'</script><a href="https://example.org/"></a>`;
const FOUND = [
  ['<a href="b.html#b">', 'en/b.html: b.html#b'],
  ['<a href="c.html">', 'en/b.html: c.html'],
  ['<a href="../../c.js">', 'en/b.html: ../../c.js'],
  ['<img src="x.png">', 'en/b.html: x.png'],
  ['<img src="https://example.org/x.png">', 'en/b.html loads https://example.org/x.png'],
];

export default {
  says: 'A missing page, a missing anchor, a path out of the site, and what is loaded from elsewhere are found',
  page: 'nothing',
  async check() {
    const root = folder(), page = path.join(root, 'en/b.html');
    fs.mkdirSync(path.dirname(page));
    fs.writeFileSync(path.join(root, 'c.js'), '');
    const whole = PAGE.replace('<a class=x\nhref="no.html"></a>', '');
    fs.writeFileSync(page, whole);
    assert.deepEqual(brokenLinks(root), { count: 4, broken: [] });
    // An attribute may begin a line.
    fs.writeFileSync(page, PAGE);
    assert.deepEqual(brokenLinks(root), { count: 5, broken: ['en/b.html: no.html'] });
    for (const [link, found] of FOUND) {
      fs.writeFileSync(page, whole + link);
      assert.deepEqual(brokenLinks(root), { count: 5, broken: [found] });
    }
  },
};
