// What checks of report pages have in common.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { ours, ROOT } from './program.mjs';

/** The page whose cases most checks are about. */
export const VERDICT = 'verify --cases 60 --seed 3 --report --json';

/** The cases in which the rule, computed by the page at every pixel, differs from the oracle. */
export const audit = (tab) => tab.value(() => items.filter((item) => item.isCase && byRule(item).hits.some((n, i) => n !== item.layers[item.oracle].hits[i]))
  .map(({ name }) => name));

export const namesListed = (tab) => tab.value('[...document.querySelectorAll("#list .name")].map(n => n.textContent)');

export const picture = (tab) => tab.value('document.querySelector("rp-view .pixels").toDataURL()');

export const data = (tab, name) => tab.value(`document.querySelector('rp-view').dataset.${name}`);

/** What the search is asked for, and the cases that are listed then. */
export async function search(tab, text) {
  await tab.value((text) => {
    const field = document.querySelector('#search');
    field.value = text;
    field.dispatchEvent(new Event('input', { bubbles: true }));
  }, text);
  return namesListed(tab);
}

/** Moves the mouse over the middle of a pixel of the first panel, counted from the window's corner. */
export async function hover(tab, x, y) {
  await tab.value('document.querySelector("rp-view .pixels").scrollIntoView()');
  await tab.draw();
  const spot = await tab.value((x, y) => {
    const view = document.querySelector('rp-view'), { left, top } = view.shown[0].canvas.getBoundingClientRect();
    const [x0, y0] = view.source.bounds;
    return [left + (x0 + x + 0.5 - view.seen[0]) * view.unit, top + (y0 + y + 0.5 - view.seen[1]) * view.unit];
  }, x, y);
  await tab.mouse('mouseMoved', spot);
}

export const thousands = (count) => count.toLocaleString('en-US');

/** Each count of the JSON stands in the page's tables. */
export async function countsEqualTheJson(tab, json) {
  const cells = await tab.value(() => [...document.querySelectorAll('table.counts')].flatMap((table) => {
    const heads = [...table.querySelectorAll('thead th')].map((head) => head.textContent);
    return [...table.querySelectorAll('tbody tr')].flatMap((row) => {
      const [name, ...texts] = [...row.children].map((cell) => cell.textContent.replace(/(\d),(?=\d{3})/g, '$1'));
      return texts.map((text, i) => [name, heads[i + 1], text.split(',')[0]]);
    });
  }));
  const shown = new Set(cells.map((cell) => cell.join(' | ')));
  const has = (...cell) => assert(shown.has(cell.join(' | ')), `${cell.join(' | ')} is not on the page`);
  let checked = 0;
  for (const { family, kind, cases, shapes, pixels, tie_cases: ties, pairs } of json.families) {
    has(family, 'cases', cases);
    has(family, kind === 'unsnapped' ? 'triangles off the grid' : kind, shapes);
    has(family, 'pixels', pixels);
    has(family, 'ties', `${Math.floor((100 * ties + Math.floor(cases / 2)) / cases)}%`);
    for (const { actual, target, tally } of pairs) {
      has(family, `${actual} : ${target}`, tally.missing + tally.extra + tally.twice + tally.order);
      checked += 1;
    }
  }
  assert(checked > 20, `${checked} pairs`);
}

/** Each place of the docs that a page leads to is there. */
export async function chaptersExist(tab) {
  const paths = await tab.value(() => {
    const { cases, frames } = JSON.parse(document.querySelector('#data').textContent);
    return [...new Set([...cases, ...frames].map((one) => one.chapter.path))];
  });
  assert(paths.length > 2, `${paths}`);
  for (const place of paths) {
    const [file, anchor] = place.split('#');
    assert(fs.existsSync(path.join(ROOT, 'docs', file)), place);
    assert(!anchor || (await ours({ anchors: `docs/${file}` })).includes(anchor), place);
  }
}
