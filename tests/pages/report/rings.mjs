import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { folder, reportOf, ROOT, run } from '../driver/program.mjs';

/** For the page: of each map its colours by the legend, and those of its pixels that the picture below it does not have, bright or dark. */
async function mapsOfPage() {
  const hex = (text) => `#${text.match(/\d+/g).map((byte) => Number(byte).toString(16).padStart(2, '0')).join('')}`;
  const [item] = items;
  const coloursOf = ({ pixels: { data, width, height } }) =>
    new Set(Array.from({ length: width * height }, (_, i) => `#${[0, 1, 2].map((c) => data[4 * i + c].toString(16).padStart(2, '0')).join('')}`));
  const usual = [...coloursOf(item.layers[0])];
  const dark = usual.map((colour) => `#${[1, 3, 5].map((at) => (parseInt(colour.slice(at, at + 2), 16) >> 1).toString(16).padStart(2, '0')).join('')}`);
  const maps = {};
  for (const [i, layer] of item.layers.entries()) {
    if (!layer.is_map) continue;
    Object.assign(state, { a: 0, b: i });
    pairChanged();
    const legend = [...document.querySelectorAll('.legend li')].map((li) => [hex(getComputedStyle(li.firstChild).backgroundColor), li.textContent]);
    maps[layer.label] = { legend: Object.fromEntries(legend), seen: [...coloursOf(layer)].filter((colour) => ![...usual, ...dark].includes(colour)) };
  }
  return maps;
}

export default {
  says: 'The page of a study says what each colour of its maps means, rings included, and leads to the pages of the docs that it names',
  page: 'nothing',
  async check(tab) {
    // In a folder that has the docs beside it, as a checkout has.
    const here = folder();
    fs.mkdirSync(path.join(here, 'docs'));
    for (const name of ['index.md', 'study.md', 'ties.md']) fs.writeFileSync(path.join(here, 'docs', name), '');
    const printed = run(['study', path.join(ROOT, 'tests/transcripts/hard-cases/box.obj'), '--once', '--size', '64x48', '--report'], here);
    assert.equal(printed.status, 0, printed.errors);
    const file = reportOf('study', printed), page = fs.readFileSync(file, 'utf8');
    await tab.open('', file);
    // A model that is fine is not called wrong because its view has hard cases.
    assert.doesNotMatch(await tab.text('header'), /\u2717|hard cases$/i);
    assert.equal(await tab.value('document.querySelector(".verdict.bad")'), null);
    const maps = await tab.value(mapsOfPage);
    assert.deepEqual(Object.keys(maps), ['hard cases', 'decided']);
    for (const [name, { legend, seen }] of Object.entries(maps)) {
      assert(seen.length > 1, `${name}: ${seen}`);
      assert.deepEqual(seen.filter((colour) => !(colour in legend)), [], name);
    }
    const ring = Object.entries(maps['hard cases'].legend).find(([, says]) => says.includes('stands alone'))[0];
    assert(maps['hard cases'].seen.includes(ring), 'the ring has its own colour');
    const named = await tab.value('[...document.querySelectorAll("main a[href*=docs]")].map(link => [link.textContent, decodeURI(new URL(link.href).pathname)])');
    assert.deepEqual(named, [['a study of your own model', path.join(here, 'docs/study.md')], ['docs/ties.md', path.join(here, 'docs/ties.md')]]);
    // A text that names a colour is not needed, and was wrong before.
    assert.doesNotMatch(page.replace(/<script[^]*?<\/script>|<style[^]*?<\/style>/g, ''), /\b(yellow|orange|violet)\b/);
  },
};
