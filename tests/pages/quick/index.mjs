import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { run } from '../driver/program.mjs';

export default {
  says: 'Each command has a page of its own, and the index lists them; a folder that has another index keeps it; two reports of one kind have different titles',
  page: 'plan --scene panels --size 64x48 --rounds 1 --report',
  async check(tab) {
    const folder = path.dirname(tab.file), read = (name) => fs.readFileSync(path.join(folder, name), 'utf8');
    const plan = read('plan.html');
    assert(plan.includes('the material has no texture') && plan.includes('second-buffer'));
    assert.match(run('render cube --size 64x48 --report --out .', folder).errors, /report: \.\/render\.html/);
    assert(read('render.html').includes('rasterproof render cube --size 64x48 --report --out .'));
    const index = read('index.html');
    for (const part of ['href="plan.html"', 'href="render.html"', 'AGREES: scanline and edge-function']) {
      assert(index.includes(part), `${part}: ${index}`);
    }
    fs.mkdirSync(path.join(folder, 'other'));
    fs.writeFileSync(path.join(folder, 'other/index.html'), 'mine');
    run('render cube --size 64x48 --report --out other', folder);
    assert.equal(read('other/index.html'), 'mine');
    assert(['render.html', 'cube.png'].every((name) => fs.existsSync(path.join(folder, 'other', name))));
    run('render cube --size 32x24 --report --out other', folder);
    const [title, other] = ['render.html', 'other/render.html'].map((name) => read(name).match(/<title>([^]*?)<\/title>/)[1]);
    assert.notEqual(title, other);
  },
};
